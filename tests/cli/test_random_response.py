#!/usr/bin/env python3
"""Responses to a random force in a stress test: as they are exported, and what methods make of them.

usage: test_random_response.py PROGRAM ROOT [TEST...]
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from case import PATIENCE
from resonance import MASS, STIFFNESS

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()


def table(path):
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))


def mean(values):
    return sum(values) / len(values)


class RandomResponse(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def run_program(self, *arguments):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE * 300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def check_same(self, out, reference):
        self.assertEqual((out / "cases.jsonl").read_bytes(), (reference / "cases.jsonl").read_bytes())
        for name in ("scores.csv", "ranking.csv", "consequences.csv"):
            self.assertEqual(table(out / name), table(reference / name))

    def test_a_linear_rig(self):
        """With next to no friction the response to a white force of density D has the variance D/(2 c k) and takes in the power D/(2 m).

        Here the force has the density D (sin u/u)^4, u = w/(4 B), which takes 2 % of the variance and 8 % of the power: both are integrals
        over the receptance. They scatter by one over the root of zeta w T, 1.9 %.
        """
        intensity, bandwidth, duration, noise = 0.5, 50, 500, 1e-4
        wn, damping = math.sqrt(STIFFNESS / MASS), 2 * 0.15 * math.sqrt(STIFFNESS * MASS)
        settings = []
        for text in ("system.damping_ratio=0.15", "system.friction={law: coulomb, kinetic: 1e-6 N}", "analysis.laws=[detuning]", "analysis.severities=[0.2]",
                     "analysis.methods=[random_decrement, stochastic_averaging]", "analysis.seeds=2", "expect=[{value: cases.failed, equals: 0}]",
                     f"analysis.sensors=[{{name: one, x: {{noise: {noise} m}}}}]",
                     f"analysis.random_response={{type: force_noise, intensity: {intensity} N^2/Hz, bandwidth: {bandwidth} Hz, duration: {duration} s, "
                     "settle: 5 s, sample_rate: 200 Hz}"):
            settings += ["--set", text]
        self.run_program("stress", "export", ROOT / "scenarios/stress/small.yaml", *settings, "--seed", 3, "--out", self.folder / "export")
        names = [f"{i:06d}{ending}.csv" for i in range(1, 5) for ending in ("", "-random")]
        self.assertEqual(sorted(path.name for path in (self.folder / "export/cases").iterdir()), sorted(names))
        numbers = json.loads((self.folder / "export/key.json").read_text())["numbers"]
        variance, work = 0, 0
        for w in (i + 0.5 for i in range(4000)):  # rad/s; both sides of the spectrum, over 2 pi
            u = w / (4 * bandwidth)
            receptance = 1 / complex(STIFFNESS - MASS * w * w, damping * w)
            density = intensity * (math.sin(u) / u) ** 4 / math.pi
            variance += density * abs(receptance) ** 2
            work += density * (1j * w * receptance).real
        self.assertAlmostEqual(variance / (intensity / (2 * damping * STIFFNESS)), 0.976, delta=0.001)
        self.assertAlmostEqual(work / (intensity / (2 * MASS)), 0.925, delta=0.001)
        motions = {}
        for file, place in enumerate(numbers, 1):
            pairs = table(self.folder / f"export/cases/{file:06d}.csv")
            self.assertEqual((len(pairs), list(pairs[0])[:2]), (5, ["Y [m]", "x [m]"]))
            rows = table(self.folder / f"export/cases/{file:06d}-random.csv")
            self.assertEqual(list(rows[0]), ["t [s]", "x [m]", "v [m/s]", "a [m/s^2]", "force [N]"])
            t, x, v, force = ([float(row[name]) for row in rows] for name in ("t [s]", "x [m]", "v [m/s]", "force [N]"))
            self.assertEqual((len(t), t[0]), (200 * duration + 1, 5))
            power = mean([f * speed for f, speed in zip(force, v)])
            four_errors = 4 / math.sqrt(0.15 * wn * duration)
            self.assertAlmostEqual((mean([value**2 for value in x]) - noise**2) / variance, 1, delta=four_errors)
            self.assertAlmostEqual(power / work, 1, delta=four_errors)
            # The drive is what the damper takes, but for the energy at both ends.
            self.assertAlmostEqual(damping * mean([speed**2 for speed in v]) / power, 1, delta=0.01)
            motions.setdefault(place // 2, []).append(x)
        # Two readings of a motion differ by the noise of both; two motions are strangers, for detuning is not there.
        for readings in motions.values():
            self.assertAlmostEqual(mean([(a - b) ** 2 for a, b in zip(*readings)]) / (2 * noise**2), 1, delta=0.02)
        first, second = (motions[number][0] for number in (0, 1))
        correlation = mean([a * b for a, b in zip(first, second)]) / variance
        self.assertLess(abs(correlation), 0.1)

    def test_scores(self):
        """100 s of three motions by any number of threads and after an interruption; 800 s: what the methods make of them."""
        scenario = ROOT / "scenarios/stress/random.yaml"
        settings = [part for text in ("analysis.laws=[contact_compliance, mass_overstated]", "analysis.severities=[0.3]", "analysis.rigs.count=1")
                    for part in ("--set", text)]
        one, two = self.folder / "one", self.folder / "two"
        short, long = ([*settings, "--set", f"analysis.random_response.duration={duration}"] for duration in ("100 s", "800 s"))
        self.run_program("run", scenario, *short, "--out", one, "--quiet", "--jobs", 1)
        self.run_program("run", scenario, *short, "--out", two, "--quiet", "--jobs", 2)
        self.check_same(two, one)
        cases = two / "cases.jsonl"
        cases.write_text("".join(cases.read_text().splitlines(keepends=True)[:2]))
        self.run_program("run", scenario, *short, "--out", two, "--quiet", "--resume")
        self.check_same(two, one)

        self.run_program("run", scenario, *long, "--out", self.folder / "long", "--quiet")
        scores = {(row["law"], row["method"]): row for row in table(self.folder / "long/scores.csv")}
        self.assertEqual(len(scores), 9)
        # A standard error of 8 % in F0.
        self.assertLess(abs(float(scores["coulomb_viscous", "stochastic_averaging"]["F0_bias"])), 0.25)
        self.assertEqual(float(scores["coulomb_viscous", "stochastic_averaging"]["false_alarm"]), 0)
        # A contact that gives by 0.3 of the curve's amplitude, which is more than that of this response, hardly rubs.
        self.assertLess(float(scores["contact_compliance", "stochastic_averaging"]["F0_bias"]), -0.5)
        # It never stands by its estimate, and misses the friction.
        for law in ("coulomb_viscous", "contact_compliance", "mass_overstated"):
            self.assertEqual(float(scores[law, "random_decrement"]["interval_score_F0"]), 2)
            self.assertLess(float(scores[law, "random_decrement"]["F0_bias"]), -0.7)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
