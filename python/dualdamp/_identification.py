"""Identification of measured data from files, arrays and data frames."""

from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np

from ._arguments import is_unicode, path_text, refuse_masked, refuse_other_rows, refuse_twice
from ._library import core
from ._run import run_source, source_of

# In place of the name of a file, if the data are in memory.
_IN_MEMORY = "data"


def identify(
    data,
    *,
    mass=None,
    stiffness=None,
    frequency=None,
    gravity_stiffness=None,
    coordinate=None,
    methods=None,
    units=None,
    columns=None,
    scale=None,
    out=None,
    threads=0,
    **options,
):
    """Identify viscous damping and Coulomb friction from measured data.

    Parameters
    ----------
    data : path, pandas.DataFrame, structured array or mapping of str to array_like
        A CSV, MATLAB or universal file; or columns by name: ``Y`` and ``x`` (amplitudes), ``t`` with ``x``, ``y``, ``v``, ``a``,
        ``force`` (histories), ``x`` alone (extremes of a free vibration), ``omega``, ``phase``, ``sweep``, .... A name may have a
        unit, ``"x [mm]"``; without one, the numbers are in SI. A ``phase`` that was not measured is NaN or None. docs/data-files.md
        has the details.
    mass, stiffness : str or float, optional
        Constants of the rig: ``"1.042 kg"``. An uncertainty may follow: ``"1.042 kg +- 0.5 %"``.
    frequency : str, optional
        Forcing frequency with its unit: ``"6.17 Hz"``.
    gravity_stiffness, coordinate : optional
        Gravity stiffness of a pendulum; ``"angle"`` if x is an angle. As in a scenario file.
    methods : list of str, optional
        Names of methods; default: all that can read the data. ``print(dualdamp.methods)`` lists them.
    units, columns, scale : mapping, optional
        Unit, name and scale of a column, if the data do not state them: ``{"x": "mm"}``, ``{"x": "LVDT 2"}``,
        ``{"x": "2.5 mm/V"}``.
    out, threads
        As in `run`.
    **options
        Further keys of the analysis ``identify``: ``robust=True``, ``sigma_x="3 um"``, ``decimal=","``, ``bootstrap=1000``, ....

    Returns
    -------
    Result
        ``answer`` (None if no method can be trusted; then ``answer_reason`` says why), ``estimates``, ``assumptions``, ``verdict``.

    Raises
    ------
    InvalidScenario
        The data or the constants are invalid. The message has all problems with their places; row i of an array is line i + 2.
    NumericalFailure
        No method gives an estimate.

    Warns
    -----
    IncompleteResult
        There is no answer.

    Examples
    --------
    >>> import dualdamp as dd
    >>> pairs = {"Y [mm]": [4.5, 5.0, 5.5, 6.0, 6.5], "x [mm]": [4.70, 7.21, 9.76, 12.25, 14.82]}
    >>> found = dd.identify(pairs, mass="1.042 kg", stiffness="1568 N/m", frequency="6.17 Hz")
    >>> round(found.answer.zeta, 3), round(found.answer.F0, 1)
    (0.099, 4.4)
    """
    refuse_twice("identify", options, ("type", "data"))
    system = {"mass": mass, "stiffness": stiffness, "gravity_stiffness": gravity_stiffness, "coordinate": coordinate}
    analysis = {"type": "identify", "methods": methods, "units": units, "columns": columns, "scale": scale, **options}
    return run_source(_source(data, system, frequency, analysis), out=out, threads=threads)


