"""Steady states, one or millions."""

from __future__ import annotations

import numpy as np

from ._analyses import function
from ._arguments import refuse_masked, refuse_other_rows, thread_count
from ._errors import Diagnostic, InvalidScenario, NumericalFailure
from ._library import core
from ._run import close, reporter


class SteadyStates:
    """Steady states of many oscillators, or of one if all parameters are numbers.

    Attributes
    ----------
    amplitude, peak, trough : float or ndarray
        (peak - trough)/2, max x, min x [m]. NaN where there is no steady state.
    phase : float or ndarray
        Phase lag of the fundamental of x behind the drive [rad], in [0, 2 pi). NaN where the mass never moves.
    multiplier : float or ndarray
        Largest modulus of the Floquet multipliers over one forcing period.
    stops : int or ndarray
        Number of stops in a period.
    outcome : str or ndarray of str
        ``"done"``, or why there is no steady state: ``"no_steady_state"``, ``"not_unique"``, ``"event_limit"``, ....
    """

    __slots__ = ("peak", "trough", "phase", "multiplier", "stops", "_outcome")

    def __init__(self, peak, trough, phase, multiplier, stops, outcome):
        self.peak = peak
        self.trough = trough
        self.phase = phase
        self.multiplier = multiplier
        self.stops = stops
        self._outcome = outcome

    @property
    def amplitude(self):
        return 0.5 * (self.peak - self.trough)

    @property
    def outcome(self):
        if isinstance(self._outcome, int):
            return core.outcomes[self._outcome]
        return np.array(core.outcomes)[self._outcome]

    @property
    def shape(self):
        return np.shape(self._outcome)

    def to_pandas(self):
        """One row for each oscillator, in the order of the flattened arrays."""
        import pandas

        names = ("amplitude", "peak", "trough", "phase", "multiplier", "stops", "outcome")
        return pandas.DataFrame({name: np.ravel(getattr(self, name)) for name in names})

    def __repr__(self):
        if self.shape == ():
            return f"<steady state: amplitude={self.amplitude:.6g}, phase={self.phase:.6g}, stops={self.stops}>"
        return f"<steady states: shape {self.shape}, {np.count_nonzero(self._outcome)} without one>"


def steady_state(
    system=None,
    excitation=None,
    *,
    mass=None,
    stiffness=None,
    damping=None,
    zeta=None,
    F0=None,
    static=None,
    Y=None,
    force=None,
    omega=None,
    damper_to=None,
    threads=0,
    progress=None,
    **keys,
):
    """The steady state of a system, or of arrays of oscillators with Coulomb friction, under a harmonic excitation.

    ``steady_state(system, excitation)`` runs a scenario, with any friction law. Without a system, the parameters are numbers or
    arrays in SI. Arrays are broadcast, and their oscillators are computed in vector registers on all cores.

    Parameters
    ----------
    system : System or mapping, optional
        The oscillator.
    excitation : Excitation or mapping, optional
        A harmonic excitation.
    mass, stiffness : array_like
        kg and N/m, > 0.
    damping, zeta : array_like
        Viscous damping c [N.s/m], or damping ratio c / (2 sqrt(m k)) [1]; one of the two.
    F0 : array_like
        Kinetic friction force [N], >= 0.
    static : array_like, optional
        Static friction force [N], >= F0; default: F0.
    Y, force : array_like
        Amplitude of the base [m], or of a force on the mass [N]; one of the two.
    omega : array_like, optional
        Frequency of the drive [rad/s], > 0; default: sqrt(k/m).
    damper_to : {"ground", "base"}, optional
        Other end of the damper; default: ground. Only without a system; a system has this key itself.
    threads : int, optional
        Largest number of threads; 0: all cores; for a system as in `run`.
    progress : callable or True, optional
        As in `run`; called if there are more than some hundred thousand oscillators.
    **keys
        Only with a system: the sections ``initial`` and ``numerics`` of the scenario; ``out`` as in `run`.

    Returns
    -------
    Result or SteadyStates
        A Result for a system, SteadyStates for arrays. SteadyStates agree with the result of a scenario to rounding, not to the bit.

    Raises
    ------
    InvalidScenario
        A value is out of range.
    NumericalFailure
        A single steady state does not exist. In an array, a missing steady state is NaN, and its outcome says why.

    Examples
    --------
    >>> import dualdamp as dd
    >>> import numpy as np
    >>> states = dd.steady_state(mass=1, stiffness=100, zeta=0.2, F0=np.linspace(0, 2, 3)[:, None], Y=np.linspace(0.1, 0.5, 5))
    >>> states.amplitude.shape
    (3, 5)
    >>> round(dd.steady_state(mass=1, stiffness=100, zeta=0.2, F0=2, Y=0.1).amplitude, 4)
    0.1861
    """
    given = dict(mass=mass, stiffness=stiffness, damping=damping, zeta=zeta, F0=F0, static=static, Y=Y, force=force, omega=omega)
    if system is not None:
        for name, value in {**given, "damper_to": damper_to}.items():
            if value is not None:
                raise TypeError(f"steady_state takes a system or {name}, not both")
        return function("steady_state")(system, excitation, threads=threads, progress=progress, **keys)
    if excitation is not None:
        raise TypeError("steady_state takes an excitation with a system; without one Y or force, and omega, are the drive")
    if keys:
        raise TypeError(f"without a system, steady_state has no parameter {next(iter(keys))!r}")
    drive = force if Y is None else Y
    for name, value in (("mass", mass), ("stiffness", stiffness), ("F0", F0), ("Y or force", drive)):
        if value is None:
            raise TypeError(f"steady_state needs {name}, or a system")
    if (Y is None) == (force is None):
        raise TypeError("steady_state takes one of Y and force")
    if (damping is None) == (zeta is None):
        raise TypeError("steady_state takes one of damping and zeta")
    refuse_other_rows(given.items())
    for name, value in given.items():
        if value.__class__ is not float and value is not None:
            given[name] = _numbers(name, value)
    mass, stiffness, F0 = given["mass"], given["stiffness"], given["F0"]
    if damping is None:
        damping = _damping(given["zeta"], mass, stiffness)
    else:
        damping = given["damping"]
    omega = _natural_frequency(mass, stiffness) if omega is None else given["omega"]
    if damper_to not in (None, "ground", "base"):
        raise ValueError(f"damper_to is 'ground' or 'base', not {damper_to!r}")
    values = (mass, damping, stiffness, F0, F0 if static is None else given["static"], given["force" if Y is None else "Y"], omega)
    report = reporter(progress)
    try:
        states = SteadyStates(*core.steady_states(Y is not None, damper_to == "base", thread_count(threads), values, report))
    except InvalidScenario:
        _refuse_bad(given)
        raise  # a product of good values left the range of double precision
    finally:
        close(report)
    if states._outcome.__class__ is int and states._outcome != 0:
        raise NumericalFailure(f"there is no steady state: {states.outcome}")
    return states


