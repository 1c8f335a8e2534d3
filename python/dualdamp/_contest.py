"""The stress test as a benchmark for methods written in Python and for other programs."""

from __future__ import annotations

import json
import os
import tempfile
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ._arguments import is_unicode, path_text, thread_count
from ._errors import InvalidScenario
from ._identification import identify, in_memory
from ._library import core
from ._run import run_source, source_of
from ._systems import quantity

# A larger number would overflow in products (core/numbers.hpp, most_magnitude).
_LARGEST = 1e60

# Columns of a row of answers; docs/benchmark.md explains them.
_COLUMNS = ("zeta", "F0", "zeta_low", "zeta_high", "F0_low", "F0_high", "p_value", "usable")


@dataclass(frozen=True, eq=False)
class Case:
    """The records and constants that a laboratory has of one rig, without the truth.

    Attributes
    ----------
    number : int
        Number of the case, from 1. Cases are in random order.
    mass, stiffness, frequency : float
        The values that the laboratory measured [kg, N/m, rad/s]; they may be wrong.
    sigma_x, sigma_Y : float
        Standard deviation of a measured amplitude, from the noise of the sensors [m].
    record : numpy.ndarray
        Structured array in SI: steady states with ``Y``, ``x``, perhaps ``omega``, ``phase``, ``fundamental``,
        ``mean_square_speed``, ``sweep``; or histories, ``t``, ``x``, ``y``, ``v``, ``a``, ``force``.
    decay : numpy.ndarray or None
        Extremes of a free vibration, ``t`` and ``x``.
    random : numpy.ndarray or None
        Response to a random drive.
    """

    number: int
    mass: float
    stiffness: float
    frequency: float
    sigma_x: float
    sigma_Y: float
    record: np.ndarray
    decay: np.ndarray | None = None
    random: np.ndarray | None = None

    def identify(self, **options):
        """Calls `dualdamp.identify` with the record and the constants of the case. `options` are those of `identify`."""
        columns = self.record.dtype.names
        units = {name: unit for name, unit in (("omega", "rad/s"), ("phase", "rad")) if name in columns}
        if "omega" not in columns:
            options = {"frequency": quantity(self.frequency, "rad/s"), **options}
        return identify(self.record, mass=self.mass, stiffness=self.stiffness, units=units, **options)


def benchmark(scenario, methods, *, changes=None, seed=None, out=None, threads=0, progress=None):
    """Score identification methods written in Python beside those of the program.

    Parameters
    ----------
    scenario : mapping, str or path
        A scenario with the analysis ``stress_test``, such as ``"scenarios/stress/benchmark.yaml"``.
    methods : mapping of str to callable
        Each is called as ``method(case)`` with a `Case`, and returns a mapping with any of ``zeta``, ``F0``, ``zeta_low``,
        ``zeta_high``, ``F0_low``, ``F0_high`` (95 % intervals), ``p_value``, ``usable`` (a bool, ``"yes"`` or ``"no"``); or None.
        A mapping without ``zeta`` or without ``F0`` counts as no answer.
    changes : mapping, optional
        Values that replace those of the scenario, as in `run`.
    seed : int, optional
        Seed of all noise. Default: drawn at random.
    out, threads, progress
        As in `run`; `progress` counts the cases of the program's own methods.

    Returns
    -------
    Result
        ``ranking``, ``scores``, ``families`` and more, with a row for each method.

    Raises
    ------
    InvalidScenario
        The scenario is no stress test, or an answer is invalid; the message names the case.
    TypeError
        A method returns no mapping, or one with other keys.

    Notes
    -----
    An exception of a method, or its first invalid answer, ends the benchmark; a note of the exception names method and case. A method is called for one case at a time.

    Examples
    --------
    >>> import dualdamp as dd, numpy as np
    >>> def line(case):
    ...     slope, intercept = np.polyfit(case.record["Y"], case.record["x"], 1)
    ...     zeta, F0 = 1 / (2 * slope), -intercept / slope * np.pi / 4 * case.stiffness
    ...     return {"zeta": zeta, "F0": F0, "zeta_low": 0.8 * zeta, "zeta_high": 1.2 * zeta, "F0_low": 0.9 * F0, "F0_high": 1.1 * F0}
    >>> scored = dd.benchmark("scenarios/stress/small.yaml", {"line": line}, seed=1)
    >>> [(row.method, round(row.interval_score, 2)) for row in scored.result.ranking]
    [('resonance_least_squares', 1.2), ('den_hartog_fit', 1.59), ('resonance_two_point', 2.0), ('line', 2.35)]
    """
    _check_names(methods, scenario, changes)
    with tempfile.TemporaryDirectory() as folder:
        stress_export(scenario, folder, changes=changes, seed=seed, threads=threads)
        answers = {name: _answers(name, method, folder) for name, method in methods.items()}
        key = Path(folder) / "key.json"
        return stress_score(scenario, key, answers, changes=changes, out=out, threads=threads, progress=progress)


def stress_export(scenario, directory, *, changes=None, seed=None, threads=0, overwrite=False):
    """Write the records and constants of all cases of a stress test, and the key.

    Parameters
    ----------
    scenario, changes
        As in `benchmark`.
    directory : path
        Directory for ``cases/``, ``constants.csv`` and ``key.json``; docs/benchmark.md explains them. `cases` reads them.
    seed : int, optional
        Seed of all noise. Default: a hidden one, drawn at random.
    threads : int, optional
        Largest number of threads; 0: all cores, or one if a friction law of the scenario is written in Python.
    overwrite : bool, optional
        Remove the files of an earlier export in this directory; without it they are refused. Other files whose names are needed are renamed to ``NAME~``, with a warning.

    Returns
    -------
    int
        The number of cases.

    Raises
    ------
    InvalidScenario
        The scenario is no stress test.
    OutputError
        The files cannot be written, or the directory holds an earlier export.
    """
    seed = "" if seed is None else str(seed)
    count, messages = core.export_cases(source_of(scenario, changes), os.fsencode(path_text(directory)), seed, thread_count(threads), bool(overwrite))
    for message in messages:
        warnings.warn(message, stacklevel=2)
    return count


