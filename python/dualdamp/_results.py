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
    """A dict whose values are also attributes: ``result.answer.zeta``."""

    def __getattr__(self, name):
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name!r} here; there are: {', '.join(self)}") from None

    def __dir__(self):
        return [*super().__dir__(), *self]


class Result:
    """The result of a scenario.

    Each value of the result is an attribute: ``result.amplitude``, ``result.answer.zeta``, ``result.estimates[0].std.zeta``. A list
    of equal rows is a structured array: ``result.points["x"]``. Numbers are in SI. Results are immutable. A pickle of a result holds
    the files that the program would write.

    Attributes
    ----------
    result : Record
        The whole result, as in result.json.
    tables : dict of str to numpy.ndarray
        Structured arrays, by the name of the program's CSV file: ``result.tables["curve"]``. A number that does not exist is NaN.
        A column of integers or booleans in which a value is missing becomes a column of floats.
    units : dict of str to dict
        Unit of each column of each table; empty for a column without a unit.
    analysis : str
        Type of the analysis.
    scenario : Record
        The scenario with numbers in SI and with all defaults.
    status : int
        Exit status of the program: 0; or 1, 4, 5 if a check failed or a part of the result is missing.
    failure : str
        What is missing; empty if nothing is.
    warnings : list of str
        The warnings of the program.
    checks : list of Record
        The comparison with the values that the scenario expects.
    document : Record
        The whole of result.json, with provenance, but without the SHA-256 sums of the tables; only a saved file has these.
    """

    def __init__(self, run):
        self._run = run

    @cached_property
    def document(self):
        document = json.loads(self._run.document(), object_hook=Record)
        document.provenance.pop("tables", None)  # sums of written tables; a run in memory has written none
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
        """The columns of a table, without a copy.

        Parameters
        ----------
        table : str
            Name of the table, as in `tables`.

        Returns
        -------
        dict of str to numpy.ndarray
            Read-only arrays over the memory of the result; a column of texts is a list.
        """
        for name, _, columns in self._run.tables():
            if name == table:
                return {column: cells if kind != "text" else _texts(cells).tolist() for column, _, kind, cells in columns}
        raise KeyError(f"there is no table {table!r}; there are: {', '.join(self._arrays)}")

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        numbers = self._numbers
        # A list that is also a table is null here.
        if isinstance(numbers, dict) and numbers.get(name) is not None:
            return numbers[name]
        for table, (key, array, _) in self._arrays.items():
            if name in (key, table):
                return array
        if isinstance(numbers, dict) and name in numbers:
            return None
        raise AttributeError(f"a result of {self.analysis} has no {name!r}; it has: {', '.join(self._names())}", name=name, obj=self)

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
        """Write the files that the program writes: result.json, a CSV file for each table, report.html.

        Parameters
        ----------
        directory : path
            Created if it is missing.

        Returns
        -------
        list of str
            Messages for the user, such as: the result of another scenario was replaced.

        Raises
        ------
        OutputError
            The files cannot be written.
        """
        return self._run.save(os.fsencode(path_text(directory)))

    def report(self):
        """The page of the result, as the program writes it.

        Returns
        -------
        str
            One HTML document that needs no network.
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
            Name of the table, as in `tables`; default: the first one. ``frame.attrs["units"]`` has the units.

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
        """Draw a table with Matplotlib, in the units of the page: those in which the scenario states such quantities.

        Parameters
        ----------
        table : str, optional
            Name of the table, as in `tables`; default: the first one that can be drawn.
        ax : matplotlib.axes.Axes, optional
            Axes to draw into; default: those of a new figure.

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
        names = ("status", "analysis", "failure", "warnings", "scenario", "numbers", "shown_units")
        return _restored, ({name: getattr(run, name) for name in names}, files, tables)


class _StoredRun:
    """The files and tables of a run that was unpickled."""

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
    """A copy that does not keep the memory of the result."""
    return cells.copy() if isinstance(cells, np.ndarray) else cells


def _texts(cells):
    """`cells`: the texts, and for each row the index of its text; None: one text for each row."""
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
    """One structured array with a copy of the columns."""
    cells = [_converted(kind, cells) for _, _, kind, cells in columns]
    array = np.empty(len(cells[0]) if cells else 0, dtype=[(column[0], part.dtype) for column, part in zip(columns, cells)])
    for column, part in zip(columns, cells):
        array[column[0]] = part
    return array
