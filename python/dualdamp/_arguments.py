"""Checks of arguments before the libraries see them: what is wrong is said by its name."""

from __future__ import annotations

import operator
import os

import numpy as np

from ._library import core

if not core.knows_numpy_2 and int(np.__version__.split(".")[0]) >= 2:
    raise ImportError(f"dualdamp was compiled with a pybind11 older than 2.12, which reads arrays of NumPy {np.__version__} wrongly; use NumPy 1, or compile it with a newer one")

_MOST_THREADS = 1024


def path_text(value, name="a path"):
    """The text of a path."""
    text = os.fsdecode(value)
    if not text:
        raise ValueError(f"{name} is empty")
    if "\0" in text:  # what stands before it would be taken for the name
        raise ValueError(f"{name} holds a null character: {text!r}")
    return text


def thread_count(threads):
    """At most so many threads; 0: all cores."""
    try:
        count = operator.index(threads)
    except TypeError:
        raise TypeError(f"threads is a whole number, not {threads!r}") from None
    if not 0 <= count <= _MOST_THREADS:
        raise ValueError(f"threads is 0 (all cores) to {_MOST_THREADS}, not {count}")
    return count


def refuse_masked(name, array):
    """Numbers behind a mask would be used like the others."""
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        raise ValueError(f"{name} has masked values: leave them out, or fill them, before they are used")


def refuse_twice(function, options, names):
    """Options that are the function's own."""
    for name in names:
        if name in options:
            raise TypeError(f"{function} has no option {name!r}")
