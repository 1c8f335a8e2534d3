#!/usr/bin/env python3
"""Writes the type stub of the package from the tables of the format, as `dualdamp schema` writes the schema.

usage: PYTHONPATH=build/ci/python python3 scripts/lib/python_stubs.py > python/dualdamp/__init__.pyi
"""

import sys

from dualdamp._analyses import OF_SYSTEMS
from dualdamp._tables import entry, python_name, tables

HEAD = '''# Written by scripts/lib/python_stubs.py from the tables of the format.
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
'''

TYPES = {
    "text": "str",
    "boolean": "bool",
    "integer": "int",
    "quantity": "Quantity",
    "list": "Sequence[Quantity]",
    "grid": "Grid",
    "integers": "Sequence[int]",
    "words": "str | Sequence[str]",
    "scalar": "str | float | bool",
    "mapping": "Mapping[str, Any]",
    "mappings": "Sequence[Mapping[str, Any]]",
}
# Values of the package that stand for a mapping.
PARTS = {"friction": "Law | Mapping[str, Any] | Sequence[Law | Mapping[str, Any]]"}
COMMON = {
    "initial": "Mapping[str, Any]",
    "numerics": "Mapping[str, Any]",
    "title": "str",
    "out": "Path",
    "threads": "int",
    "progress": "Progress",
}
# What may be said of all records of a fit (`dualdamp._fitting`).
OF_RECORDS = {
    "drive": 'Literal["y", "force", "none"]',
    "loop": "bool",
    **{name: "Mapping[str, str]" for name in ("units", "columns", "scale")},
    "decimal": 'Literal[".", ","]',
    "no_header": "bool",
    "sample_rate": "Quantity",
    **{f"sigma_{signal}": "Quantity" for signal in ("x", "v", "a", "force", "phase")},
}


def type_of(key):
    if key["name"] in PARTS:
        return PARTS[key["name"]]
    if key["kind"] == "word":
        return "Literal[" + ", ".join(f'"{word}"' for word in key["words"]) + "]"
    kind = TYPES[key["kind"]]
    return f"{kind} | Sequence[{kind}]" if key["listed"] and key["kind"] == "mapping" else kind


def parameters_of(keys):
    """'name: type' and 'name: type | None = None'."""
    for key in keys:
        if key["name"].isidentifier():
            yield f"{python_name(key['name'])}: {type_of(key)}" + ("" if key["required"] else " | None = None")


def function(name, first, keys, result, margin=""):
    rows = [*first, *(["*"] if keys else []), *keys]
    if not rows:
        return f"{margin}def {name}() -> {result}: ..."
    return "\n".join([f"{margin}def {name}(", *(f"{margin}    {row}," for row in rows), f"{margin}) -> {result}: ..."])


def analysis_function(name, is_method):
    keys = entry("analyses", name)["keys"]
    known = {key["name"] for key in keys}
    named = [*parameters_of(keys), *(f"{key}: {kind} | None = None" for key, kind in COMMON.items() if key not in known)]
    drive = "excitation: Excitation | Mapping[str, Any] | None = None"
    first = ["self", drive] if is_method else ["system: System | Mapping[str, Any]", drive]
    return function(name, first, named, "Result", "    " if is_method else "")


def identify_function():
    own = {"data", "methods", "units", "columns", "scale", "measurement", "sensors"}
    keys = [key for key in entry("analyses", "identify")["keys"] if key["name"] not in own]
    named = ["mass: Quantity | None = None", "stiffness: Quantity | None = None", "frequency: str | None = None"]
    named += ["gravity_stiffness: Quantity | None = None", 'coordinate: Literal["displacement", "angle"] | None = None']
    named += ["methods: str | Sequence[str] | None = None"]
    named += [f"{name}: Mapping[str, str] | None = None" for name in ("units", "columns", "scale")]
    named += ["out: Path | None = None", "threads: int = 0", *parameters_of(keys)]
    return function("identify", ["data: Path | Mapping[str, Any] | NDArray[Any] | Any"], named, "Result")


def next_function():
    own = {"data", "units", "columns", "scale", "measurement", "sensors"}
    keys = [key for key in entry("analyses", "design")["keys"] if key["name"] not in own]
    named = ["mass: Quantity | None = None", "stiffness: Quantity | None = None", "frequency: str | None = None"]
    named += [f"{name}: Mapping[str, str] | None = None" for name in ("units", "columns", "scale")]
    named += ["out: Path | None = None", "threads: int = 0", *parameters_of(keys)]
    return function("next", ["data: Path | Mapping[str, Any] | NDArray[Any] | Any"], named, "Result")


def fit_functions():
    own = {"data", "laws", "validate"}
    keys = [key for key in entry("analyses", "fit")["keys"] if key["name"] not in own]
    named = [f"{name}: Quantity | None = None" for name in ("mass", "stiffness", "damping")]
    named += ["frequency: str | None = None", "amplitude: Quantity | None = None"]
    after = ["record: Mapping[str, Any] | Sequence[Mapping[str, Any] | None] | None = None", "out: Path | None = None", "threads: int = 0"]
    drive = "excitation: Excitation | Mapping[str, Any] | None = None"
    of_records = [f"{name}: {kind} | None = None" for name, kind in OF_RECORDS.items()]
    named += [drive, "initial: Mapping[str, Any] | None = None", "validate: Any = None", *after, *parameters_of(keys), *of_records]
    yield function("fit", ["law: str | Law | Mapping[str, Any] | Sequence[str]", "data: Any"], named, "Result")
    yield function("predict", ["fitted: Result", "data: Any"], [drive, *after, *of_records], "Result")


def system_class():
    keys = list(parameters_of(tables()["system"][0]["keys"]))
    lines = ["class System:", function("__init__", ["self"], keys, "None", "    ")]
    lines += ["    def replace(self, **keys: Any) -> System: ...", "    def to_dict(self) -> dict[str, Any]: ...", "    def __getattr__(self, name: str) -> Any: ..."]
    lines += [analysis_function(name, True) for name in OF_SYSTEMS]
    lines.append(function("steady_state", ["self", "excitation: Excitation | Mapping[str, Any]"], [f"{key}: {kind} | None = None" for key, kind in COMMON.items()], "Result", "    "))
    return "\n".join(lines)


def names_class(class_name, items, made):
    lines = [f"class {class_name}:", "    def __iter__(self) -> Iterator[str]: ...", "    def __contains__(self, name: str) -> bool: ...", "    def __len__(self) -> int: ..."]
    for item in items:
        lines.append(function(item["name"], ["self"], list(parameters_of(item["keys"])), made, "    ") if made != "Record" else f"    {item['name']}: Record")
    return "\n".join(lines)


def overloads(name, key, items, made):
    for item in items:
        yield "@overload"
        yield function(name, [f'{key}: Literal["{item["name"]}"]'], list(parameters_of(item["keys"])), made)


def main():
    laws, drives = tables()["laws"], tables()["excitation"]
    parts = [
        HEAD.rstrip(),
        *overloads("law", "name", laws, "Law"),
        *overloads("excitation", "type", drives, "Excitation"),
        identify_function(),
        next_function(),
        *fit_functions(),
        *(analysis_function(name, False) for name in OF_SYSTEMS),
        system_class(),
        names_class("_Laws", laws, "Law"),
        names_class("_Excitations", drives, "Excitation"),
        names_class("_Methods", tables()["methods"], "Record"),
        "laws: _Laws\nexcitations: _Excitations\nmethods: _Methods",
    ]
    sys.stdout.write("\n".join(parts) + "\n")


if __name__ == "__main__":
    main()
