#!/usr/bin/env python3
"""Standard errors of the stress test's scores, recomputed by resamples of its own from the files of a run.

usage: test_standard_errors.py PROGRAM ROOT [TEST...]

docs/benchmark.md: departures are drawn anew within their family, rigs among all, and each case counts a Poisson number of times.
"""

import json
import random
import statistics
import subprocess
import sys
import tempfile
import unittest
from collections import Counter, defaultdict
from pathlib import Path

from case import PATIENCE
from definitions import interval_score, table

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()
LAWS = ("contact_compliance", "free_play", "iwan", "detuning", "base_distortion", "static_friction", "asymmetry", "displacement_gain", "base_gain")
METHODS = ("den_hartog_fit", "resonance_least_squares")
RESAMPLES = 1500
POISSON = (0.367879, 0.735759, 0.919699, 0.981012, 0.996340, 0.999406, 0.999917)  # cumulated, mean 1


def mean(values, weights):
    return sum(v * w for v, w in zip(values, weights)) / total if (total := sum(weights)) > 0 else None


class StandardErrors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            subprocess.run([PROGRAM, "run", str(ROOT / "scenarios/stress/small.yaml"), "--set", f"analysis.laws=[{', '.join(LAWS)}]", "--set", "analysis.severities=[0.1]",
                            "--set", "analysis.rigs={count: 5, damping_ratio: {from: 0.03, to: 0.2}, friction_ratio: {from: 0.1, to: 0.45}}", "--set",
                            f"analysis.methods=[{', '.join(METHODS)}]", "--set", "expect=[{value: cases.failed, equals: 0}]", "--out", str(out), "--quiet"],
                           check=True, capture_output=True, timeout=PATIENCE * 100)
            cls.ranking = {row["method"]: row for row in table(out / "ranking.csv")}
            cls.difference = table(out / "differences.csv")[0]
            cls.family = {row["departure"]: row["family"] for row in table(out / "departures.csv")}
            truths = {(row["law"], row["rig"]): (float(row["zeta"]), float(row["F0 [N]"])) for row in table(out / "consequences.csv")}
            lines = [json.loads(line) for line in (out / "cases.jsonl").read_text().splitlines()[1:]]
        cls.cases = [(line["law"], line["rig"], [cls.marked(estimate, truths[line["law"], str(line["rig"])]) for estimate in line["estimates"]]) for line in lines]

    @staticmethod
    def marked(estimate, truth):
        """Rejected, and the interval score of both parameters."""
        if not estimate.get("usable"):
            return 1, 2
        scores = [interval_score(*estimate[name], value) for name, value in zip(("zeta95", "F095"), truth)]
        return 0, sum(scores) / 2

    def scores(self, laws, rigs, count):
        """Power and interval score of each method: of departures, means over families, then over these."""
        cells = defaultdict(list)
        for law, rig, marks in self.cases:
            cells[law].append((rigs[rig] * count(), marks))
        found = []
        for method in range(len(METHODS)):
            of_method = []
            for metric in range(2):
                families = defaultdict(list)
                for law, cases in cells.items():
                    value = mean([marks[method][metric] for _, marks in cases], [weight for weight, _ in cases])
                    if value is not None and not (metric == 0 and law == "coulomb_viscous"):
                        families[self.family.get(law, "none")].append((value, laws.get(law, 1)))
                means = [mean(*zip(*members)) for members in families.values()]
                of_method.append(statistics.mean(value for value in means if value is not None))
            found.append(of_method)
        return found

    def resampled(self):
        draws = random.Random(11)
        poisson = lambda: sum(u >= bound for bound in POISSON) if (u := draws.random()) else 0
        families = defaultdict(list)
        for law in LAWS:
            families[self.family[law]].append(law)
        for _ in range(RESAMPLES):
            laws = Counter(law for members in families.values() for law in draws.choices(members, k=len(members)))
            rigs = Counter(draws.choices(range(5), k=5))
            yield self.scores({law: laws[law] for law in LAWS}, rigs, poisson)

    def test_scores_and_their_standard_errors(self):
        whole = self.scores({law: 1 for law in LAWS}, Counter(range(5)), lambda: 1)
        drawn = list(self.resampled())
        for method, name in enumerate(METHODS):
            for metric, column in enumerate(("power", "interval_score")):
                self.assertAlmostEqual(float(self.ranking[name][column]), whole[method][metric], delta=1e-5)
                expected = statistics.stdev(scores[method][metric] for scores in drawn)
                # 200 resamples know their standard deviation to 5 %, these to 2 %.
                self.assertAlmostEqual(float(self.ranking[name][f"{column}_se"]) / expected, 1, delta=0.2, msg=f"{name} {column}")

    def test_methods_are_compared_on_the_same_resamples(self):
        differences = [scores[1][1] - scores[0][1] for scores in self.resampled()]
        self.assertAlmostEqual(float(self.difference["difference_se"]) / statistics.stdev(differences), 1, delta=0.2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
