"""Friction laws written in Python or C.

A law is handed to the libraries as a table of C functions (friction_models/dualdamp_law.h), as a plugin is. Here the functions are
those of a Python class, or compiled from a C text. Names and layout of the structures are those of the header.
"""

from __future__ import annotations

import ctypes as c
import inspect
import operator
import os
import shutil
import subprocess
import tempfile
import threading
import traceback
from pathlib import Path

from . import _law_parts, _tables
from ._library import core

_ABI = 1
_IS_ODD, _IS_PASSIVE = 1, 2
_REFUSED = 1
_Doubles = c.POINTER(c.c_double)


class Instant(c.Structure):
    """The state of the mass at one instant, for a law written in Python.

    Attributes
    ----------
    t, x, v : float
        Time [s], position [m], velocity [m/s].
    direction : int
        Direction of slip: -1 or 1; 0 while the mass sticks. Write ``direction * v`` for the absolute value of v.
    """

    _fields_ = [
        ("t", c.c_double),
        ("x", c.c_double),
        ("v", c.c_double),
        ("direction", c.c_int),
        ("limit_factor", c.c_double),
        ("limit_offset", c.c_double),
        ("limit_vanished", c.c_double),
    ]

    def limit(self, nominal):
        """The force limit at this instant. `nominal`: its value without modifiers (drift, fluctuation, ...)."""
        return 0.0 if nominal <= self.limit_vanished else self.limit_factor * nominal + self.limit_offset


class _Parameter(c.Structure):
    _fields_ = [
        ("name", c.c_char_p),
        ("unit", c.c_char_p),
        ("meaning", c.c_char_p),
        ("low", c.c_double),
        ("high", c.c_double),
        ("low_is_open", c.c_int),
        ("high_is_open", c.c_int),
        ("has_default", c.c_int),
        ("fallback", c.c_double),
        ("is_limit", c.c_int),
    ]


_Now = c.POINTER(Instant)
_FUNCTIONS = {
    "create": c.CFUNCTYPE(c.c_int, _Doubles, c.POINTER(c.c_void_p), c.POINTER(c.c_char), c.c_uint),
    "destroy": c.CFUNCTYPE(None, c.c_void_p),
    "respond": c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, _Doubles, _Now, _Doubles, _Doubles),
    "scales": c.CFUNCTYPE(c.c_int, c.c_void_p, _Doubles),
    "start": c.CFUNCTYPE(c.c_int, c.c_void_p, _Now, c.POINTER(c.c_int), _Doubles),
    "static_limit": c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, _Doubles, _Now, _Doubles),
    "guard": c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, _Doubles, _Now, _Doubles),
    "jump": c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, _Now, c.POINTER(c.c_int), _Doubles),
    "dissipation": c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, _Doubles, _Now, _Doubles),
}


class _Table(c.Structure):
    _fields_ = [
        *((name, c.c_uint) for name in ("size", "abi", "abilities", "modes", "states", "guards", "parameter_count")),
        ("parameters", c.POINTER(_Parameter)),
        *((name, c.c_char_p) for name in ("name", "version", "summary", "equation", "remembers", "caution", "sources")),
        *_FUNCTIONS.items(),
    ]


def _row(name, value):
    default = 0.0 if value.default is None else value.default
    texts = [text.encode() for text in (name, value.unit, value.meaning)]
    return _Parameter(*texts, value.low, value.high, value.low_is_open, False, value.default is not None, default, value.is_limit)


