"""Running scenarios."""

from __future__ import annotations

import sys
import traceback
import warnings
from collections.abc import Mapping
from contextlib import nullcontext
from os import PathLike, fsencode

from . import _tables
from ._arguments import path_text, thread_count
from ._errors import CheckFailed, IncompleteResult, NumericalFailure
from ._library import core
from ._results import Result
from ._scenario import flow, plain, refuse_surrogates, text_of

_CHECK_FAILED = 1  # exit status of the program after a check that was asked for


def run(scenario, changes=None, *, out=None, threads=0, resume=False, overwrite=False, verify=False, progress=None):
    """Run a scenario.

    Parameters
    ----------
    scenario : mapping, str or path
        A dict with the keys of a scenario file; or the text of a scenario, which has more than one line or begins with a brace (as
        the text that `check` returns); or the name of a scenario file.
    changes : mapping, optional
        Values that replace those of the scenario, by path: ``{"system.friction.kinetic": "3 N"}``. The same as the program's ``--set``.
    out : path, optional
        Directory for the files that the program writes: result.json, a CSV file for each table, report.html.
    threads : int, optional
        Largest number of threads; 0: all cores, or one if a friction law of the scenario is written in Python.
    resume, overwrite : bool, optional
        For a stress test or a sweep whose earlier run with the same `out` was interrupted: `resume` computes the missing cases,
        `overwrite` discards the finished ones. If finished cases exist and neither is True, the run is refused.
    verify : bool, optional
        Compute the result again in another way and compare the two.
    progress : callable or True, optional
        Called as ``progress(done, all)`` during a long run, from one thread at a time. True: a bar of tqdm if that is
        installed, else a line on stderr.

    Returns
    -------
    Result
        Numbers, tables and warnings.

    Raises
    ------
    InvalidScenario
        The scenario or its data are invalid. The message has all problems with their places.
    NumericalFailure
        There is no result: no steady state, values beyond the range of double precision, a law that broke its contract.
    CheckFailed
        A value of the result differs from the one that the scenario expects, or the verification found a difference.
    KeyboardInterrupt
        Ctrl-C, or "interrupt" in a notebook; within about a tenth of a second.

    Warns
    -----
    IncompleteResult
        A part of the result is missing: an identification without an answer, failed cases of a stress test.

    Notes
    -----
    A scenario file may name data files in its own directory or below it. A text may name data files in the current directory or
    below it. A dict may name any file. The lock of the interpreter is released while a scenario runs.

    Examples
    --------
    >>> import dualdamp as dd
    >>> result = dd.run({
    ...     "system": {"mass": "1 kg", "stiffness": "100 N/m", "damping": "4 N.s/m", "friction": {"law": "coulomb", "kinetic": "2 N"}},
    ...     "excitation": {"type": "base_harmonic", "amplitude": "0.1 m", "frequency": "natural"},
    ...     "analysis": {"type": "steady_state"}})
    >>> round(result.amplitude, 6), result.stops_per_cycle
    (0.186078, 0)
    """
    if verify:
        changes = {**(changes or {}), "numerics.verify": True}
    return run_source(source_of(scenario, changes), out=out, threads=threads, resume=resume, overwrite=overwrite, progress=progress)


def check(scenario, changes=None):
    """Check a scenario without running it.

    Parameters
    ----------
    scenario, changes
        As in `run`.

    Returns
    -------
    str
        The scenario as one line of JSON, with numbers in SI and with all defaults. It is itself a valid scenario.

    Raises
    ------
    InvalidScenario
        The scenario is invalid. The message has all problems with their places.
    """
    return core.resolved(source_of(scenario, changes))


def load_plugin(path):
    """Load a friction law from a shared library with the C interface of docs/plugins.md.

    Parameters
    ----------
    path : path
        The library. It stays loaded. Call this function before the first scenario is run.

    Raises
    ------
    InvalidScenario
        The file is no such library.
    """
    core.load_plugin(fsencode(path_text(path)))
    _tables.forget()


def source_of(scenario, changes=None, data=None):
    """The source of a scenario for the libraries. `data`: texts in place of data files, by name."""
    if not isinstance(changes or {}, Mapping):
        raise TypeError(f"changes are a dict of path and value, such as {{'system.mass': '2 kg'}}, not {changes!r}")
    set_ = [f"{path}={flow(plain(value))}" for path, value in (changes or {}).items()]
    data = data or {}
    for text in set_:
        refuse_surrogates(text)
    if isinstance(scenario, Mapping):
        return core.Source(text_of(scenario), "scenario", data_anywhere=True, data=data, set=set_)
    if isinstance(scenario, str) and ("\n" in scenario or scenario.lstrip().startswith("{")):
        refuse_surrogates(scenario)
        return core.Source(scenario, "scenario", data=data, set=set_)
    if isinstance(scenario, (str, PathLike)):
        return core.Source("", fsencode(path_text(scenario, "the name of a scenario")), is_file=True, data=data, set=set_)
    raise TypeError(f"a scenario is a dict, a text or a path, not {type(scenario).__name__}")


def run_source(source, *, out=None, threads=0, resume=False, overwrite=False, progress=None, key="", answers=()):
    report = reporter(progress)
    if resume and overwrite:
        raise TypeError("a run goes on where an earlier one ended, or begins anew: one of resume and overwrite")
    if resume and out is None and not key:
        raise TypeError("resume goes on with what is in the directory `out`, and none is given")
    directory = b"" if out is None else fsencode(path_text(out, "out"))
    laws = sys.modules.get(__package__ + "._python_laws")  # the module is loaded only if a law is written in Python
    try:
        with laws.Watch() if laws is not None else nullcontext() as watch:
            done = core.run(source, directory, thread_count(threads), bool(resume), bool(overwrite), report, key, list(answers))
    finally:
        close(report)
    result = Result(done)
    if out is not None:
        for message in done.save(directory):
            warnings.warn(message, stacklevel=3)
    if done.numbers == "null":
        error = watch and watch.error
        because = f": {''.join(traceback.format_exception_only(error)).strip()}" if error else ""
        raise NumericalFailure(done.failure + because, result) from error
    if result.status == _CHECK_FAILED:
        raise CheckFailed(_failed_checks(result), result)
    if result.status != 0:
        warnings.warn(IncompleteResult(done.failure or "some cases failed; their rows have a reason"), stacklevel=3)
    return result


def _failed_checks(result):
    lines = [f"{check.value} is {check.found}, expected {check.expected}" for check in result.checks if not check.ok]
    verification = result.document.get("verification") or {}
    if not verification.get("agrees", True):
        lines.append("verification: " + verification["reason"])
    return "\n".join(lines)


def reporter(progress):
    """The function to call as (done, all), or None."""
    if progress is True:
        return _Progress()
    if progress is None or progress is False or callable(progress):
        return progress or None
    raise TypeError(f"progress is True, False or a function of (done, all), not {progress!r}")


def close(report):
    """To be called after the last call of `report`."""
    if isinstance(report, _Progress):
        report.close()


class _Progress:
    """A bar of tqdm, or a line on stderr."""

    def __init__(self):
        self._bar = None
        self._is_shown = False

    def __call__(self, done, all_):
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._is_shown = True
            print(f"\r{done} of {all_} cases", end="", file=sys.stderr, flush=True)
            return
        if self._bar is None:
            self._bar = tqdm(total=all_, unit="case")
        self._bar.update(done - self._bar.n)

    def close(self):
        if self._bar is not None:
            self._bar.close()
        elif self._is_shown:
            print(file=sys.stderr)
