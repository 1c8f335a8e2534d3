"""The parts of a class that is to be a friction law, checked before the libraries get its table."""

from __future__ import annotations

import inspect
import operator
from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from numbers import Real

from ._errors import Diagnostic, InvalidScenario


@dataclass(frozen=True)
class Parameter:
    """A parameter of a law that is written in Python. `parameter` makes one."""

    unit: str
    meaning: str
    low: float = -inf
    high: float = inf
    low_is_open: bool = False
    default: float | None = None
    is_limit: bool = False

    def __post_init__(self):
        for name in ("unit", "meaning"):
            if not isinstance(getattr(self, name), str):
                raise TypeError(f"the {name} of a parameter is a text, not {getattr(self, name)!r}")
        numbers = {"lower limit": self.low, "upper limit": self.high, **({} if self.default is None else {"default": self.default})}
        for name, value in numbers.items():
            if isinstance(value, bool) or not isinstance(value, Real):
                raise TypeError(f"the {name} of a parameter is a number, not {value!r}")


def parameter(unit, meaning, *, above=None, at_least=None, at_most=None, default=None, is_limit=False):
    """A parameter of a law that is written in Python.

    Parameters
    ----------
    unit : str
        SI unit; ``"1"`` for a number without unit.
    meaning : str
        The meaning, in one line.
    above, at_least, at_most : float, optional
        Range of the values. One of `above` and `at_least`.
    default : float, optional
        Default value; without one, the parameter is required.
    is_limit : bool, optional
        Whether the parameter is a force limit or multiplies the whole force. Modifiers act on it if the law calls
        ``now.limit(value)``.

    Returns
    -------
    Parameter
    """
    if above is not None and at_least is not None:
        raise TypeError(f"a parameter has one lower limit: above={above!r} or at_least={at_least!r}")
    low = above if above is not None else -inf if at_least is None else at_least
    return Parameter(unit, meaning, low, inf if at_most is None else at_most, above is not None, default, is_limit)


def check(kind):
    """Raises `InvalidScenario` with all faults of a class that is to be a friction law."""
    if not inspect.isclass(kind):
        raise TypeError(f"a friction law is a class, not {kind!r}")
    faults = [*_faults_of_texts(kind), *_faults_of_parameters(kind), *_faults_of_functions(kind)]
    if not faults:
        faults = [*_faults_of_init(kind)]
    if faults:
        file = file_of(kind)
        problems = [Diagnostic(f"law {kind.__name__!r} refused: {fault}", file=file) for fault in faults]
        raise InvalidScenario("\n".join(f"{file}: error: {problem.message}" for problem in problems), problems)


def file_of(kind):
    """The name of the file with the source of a class."""
    try:
        return inspect.getsourcefile(kind) or "Python"
    except (OSError, TypeError):
        return "Python"


def summary_of(kind):
    """The first line of the docstring of a class."""
    return (inspect.getdoc(kind) or "").split("\n")[0].rstrip(".")


def _fault_of_text(owner, what, text, is_needed=True):
    """At most one fault."""
    if text is None or text == "":
        if is_needed:
            yield f"{owner} has no {what}"
    elif not isinstance(text, str):
        yield f"the {what} of {owner} is no text: {text!r}"
    elif not (text.isascii() and text.isprintable()):
        yield f"the {what} of {owner} is not one line of printable ASCII: {text!r}"


def _faults_of_texts(kind):
    yield from _fault_of_text("the class", "docstring, whose first line is the summary", summary_of(kind))
    yield from _fault_of_text("the class", "'equation'", getattr(kind, "equation", None))
    yield from _fault_of_text("the class", "'version'", str(getattr(kind, "version", "1")))
    for name in ("caution", "sources"):
        yield from _fault_of_text("the class", repr(name), getattr(kind, name, None), is_needed=False)


def _faults_of_parameters(kind):
    parameters = getattr(kind, "parameters", {})
    if not isinstance(parameters, Mapping):
        yield f"'parameters' is no dict of name and dualdamp.parameter(...): {parameters!r}"
        return
    for name, value in parameters.items():
        if not (isinstance(name, str) and name.isascii() and name.isidentifier()):
            yield f"the name of a parameter is no key of a scenario: {name!r}"
        elif not isinstance(value, Parameter):
            yield f"the parameter {name!r} is no dualdamp.parameter(...): {value!r}"
        else:
            for what in ("unit", "meaning"):
                yield from _fault_of_text(f"the parameter {name!r}", what, getattr(value, what))


def _faults_of_functions(kind):
    try:
        states = operator.index(getattr(kind, "states", 0))
    except TypeError:
        states = -1
    if states < 0:
        yield f"'states' is no number of states: {kind.states!r}"
        return
    needed = ("force(self, now)",) if states == 0 else ("scales(self)", "respond(self, now, states)")
    for function in needed:
        if not hasattr(kind, function.split("(")[0]):
            yield f"the class has no function {function}, which a law {'without' if states == 0 else 'with'} states needs"
    for name in ("force", "scales", "respond", "start", "static_limit", "dissipation"):
        if hasattr(kind, name) and not callable(getattr(kind, name)):
            yield f"{name!r} is no function: {getattr(kind, name)!r}"


def _faults_of_init(kind):
    try:
        signature = inspect.signature(kind)
    except (TypeError, ValueError):
        return  # the first law that is made shows it
    try:
        signature.bind(**getattr(kind, "parameters", {}))
    except TypeError as error:
        yield f"__init__ does not take the values of 'parameters': {error}"
