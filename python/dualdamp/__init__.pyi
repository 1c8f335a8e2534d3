# Written by scripts/lib/python_stubs.py from the tables of the format.
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, TypeAlias, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

# A text with its unit, or an SI number.
Quantity: TypeAlias = str | float
Grid: TypeAlias = Sequence[Quantity] | NDArray[np.floating[Any]] | Mapping[str, Any]
Path: TypeAlias = str | os.PathLike[str]
Progress: TypeAlias = Callable[[int, int], object] | bool
Scenario: TypeAlias = Mapping[str, Any] | str | os.PathLike[str]

__version__: str

class Diagnostic:
    message: str
    file: str
    line: int
    column: int
    text: str
    allowed: str
    found: str
    suggestion: str

class DualdampError(Exception): ...

class InvalidScenario(DualdampError, ValueError):
    diagnostics: tuple[Diagnostic, ...]

class NumericalFailure(DualdampError, ArithmeticError):
    result: Result | None

class CheckFailed(DualdampError, AssertionError):
    result: Result

class OutputError(DualdampError, OSError): ...
class IncompleteResult(UserWarning): ...

class Record(dict[str, Any]):
    def __getattr__(self, name: str) -> Any: ...

class Result:
    @property
    def result(self) -> Record: ...
    @property
    def tables(self) -> dict[str, NDArray[Any]]: ...
    @property
    def units(self) -> dict[str, dict[str, str]]: ...
    @property
    def analysis(self) -> str: ...
    @property
    def scenario(self) -> Record: ...
    @property
    def status(self) -> int: ...
    @property
    def failure(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def checks(self) -> list[Record]: ...
    @property
    def document(self) -> Record: ...
    def columns(self, table: str) -> dict[str, Any]: ...
    def save(self, directory: Path) -> list[str]: ...
    def report(self) -> str: ...
    def to_pandas(self, table: str | None = None) -> Any: ...
    def plot(self, table: str | None = None, ax: Any = None) -> Any: ...
    # The values and lists of the result, which differ from analysis to analysis.
    def __getattr__(self, name: str) -> Any: ...

class SteadyStates:
    peak: Any
    trough: Any
    phase: Any
    multiplier: Any
    stops: Any
    @property
    def amplitude(self) -> Any: ...
    @property
    def outcome(self) -> Any: ...
    @property
    def shape(self) -> tuple[int, ...]: ...
    def to_pandas(self) -> Any: ...

class Instant:
    t: float
    x: float
    v: float
    direction: int
    def limit(self, nominal: float) -> float: ...

class Parameter:
    unit: str
    meaning: str

_Kind = TypeVar("_Kind", bound=type)

def parameter(
    unit: str,
    meaning: str,
    *,
    above: float | None = None,
    at_least: float | None = None,
    at_most: float | None = None,
    default: float | None = None,
    is_limit: bool = False,
) -> Parameter: ...
def friction_law(kind: _Kind) -> _Kind: ...
def compile_law(source: str | os.PathLike[str], *, compiler: str | None = None) -> None: ...
def include_directory() -> str: ...

class Law:
    def replace(self, **parameters: Any) -> Law: ...
    def to_dict(self) -> dict[str, Any]: ...
    def __getattr__(self, name: str) -> Any: ...

class Excitation:
    def replace(self, **keys: Any) -> Excitation: ...
    def to_dict(self) -> dict[str, Any]: ...
    def __getattr__(self, name: str) -> Any: ...

def run(
    scenario: Scenario,
    changes: Mapping[str, Any] | None = None,
    *,
    out: Path | None = None,
    threads: int = 0,
    resume: bool = False,
    overwrite: bool = False,
    verify: bool = False,
    progress: Progress | None = None,
) -> Result: ...
def check(scenario: Scenario, changes: Mapping[str, Any] | None = None) -> str: ...
def load_plugin(path: Path) -> None: ...

class Case:
    number: int
    mass: float
    stiffness: float
    frequency: float
    sigma_x: float
    sigma_Y: float
    record: NDArray[Any]
    decay: NDArray[Any] | None
    random: NDArray[Any] | None
    def identify(self, **options: Any) -> Result: ...

def benchmark(
    scenario: Scenario,
    methods: Mapping[str, Callable[[Case], Mapping[str, Any] | None]],
    *,
    changes: Mapping[str, Any] | None = None,
    seed: int | None = None,
    out: Path | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Result: ...
def stress_export(
    scenario: Scenario,
    directory: Path,
    *,
    changes: Mapping[str, Any] | None = None,
    seed: int | None = None,
    threads: int = 0,
    overwrite: bool = False,
) -> int: ...
def cases(directory: Path) -> Iterator[Case]: ...
def stress_score(
    scenario: Scenario,
    key: Path,
    answers: Mapping[str, Any],
    *,
    changes: Mapping[str, Any] | None = None,
    out: Path | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Result: ...
@overload
def quantity(values: float, unit: str) -> str: ...
@overload
def quantity(values: Sequence[float] | NDArray[Any], unit: str) -> list[str]: ...
@overload
def steady_state(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> Result: ...
@overload
def steady_state(
    *,
    mass: ArrayLike,
    stiffness: ArrayLike,
    F0: ArrayLike,
    damping: ArrayLike | None = None,
    zeta: ArrayLike | None = None,
    static: ArrayLike | None = None,
    Y: ArrayLike | None = None,
    force: ArrayLike | None = None,
    omega: ArrayLike | None = None,
    damper_to: Literal["ground", "base"] | None = None,
    threads: int = 0,
    progress: Progress | None = None,
) -> SteadyStates: ...
@overload
def law(
    name: Literal["asymmetric_coulomb"],
    *,
    kinetic_forward: Quantity,
    kinetic_backward: Quantity,
    static_forward: Quantity | None = None,
    static_backward: Quantity | None = None,
    viscous_forward: Quantity | None = None,
    viscous_backward: Quantity | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_gradient: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["attached_mass"],
    *,
    mass: Quantity,
    stiffness: Quantity,
    damping: Quantity | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["bouc_wen"],
    *,
    limit: Quantity,
    stiffness: Quantity,
    exponent: Quantity,
    ratio: Quantity | None = None,
    beta_share: Quantity | None = None,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["bristle"],
    *,
    stiffness: Quantity,
    snap_distance: Quantity,
    count: int,
    seed: int,
    fluctuation: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["contact_compliance"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    contact_stiffness: Quantity,
    contact_damping: Quantity | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_gradient: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["coulomb"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_gradient: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["dahl"],
    *,
    kinetic: Quantity,
    sigma0: Quantity,
    exponent: Quantity | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["elasto_plastic"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    stribeck_velocity: Quantity,
    sigma0: Quantity,
    sigma1: Quantity,
    sigma2: Quantity | None = None,
    elastic_limit: Quantity,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["free_play"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    play: Quantity,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_gradient: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["friction_lag"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    stribeck_velocity: Quantity,
    exponent: Quantity | None = None,
    form: Literal["gaussian", "exponential", "lorentz"] | None = None,
    lag: Quantity,
    delay: bool | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_gradient: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["gap_spring"],
    *,
    stiffness: Quantity,
    gap: Quantity,
) -> Law: ...
@overload
def law(
    name: Literal["generalized_maxwell_slip"],
    *,
    elements: Sequence[Mapping[str, Any]],
    kinetic: Quantity,
    static: Quantity | None = None,
    stribeck_velocity: Quantity,
    attraction: Quantity,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["iwan"],
    *,
    elements: Sequence[Mapping[str, Any]],
    stiffness: Quantity | None = None,
    limit: Quantity | None = None,
    count: int | None = None,
    distribution: Literal["uniform"] | None = None,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["iwan_four_parameter"],
    *,
    stiffness: Quantity,
    limit: Quantity,
    exponent: Quantity,
    beta: Quantity,
    count: int | None = None,
    smallest: Quantity | None = None,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["lugre"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    stribeck_velocity: Quantity,
    sigma0: Quantity,
    sigma1: Quantity,
    sigma2: Quantity | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["normal_vibration"],
    *,
    mu: Quantity,
    mu_static: Quantity | None = None,
    weight: Quantity,
    normal_mass: Quantity,
    static_approach: Quantity,
    normal_damping_ratio: Quantity,
    lift: Quantity,
    lift_velocity: Quantity,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["rate_state"],
    *,
    normal_force: Quantity,
    mu0: Quantity,
    a: Quantity,
    b: Quantity,
    slip_distance: Quantity,
    reference_velocity: Quantity,
    evolution: Literal["aging", "slip"] | None = None,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["reset_integrator"],
    *,
    kinetic: Quantity,
    stiffness: Quantity,
    static_gain: Quantity | None = None,
    damping: Quantity | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["stribeck"],
    *,
    kinetic: Quantity,
    static: Quantity | None = None,
    stribeck_velocity: Quantity,
    exponent: Quantity | None = None,
    form: Literal["gaussian", "exponential", "lorentz"] | None = None,
    drift: Quantity | None = None,
    position_slope: Quantity | None = None,
    load_gradient: Quantity | None = None,
    load_modulation: Mapping[str, Any] | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["viscous_power"],
    *,
    coefficient: Quantity,
    reference_velocity: Quantity | None = None,
    exponent: Quantity,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def law(
    name: Literal["viscous_saturating"],
    *,
    coefficient: Quantity,
    saturation_velocity: Quantity,
    drift: Quantity | None = None,
    fluctuation: Mapping[str, Any] | None = None,
    warming: Mapping[str, Any] | None = None,
) -> Law: ...
@overload
def excitation(
    type: Literal["none"],
) -> Excitation: ...
@overload
def excitation(
    type: Literal["base_harmonic"],
    *,
    amplitude: Quantity | None = None,
    frequency: Quantity | None = None,
    frequency_uncertainty: Quantity | None = None,
    phase: Quantity | None = None,
    harmonics: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["force_harmonic"],
    *,
    amplitude: Quantity | None = None,
    frequency: Quantity | None = None,
    frequency_uncertainty: Quantity | None = None,
    phase: Quantity | None = None,
    harmonics: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    offset: Quantity | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["base_ramp"],
    *,
    velocity: Quantity,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["force_ramp"],
    *,
    rate: Quantity,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["base_noise"],
    *,
    intensity: Quantity,
    bandwidth: Quantity,
    seed: int | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["force_noise"],
    *,
    intensity: Quantity,
    bandwidth: Quantity,
    seed: int | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["base_chirp"],
    *,
    amplitude: Quantity,
    from_: Quantity,
    to: Quantity,
    duration: Quantity,
    spacing: Literal["linear", "log"] | None = None,
    phase: Quantity | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["force_chirp"],
    *,
    amplitude: Quantity,
    from_: Quantity,
    to: Quantity,
    duration: Quantity,
    spacing: Literal["linear", "log"] | None = None,
    phase: Quantity | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["base_table"],
    *,
    times: Sequence[Quantity],
    values: Sequence[Quantity],
    interpolation: Literal["linear", "cubic", "step"] | None = None,
    repeat: bool | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["force_table"],
    *,
    times: Sequence[Quantity],
    values: Sequence[Quantity],
    interpolation: Literal["linear", "cubic", "step"] | None = None,
    repeat: bool | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["measured_base"],
    *,
    file: str,
    column: str | None = None,
    unit: str | None = None,
    time_column: str | None = None,
    time_unit: str | None = None,
    scale: str | None = None,
    decimal: Literal[".", ","] | None = None,
    no_header: bool | None = None,
    sample_rate: Quantity | None = None,
    interpolation: Literal["linear", "cubic", "step"] | None = None,
    repeat: bool | None = None,
    detrend: Literal["none", "mean", "line"] | None = None,
    offset: Quantity | None = None,
) -> Excitation: ...
@overload
def excitation(
    type: Literal["measured_force"],
    *,
    file: str,
    column: str | None = None,
    unit: str | None = None,
    time_column: str | None = None,
    time_unit: str | None = None,
    scale: str | None = None,
    decimal: Literal[".", ","] | None = None,
    no_header: bool | None = None,
    sample_rate: Quantity | None = None,
    interpolation: Literal["linear", "cubic", "step"] | None = None,
    repeat: bool | None = None,
    detrend: Literal["none", "mean", "line"] | None = None,
    offset: Quantity | None = None,
) -> Excitation: ...
def identify(
    data: Path | Mapping[str, Any] | NDArray[Any] | Any,
    *,
    mass: Quantity | None = None,
    stiffness: Quantity | None = None,
    frequency: str | None = None,
    gravity_stiffness: Quantity | None = None,
    coordinate: Literal["displacement", "angle"] | None = None,
    methods: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | None = None,
    scale: Mapping[str, str] | None = None,
    out: Path | None = None,
    threads: int = 0,
    decimal: Literal[".", ","] | None = None,
    no_header: bool | None = None,
    sample_rate: Quantity | None = None,
    approximate_G: bool | None = None,
    bootstrap: int | None = None,
    cutoffs: Sequence[Quantity] | None = None,
    forgetting: Quantity | None = None,
    free_natural_frequency: bool | None = None,
    largest_severity: Quantity | None = None,
    law_error: Quantity | None = None,
    least_speed: Quantity | None = None,
    pairs: Sequence[int] | None = None,
    profile: bool | None = None,
    severity_deviation: Quantity | None = None,
    sigma_Y: Quantity | None = None,
    sigma_x: Quantity | None = None,
    sign_width: Quantity | None = None,
    without: str | Sequence[str] | None = None,
    zero_offset: bool | None = None,
    gain_uncertainty: Mapping[str, Any] | None = None,
    least_change: Quantity | None = None,
    robust: bool | None = None,
) -> Result: ...
def next(
    data: Path | Mapping[str, Any] | NDArray[Any] | Any,
    *,
    mass: Quantity | None = None,
    stiffness: Quantity | None = None,
    frequency: str | None = None,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | None = None,
    scale: Mapping[str, str] | None = None,
    out: Path | None = None,
    threads: int = 0,
    decimal: Literal[".", ","] | None = None,
    no_header: bool | None = None,
    sample_rate: Quantity | None = None,
    largest_severity: Quantity | None = None,
    law_error: Quantity | None = None,
    severity_deviation: Quantity | None = None,
    sigma_Y: Quantity | None = None,
    sigma_x: Quantity | None = None,
    without: str | Sequence[str] | None = None,
    gain_uncertainty: Mapping[str, Any] | None = None,
    most_level: Quantity | None = None,
    most_frequency: Quantity | None = None,
) -> Result: ...
def fit(
    law: str | Law | Mapping[str, Any] | Sequence[str],
    data: Any,
    *,
    mass: Quantity | None = None,
    stiffness: Quantity | None = None,
    damping: Quantity | None = None,
    frequency: str | None = None,
    amplitude: Quantity | None = None,
    excitation: Excitation | Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None,
    validate: Any = None,
    record: Mapping[str, Any] | Sequence[Mapping[str, Any] | None] | None = None,
    out: Path | None = None,
    threads: int = 0,
    free: str | Sequence[str] | None = None,
    bounds: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    stated: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    robust: bool | None = None,
    profile: bool | None = None,
    starts: int | None = None,
    drive: Literal["y", "force", "none"] | None = None,
    loop: bool | None = None,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | None = None,
    scale: Mapping[str, str] | None = None,
    decimal: Literal[".", ","] | None = None,
    no_header: bool | None = None,
    sample_rate: Quantity | None = None,
    sigma_x: Quantity | None = None,
    sigma_v: Quantity | None = None,
    sigma_a: Quantity | None = None,
    sigma_force: Quantity | None = None,
    sigma_phase: Quantity | None = None,
) -> Result: ...
def predict(
    fitted: Result,
    data: Any,
    *,
    excitation: Excitation | Mapping[str, Any] | None = None,
    record: Mapping[str, Any] | Sequence[Mapping[str, Any] | None] | None = None,
    out: Path | None = None,
    threads: int = 0,
    drive: Literal["y", "force", "none"] | None = None,
    loop: bool | None = None,
    units: Mapping[str, str] | None = None,
    columns: Mapping[str, str] | None = None,
    scale: Mapping[str, str] | None = None,
    decimal: Literal[".", ","] | None = None,
    no_header: bool | None = None,
    sample_rate: Quantity | None = None,
    sigma_x: Quantity | None = None,
    sigma_v: Quantity | None = None,
    sigma_a: Quantity | None = None,
    sigma_force: Quantity | None = None,
    sigma_phase: Quantity | None = None,
) -> Result: ...
def simulate(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    duration: Quantity | None = None,
    cycles: Quantity | None = None,
    sample_rate: Quantity | None = None,
    measured: Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
def free_decay(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    peaks: int,
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
def xy_curve(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    amplitudes: Grid,
    continue_: Literal["up", "down", "both"] | None = None,
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
def frequency_response(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    frequencies: Grid,
    continue_: Literal["up", "down", "both"] | None = None,
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
def regime_map(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    frequencies: Grid,
    amplitudes: Grid,
    sticking_boundary: bool | None = None,
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
def xy_branch(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    amplitudes: Mapping[str, Any],
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
def frequency_branch(
    system: System | Mapping[str, Any],
    excitation: Excitation | Mapping[str, Any] | None = None,
    *,
    frequencies: Mapping[str, Any],
    initial: Mapping[str, Any] | None = None,
    numerics: Mapping[str, Any] | None = None,
    title: str | None = None,
    out: Path | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Result: ...
class System:
    def __init__(
        self,
        *,
        coordinate: Literal["displacement", "angle"] | None = None,
        mass: Quantity | None = None,
        mass_uncertainty: Quantity | None = None,
        stiffness: Quantity | None = None,
        stiffness_uncertainty: Quantity | None = None,
        damping: Quantity | None = None,
        damping_ratio: Quantity | None = None,
        cubic_stiffness: Quantity | None = None,
        gravity_stiffness: Quantity | None = None,
        loss_factor: Quantity | None = None,
        damper_to: Literal["ground", "base"] | None = None,
        friction: Law | Mapping[str, Any] | Sequence[Law | Mapping[str, Any]] | None = None,
    ) -> None: ...
    def replace(self, **keys: Any) -> System: ...
    def to_dict(self) -> dict[str, Any]: ...
    def __getattr__(self, name: str) -> Any: ...
    def simulate(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        duration: Quantity | None = None,
        cycles: Quantity | None = None,
        sample_rate: Quantity | None = None,
        measured: Mapping[str, Any] | None = None,
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def free_decay(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        peaks: int,
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def xy_curve(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        amplitudes: Grid,
        continue_: Literal["up", "down", "both"] | None = None,
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def frequency_response(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        frequencies: Grid,
        continue_: Literal["up", "down", "both"] | None = None,
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def regime_map(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        frequencies: Grid,
        amplitudes: Grid,
        sticking_boundary: bool | None = None,
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def xy_branch(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        amplitudes: Mapping[str, Any],
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def frequency_branch(
        self,
        excitation: Excitation | Mapping[str, Any] | None = None,
        *,
        frequencies: Mapping[str, Any],
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
    def steady_state(
        self,
        excitation: Excitation | Mapping[str, Any],
        *,
        initial: Mapping[str, Any] | None = None,
        numerics: Mapping[str, Any] | None = None,
        title: str | None = None,
        out: Path | None = None,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Result: ...
class _Laws:
    def __iter__(self) -> Iterator[str]: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def asymmetric_coulomb(
        self,
        *,
        kinetic_forward: Quantity,
        kinetic_backward: Quantity,
        static_forward: Quantity | None = None,
        static_backward: Quantity | None = None,
        viscous_forward: Quantity | None = None,
        viscous_backward: Quantity | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_gradient: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def attached_mass(
        self,
        *,
        mass: Quantity,
        stiffness: Quantity,
        damping: Quantity | None = None,
    ) -> Law: ...
    def bouc_wen(
        self,
        *,
        limit: Quantity,
        stiffness: Quantity,
        exponent: Quantity,
        ratio: Quantity | None = None,
        beta_share: Quantity | None = None,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def bristle(
        self,
        *,
        stiffness: Quantity,
        snap_distance: Quantity,
        count: int,
        seed: int,
        fluctuation: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def contact_compliance(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        contact_stiffness: Quantity,
        contact_damping: Quantity | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_gradient: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def coulomb(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_gradient: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def dahl(
        self,
        *,
        kinetic: Quantity,
        sigma0: Quantity,
        exponent: Quantity | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def elasto_plastic(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        stribeck_velocity: Quantity,
        sigma0: Quantity,
        sigma1: Quantity,
        sigma2: Quantity | None = None,
        elastic_limit: Quantity,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def free_play(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        play: Quantity,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_gradient: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def friction_lag(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        stribeck_velocity: Quantity,
        exponent: Quantity | None = None,
        form: Literal["gaussian", "exponential", "lorentz"] | None = None,
        lag: Quantity,
        delay: bool | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_gradient: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def gap_spring(
        self,
        *,
        stiffness: Quantity,
        gap: Quantity,
    ) -> Law: ...
    def generalized_maxwell_slip(
        self,
        *,
        elements: Sequence[Mapping[str, Any]],
        kinetic: Quantity,
        static: Quantity | None = None,
        stribeck_velocity: Quantity,
        attraction: Quantity,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def iwan(
        self,
        *,
        elements: Sequence[Mapping[str, Any]],
        stiffness: Quantity | None = None,
        limit: Quantity | None = None,
        count: int | None = None,
        distribution: Literal["uniform"] | None = None,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def iwan_four_parameter(
        self,
        *,
        stiffness: Quantity,
        limit: Quantity,
        exponent: Quantity,
        beta: Quantity,
        count: int | None = None,
        smallest: Quantity | None = None,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def lugre(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        stribeck_velocity: Quantity,
        sigma0: Quantity,
        sigma1: Quantity,
        sigma2: Quantity | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def normal_vibration(
        self,
        *,
        mu: Quantity,
        mu_static: Quantity | None = None,
        weight: Quantity,
        normal_mass: Quantity,
        static_approach: Quantity,
        normal_damping_ratio: Quantity,
        lift: Quantity,
        lift_velocity: Quantity,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def rate_state(
        self,
        *,
        normal_force: Quantity,
        mu0: Quantity,
        a: Quantity,
        b: Quantity,
        slip_distance: Quantity,
        reference_velocity: Quantity,
        evolution: Literal["aging", "slip"] | None = None,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def reset_integrator(
        self,
        *,
        kinetic: Quantity,
        stiffness: Quantity,
        static_gain: Quantity | None = None,
        damping: Quantity | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def stribeck(
        self,
        *,
        kinetic: Quantity,
        static: Quantity | None = None,
        stribeck_velocity: Quantity,
        exponent: Quantity | None = None,
        form: Literal["gaussian", "exponential", "lorentz"] | None = None,
        drift: Quantity | None = None,
        position_slope: Quantity | None = None,
        load_gradient: Quantity | None = None,
        load_modulation: Mapping[str, Any] | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def viscous_power(
        self,
        *,
        coefficient: Quantity,
        reference_velocity: Quantity | None = None,
        exponent: Quantity,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
    def viscous_saturating(
        self,
        *,
        coefficient: Quantity,
        saturation_velocity: Quantity,
        drift: Quantity | None = None,
        fluctuation: Mapping[str, Any] | None = None,
        warming: Mapping[str, Any] | None = None,
    ) -> Law: ...
class _Excitations:
    def __iter__(self) -> Iterator[str]: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def none(
        self,
    ) -> Excitation: ...
    def base_harmonic(
        self,
        *,
        amplitude: Quantity | None = None,
        frequency: Quantity | None = None,
        frequency_uncertainty: Quantity | None = None,
        phase: Quantity | None = None,
        harmonics: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
    ) -> Excitation: ...
    def force_harmonic(
        self,
        *,
        amplitude: Quantity | None = None,
        frequency: Quantity | None = None,
        frequency_uncertainty: Quantity | None = None,
        phase: Quantity | None = None,
        harmonics: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
        offset: Quantity | None = None,
    ) -> Excitation: ...
    def base_ramp(
        self,
        *,
        velocity: Quantity,
    ) -> Excitation: ...
    def force_ramp(
        self,
        *,
        rate: Quantity,
    ) -> Excitation: ...
    def base_noise(
        self,
        *,
        intensity: Quantity,
        bandwidth: Quantity,
        seed: int | None = None,
    ) -> Excitation: ...
    def force_noise(
        self,
        *,
        intensity: Quantity,
        bandwidth: Quantity,
        seed: int | None = None,
    ) -> Excitation: ...
    def base_chirp(
        self,
        *,
        amplitude: Quantity,
        from_: Quantity,
        to: Quantity,
        duration: Quantity,
        spacing: Literal["linear", "log"] | None = None,
        phase: Quantity | None = None,
    ) -> Excitation: ...
    def force_chirp(
        self,
        *,
        amplitude: Quantity,
        from_: Quantity,
        to: Quantity,
        duration: Quantity,
        spacing: Literal["linear", "log"] | None = None,
        phase: Quantity | None = None,
    ) -> Excitation: ...
    def base_table(
        self,
        *,
        times: Sequence[Quantity],
        values: Sequence[Quantity],
        interpolation: Literal["linear", "cubic", "step"] | None = None,
        repeat: bool | None = None,
    ) -> Excitation: ...
    def force_table(
        self,
        *,
        times: Sequence[Quantity],
        values: Sequence[Quantity],
        interpolation: Literal["linear", "cubic", "step"] | None = None,
        repeat: bool | None = None,
    ) -> Excitation: ...
    def measured_base(
        self,
        *,
        file: str,
        column: str | None = None,
        unit: str | None = None,
        time_column: str | None = None,
        time_unit: str | None = None,
        scale: str | None = None,
        decimal: Literal[".", ","] | None = None,
        no_header: bool | None = None,
        sample_rate: Quantity | None = None,
        interpolation: Literal["linear", "cubic", "step"] | None = None,
        repeat: bool | None = None,
        detrend: Literal["none", "mean", "line"] | None = None,
        offset: Quantity | None = None,
    ) -> Excitation: ...
    def measured_force(
        self,
        *,
        file: str,
        column: str | None = None,
        unit: str | None = None,
        time_column: str | None = None,
        time_unit: str | None = None,
        scale: str | None = None,
        decimal: Literal[".", ","] | None = None,
        no_header: bool | None = None,
        sample_rate: Quantity | None = None,
        interpolation: Literal["linear", "cubic", "step"] | None = None,
        repeat: bool | None = None,
        detrend: Literal["none", "mean", "line"] | None = None,
        offset: Quantity | None = None,
    ) -> Excitation: ...
class _Methods:
    def __iter__(self) -> Iterator[str]: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    acceleration_velocity_displacement: Record
    any_law: Record
    den_hartog_fit: Record
    energy_balance: Record
    extended_kalman: Record
    free_decay: Record
    friction_force: Record
    harmonic_balance: Record
    jacobsen_ayre: Record
    law_selection: Record
    output_error: Record
    random_decrement: Record
    receptance: Record
    recursive_least_squares: Record
    resonance_deming: Record
    resonance_least_squares: Record
    resonance_two_point: Record
    resonance_within_sweep: Record
    stochastic_averaging: Record
laws: _Laws
excitations: _Excitations
methods: _Methods