def friction_law(kind):
    """Make a class a friction law; a decorator.

    `law` and scenarios take the law by the name of the class. Its parameters are checked, and all analyses run it with the smooth
    engine. A call into Python takes about two microseconds, and a motion needs thousands of calls. For full speed, write the law in C
    and use `compile_law`.

    Parameters
    ----------
    kind : type
        A class with

        * a docstring, whose first line is the summary;
        * ``equation``: the formula as text;
        * ``parameters``: dict of name to `parameter`; ``__init__`` gets their values in SI, by name, and raises
          ValueError for values that are not allowed together;
        * ``force(self, now)``: the force [N], > 0 opposing v > 0; `now` is an `Instant`;
        * or, for a law with internal states: ``states``, their number; ``scales(self)``, the size of each state in a motion that
          slips; and ``respond(self, now, states)``, which returns the force [N] and the rate of each state;
        * optional: ``start(self, now)``, the states at the start; ``static_limit(self, now)`` or ``static_limit(self, now, states)``,
          the largest force that the law holds while the mass sticks [N]; ``dissipation(self, now, states)``, the power that becomes
          heat [W], for a law that stores energy;
        * optional: ``is_odd``, ``is_passive`` (default: True), ``version``, ``sources``, ``caution``.

        Its functions must be pure: the same arguments must give the same results, and several threads may call them. A run calls them
        in one thread, unless ``threads`` is stated: threads that take the interpreter's lock in turn take longer.

    Returns
    -------
    type
        The class itself.

    Raises
    ------
    InvalidScenario
        The class lacks a part of a law, or a part is invalid.

    Notes
    -----
    Define laws before other threads run scenarios. A class of the same name replaces the law. An exception in a function of the
    law ends the run; it is the cause of the `NumericalFailure`. The direction of slip is constant between events: write
    ``now.direction`` for the sign of v, and ``now.direction * now.v`` for its absolute value.

    Examples
    --------
    >>> import math
    >>> import dualdamp as dd
    >>> @dd.friction_law
    ... class smooth_coulomb:
    ...     '''Coulomb friction without a jump.'''
    ...     equation = "F = level tanh(v/speed)"
    ...     parameters = {
    ...         "level": dd.parameter("N", "force at high speed", at_least=0, is_limit=True),
    ...         "speed": dd.parameter("m/s", "speed at which it is three quarters of that", above=0),
    ...     }
    ...     def __init__(self, level, speed):
    ...         self.level, self.speed = level, speed
    ...     def force(self, now):
    ...         return now.limit(self.level) * math.tanh(now.v / self.speed)
    >>> dd.law("smooth_coulomb", level="2 N", speed="1 mm/s")
    law('smooth_coulomb', level='2 N', speed='1 mm/s')
    """
    _law_parts.check(kind)
    table = _LawTable(kind)
    core.add_law(c.addressof(table.table), table.origin, table.source)
    _keep(table)
    _tables.forget()
    vars(_tables.laws).pop(kind.__name__, None)
    return kind


def compile_law(source, *, compiler=None):
    """Compile and load a friction law in C, with the interface of docs/plugins.md.

    Parameters
    ----------
    source : str or path
        The C text, which has more than one line, or the name of a C file. It must include ``dualdamp_law.h``.
    compiler : str, optional
        Default: the environment variable ``CC``, or ``cc``.

    Raises
    ------
    InvalidScenario
        The library is no law, or another law has its name.
    RuntimeError
        The compiler refuses the text; the exception has its messages.
    """
    text = source if isinstance(source, str) and "\n" in source else Path(source).read_text(encoding="utf-8")
    directory = Path(tempfile.mkdtemp(prefix="dualdamp-law-"))
    try:
        (directory / "law.c").write_text(text, encoding="utf-8")
        command = [compiler or os.environ.get("CC", "cc"), "-O2", "-shared", "-fPIC", f"-I{include_directory()}", "law.c", "-lm", "-o", "law.so"]
        done = subprocess.run(command, cwd=directory, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}:\n{done.stderr}")
        core.load_plugin(str(directory / "law.so"))
    except BaseException:
        shutil.rmtree(directory, ignore_errors=True)
        raise
    # Otherwise the directory stays: the library is loaded, and provenance names its file.
    _tables.forget()


def include_directory():
    """The directory of ``dualdamp_law.h``, for laws in C.

    Returns
    -------
    str
    """
    return str(Path(__file__).with_name("include"))


def _keep(table):
    """Keeps a table and its functions for good. A law that was replaced may still be in use, and results that are alive when the interpreter
    ends call `destroy` in its last collection of garbage, in which modules and what only they hold are freed too."""
    c.pythonapi.Py_IncRef(c.py_object(table))


class Watch:
    """Keeps the last exception of a law in the runs of one thread, while it is entered.

    The libraries learn only that a function failed, and several threads may run scenarios. So an exception belongs to the run of the thread
    in which it was raised; in a thread of the libraries, to the run that made the law, or to the only run. An exception that may belong to
    another run is the cause of none.
    """

    _of_thread = threading.local()
    _entered: list[Watch] = []

    def __init__(self):
        self.error = None

    def __enter__(self):
        self._outer, self._of_thread.watch = Watch.here(), self
        self._entered.append(self)
        return self

    def __exit__(self, *_):
        self._of_thread.watch = self._outer
        self._entered.remove(self)

    @classmethod
    def here(cls):
        """The watch of this thread, or None."""
        return getattr(cls._of_thread, "watch", None)

    @classmethod
    def keep(cls, error, maker):
        """Keeps an exception of a law that was made under the watch `maker`, or under none."""
        watch = cls.here() or maker or (cls._entered[0] if len(cls._entered) == 1 else None)
        if watch is not None:
            watch.error = error


