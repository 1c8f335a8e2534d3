"""Every shipped scenario gives what the program gives, to the last bit: numbers, tables, status, messages.

Those that take many seconds are compared only where DUALDAMP_ALL_SCENARIOS is set.
"""

import csv
import json
import os
import warnings
from pathlib import Path

import dualdamp as dd
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
LONG = {
    "any_law",
    "design",
    "figure3",
    "fit",
    "identify_frequency_response",
    "identify_histories",
    "identify_intervals",
    "open_question",
    "open_question_any_law",
    "open_question_waiting",
    "regime_map_undamped",
    "stochastic_averaging",
}
SHIPPED = sorted(path.relative_to(ROOT) for folder in ("examples", "paper") for path in (ROOT / "scenarios" / folder).glob("*.yaml"))

SCENARIOS = [path for path in SHIPPED if path.stem not in LONG or os.environ.get("DUALDAMP_ALL_SCENARIOS")]
# Friction departs from Coulomb and viscous there, or the method reads the damping alone.
WITHOUT_ANSWER = {"open_question_two_frequencies", "random_decrement", "section4_laws", "section4_subsets"}


def same(document):
    """Without what differs from run to run."""
    document = json.loads(json.dumps(document))
    del document["program"]
    document["provenance"].pop("tables", None)  # sums of files: a result in memory has written none
    for key in ("started", "duration"):
        del document["provenance"][key]
    return document


def rows_of(path):
    with path.open(newline="") as file:
        lines = [line for line in file if not line.startswith("# ")]
    rows = list(csv.reader(lines))
    return [head.split(" [")[0] for head in rows[0]], rows[1:]


def as_text(cell):
    """A cell as the number or the text that the CSV file would be read as."""
    if isinstance(cell, str):
        return cell
    value = float(cell)
    return "" if np.isnan(value) else value


def test_there_are_scenarios():
    assert len(SCENARIOS) > 60
    assert LONG < {path.stem for path in SHIPPED}


@pytest.mark.parametrize("path", SCENARIOS, ids=lambda path: path.stem)
def test_scenario(path, program, tmp_path):
    status, _, message = program("run", path, "--out", tmp_path / "program", "--quiet")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.IncompleteResult)
        try:
            result = dd.run(path)
        except (dd.NumericalFailure, dd.CheckFailed) as failure:
            result = failure.result
    assert status == (4 if path.stem in WITHOUT_ANSWER else 0), message
    assert result.status == status
    document = json.loads((tmp_path / "program" / "result.json").read_text())
    assert same(result.document) == same(document)

    written = {file.stem for file in (tmp_path / "program").glob("*.csv")}
    assert set(result.tables) == written
    for name, array in result.tables.items():
        head, rows = rows_of(tmp_path / "program" / f"{name}.csv")
        assert list(array.dtype.names) == head
        assert len(array) == len(rows)
        for i, column in enumerate(head):
            is_text = array.dtype[column].kind == "O"
            expected = [row[i] if is_text or row[i] == "" else float(row[i]) for row in rows]
            assert [as_text(cell) for cell in array[column]] == expected, column
