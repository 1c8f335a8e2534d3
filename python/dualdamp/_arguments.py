"""Checks of arguments before they reach the libraries. A message names the wrong argument."""

from __future__ import annotations

import operator
import os

import numpy as np

from ._library import core

if not core.knows_numpy_2 and int(np.__version__.split(".")[0]) >= 2:
    raise ImportError(f"dualdamp was compiled with a pybind11 older than 2.12, which reads arrays of NumPy {np.__version__} wrongly; use NumPy 1, or compile it with a newer one")

_MOST_THREADS = 1024


def path_text(value, name="a path"):
    """The text of a path. Raises ValueError, with `name`, for an empty path or one with a null character."""
    text = os.fsdecode(value)
    if not text:
        raise ValueError(f"{name} is empty")
    if "\0" in text:  # the operating system would cut the name there
        raise ValueError(f"{name} holds a null character: {text!r}")
    return text


def is_unicode(text):
    """Whether a text can be encoded: it has no lone surrogate."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def thread_count(threads):
    """The number of threads as an int; 0: not stated. Raises TypeError or ValueError."""
    try:
        count = operator.index(threads)
    except TypeError:
        raise TypeError(f"threads is a whole number, not {threads!r}") from None
    if not 0 <= count <= _MOST_THREADS:
        raise ValueError(f"threads is 0 (all cores) to {_MOST_THREADS}, not {count}")
    return count


def refuse_masked(name, array):
    """Refuses an array with masked values: the numbers behind the mask would be used."""
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        raise ValueError(f"{name} has masked values: leave them out, or fill them, before they are used")


def refuse_other_rows(columns):
    """Refuses Series of pandas whose indexes differ: they would be paired by position, not by index. `columns`: pairs of name and values."""
    indexed = [(name, values.index) for name, values in columns if hasattr(values, "to_numpy") and hasattr(values, "index")]
    for name, index in indexed[1:]:
        if not index.equals(indexed[0][1]):
            raise ValueError(f"{indexed[0][0]!r} and {name!r} are Series with different indexes: align them, or take their values without index, to_numpy()")


def refuse_twice(function, options, names):
    """Refuses options that the function itself sets."""
    for name in names:
        if name in options:
            raise TypeError(f"{function} has no option {name!r}")
