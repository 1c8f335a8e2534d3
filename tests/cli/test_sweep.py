#!/usr/bin/env python3
"""Sweeps: the numbers of a loop over --set, for any number of threads, killed and resumed, and their exit status.

usage: test_sweep.py PROGRAM ROOT [TEST...]; DUALDAMP_KILLS: how often a sweep is killed (default 4)
"""

import csv
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from case import PROGRAM, Case

ROOT = Path(sys.argv[2]).resolve()
KILLS = int(os.environ.get("DUALDAMP_KILLS", "4"))

SYSTEM = """schema: dualdamp/1
title: a rig
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.0987, friction: {law: coulomb, kinetic: 4.39 N}}
excitation: {type: base_harmonic, amplitude: 5 mm, frequency: natural}
analysis: {type: steady_state}
"""
SWEPT = {"system.friction.kinetic": ["1 N", "2.5 N", "4 N"], "excitation.frequency": ["5.1 Hz", "6.3 Hz"]}
TWO_KEYS = SYSTEM + """sweep:
  system.friction.kinetic: {from: 1 N, to: 4 N, count: 3}
  excitation.frequency: [5.1 Hz, 6.3 Hz]
"""
# Long enough to be killed in the middle: 30 steady states under a smooth law.
SLOW = """schema: dualdamp/1
system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: dahl, kinetic: 2 N, sigma0: 2000 N/m}}
excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}
analysis: {type: steady_state}
sweep: {system.friction.kinetic: {from: 0.5 N, to: 3 N, count: 30}}
"""
# A point that has no steady state.
HALF_FAILS = SYSTEM + "sweep: {system.damping_ratio: [0, 0.1], system.friction.kinetic: [0 N]}\n"


def rows(path):
    """A table without its provenance, which tells of times."""
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


