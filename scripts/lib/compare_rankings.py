#!/usr/bin/env python3
"""Compares the differences of methods in several runs of one stress test.

usage: compare_rankings.py DIRECTORY...

Prints how many differences exceed two standard errors in each, and every pair of methods that one run puts in one order by such a
difference and another run in the other. Exit status 1 if there is such a pair.
"""

import csv
import sys
from itertools import combinations
from pathlib import Path


def significant(directory):
    """Pairs of (better, worse)."""
    lines = [line for line in (Path(directory) / "differences.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    pairs = {(row["better"], row["worse"]) for row in rows if row["significant"] == "1"}
    print(f"{Path(directory).name}: {len(pairs)} of {len(rows)} differences exceed two standard errors")
    return pairs


def main(directories):
    found = {directory: significant(directory) for directory in directories}
    turned = [(a, b, pair) for a, b in combinations(found, 2) for pair in found[a] if pair[::-1] in found[b]]
    for a, b, (better, worse) in turned:
        print(f"{better} before {worse} in {Path(a).name}, after it in {Path(b).name}")
    print("pairs that change their order:", len(turned))
    return 1 if turned else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
