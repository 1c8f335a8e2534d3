#!/usr/bin/env python3
"""Rules of the benchmark that its small scenario does not reach: rigs that stick, truths that do not exist, departures of which not all
cells have a value, lists in any order, and directories with the files of an earlier export.

usage: test_benchmark_rules.py PROGRAM ROOT [TEST...]
"""

import json
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from case import PATIENCE
from definitions import number, plain, table
from resonance import F0, ZETA

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()
COLUMNS = ("zeta", "F0", "zeta_low", "zeta_high", "F0_low", "F0_high", "p_value", "usable")


def setting(**values):
    """--set analysis.KEY=VALUE for each."""
    return [part for key, value in values.items() for part in ("--set", f"analysis.{key}={value}")]


class Rules(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.scenario = self.folder / "small.yaml"  # without the numbers that it expects of its own cases
        self.scenario.write_text((ROOT / "scenarios/stress/small.yaml").read_text().split("\nexpect:")[0])

    def call(self, *arguments, status=0):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE * 300)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result

    def run_small(self, name, *settings, status=0):
        self.call("run", self.scenario, *settings, "--out", self.folder / name, "--quiet", status=status)
        return self.folder / name

    def score(self, settings, **methods):
        """Scores answers: by the name of each method a function of (departure's place in the grid) that gives a dict."""
        self.call("stress", "export", self.scenario, *settings, "--out", self.folder / "export", "--seed", 7)
        numbers = json.loads((self.folder / "export/key.json").read_text())["numbers"]
        options = []
        for name, method in methods.items():
            rows = [[str(i + 1), *(str(method(case).get(column, "")) for column in COLUMNS)] for i, case in enumerate(numbers)]
            (self.folder / f"{name}.csv").write_text("".join(",".join(row) + "\n" for row in [["case", *COLUMNS], *rows]))
            options += ["--answers", f"{name}={self.folder / name}.csv"]
        self.call("stress", "score", self.scenario, *settings, "--key", self.folder / "export/key.json", *options, "--out", self.folder / "scored", "--quiet")
        return self.folder / "scored"

    def test_a_rig_that_sticks_in_the_middle_of_a_range_is_a_failed_case_with_its_reason(self):
        rest = "{count: 2, friction_ratio: {from: 0.3, to: 2}}"  # 0.56 and 1.06 in the middle, where the second sticks
        laws = "[contact_compliance, cubic_spring, dahl, detuning, displacement_gain, iwan, softening_spring, stribeck, warming]"
        out = self.run_small("resting", *setting(rigs=rest, laws=laws, severities="[0.1]", seeds=1), status=5)
        lines = [json.loads(line) for line in (out / "cases.jsonl").read_text().splitlines()[1:]]
        resting = [line for line in lines if line["rig"] == 1 and line["law"] != "coulomb_viscous"]
        self.assertEqual(len(resting), 9)
        for line in resting:
            self.assertIn("sticks, or hardly moves, in the middle of the range", line["reason"])
            self.assertTrue(all("reason" in estimate for estimate in line["estimates"]))
        self.assertTrue(all("reason" not in line for line in lines if line["rig"] == 0))
        self.call("run", self.scenario, *setting(rigs=rest, laws=laws, severities="[0.1]", seeds=1), "--dry-run")
        self.call("stress", "export", self.scenario, *setting(rigs=rest, laws=laws, severities="[0.1]", seeds=1), "--out", self.folder / "export")
        answers = subprocess.run([sys.executable, str(ROOT / "docs/benchmark/answers.py"), str(self.folder / "export"), str(self.folder / "answers.csv")])
        self.assertEqual(answers.returncode, 0)

    def test_a_range_in_which_no_rig_moves_is_refused(self):
        rest = "{count: 8, friction_ratio: {from: 1.3, to: 1.5}}"
        for settings in (["--set", "system.friction.kinetic=12 N"], setting(rigs=rest)):
            told = self.call("run", self.scenario, *settings, "--out", self.folder / "rest", status=3).stderr
            self.assertIn("the mass sticks at every level of the range 'paper': F0/(kY) is 1.0", told)
            self.assertRegex(told, r"an amplitude above F0/k = 0\.00\d+ m[,;:) \n]")
        self.call("run", self.scenario, "--set", "system.friction.kinetic=11.7 N", "--dry-run")  # k times 7.5 mm is 11.76 N

    def test_refusals_of_an_angle_have_the_units_of_a_rotation(self):
        text = self.scenario.read_text()
        for old, new in (("1.042 kg", "1.042 kg.m^2"), ("1568 N/m", "1568 N.m/rad"), ("4.39 N}", "4.39 N.m}"), (" mm", " mrad"), (" um", " urad")):
            text = text.replace(old, new)
        self.scenario.write_text(text)
        self.call("run", self.scenario, "--dry-run")
        told = self.call("run", self.scenario, "--set", "system.friction.kinetic=12 N.m", "--dry-run", status=3).stderr
        self.assertRegex(told, r"an amplitude above F0/k = 0\.00765 rad\n +found: 0\.0075 rad\n")
        told = self.call("run", self.scenario, "--set", "system.friction.kinetic=0 N.m", "--dry-run", status=3).stderr
        self.assertIn("allowed: > 0 N.m\n", told)
        told = self.call("run", self.scenario, "--set", "system.damping_ratio=0", "--dry-run", status=3).stderr
        self.assertIn("damping > 0 N.m.s/rad\n", told)

    def test_equal_severities_are_refused(self):
        told = self.call("run", self.scenario, *setting(severities="[0.1, 0.01, 0.1]"), "--dry-run", status=3).stderr
        self.assertIn("'analysis.severities' has a value twice", told)

    def test_lists_may_be_in_any_order(self):
        """The middle of a range is that of its values, not of its text: severities, harm and predictions do not depend on the order."""
        found = []
        for name, levels, frequencies in (("up", "[4.5 mm, 6 mm, 7.5 mm]", "[5.9 Hz, 6.1 Hz, 6.4 Hz]"), ("mixed", "[6 mm, 7.5 mm, 4.5 mm]", "[6.1 Hz, 6.4 Hz, 5.9 Hz]")):
            ranges = f"[{{name: a, amplitudes: {levels}, frequencies: {frequencies}}}]"
            rigs = "{count: 2, friction_ratio: {from: 0.2, to: 0.4}}"
            out = self.run_small(name, *setting(ranges=ranges, rigs=rigs, laws="[cubic_spring]", severities="[0.1]", seeds=1, methods="[den_hartog_fit]"))
            lines = [json.loads(line) for line in (out / "cases.jsonl").read_text().splitlines()[1:]]
            found.append([[*line["unmeasured"], line["harm_zeta"], line["harm_F0"]] for line in lines])
        for one, other in zip(*found):
            for a, b in zip(one, other):
                self.assertAlmostEqual(a, b, delta=1e-4 * abs(a))

    def test_answers_without_a_truth_do_not_enter_the_area_of_risk(self):
        """viscous_power has neither zeta nor F0: confident nonsense about it, and confident sense, have the same area."""
        sense = {"zeta": 1.05 * ZETA, "F0": F0, "usable": "yes", "p_value": 0.5}
        nonsense = {"zeta": 500, "F0": 1e5, "usable": "yes", "p_value": 1}
        settings = setting(laws="[static_friction, viscous_power]", severities="[0.1, 0.2]", seeds=2)
        power = set(range(6, 10))  # the truth, static friction at two severities, viscous_power at two; two seeds
        draws = {case: {**sense, "zeta": (1 + 0.03 * case) * ZETA, "p_value": 1 - 0.05 * case} for case in range(10)}
        out = self.score(settings, sense=draws.get, nonsense=lambda case: nonsense if case in power else draws[case], silence=lambda case: {} if case in power else draws[case])
        for name in ("ranking", "families"):
            areas = {}
            for row in table(out / f"{name}.csv"):
                if row["method"] in ("sense", "nonsense", "silence"):
                    areas.setdefault(row.get("family"), []).append(row["selective_risk_area"])
            self.assertEqual(len(areas), 1 if name == "ranking" else 2)
            for three in areas.values():
                self.assertNotEqual(three[0], "")
                self.assertEqual(three, 3 * three[:1])
        cells = {(row["law"], row["method"]): row["selective_risk_area"] for row in table(out / "scores.csv")}
        self.assertEqual(cells["viscous_power", "nonsense"], "")
        self.assertNotEqual(cells["static_friction", "nonsense"], "")

    def test_departures_count_once_in_their_family_however_many_cells_have_a_value(self):
        """static_friction states intervals at three severities, quadratic_drag at one."""
        settings = setting(laws="[quadratic_drag, static_friction]", severities="[0.01, 0.02, 0.03]", seeds=1)
        right = {"zeta": ZETA, "F0": F0, "zeta_low": 0.9 * ZETA, "zeta_high": 1.1 * ZETA, "usable": "yes"}
        wrong = {**right, "zeta_low": 1.05 * ZETA}
        silent = {"zeta": ZETA, "F0": F0, "usable": "yes"}
        # The truth, quadratic_drag, static_friction.
        out = self.score(settings, mine=lambda case: [right, wrong, silent, silent, right, right, right][case])
        row = next(row for row in table(out / "families.csv") if (row["family"], row["method"]) == ("velocity", "mine"))
        self.assertAlmostEqual(number(row["coverage_zeta"]), (0 + 1) / 2, delta=1e-12)

    def test_answers_without_damping_are_scored_at_once(self):
        settings = setting(laws="[static_friction]", severities="[0.1]", seeds=40)
        ways = {f"way{i}": (lambda case, zeta=zeta, force=force: {"zeta": zeta, "F0": force}) for i, (zeta, force) in
                enumerate([(0, 0), (0, F0), (-1, F0), (-1e9, 2.5 * F0), (0, -1), (1e-30, F0)])}
        self.score(settings)
        (self.folder / "export").rename(self.folder / "first")
        start = time.monotonic()
        out = self.score(settings, **ways)
        self.assertLess(time.monotonic() - start, PATIENCE * 10)  # a tenth of a second for each answer would be 48 s
        for row in table(out / "ranking.csv"):
            if row["method"].startswith("way"):
                self.assertGreater(number(row["prediction_error"]), 0.3)

    def test_an_earlier_export_is_refused_or_removed(self):
        self.call("stress", "export", self.scenario, *setting(decay="{displacement: 20 mm, peaks: 6}"), "--out", self.folder / "export", "--seed", 7)
        key = (self.folder / "export/key.json").read_bytes()
        (self.folder / "export/cases/mine.txt").write_text("a file of the user")
        again = ["stress", "export", self.scenario, *setting(seeds=1), "--out", self.folder / "export", "--seed", 7]
        told = self.call(*again, status=2).stderr
        self.assertIn("holds an earlier export: --overwrite begins anew, --out DIR keeps them apart", told)
        self.assertEqual((self.folder / "export/key.json").read_bytes(), key)
        self.call(*again, "--overwrite")
        files = sorted(path.name for path in (self.folder / "export/cases").iterdir())
        self.assertEqual(files, [*(f"{i:06d}.csv" for i in range(1, 11)), "mine.txt"])

    def test_what_is_said_of_finished_cases_of_another_campaign_can_be_done(self):
        self.run_small("cases", *setting(seeds=1))
        told = self.call("run", self.scenario, "--out", self.folder / "cases", status=2).stderr
        self.assertIn("of another campaign: --overwrite begins anew, --out DIR keeps them apart", told)
        self.assertNotIn("--resume", told)

    def test_the_chart_of_a_stress_test_is_harm_over_distance(self):
        for name in ("one", "other"):
            self.run_small(name, *setting(seeds=1))
        self.call("compare", self.folder / "one", self.folder / "other", "--out", self.folder / "both")
        head, *rows = [line for line in (self.folder / "both/compare.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertIn("harm", head)
        self.assertGreaterEqual(len(rows), 2 * 10)
        self.assertIn("distance in units of noise", (self.folder / "both/compare.svg").read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
