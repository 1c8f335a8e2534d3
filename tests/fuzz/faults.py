#!/usr/bin/env python3
"""What a machine may do to a command: signals, too little memory, full disks, strange surroundings. docs/reliability.md

usage: faults.py PROGRAM ROOT [--seconds S] [--trials N] [--seed S] [--kind KIND]... [--command NAME]...

KIND: signal, memory, disk, surroundings. Every command (fault_commands.py) meets each kind N times, or random ones meet random kinds
for S seconds, each in a folder with the results of an earlier run. Whatever happens, the folder then holds the earlier result or the whole new one, and no
stray file; the status and a message say which. After a kill the next run gives the result that an undisturbed run gives.
Prints counts by kind and status, and every fault; exit status 1 where there is one. Mounts small disks in a namespace of its own.
"""

import argparse
import collections
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from fault_commands import Prepared, commands
from fault_kinds import Trial, by_disk, by_memory, by_signal, enter_namespace
from fault_surroundings import by_surroundings

KINDS = {"signal": by_signal, "memory": by_memory, "disk": by_disk, "surroundings": by_surroundings}


class Campaign:
    def __init__(self, options, folder):
        self.options = options
        self.folder = folder
        self.random = random.Random(options.seed)
        self.counts = collections.Counter()
        self.faults = []
        self.known = {}

    def trial(self, kind, prepared, number):
        place = self.folder / "trial"
        shutil.copytree(prepared.before_folder, place, symlinks=True)
        try:
            what, status, faults = KINDS[kind](Trial(self.options.program, prepared, place, self.random, number))
        finally:
            subprocess.run(["rm", "-rf", str(place)], check=False)
        if status is None:  # nothing that this command could meet
            return
        self.counts[kind, status] += 1
        for fault in faults:
            self.faults.append(f"{prepared.command.name}, {what}: {fault}")
            print(self.faults[-1], flush=True)

    def prepared(self, command):
        """Made when it is first needed."""
        if command.name not in self.known:
            self.known[command.name] = Prepared(self.options.program, self.options.root, command, self.folder / str(len(self.known)))
        return self.known[command.name]

    def run(self):
        chosen = [command for command in commands() if not self.options.command or command.name in self.options.command]
        end = time.monotonic() + (self.options.seconds or 0)
        for number in range(1_000_000 if self.options.seconds else self.options.trials):
            for kind, command in self.random.sample([(kind, command) for kind in self.options.kind for command in chosen], len(self.options.kind) * len(chosen)):
                if self.options.seconds and time.monotonic() > end:
                    return
                step = self.random.randrange(20) if self.options.seconds else number
                self.trial(kind, self.prepared(command), step)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda path: str(Path(path).resolve()))
    parser.add_argument("root", type=lambda path: Path(path).resolve())
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", action="append", choices=sorted(KINDS))
    parser.add_argument("--command", action="append")
    options = parser.parse_args()
    options.kind = options.kind or sorted(KINDS)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        if not enter_namespace():
            options.kind = [kind for kind in options.kind if kind != "disk"]
            print("no disks can be mounted: the kind disk is left out")
        if "DUALDAMP_SANITIZED" in os.environ:
            options.kind = [kind for kind in options.kind if kind != "memory"]
            print("a sanitizer reserves terabytes of addresses: the kind memory is left out")
        campaign = Campaign(options, Path(folder))
        campaign.run()
    for (kind, status), count in sorted(campaign.counts.items(), key=str):
        print(f"{kind}: status {status}: {count}")
    print(f"{sum(campaign.counts.values())} trials, {len(campaign.faults)} faults, seed {options.seed}")
    return 1 if campaign.faults else 0


if __name__ == "__main__":
    sys.exit(main())
