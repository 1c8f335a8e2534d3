"""Scores of the benchmark by their definitions in docs/benchmark.md, and the tables of a result."""

import csv
from pathlib import Path


def table(path):
    lines = [line for line in Path(path).read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def number(text):
    return float(text) if text not in ("", None) else None


def plain(row):
    """A row without the name of its method."""
    return {key: value for key, value in row.items() if key != "method"}


def interval_score(low, high, truth):
    return min(((high - low) + 40 * max(low - truth, 0) + 40 * max(truth - high, 0)) / truth, 40)


def risk_area(items):
    """items: (confidence, loss)."""
    groups = {}
    for confidence, loss in items:
        groups.setdefault(confidence, []).append(loss)
    seen, area = [], 0
    for confidence in sorted(groups, reverse=True):
        seen += groups[confidence]
        area += len(groups[confidence]) / len(items) * sum(seen) / len(seen)
    return area
