#!/usr/bin/env python3
"""Compares what a built program computes with what an earlier one did, on all that is shipped.

usage: compare_results.py BASELINE PROGRAM [--record] [--only TEXT]...

The jobs are `run` on every scenario under scenarios/ and `identify` on every data file listed below. With --record
their outputs are written to the directory BASELINE; without it the jobs are run in a temporary directory and every
difference from BASELINE is printed, a line each: result.json and the other JSON files value by value, CSV files cell
by cell, and the exit status. What says who computed it and when (program, provenance, title, campaign, comments of CSV files) is left
out. --only picks the jobs whose name contains TEXT. Exit status 1 when something differs.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ["scenarios/paper", "scenarios/examples", "scenarios/stress"]
RIG = ["--mass", "1.042 kg", "--stiffness", "1568 N/m"]
DATA = {
    "scenarios/examples/my_rig.csv": [*RIG, "--frequency", "6.17 Hz"],
    "scenarios/examples/drifting_sweeps.csv": [*RIG, "--frequency", "6.17 Hz"],
    "scenarios/examples/steady_states.csv": RIG,
    "scenarios/examples/bearing_history.csv": RIG,
    "scenarios/paper/example_22_64.csv": [*RIG, "--frequency", "6.17 Hz"],
    "scenarios/paper/subset_trend.csv": [*RIG, "--frequency", "6.17 Hz"],
    "tests/valid/pairs.csv": ["--mass", "1 kg", "--stiffness", "100 N/m", "--frequency", "10 rad/s"],
}
VARYING = {"program", "provenance", "title", "campaign"}
SHOWN = 8  # differences of one job


def jobs(only):
    """Name and arguments of each job, without --out."""
    found = {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).glob("*.yaml")):
            name = str(path.relative_to(ROOT))
            found[name] = ["run", name]
    for path, constants in DATA.items():
        found["identify " + path] = ["identify", path, *constants]
    return {name: words for name, words in found.items() if not only or any(text in name for text in only)}


def run(program, words, out):
    done = subprocess.run([program, *words, "--quiet", "--out", str(out)], cwd=ROOT, capture_output=True, text=True)
    out.mkdir(parents=True, exist_ok=True)
    (out / "status").write_text(f"{done.returncode}\n")
    (out / "errors").write_text(done.stderr)


def slot(name):
    return name.replace("/", "-").replace(" ", "-")


def run_all(program, chosen, directory):
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda job: run(program, job[1], directory / slot(job[0])), chosen.items()))


def flat(value, path=""):
    """Every leaf of a JSON document with its path."""
    if value == {}:
        yield path, value
    elif isinstance(value, dict):
        for key, item in value.items():
            if key not in VARYING:
                yield from flat(item, f"{path}.{key}")
    elif isinstance(value, list):
        yield f"{path}.length", len(value)
        for index, item in enumerate(value):
            yield from flat(item, f"{path}[{index}]")
    else:
        yield path, value


def leaves(path):
    text = path.read_text()
    if path.suffix == ".json":
        return dict(flat(json.loads(text)))
    if path.suffix == ".jsonl":
        return dict(flat([json.loads(line) for line in text.splitlines()]))
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return {f"row {row}, column {column}": cell for row, line in enumerate(lines)
            for column, cell in enumerate(line.split(","))}


def differences(before, after):
    names = {path.name for side in (before, after) for path in side.iterdir()
             if path.suffix in (".json", ".jsonl", ".csv") or path.name == "status"}
    for name in sorted(names):
        if not (before / name).exists() or not (after / name).exists():
            yield f"{name}: only {'after' if (after / name).exists() else 'before'}"
            continue
        old, new = leaves(before / name), leaves(after / name)
        for key in [*old, *(key for key in new if key not in old)]:
            if old.get(key, "nothing") != new.get(key, "nothing"):
                yield f"{name}: {key}: {old.get(key, 'nothing')!r} -> {new.get(key, 'nothing')!r}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("baseline", type=Path)
    parser.add_argument("program", type=lambda name: str(Path(name).resolve()))
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--only", action="append", default=[])
    options = parser.parse_args()
    chosen = jobs(options.only)
    if not chosen:
        parser.error("no job has such a name: nothing would be compared")
    if options.record:
        run_all(options.program, chosen, options.baseline)
        print(f"recorded {len(chosen)} jobs")
        return
    changed = 0
    with tempfile.TemporaryDirectory() as place:
        run_all(options.program, chosen, Path(place))
        for name in chosen:
            before = options.baseline / slot(name)
            found = list(differences(before, Path(place) / slot(name))) if before.is_dir() else ["not in the baseline"]
            changed += bool(found)
            for line in found[:SHOWN]:
                print(f"{name}: {line}")
            if len(found) > SHOWN:
                print(f"{name}: and {len(found) - SHOWN} more")
    print(f"{len(chosen)} jobs, {len(chosen) - changed} the same, {changed} different")
    sys.exit(1 if changed else 0)


if __name__ == "__main__":
    main()
