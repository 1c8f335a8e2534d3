"""Results: numbers by name, tables as NumPy arrays."""

from __future__ import annotations

import html
import json
import os
import tempfile
from functools import cached_property
from pathlib import Path

import numpy as np

from ._arguments import path_text


class Record(dict):
    """A dict whose values are attributes too: ``result.answer.zeta``."""

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name!r} here; there are: {', '.join(self)}") from None

    def __dir__(self):
        return [*super().__dir__(), *self]


class Result:
    """What a scenario gave.

    Each value of the result is an attribute: ``result.amplitude``, ``result.answer.zeta``, ``result.estimates[0].std.zeta``; a list
    of equal rows is a structured array: ``result.points["x"]``. Numbers are SI. Results are immutable; pickles hold the files that the program would write.

    Attributes
    ----------
    result : Record
        The whole result, as in result.json.
    tables : dict of str to numpy.ndarray
        Structured arrays, by the name of the program's CSV file: ``result.tables["curve"]``. A number that does not exist is NaN;
        a column of whole numbers or truths in which one is missing is a column of floats.
    units : dict of str to dict
        Unit of each column of each table; an empty text: none.
    analysis : str
        Type of the analysis.
    scenario : Record
        The scenario with SI numbers, defaults filled in.
    status : int
        Exit status of the program: 0, or 1, 4, 5 for a result that lacks something.
    failure : str
        What it lacks.
    warnings : list of str
        What the program warns of.
    checks : list of Record
        The comparison with the values that the scenario expects.
    document : Record
        The whole of result.json, with provenance; the sums of the tables stand in files alone.
    """

    def __init__(self, run):
        self._run = run

    @cached_property
    def document(self):
        document = json.loads(self._run.document(), object_hook=Record)
        document.provenance.pop("tables", None)  # of a run in memory no table is written yet
        return document

    @cached_property
    def _numbers(self):
        return json.loads(self._run.numbers, object_hook=Record)

    @cached_property
    def _arrays(self):
        return {name: (key, _structured(columns), {column[0]: column[1] for column in columns}) for name, key, columns in self._run.tables()}

    @property
    def result(self):
        return self.document.result

    @property
    def tables(self):
        return {name: array for name, (_, array, _) in self._arrays.items()}

    @property
    def units(self):
        return {name: units for name, (_, _, units) in self._arrays.items()}

    @property
    def analysis(self):
        return self._run.analysis

    @cached_property
    def scenario(self):
        return json.loads(self._run.scenario, object_hook=Record)

    @property
    def status(self):
        return self._run.status

    @property
    def failure(self):
        return self._run.failure

    @property
    def warnings(self):
        return list(self._run.warnings)

    @property
    def checks(self):
        return self.document.checks

    def columns(self, table):
        """The columns of a table without a copy.

        Parameters
        ----------
        table : str
            Its name, as in `tables`.

        Returns
        -------
        dict of str to numpy.ndarray
            Read-only arrays over the memory of the result; texts are lists.
        """
        for name, _, columns in self._run.tables():
            if name == table:
                return {column: cells if kind != "text" else _texts(cells).tolist() for column, _, kind, cells in columns}
        raise KeyError(f"there is no table {table!r}; there are: {', '.join(self._arrays)}")

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        numbers = self._numbers
        # Null stands for a list that is a table.
        if isinstance(numbers, dict) and numbers.get(name) is not None:
            return numbers[name]
        for table, (key, array, _) in self._arrays.items():
            if name in (key, table):
                return array
        if isinstance(numbers, dict) and name in numbers:
            return None
        raise AttributeError(f"a result of {self.analysis} has no {name!r}; it has: {', '.join(self._names())}")

    def _names(self):
        numbers = self._numbers
        names = list(numbers) if isinstance(numbers, dict) else []
        return [*names, *(name for name in self._arrays if name not in names)]

    def __dir__(self):
        return [*super().__dir__(), *self._names()]

    def __repr__(self):
        parts = [f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value}" for name, value in self._scalars()]
        parts += [f"{name}: {len(array)} rows" for name, array in self.tables.items()]
        if self.status != 0:
            parts.append(f"status {self.status}: {self.failure}" if self.failure else f"status {self.status}")
        return f"<dualdamp {self.analysis}: {', '.join(parts)}>"

    def _scalars(self):
        numbers = self._numbers
        if not isinstance(numbers, dict):
            return []
        return [(name, value) for name, value in numbers.items() if isinstance(value, (int, float)) and not isinstance(value, bool)]

    def save(self, directory):
        """Write what the program writes: result.json, a CSV file for each table, report.html.

        Parameters
        ----------
        directory : path
            Created if need be.

        Returns
        -------
        list of str
            What there is to tell: that the result of another scenario was replaced.

        Raises
        ------
        OutputError
            The files cannot be written.
        """
        return self._run.save(os.fsencode(path_text(directory)))

    def report(self):
        """The page of the result.

        Returns
        -------
        str
            HTML, one document that needs no network.
        """
        with tempfile.TemporaryDirectory() as directory:
            self._run.save(directory)
            return (Path(directory) / "report.html").read_text(encoding="utf-8")

    def _repr_html_(self):
        page = html.escape(self.report(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 40em; border: 1px solid #ccc" title="dualdamp {self.analysis}"></iframe>'

    def _main_table(self, table):
        arrays = self.tables
        if table is None and arrays:
            return next(iter(arrays))
        if table not in arrays:
            raise KeyError(f"there is no table {table!r}; there are: {', '.join(arrays) or 'none'}")
        return table

    def to_pandas(self, table=None):
        """A table as a data frame.

        Parameters
        ----------
        table : str, optional
            Its name, as in `tables`; default: the first one. ``frame.attrs["units"]`` has the units.

        Returns
        -------
        pandas.DataFrame
        """
        import pandas

        name = self._main_table(table)
        frame = pandas.DataFrame(self.tables[name])
        frame.attrs["units"] = self.units[name]
        return frame

    def plot(self, table=None, ax=None):
        """Draw a table with Matplotlib.

        Parameters
        ----------
        table : str, optional
            Its name, as in `tables`; default: the first one that can be drawn.
        ax : matplotlib.axes.Axes, optional
            Where to; default: a new figure.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import draw

        return draw(self, table, ax)

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        run = self._run
        with tempfile.TemporaryDirectory() as directory:
            run.save(directory)
            files = {path.name: path.read_bytes() for path in Path(directory).iterdir()}
        tables = [(name, key, [(column, unit, kind, _own(cells)) for column, unit, kind, cells in columns]) for name, key, columns in run.tables()]
        names = ("status", "analysis", "failure", "warnings", "scenario", "numbers")
        return _restored, ({name: getattr(run, name) for name in names}, files, tables)


class _StoredRun:
    """A run that was unpickled: its files and tables."""

    def __init__(self, values, files, tables):
        vars(self).update(values)
        self._files = files
        self._tables = tables

    def document(self):
        return self._files["result.json"].decode()

    def tables(self):
        return self._tables

    def save(self, directory):
        directory = Path(os.fsdecode(directory))
        directory.mkdir(parents=True, exist_ok=True)
        for name, content in self._files.items():
            (directory / name).write_bytes(content)
        return []


def _restored(values, files, tables):
    return Result(_StoredRun(values, files, tables))


def _own(cells):
    """Without the memory of the result behind it."""
    return cells.copy() if isinstance(cells, np.ndarray) else cells


def _texts(cells):
    """(texts, which of them each row has)"""
    texts, choices = cells
    array = np.array(texts, dtype=object)
    return array if choices is None else array[choices]


def _converted(kind, cells):
    if kind == "text":
        return _texts(cells)
    if kind in ("count", "truth") and np.isfinite(cells).all():
        return cells.astype(np.int64 if kind == "count" else np.bool_)
    return cells


def _structured(columns):
    """One array of the columns; each is copied into its place."""
    cells = [_converted(kind, cells) for _, _, kind, cells in columns]
    array = np.empty(len(cells[0]) if cells else 0, dtype=[(column[0], part.dtype) for column, part in zip(columns, cells)])
    for column, part in zip(columns, cells):
        array[column[0]] = part
    return array
