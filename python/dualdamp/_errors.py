"""The exceptions of the package."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Diagnostic:
    """One problem of an input: where it is, what is wrong, what was allowed and what was found.

    Attributes
    ----------
    message : str
        What is wrong.
    file : str
        The name of the file; ``scenario`` if the scenario is a text or a dict.
    line, column : int
        The place in the file, from 1; 0 if it is not known. If the scenario is a dict, the place in its text as YAML.
    text : str
        The line itself.
    allowed, found, suggestion : str
        What is accepted, what was found, and what was perhaps meant; empty if there is nothing to say.
    """

    message: str
    file: str = ""
    line: int = 0
    column: int = 0
    text: str = ""
    allowed: str = ""
    found: str = ""
    suggestion: str = ""


class DualdampError(Exception):
    """Base class of all exceptions of the package."""


class InvalidScenario(DualdampError, ValueError):
    """A scenario or its data are invalid. The text of the exception is the program's message, with all problems.

    Attributes
    ----------
    diagnostics : tuple of Diagnostic
        The parts of each problem.
    """

    def __init__(self, message, diagnostics=()):
        super().__init__(message)
        self.diagnostics = tuple(Diagnostic(**fields) if isinstance(fields, dict) else fields for fields in diagnostics)

    def __reduce__(self):
        return type(self), (str(self), self.diagnostics)


class _WithResult(DualdampError):
    def __init__(self, message, result=None):
        super().__init__(message)
        self.result = result

    def __reduce__(self):
        return type(self), (str(self), self.result)


class NumericalFailure(_WithResult, ArithmeticError):
    """The scenario is valid, but there is no result. The text of the exception says why: no steady state, a law broke its contract, ...

    Attributes
    ----------
    result : Result or None
        The run, with its warnings and its scenario.
    """


class CheckFailed(_WithResult, AssertionError):
    """A value differs from the one that the scenario expects, or the verification found a difference.

    Attributes
    ----------
    result : Result
        The whole result; `result.checks` has the comparison.
    """


class OutputError(DualdampError, OSError):
    """A result cannot be written."""


class IncompleteResult(UserWarning):
    """There is a result, but a part of it is missing: an identification without an answer, a stress test with failed cases."""
