"""Tables are read by the calls of the user guide, by pandas all of them, by NumPy those without sentences."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
# Between them these write each kind of table: numbers, words, empty cells, units in the names.
SCENARIOS = ["xy_curve", "simulate", "regime_map", "free_decay", "steady_state", "identify_sensors", "sweep", "fit"]


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """The CSV files of the scenarios, written by the package."""
    import os

    import dualdamp as dd

    os.chdir(ROOT)
    folder = tmp_path_factory.mktemp("tables")
    for name in SCENARIOS:
        dd.run(f"scenarios/examples/{name}.yaml", out=folder / name)
    return sorted(folder.rglob("*.csv"))


def without_comments(path):
    """NumPy would take names from the first line, be it a comment or not."""
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


def rows_of(path):
    """By the rules of CSV: names, and the cells of every row."""
    names, *rows = csv.reader(without_comments(path))
    return names, rows


def number(cell):
    try:
        return float(cell)
    except ValueError:
        return None


def test_there_are_tables_of_each_kind(tables):
    cells = [cell for path in tables for row in rows_of(path)[1] for cell in row]
    assert len(tables) > 10 and "" in cells and any(number(cell) is None for cell in cells)


def test_pandas(tables):
    pandas = pytest.importorskip("pandas")
    for path in tables:
        table = pandas.read_csv(path, comment="#")
        exact = pandas.read_csv(path, comment="#", float_precision="round_trip")
        names, rows = rows_of(path)
        assert list(table.columns) == names and len(table) == len(rows), path
        for column, name in enumerate(names):
            read = [number(row[column]) for row in rows]
            if all(value is not None for value in read):
                # The default reader of pandas rounds in its last digits.
                assert np.allclose(table[name].to_numpy(dtype=float), read, rtol=1e-12, atol=0), (path, name)
                assert np.array_equal(exact[name].to_numpy(dtype=float), read), (path, name)


def test_numpy_without_names(tables):
    """Numbers, and a row of NaN where the names stand."""
    path = next(path for path in tables if path.parent.name == "xy_curve" and path.name == "curve.csv")
    numbers = np.genfromtxt(path, delimiter=",")
    names, rows = rows_of(path)
    assert numbers.shape == (len(rows) + 1, len(names)) and np.isnan(numbers[0]).all()
    assert np.array_equal(numbers[1:, 1], [number(row[1]) for row in rows])


def test_numpy_with_names(tables):
    """But for tables with sentences: NumPy knows no quotes."""
    plain = [path for path in tables if not any('"' in line for line in without_comments(path))]
    assert len(plain) > len(tables) / 2
    for path in plain:
        table = np.atleast_1d(np.genfromtxt(without_comments(path), delimiter=",", names=True, dtype=None, encoding="utf-8", deletechars=""))
        names, rows = rows_of(path)
        assert len(table) == len(rows) and len(table.dtype.names) == len(names), path
        for column, name in enumerate(table.dtype.names):
            read = [number(row[column]) for row in rows]
            if all(value is not None for value in read):
                assert np.array_equal(table[name].astype(float), read), (path, name)


def test_the_numbers_are_those_of_the_result(tables):
    path = next(path for path in tables if path.parent.name == "xy_curve" and path.name == "curve.csv")
    table = np.genfromtxt(without_comments(path), delimiter=",", names=True, deletechars="")
    points = json.loads((path.parent / "result.json").read_text())["result"]["points"]
    assert [point["x"] for point in points] == table[table.dtype.names[1]].tolist()