class Sweep(Case):
    def check_same(self, out, reference):
        self.assertEqual((self.folder / out / "points.jsonl").read_bytes(), (self.folder / reference / "points.jsonl").read_bytes())
        self.assertEqual(rows(self.folder / out / "sweep.csv"), rows(self.folder / reference / "sweep.csv"))
        results = [json.loads((self.folder / name / "result.json").read_text())["result"] for name in (out, reference)]
        self.assertEqual(*results)

    def test_equals_a_loop_to_the_bit(self):
        self.write("sweep.yaml", TWO_KEYS)
        self.write("one.yaml", SYSTEM)
        self.run_program("run", "sweep.yaml", "--out", "sweep", "--jobs", 2)
        swept = json.loads((self.folder / "sweep/result.json").read_text())["result"]["sweep"]
        table = list(csv.reader(rows(self.folder / "sweep/sweep.csv")))
        self.assertEqual(table[0][:3], ["system.friction.kinetic [N]", "excitation.frequency [Hz]", "status"])
        index = 0
        for friction in SWEPT["system.friction.kinetic"]:
            for frequency in SWEPT["excitation.frequency"]:
                self.run_program("run", "one.yaml", "--out", "one", "--set", f"system.friction.kinetic={friction}",
                                 "--set", f"excitation.frequency={frequency}")
                # As text: the same digits.
                alone = json.loads((self.folder / "one/result.json").read_text(), parse_float=str)["result"]
                here = json.loads((self.folder / "sweep/result.json").read_text(), parse_float=str)["result"]["sweep"][index]
                self.assertEqual(here["result"], alone)
                row = dict(zip(table[0], table[1 + index]))
                self.assertEqual(row["amplitude [m]"], alone["amplitude"])
                self.assertEqual([row["system.friction.kinetic [N]"] + " N", row["excitation.frequency [Hz]"] + " Hz"], [friction, frequency])
                index += 1
        self.assertEqual(len(swept), index)

    def test_curves_equal_a_loop_to_the_bit(self):
        self.write("one.yaml", SYSTEM.replace("{type: steady_state}", "{type: xy_curve, amplitudes: {from: 3 mm, to: 7 mm, count: 9}}"))
        self.run_program("run", "one.yaml", "--out", "sweep", "--set", "sweep={system.mass: [1 kg, 1.1 kg]}")
        table = rows(self.folder / "sweep/sweep_points.csv")
        for index, mass in enumerate(("1 kg", "1.1 kg")):
            self.run_program("run", "one.yaml", "--out", "one", "--set", f"system.mass={mass}")
            alone = rows(self.folder / "one/curve.csv")
            self.assertEqual(table[1 + 9 * index:10 + 9 * index], [f"{index},{mass.split()[0]},{line}" for line in alone[1:]])

    def test_threads(self):
        self.write("slow.yaml", SLOW)
        for threads in (1, 2, 3):
            self.run_program("run", "slow.yaml", "--out", f"out{threads}", "--jobs", threads)
            self.check_same(f"out{threads}", "out1")

    def test_killed_at_any_time_and_resumed(self):
        self.write("slow.yaml", SLOW)
        self.run_program("run", "slow.yaml", "--out", "undisturbed")
        size = (self.folder / "undisturbed/points.jsonl").stat().st_size
        draws = random.Random(2)
        interrupted = 0
        for attempt in range(KILLS):
            points = self.folder / f"killed{attempt}/points.jsonl"
            process = subprocess.Popen([PROGRAM, "run", "slow.yaml", "--out", f"killed{attempt}", "--resume", "--quiet"],
                                       cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            place = draws.uniform(-0.05, 1.05) * size
            while process.poll() is None and (points.stat().st_size if points.exists() else -1) < place:
                time.sleep(0.0005)
            process.send_signal(signal.SIGKILL)
            process.wait()
            interrupted += points.exists() and points.stat().st_size < size
            if points.exists() and attempt % 2 == 0:
                with points.open("a") as file:  # as if the machine had stopped in the middle of a line
                    file.write('{"case":39,"values":{"sys')
            self.run_program("run", "slow.yaml", "--out", f"killed{attempt}", "--resume")
            self.check_same(f"killed{attempt}", "undisturbed")
        self.assertGreater(interrupted, KILLS // 3)

    def test_an_interrupt_keeps_finished_points(self):
        self.write("slow.yaml", SLOW)
        process = subprocess.Popen([PROGRAM, "run", "slow.yaml", "--out", "out", "--quiet"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        points = self.folder / "out/points.jsonl"
        while process.poll() is None and (not points.exists() or points.stat().st_size < 5000):
            time.sleep(0.0005)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        self.assertGreater(len(points.read_text().splitlines()), 2)
        self.assertFalse((self.folder / "out/result.json").exists())

    def test_several_sweeps_in_one_call(self):
        for name in ("one", "two", "three"):
            self.write(f"{name}.yaml", TWO_KEYS)
        self.run_program("run", "one.yaml", "two.yaml", "three.yaml", "--jobs", 2)
        for name in ("two", "three"):
            self.assertEqual(rows(self.folder / f"results/{name}/sweep.csv"), rows(self.folder / "results/one/sweep.csv"))
        self.assertEqual(len(rows(self.folder / "results/one/sweep.csv")), 7)

    def test_another_sweep_is_not_mixed_in(self):
        self.write("two.yaml", TWO_KEYS)
        self.run_program("run", "two.yaml", "--out", "out")
        result = self.run_program("run", "two.yaml", "--out", "out", "--resume", "--set", "system.mass=2 kg", status=3)
        self.assertIn("another campaign", result.stderr)

    def test_a_damaged_point_is_computed_again(self):
        """A digit, a word or a key of any field, and the check itself."""
        self.write("two.yaml", TWO_KEYS)
        self.run_program("run", "two.yaml", "--out", "whole")
        points = (self.folder / "whole/points.jsonl").read_text()
        head, zeroth, first, *others = points.splitlines()
        self.assertEqual(first[-28:], ',"check":"' + hashlib.sha256(first[:-28].encode()).hexdigest()[:16] + '"}')
        fields = [*json.loads(first), *json.loads(first)["result"]]
        damages = [first.replace(f'"{field}"', f'"{field[1:]}"', 1) for field in fields]
        damages += [first.replace('"case":1', '"case":0'), first.replace('"status":0', '"status":4'), first.replace("0.", "0.9", 1), first.replace('"peak":0', '"peak":1'),
                    first[:-28] + "}", first[:-3] + '"}', first[:-1], first.upper(), ""]
        shutil.copytree(self.folder / "whole", self.folder / "out")
        for damaged in damages:
            with self.subTest(damaged[:60]):
                self.assertNotEqual(damaged, first)
                (self.folder / "out/points.jsonl").write_text("\n".join([head, zeroth, damaged, *others]) + "\n")
                result = self.run_program("run", "two.yaml", "--out", "out", "--resume")
                self.assertIn("points.jsonl:3: a line is not as the program wrote it: what is missing is computed again", result.stderr)
                self.check_same("out", "whole")
        self.assertNotIn("not as the program wrote it", self.run_program("run", "two.yaml", "--out", "out", "--resume").stderr)
        # Without --resume, a sweep with a damaged point is not finished.
        (self.folder / "out/points.jsonl").write_text(points.replace('"peak":0', '"peak":1', 1))
        self.assertIn("--resume goes on with them", self.run_program("run", "two.yaml", "--out", "out", status=2).stderr)

    def test_status(self):
        self.write("half.yaml", HALF_FAILS)
        result = self.run_program("run", "half.yaml", "--out", "half", status=5)
        self.assertIn("1 of 2 points failed; first system.damping_ratio = 0, system.friction.kinetic = 0 N: ", result.stderr)
        table = list(csv.DictReader(rows(self.folder / "half/sweep.csv")))
        self.assertEqual([row["status"] for row in table], ["4", "0"])
        self.assertNotEqual(table[0]["reason"], "")
        self.assertEqual(table[1]["reason"], "")
        self.run_program("run", "half.yaml", "--out", "all", "--set", "sweep={system.damping_ratio: [0], system.friction.kinetic: [0 N]}", status=4)

    def test_dry_run(self):
        self.write("two.yaml", TWO_KEYS)
        result = self.run_program("run", "two.yaml", "--dry-run")
        self.assertIn("6 points: system.friction.kinetic (3 values), excitation.frequency (2 values)", result.stdout)
        self.assertFalse((self.folder / "results").exists())

    def test_faults_stand_at_their_value(self):
        self.write("bad.yaml", TWO_KEYS.replace("from: 1 N", "from: -1 N"))
        result = self.run_program("run", "bad.yaml", status=3)
        self.assertIn("bad.yaml:7:35: error: with system.friction.kinetic = -1 N", result.stderr)
        self.assertIn("'system.friction.kinetic' is out of range (so at 2 points)", result.stderr)
        self.assertFalse((self.folder / "results").exists())

    def test_a_warning_with_numbers_of_each_point_is_told_once(self):
        lugre = "{law: lugre, kinetic: 2 N, static: 3 N, stribeck_velocity: 0.05 m/s, sigma0: 10000 N/m, sigma1: 20 N.s/m}"
        self.write("warned.yaml", SLOW.replace("{law: dahl, kinetic: 2 N, sigma0: 2000 N/m}", lugre).replace("count: 30", "count: 4"))
        told = [line for line in self.run_program("run", "warned.yaml", "--out", "out").stderr.splitlines() if "warning" in line]
        self.assertEqual(len(told), 1, told)
        self.assertIn("= 100 N.s/m (3 points, with numbers of their own; first system.friction.kinetic = 0.5 N)", told[0])
        points = json.loads((self.folder / "out/result.json").read_text())["result"]["sweep"]
        self.assertEqual(len({point["warnings"][0] for point in points[:3]}), 3)

    def test_verify(self):
        self.write("two.yaml", TWO_KEYS)
        told = self.run_program("run", "two.yaml", "--out", "out", "--verify").stdout
        document = json.loads((self.folder / "out/result.json").read_text())
        points = [point["verification"] for point in document["result"]["sweep"]]
        self.assertTrue(all(point["agrees"] for point in points))
        self.assertIn("agrees", told)
        whole = document["verification"]
        self.assertTrue(whole["agrees"])
        self.assertEqual(whole["quantities"], sum(point["quantities"] for point in points))
        shares = [point["largest_difference"] / point["tolerance"] for point in points]
        worst = shares.index(max(shares))
        self.assertEqual(whole["largest_difference"], points[worst]["largest_difference"])
        self.assertTrue(whole["quantity"].startswith(f"sweep[{worst}].result."), whole["quantity"])

    def test_verify_of_points_that_do_not_agree(self):
        # At a loose tolerance, steps err by more than a verification allows.
        self.write("loose.yaml", TWO_KEYS.replace("law: coulomb, kinetic: 4.39 N", "law: lugre, kinetic: 4.39 N, static: 6 N, "
                   "stribeck_velocity: 0.05 m/s, sigma0: 10000 N/m, sigma1: 20 N.s/m") + "numerics: {tolerance: 1e-4}\n")
        result = self.run_program("run", "loose.yaml", "--out", "out", "--verify", status=1)
        self.assertIn("DOES NOT AGREE", result.stdout)
        self.assertIn("without agreement; first", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