class _LawTable:
    """The table of C functions of a class."""

    def __init__(self, kind):
        self._kind = kind
        self._laws = {}
        self._makers = {}  # the watch under which each law was made
        self._states = operator.index(getattr(kind, "states", 0))
        parameters = getattr(kind, "parameters", {})
        self._names = list(parameters)
        self._rows = (_Parameter * max(len(parameters), 1))(*(_row(name, value) for name, value in parameters.items()))
        self._functions = {name: _FUNCTIONS[name](getattr(self, "_" + name)) for name in self._present()}
        self.origin = _law_parts.file_of(kind)
        try:
            self.source = inspect.getsource(kind)
        except (OSError, TypeError):
            self.source = repr(kind)
        self.table = self._filled()

    def _present(self):
        yield from ("create", "destroy", "respond")
        if self._states > 0:
            yield "scales"
        for name in ("start", "static_limit", "dissipation"):
            if hasattr(self._kind, name):
                yield name

    def _filled(self):
        kind = self._kind
        texts = {
            "name": kind.__name__,
            "version": str(getattr(kind, "version", "1")),
            "summary": _law_parts.summary_of(kind),
            "equation": getattr(kind, "equation", ""),
            "remembers": f"{self._states} states" if self._states > 0 else None,
            "caution": getattr(kind, "caution", None),
            "sources": getattr(kind, "sources", None),
        }
        table = _Table(size=c.sizeof(_Table), abi=_ABI, modes=1, states=self._states, guards=0, parameter_count=len(self._names))
        table.abilities = _IS_ODD * bool(getattr(kind, "is_odd", True)) + _IS_PASSIVE * bool(getattr(kind, "is_passive", True))
        table.parameters = c.cast(self._rows, c.POINTER(_Parameter))
        for name, text in texts.items():
            setattr(table, name, None if text is None else text.encode())
        for name, function in self._functions.items():
            setattr(table, name, function)
        return table

    def _create(self, values, law, message, size):
        try:
            made = self._kind(**{name: values[i] for i, name in enumerate(self._names)})
        except ValueError as error:
            text = str(error).encode("ascii", "replace")[: size - 1]
            c.memmove(message, text + b"\0", len(text) + 1)
            return _REFUSED
        except BaseException as error:
            text = "".join(traceback.format_exception_only(error)).strip().encode("ascii", "replace")[: size - 1]
            c.memmove(message, text + b"\0", len(text) + 1)
            return _REFUSED
        # The libraries know the object by its address, which is never 0.
        self._laws[id(made)] = made
        self._makers[id(made)] = Watch.here()
        law[0] = id(made)
        return 0

    def _destroy(self, law):
        self._laws.pop(law, None)
        self._makers.pop(law, None)

    def _guarded(self, law, work):
        try:
            work()
        except BaseException as error:  # noqa: BLE001 - no exception may cross the border; KeyboardInterrupt is raised behind it
            Watch.keep(error, self._makers.get(law))
            return _REFUSED
        return 0

    def _respond(self, law, mode, states, now, force, rates):
        def work():
            if self._states == 0:
                force[0] = self._laws[law].force(now[0])
                return
            force[0], found = self._laws[law].respond(now[0], states[: self._states])
            self._fill(rates, found, "rates")

        return self._guarded(law, work)

    def _fill(self, place, values, what):
        if len(values) != self._states:
            raise ValueError(f"{self._kind.__name__} gave {len(values)} {what}, and has {self._states} states")
        for i, value in enumerate(values):
            place[i] = value

    def _scales(self, law, scales):
        return self._guarded(law, lambda: self._fill(scales, self._laws[law].scales(), "scales"))

    def _start(self, law, now, mode, states):
        return self._guarded(law, lambda: self._fill(states, self._laws[law].start(now[0]), "states"))

    def _with_states(self, function, now, states):
        return function(now[0], states[: self._states]) if self._states > 0 else function(now[0])

    def _static_limit(self, law, mode, states, now, limit):
        def work():
            limit[0] = self._with_states(self._laws[law].static_limit, now, states)

        return self._guarded(law, work)

    def _dissipation(self, law, mode, states, now, power):
        def work():
            power[0] = self._with_states(self._laws[law].dissipation, now, states)

        return self._guarded(law, work)