def cases(directory):
    """Read exported cases, one after the other.

    Parameters
    ----------
    directory : path
        Directory of an export, with or without the key.

    Yields
    ------
    Case
    """
    folder = Path(directory)
    for known in _table(folder / "constants.csv"):
        number, *constants = known.tolist()
        name = f"{int(number):06d}"
        others = (_table(path) if (path := folder / "cases" / f"{name}-{kind}.csv").exists() else None for kind in ("decay", "random"))
        yield Case(int(number), *constants, _table(folder / "cases" / f"{name}.csv"), *others)


def stress_score(scenario, key, answers, *, changes=None, out=None, threads=0, progress=None):
    """Score answers to an exported stress test beside the methods of the program.

    Parameters
    ----------
    scenario, changes
        The same as for the export.
    key : path
        ``key.json`` of the export.
    answers : mapping of str to path or columns
        By the name of the participant: a file of answers, or its columns as a DataFrame, a structured array or a dict.
    out, threads, progress
        As in `run`. A second call with the same `out` only scores, because the estimates of the methods are stored there.

    Returns
    -------
    Result
        ``ranking``, ``scores``, ``families`` and more.

    Raises
    ------
    InvalidScenario
        The key is that of another stress test, or answers are invalid; the message has their places.
    """
    _check_names(answers, scenario, changes)
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for i, (name, columns) in enumerate(answers.items()):
            path = columns
            if not isinstance(columns, (str, os.PathLike)):
                # Messages name the file, so it gets the name of the participant where that is a valid file name.
                path = Path(folder) / str(i) / (name if name.isidentifier() else "answers")
                path.parent.mkdir()
                path.write_text(in_memory(columns))
            files.append((name, os.fsencode(path)))
        return run_source(source_of(scenario, changes), out=out, threads=threads, resume=True, progress=progress, key=os.fsencode(key), answers=files)


def _check_names(names, scenario, changes):
    """Refuses names that are none, and those of methods of the program in this scenario, before long computations."""
    for name in names:
        if not (isinstance(name, str) and name and is_unicode(name)):
            raise TypeError(f"methods need names: texts that are not empty, not {name!r}")
    asked = json.loads(core.resolved(source_of(scenario, changes)))["analysis"].get("methods") or ()
    for name in names:
        if name in asked:
            raise InvalidScenario(f"two entries have the same name: {name!r} is a method of the program in this scenario; use another name")


def _table(path):
    """A structured array from a file that the program wrote, in SI."""
    with open(path) as file:
        names = [name.split(" ")[0] for name in file.readline().strip().split(",")]
        rows = file.readlines()
    numbers = np.loadtxt(rows, delimiter=",", ndmin=2) if rows else np.empty((0, len(names)))
    table = np.empty(len(numbers), [(name, float) for name in names])
    for i, name in enumerate(names):
        table[name] = numbers[:, i]
    return table


def _answers(name, method, directory):
    """Columns of the answers of a method to exported cases."""
    rows = []
    for case in cases(directory):
        try:
            rows.append(_row(case.number, method(case)))
        except Exception as error:
            error.add_note(f"in case {case.number} of the method {name!r}")
            raise
    return dict(zip(("case", *_COLUMNS), map(list, zip(*rows)))) if rows else {"case": []}


def _row(number, answer):
    """The cells of one answer."""
    if answer is None:
        answer = {}
    if not isinstance(answer, Mapping):
        raise TypeError(f"a method returns a mapping or None, not {type(answer).__name__}")
    if unknown := set(answer) - set(_COLUMNS):
        raise TypeError(f"an answer has no {', '.join(map(repr, sorted(unknown)))}; it may have {', '.join(_COLUMNS)}")
    cells = {column: _cell(number, column, answer.get(column)) for column in _COLUMNS}
    for name in ("zeta", "F0"):
        low, high = cells[f"{name}_low"], cells[f"{name}_high"]
        if (low == "") != (high == ""):
            raise InvalidScenario(f"case {number}: the interval of {name!r} has one end")
        if low and float(low) > float(high):
            raise InvalidScenario(f"case {number}: the interval of {name!r} ends below its start: {low} > {high}")
    return [number, *cells.values()]


def _cell(number, column, value):
    if value is None:
        return ""
    if column == "usable":
        for word, same in (("yes", True), ("no", False)):
            if isinstance(value, str) and value == word or not isinstance(value, str) and value == same:
                return word
        raise InvalidScenario(f"case {number}: 'usable' is True, False, 'yes' or 'no', not {value!r}")
    try:
        found = float(value)
    except (TypeError, ValueError):
        found = None
    if found is None or isinstance(value, (bool, np.bool_)):
        raise InvalidScenario(f"case {number}: {column!r} is no number: {value!r}")
    if np.isnan(found):
        return ""
    low, high = (0, 1) if column == "p_value" else (-_LARGEST, _LARGEST)
    if not low <= found <= high:
        raise InvalidScenario(f"case {number}: {column!r} is out of range: {found!r}, not from {low} to {high}")
    return repr(found)