# What each argument may be, for messages after the libraries refused a batch: unit, and the least value with whether it is excluded.
_RANGES = {
    "mass": ("kg", 0.0, True),
    "stiffness": ("N/m", 0.0, True),
    "damping": ("N.s/m", -np.inf, True),
    "zeta": ("", -np.inf, True),
    "F0": ("N", 0.0, False),
    "static": ("N", None, False),
    "Y": ("m", 0.0, False),
    "force": ("N", 0.0, False),
    "omega": ("rad/s", 0.0, True),
}


def _refuse_bad(given):
    """Raises InvalidScenario with each argument that has a value out of range, and the index of the first such value."""
    problems = []
    for name, (unit, low, is_open) in _RANGES.items():
        if given[name] is None:
            continue
        values, low = np.broadcast_arrays(given[name], given["F0"] if low is None else low)
        is_good = np.isfinite(values) & ((values > low) if is_open else (values >= low))
        bad = np.argwhere(~is_good & ~np.isnan(low))
        if len(bad) > 0:
            problems.append(_bad_value(name, tuple(bad[0]), given[name], values, low, f" {unit}".rstrip(), is_open))
    if problems:
        text = "\n".join(f"error: {one.message}\n  allowed: {one.allowed}\n  found: {one.found}" for one in problems)
        raise InvalidScenario(text, problems)


def _bad_value(name, place, value, values, low, unit, is_open):
    """`place`: in the shape of `values`, to which the value of the argument was broadcast."""
    shape = np.shape(value)
    index = [0 if length == 1 else i for i, length in zip(place[len(place) - len(shape) :], shape)]
    least = float(low[place])
    where = f"{name}[{', '.join(map(str, index))}]" if index else name
    allowed = "any finite value" if least == -np.inf else f"{'>' if is_open else '>='} {least:g}{unit}"
    return Diagnostic(f"{where!r} is out of range", allowed=allowed, found=f"{float(values[place]):g}{unit}")


def _numbers(name, value):
    """The value in double precision. Products of small integers would overflow, products of float32 would be rounded."""
    if value.__class__ is int:
        return float(value)
    refuse_masked(name, value)
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"without a system, {name} is a number or an array of numbers, in SI, not {value!r}")
    return float(array) if array.ndim == 0 else array.astype(np.float64, copy=False)


# If the mass or the stiffness is out of range, the values of these functions do not matter: the core refuses the mass or stiffness.


def _damping(zeta, mass, stiffness):
    if _is_scalar(zeta, mass, stiffness):
        return 2.0 * zeta * abs(mass * stiffness) ** 0.5
    return 2.0 * np.asarray(zeta) * np.sqrt(np.abs(np.multiply(mass, stiffness)))


def _natural_frequency(mass, stiffness):
    if _is_scalar(mass, stiffness):
        return abs(stiffness / mass) ** 0.5 if mass != 0 else 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.sqrt(np.abs(np.divide(stiffness, mass)))


def _is_scalar(*values):
    return all(value.__class__ is float for value in values)