def next(  # noqa: A001, of the package it is dualdamp.next, as the command is
    data, *, mass=None, stiffness=None, frequency=None, units=None, columns=None, scale=None, out=None, threads=0, **options
):
    """Find the measurements that would narrow the ranges over friction laws of a record.

    Parameters
    ----------
    data, mass, stiffness, frequency, units, columns, scale
        As in `identify`; the data are steady states.
    out, threads
        As in `run`.
    **options
        Further keys of the analysis ``design``: ``sigma_x="20 um"``, ``most_level="8 mm"`` if the drive can do no more, ....

    Returns
    -------
    Result
        ``candidates``: measurements, the best one first, with what to do as ``instruction``; ``advice``: the best one in words.

    Raises
    ------
    InvalidScenario
        As in `identify`; also for data that are no steady states.

    Examples
    --------
    >>> import dualdamp as dd
    >>> pairs = {"Y [mm]": [4.5, 5.0, 5.5, 6.0, 6.5], "x [mm]": [4.70, 7.21, 9.76, 12.25, 14.82]}
    >>> advice = dd.next(pairs, mass="1.042 kg", stiffness="1568 N/m", frequency="6.17 Hz")
    >>> advice.candidates[0].measurement
    'the same states at levels twice as high, with phases'
    """
    refuse_twice("next", options, ("type", "data"))
    analysis = {"type": "design", "units": units, "columns": columns, "scale": scale, **options}
    return run_source(_source(data, {"mass": mass, "stiffness": stiffness}, frequency, analysis), out=out, threads=threads)


def _source(data, system, frequency, analysis):
    """A scenario about one data file, or about data in memory."""
    texts = {}
    title = None
    if isinstance(data, (str, os.PathLike)):
        name = path_text(data, "the name of a data file")
        title = os.path.basename(name) or None
    else:
        name = _IN_MEMORY
        texts[name] = in_memory(data)
    scenario = {"title": title, "system": system, "analysis": {"data": name, **analysis}}
    if frequency is not None:
        scenario["excitation"] = {"type": "base_harmonic", "frequency": frequency}
    return source_of(scenario, data=texts)


def in_memory(data):
    """Data as the text of a CSV file."""
    return core.csv_text(*_columns_of(data))


def _columns_of(data):
    """A list of (heading, numbers or texts), and the number of rows."""
    if isinstance(data, np.ndarray):
        if data.dtype.names is None:
            raise TypeError("an array of data needs names: a structured array, a DataFrame, or a dict of columns such as {'Y': ..., 'x': ...}")
        pairs = [(name, data[name]) for name in data.dtype.names]
    elif isinstance(data, Mapping) or hasattr(data, "items"):  # a DataFrame has items, too
        pairs = [*_named_index(data), *data.items()]
    else:
        raise TypeError(f"data are a path, a DataFrame, a structured array or a dict of columns, not {type(data).__name__}")
    refuse_other_rows(pairs)
    columns = [(_field("the name of a column", str(name)), _cells(name, values)) for name, values in pairs]
    lengths = {len(cells) for _, cells in columns}
    if len(lengths) > 1:
        raise ValueError("the columns differ in length: " + ", ".join(f"{head} {len(cells)}" for head, cells in columns))
    return columns, lengths.pop() if lengths else 0


def _named_index(data):
    """The index of a DataFrame as columns, where it has names that no column has: that of times, such as ``t [s]``."""
    index = getattr(data, "index", None)
    names = getattr(index, "names", None)
    if names is None or not hasattr(data, "columns"):
        return []
    return [(name, index.get_level_values(i)) for i, name in enumerate(names) if name is not None and name not in data.columns]


def _cells(name, values):
    refuse_masked(f"the column {name!r}", values)
    cells = np.asarray(values)
    if cells.ndim != 1:
        raise ValueError(f"the column {name!r} has {cells.ndim} dimensions; a column has one")
    if cells.dtype.kind in "fiub":
        return cells.astype(np.float64)
    return [_field(f"row {i} of the column {name!r}", str(cell)) for i, cell in enumerate(cells)]


def _field(what, text):
    """A text as a field of a CSV file, quoted where needed. A field of a file of data has one line of characters."""
    if "\n" in text:
        raise ValueError(f"{what} has a line break: {text!r}")
    if not is_unicode(text):
        raise ValueError(f"{what} has a lone surrogate: {text!r}")
    return '"' + text.replace('"', '""') + '"' if any(c in text for c in ',"#') else text
