#!/usr/bin/env python3
"""Mutates good inputs, gives them to the program and reports every end that is not promised.

usage: campaign.py PROGRAM ROOT KIND [--seconds S] [--executions N] [--processor S] [--seed S] [--workers N] [--keep DIR] [--only NUMBER]

KIND: scenario, neighbour, data, result. Case NUMBER of a seed is always the same; faulty ones are kept in DIR (default
build/fuzz) as a folder with the input, the command line and what is wrong. Prints counts by exit status, and every fault.
Exit status 1 where there is one. Long computations are counted, not faults: `out of time` at the budget of processor time,
which is that of the case, or S of --processor if that is less.
"""

import argparse
import collections
import concurrent.futures
import json
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import seeds
from execution import SANITIZED, Execution, faults_of_refusal, faults_of_results

MEMORY = 3 << 30  # address space of one execution


class Outcome:
    def __init__(self):
        self.executions = 0
        self.ends = []
        self.faults = []
        self.late = []
        self.command = []

    def add(self, execution, what, faults):
        self.executions += 1
        self.ends.append((what, "late" if execution.is_late else execution.status))
        if execution.is_late and what != "check":
            self.late.append(f"{what}: {faults[0]}")
            return
        self.faults += [f"{what}: {fault}" for fault in faults]
        if faults:
            self.command.append(execution.stderr[-3000:])


def result_of(directory):
    path = directory / "result.json"
    return path.read_bytes() if path.is_file() else None


def run_case(program, case, keep):
    outcome = Outcome()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, content in case.files.items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_bytes(content)
        for step in case.steps:
            earlier = result_of(folder / step.out) if step.out else None
            execution = Execution(program, step.arguments, folder, case.budget, MEMORY)
            faults = execution.faults(step.ends)
            if execution.status == 3:
                faults += faults_of_refusal(execution, step.names)
            if execution.status == 3 and earlier is not None:
                faults += [] if result_of(folder / step.out) == earlier else ["a refusal changed the result that was there"]
            elif step.out and not execution.is_late:
                faults += faults_of_results(folder / step.out, execution.status)
            outcome.add(execution, step.what, faults)
            if execution.status not in (0, 1, 4, 5) or execution.is_late:
                break
        if outcome.faults or outcome.late:
            place = Path(keep) / ("late" if not outcome.faults else "faults") / case.name
            shutil.rmtree(place, ignore_errors=True)
            shutil.copytree(folder, place, ignore=shutil.ignore_patterns("out*"))
            lines = [" ".join(map(str, step.arguments)) for step in case.steps] + outcome.faults + outcome.late + outcome.command
            (place / "why.txt").write_text("\n".join(lines) + "\n")
    return case.name, outcome


def work(arguments):
    program, root, kind, seed, number, keep, processor = arguments
    case = seeds.case(kind, root, seed, number, program)
    case.budget = min(case.budget, (10 if SANITIZED else 1) * processor)
    return run_case(program, case, keep)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("root")
    parser.add_argument("kind", choices=sorted(seeds.KINDS))
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--executions", type=int, default=1000)
    parser.add_argument("--processor", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--keep", default="build/fuzz")
    parser.add_argument("--only", type=int)
    options = parser.parse_args()
    program, keep = str(Path(options.program).resolve()), str(Path(options.keep).resolve())

    def jobs():
        number = 0
        while True:
            yield program, options.root, options.kind, options.seed, number, keep, options.processor
            number += 1

    started = time.monotonic()
    ends, executions, faulty, late = collections.Counter(), 0, 0, 0
    if options.only is not None:
        results = [work((program, options.root, options.kind, options.seed, options.only, keep, options.processor))]
        print(*results[0][1].ends, *results[0][1].faults, *results[0][1].late, sep="\n")
        return 1 if results[0][1].faults else 0
    with concurrent.futures.ProcessPoolExecutor(options.workers) as pool:
        pending = set()
        source = jobs()
        while True:
            is_over = executions >= options.executions or time.monotonic() - started > options.seconds
            while not is_over and len(pending) < 4 * options.workers:
                pending.add(pool.submit(work, next(source)))
            if not pending:
                break
            done, pending = concurrent.futures.wait(pending, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in done:
                name, outcome = future.result()
                executions += outcome.executions
                ends.update(outcome.ends)
                faulty += bool(outcome.faults)
                late += bool(outcome.late)
                for fault in outcome.faults + outcome.late:
                    print(f"{name}: {fault}", flush=True)
    print(json.dumps({"kind": options.kind, "seed": options.seed, "executions": executions, "seconds": round(time.monotonic() - started),
                      "ends": {f"{what} {status}": count for (what, status), count in sorted(ends.items(), key=str)}, "faulty": faulty, "out of time": late}))
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
