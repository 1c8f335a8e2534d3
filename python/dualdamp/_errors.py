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
        The file, or what stands for it: ``scenario`` for a text or a dict.
    line, column : int
        The place in the file, from 1; 0 where it is not known. Of a dict, the place in its text (`scenario_text`).
    text : str
        The line itself.
    allowed, found, suggestion : str
        What would have been accepted, what stood there, and what was perhaps meant; empty where there is nothing to say.
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
    """What every exception of the package is."""


class InvalidScenario(DualdampError, ValueError):
    """A scenario, or its data, cannot be run. Its text is the program's message, with every problem at once.

    Attributes
    ----------
    diagnostics : tuple of Diagnostic
        Each problem by its parts.
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
    """The scenario is valid, and there is no result. Its text says why: there is no steady state, a law broke its contract, ...

    Attributes
    ----------
    result : Result or None
        The run, with its warnings and its scenario.
    """


class CheckFailed(_WithResult, AssertionError):
    """A value differs from the one that the scenario expects, or the verification by another engine disagrees.

    Attributes
    ----------
    result : Result
        The whole result; `result.checks` has the comparison.
    """


class OutputError(DualdampError, OSError):
    """A result cannot be written."""


class IncompleteResult(UserWarning):
    """There is a result, and something in it is missing: an identification without an answer, a campaign with failed cases."""
