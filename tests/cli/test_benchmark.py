#!/usr/bin/env python3
"""The stress test as a benchmark: exported records, answers of programs outside, and the scores recomputed here.

usage: test_benchmark.py PROGRAM ROOT [TEST...]

What is recomputed shares nothing with the program but the files: truths come from the scenario and the numbers of the
cases, scores from their definitions in docs/benchmark.md.
"""

import csv
import json
import math
import random
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from case import PATIENCE
from definitions import interval_score, number, plain, risk_area, table
from resonance import F0, MASS, STIFFNESS, ZETA, amplitude, line, nearest, steady_state

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()
SCENARIO = ROOT / "scenarios/stress/small.yaml"
METRICS = ("coverage_zeta", "coverage_F0", "interval_score_zeta", "interval_score_F0", "power", "attainable_power", "false_alarm",
           "prediction_error", "selective_risk_area")
SEEDS = 4


class Benchmark(unittest.TestCase):
    shared = None

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.shared = Path(temporary.name)
        cls.call("stress", "export", SCENARIO, "--out", cls.shared / "export", "--seed", 7)

    @classmethod
    def call(cls, *arguments, status=0, command=None):
        result = subprocess.run(command or [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE * 300)
        assert result.returncode == status, (result.returncode, result.stdout + result.stderr)
        return result

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.export = self.shared / "export"
        self.key = json.loads((self.export / "key.json").read_text())

    def score(self, *answers, out="scored", scenario=SCENARIO, **options):
        """Scores answers, a list of NAME=FILE; one run of the methods serves all tests."""
        place = self.folder / out
        if (self.shared / "cases.jsonl").exists() and scenario == SCENARIO:
            place.mkdir()
            shutil.copy(self.shared / "cases.jsonl", place)
        result = self.call("stress", "score", scenario, "--key", self.export / "key.json", "--out", place, "--quiet",
                           *[part for answer in answers for part in ("--answers", answer)], **options)
        if options.get("status", 0) == 0 and not (self.shared / "cases.jsonl").exists():
            shutil.copy(place / "cases.jsonl", self.shared)
        return place, result

    def cases(self):
        """Law, severity and seed of each exported case, from its number in the grid."""
        departures = [("coulomb_viscous", 0.0)] + [(law, s) for law in ("contact_compliance", "detuning", "static_friction") for s in (0.01, 0.1, 0.3)]
        return [(*departures[place // SEEDS], place % SEEDS) for place in self.key["numbers"]]

    def write(self, name, rows, columns):
        path = self.folder / name
        with path.open("w", newline="") as file:
            writer = csv.DictWriter(file, columns)
            writer.writeheader()
            writer.writerows(rows)
        return path

    def test_exported_records_tell_nothing(self):
        files = sorted((self.export / "cases").iterdir())
        self.assertEqual([file.name for file in files], [f"{i:06d}.csv" for i in range(1, 41)])
        self.assertEqual(sorted(self.key["numbers"]), list(range(40)))
        self.assertNotEqual(self.key["numbers"], list(range(40)))
        for path in [*files, self.export / "constants.csv"]:
            text = path.read_text()
            for line in text.splitlines()[1:]:
                self.assertRegex(line, r"^[-+.eE0-9,]+$")
            self.assertNotRegex(text, "(?i)coulomb|compliance|detuning|static|severity|seed|rig|law|0\\.0987|4\\.39")
        constants = table(self.export / "constants.csv")
        self.assertEqual({(row["mass [kg]"], row["stiffness [N/m]"]) for row in constants}, {("1.042", "1568")})

    def test_the_same_seed_gives_the_same_files_and_a_hidden_one_others(self):
        self.call("stress", "export", SCENARIO, "--out", self.folder / "again", "--seed", 7, "--jobs", 1)
        for path in self.export.rglob("*.*"):
            self.assertEqual(path.read_bytes(), (self.folder / "again" / path.relative_to(self.export)).read_bytes())
        for name, options in (("first", []), ("second", ["--overwrite"])):
            (self.folder / name / "cases").mkdir(parents=True)
            mine = [self.folder / name / file for file in ("key.json", "constants.csv", "cases/000001.csv", "cases/000002-decay.csv")]
            for path in mine:
                path.write_text("mine")
            said = self.call("stress", "export", SCENARIO, "--out", self.folder / name, *options).stderr
            self.assertEqual(([Path(f"{path}~").read_text() for path in mine], said.count("is kept as")), (["mine"] * 4, 4))
        self.assertEqual(len({json.loads((self.folder / name / "key.json").read_text())["seed"] for name in ("first", "second")}), 2)

    def reentered(self, export):
        """Answers of resonance_least_squares to the exported files, by the program's own command."""
        rows = []
        for known in table(export / "constants.csv"):
            result = subprocess.run([PROGRAM, "identify", str(export / f"cases/{int(known['case']):06d}.csv"), "--mass", known["mass [kg]"] + " kg", "--stiffness",
                                     known["stiffness [N/m]"] + " N/m", "--frequency", known["frequency [rad/s]"] + " rad/s", "--method",
                                     "resonance_least_squares", "--json", "--out", str(self.folder / "identified")],
                                    capture_output=True, text=True, timeout=PATIENCE * 60)
            estimates = json.loads(result.stdout)["result"]["estimates"]
            if not estimates or estimates[0].get("zeta") is None:
                continue
            estimate, interval = estimates[0], estimates[0].get("interval95") or {}
            # The method's own test; what `identify` says beside asks the ledger of assumptions too.
            lack = estimate["diagnostics"]["lack_of_fit"]
            row = {"case": known["case"], "zeta": estimate["zeta"], "F0": estimate["F0"], "p_value": lack["p_value"], "usable": not lack["fired"]}
            for name in ("zeta", "F0"):
                low, high = interval.get(name) or (None, None)
                row |= {f"{name}_low": low, f"{name}_high": high}
            rows.append(row)
        return rows

    def test_a_scenario_without_stress_test_has_no_records(self):
        curve = ROOT / "scenarios/examples/xy_curve.yaml"
        told = self.call("stress", "export", curve, "--out", self.folder / "none", status=3).stderr
        self.assertIn("this scenario asks for no stress test", told)
        self.assertNotIn("seed", told)

    def test_a_built_in_method_that_enters_as_a_program_scores_as_itself(self):
        few = [SCENARIO, "--set", "analysis.seeds=2", "--set", "expect=[{value: cases.all, equals: 20}]"]  # two of each tell that as well as four
        export, out = self.folder / "few", self.folder / "scored"
        self.call("stress", "export", *few, "--out", export, "--seed", 7)
        answers = self.write("answers.csv", self.reentered(export), ["usable", "case", "zeta", "F0", "zeta_low", "zeta_high", "F0_low", "F0_high", "p_value"])
        self.call("stress", "score", *few, "--key", export / "key.json", "--answers", f"outside={answers}", "--out", out, "--quiet")
        for name in ("scores", "families", "ranking"):
            rows = table(out / f"{name}.csv")
            inside, outside = ([plain(row) for row in rows if row["method"] == method] for method in ("resonance_least_squares", "outside"))
            self.assertGreater(len(inside), 0)
            self.assertEqual(inside, outside)
        difference = [row for row in table(out / "differences.csv") if {row["better"], row["worse"]} == {"outside", "resonance_least_squares"}]
        self.assertEqual([(float(row["difference"]), row["significant"]) for row in difference], [(0.0, "0")])

    def drawn(self):
        """Answers of all kinds: with and without intervals, p-values, verdicts; some missing."""
        draws = random.Random(3)
        rows = []
        for case in range(1, 41):
            if draws.random() < 0.1:
                continue
            row = {"case": case, "zeta": ZETA * draws.uniform(0.8, 1.3), "F0": F0 * draws.uniform(0.5, 1.2)}
            for name, truth in (("zeta", ZETA), ("F0", F0)):
                if draws.random() < 0.8:
                    row[f"{name}_low"], row[f"{name}_high"] = truth * draws.uniform(0.5, 1.1), truth * draws.uniform(1.1, 1.9)
            if draws.random() < 0.7:
                row["p_value"] = draws.choice([0.01, 0.04, 0.2, draws.random()])
            if draws.random() < 0.5:
                row["usable"] = draws.choice(["yes", "no"])
            rows.append(row)
        return rows

    @staticmethod
    def marked(row):
        """rejected, confidence, loss and per parameter (covers, score) of one answer, by the definitions."""
        if row is None:
            return True, -3, 1, {"zeta": (None, 2), "F0": (None, 2)}
        usable, p = row.get("usable"), row.get("p_value")
        rejected = usable == "no" if usable else p is not None and p < 0.05
        confidence = (1 if p is None else p) - (2 if rejected else 0)
        loss = min(1, max(abs(row["zeta"] / ZETA - 1), abs(row["F0"] / F0 - 1)))
        parameters = {}
        for name, truth in (("zeta", ZETA), ("F0", F0)):
            if rejected or f"{name}_low" not in row:
                parameters[name] = (None, 2)
            else:
                low, high = row[f"{name}_low"], row[f"{name}_high"]
                parameters[name] = (low <= truth <= high, interval_score(low, high, truth))
        return rejected, confidence, loss, parameters

    def test_cells_recomputed_from_the_definitions(self):
        drawn = self.drawn()
        answers = self.write("drawn.csv", drawn, ["case", "zeta", "F0", "zeta_low", "zeta_high", "F0_low", "F0_high", "p_value", "usable"])
        out, _ = self.score(f"drawn={answers}")
        cells = {}
        by_case = {row["case"]: row for row in drawn}
        for i, (law, severity, _) in enumerate(self.cases()):
            cells.setdefault((law, severity), []).append(self.marked(by_case.get(i + 1)))
        rows = {(row["law"], float(row["severity"])): row for row in table(out / "scores.csv") if row["method"] == "drawn"}
        self.assertEqual(set(rows), set(cells))
        checked = 0
        for cell, marks in cells.items():
            row = rows[cell]
            rejections = sum(mark[0] for mark in marks) / len(marks)
            expected = {"false_alarm" if cell[0] == "coulomb_viscous" else "power": rejections,
                        "power" if cell[0] == "coulomb_viscous" else "false_alarm": None,
                        "selective_risk_area": risk_area([(mark[1], mark[2]) for mark in marks])}
            for name in ("zeta", "F0"):
                covered = [mark[3][name][0] for mark in marks if mark[3][name][0] is not None]
                expected[f"coverage_{name}"] = sum(covered) / len(covered) if covered else None
                expected[f"interval_score_{name}"] = sum(mark[3][name][1] for mark in marks) / len(marks)
            for metric, value in expected.items():
                if value is None:
                    self.assertEqual(row[metric], "", (cell, metric))
                else:
                    self.assertAlmostEqual(float(row[metric]), value, delta=1e-5 * max(1, value), msg=f"{cell} {metric}")
                checked += 1
        self.assertGreaterEqual(checked, 10 * 7)
        self.check_families(out, rows)
        self.check_intervals_of_consequence(out, cells)

    def test_prediction_errors_recomputed_from_den_hartogs_law(self):
        """Of answers that are drawn: amplitudes in two tests that no record holds: at 1.5 times the largest input amplitude, and at 0.9 times the lowest frequency."""
        drawn = self.drawn()
        answers = self.write("drawn.csv", drawn, ["case", "zeta", "F0", "zeta_low", "zeta_high", "F0_low", "F0_high", "p_value", "usable"])
        out, _ = self.score(f"drawn={answers}")
        wn, by_case = math.sqrt(STIFFNESS / MASS), {row["case"]: row for row in drawn}
        tests = [(1.5 * 7.5e-3, wn), (6e-3, 0.9 * wn)]
        cells = {}
        for i, (law, severity, _) in enumerate(self.cases()):
            if law == "contact_compliance":
                continue
            faster = 1 + severity if law == "detuning" else 1
            error = 0
            for Y, omega in tests:
                row = by_case.get(i + 1)
                truth = steady_state(ZETA, F0, Y, omega * faster)[0]
                error += min(1, abs(steady_state(row["zeta"], row["F0"], Y, omega)[0] / truth - 1)) / 2 if row else 0.5
            cells.setdefault((law, severity), []).append(error)
        rows = {(row["law"], float(row["severity"])): row for row in table(out / "scores.csv") if row["method"] == "drawn"}
        self.assertEqual(len(cells), 7)
        for cell, errors in cells.items():
            self.assertAlmostEqual(float(rows[cell]["prediction_error"]), sum(errors) / len(errors), delta=1e-5, msg=cell)

    def check_families(self, out, rows):
        """Departures first, then families."""
        families = {"presliding": ["contact_compliance"], "drive": ["detuning"], "velocity": ["static_friction"], "none": ["coulomb_viscous"]}
        means = {}
        for family, laws in families.items():
            for metric in METRICS[:-1]:
                values = [number(row[metric]) for (law, _), row in rows.items() if law in laws]
                values = [value for value in values if value is not None]
                means[family, metric] = sum(values) / len(values) if values else None
        found = {row["family"]: row for row in table(out / "families.csv") if row["method"] == "drawn"}
        overall = next(row for row in table(out / "ranking.csv") if row["method"] == "drawn")
        for (family, metric), value in means.items():
            if value is not None:
                self.assertAlmostEqual(float(found[family][metric]), value, delta=1e-9)
        for metric in METRICS[:-1]:
            values = [value for (_, name), value in means.items() if name == metric and value is not None]
            self.assertAlmostEqual(float(overall[metric]), sum(values) / len(values), delta=1e-9)
        self.assertAlmostEqual(float(overall["interval_score"]), (float(overall["interval_score_zeta"]) + float(overall["interval_score_F0"])) / 2, delta=1e-9)

    def check_intervals_of_consequence(self, out, cells):
        """Cases within an interval of distance or harm: pooled by departure, then means over departures and families."""
        family = {"contact_compliance": "presliding", "detuning": "drive", "static_friction": "velocity"}
        consequences = table(out / "consequences.csv")
        found = [row for row in table(out / "by_consequence.csv") if row["method"] == "drawn"]
        self.assertGreaterEqual(len(found), 4)
        for row in found:
            low, high = float(row["from"]), number(row["to"]) or math.inf
            inside = [(c["law"], float(c["severity"])) for c in consequences if c["law"] in family and low <= float(c[row["of"]]) < high]
            pooled = {law: [mark for cell in inside if cell[0] == law for mark in cells[cell]] for law in {law for law, _ in inside}}
            self.assertEqual((int(row["departures"]), int(row["cases"])), (len(pooled), sum(map(len, pooled.values()))))
            for metric, of_mark in (("power", lambda mark: mark[0]), ("interval_score_zeta", lambda mark: mark[3]["zeta"][1]), ("coverage_F0", lambda mark: mark[3]["F0"][0])):
                families = {}
                for law, marks in pooled.items():
                    values = [value for mark in marks if (value := of_mark(mark)) is not None]
                    if values:
                        families.setdefault(family[law], []).append(sum(values) / len(values))
                means = [sum(values) / len(values) for values in families.values()]
                if means:
                    self.assertAlmostEqual(number(row[metric]), sum(means) / len(means), delta=1e-5, msg=f"{row['of']} {low} {metric}")
                else:
                    self.assertEqual(row[metric], "")

    def test_estimates_of_23_cells_recomputed_by_another_integrator(self):
        """Without noise: the errors of the line through motions that are integrated here, for departures of every kind."""
        s, wn = 0.04, math.sqrt(STIFFNESS / MASS)
        levels = [4.5e-3 + i * 0.75e-3 for i in range(5)]
        X, c = amplitude(levels[2], wn), 2 * ZETA * math.sqrt(MASS * STIFFNESS)
        V = wn * X
        motions = {  # law: arguments of the motion, frequency ratio, gains of y and x, mass and stiffness as stated
            "coulomb_viscous": {}, "asymmetry": {"forward": s}, "base_distortion": {"third": s * levels[2]},
            "base_gain": {"y": 1 + s}, "cubic_spring": {"cubic": s * STIFFNESS / X**2}, "dahl": {"bristle": F0 / (s * X)},
            "detuned_below": {"r": 1 - s}, "detuning": {"r": 1 + s}, "displacement_gain": {"x": 1 + s}, "late_displacement": {},
            "mass_overstated": {"m": 1 + s}, "quadratic_drag": {"damper": lambda v: c * v * (1 + s * abs(v) / V)},
            "second_mode": {"rider": (s, 4 * wn * math.sqrt(1 - s), 0.02)}, "softening_spring": {"cubic": -s * STIFFNESS / X**2}, "static_friction": {},
            "stiffness_overstated": {"k": 1 + s}, "stiffness_understated": {"k": 1 - s / 2},
            "viscous_saturating": {"damper": lambda v: c * v / (1 + abs(v) * s / V)},
        }
        laws = sorted(set(motions) - {"coulomb_viscous"})
        pairs = [("dahl", "stiffness_overstated"), ("asymmetry", "detuning"), ("cubic_spring", "displacement_gain"), ("dahl", "second_mode"), ("second_mode", "detuning")]
        motions |= {f"{law} + {beside}": motions[law] | motions[beside] for law, beside in pairs}
        out = self.folder / "exact"
        self.call("run", SCENARIO, "--set", f"analysis.laws=[{', '.join(laws)}]", "--set", f"analysis.severities=[{s}]", "--set",
                  f"analysis.pairs=[{', '.join(f'{{law: {law}, beside: {beside}}}' for law, beside in pairs)}]", "--set",
                  "analysis.sensors=[{name: perfect}]", "--set", "analysis.seeds=1", "--set", "analysis.methods=[resonance_least_squares]", "--set",
                  "expect=[{value: cases.failed, equals: 0}]", "--out", out, "--quiet")
        rows = {row["law"]: row for row in table(out / "scores.csv")}
        self.assertEqual(set(rows), set(motions))
        for law, change in motions.items():
            r, y, x, m, k = (change.pop(key, 1) for key in ("r", "y", "x", "m", "k"))
            amplitudes = [x * amplitude(Y, wn * r, **change) for Y in levels]
            zeta, friction = line([y * Y for Y in levels], amplitudes, MASS * m, STIFFNESS * k)
            self.assertAlmostEqual(number(rows[law]["zeta_bias"]), zeta / ZETA - 1, delta=2e-5, msg=law)
            self.assertAlmostEqual(number(rows[law]["F0_bias"]), friction / F0 - 1, delta=2e-5, msg=law)

    def test_distance_and_harm_of_a_detuned_drive_are_those_of_den_hartogs_law(self):
        wn = math.sqrt(STIFFNESS / MASS)
        levels = [4.5e-3 + i * 0.75e-3 for i in range(5)]
        x_noise, y_noise, periods = math.hypot(20e-6, 3e-6 / math.sqrt(12)), 20e-6, 12
        out = self.folder / "detuned"
        self.call("run", SCENARIO, "--set", "analysis.laws=[detuning]", "--set", "analysis.severities=[0.003, 0.01, 0.03]", "--set",
                  "expect=[{value: cases.failed, equals: 0}]", "--out", out, "--quiet")
        rows = {(row["law"], float(row["severity"])): row for row in table(out / "consequences.csv")}
        for severity in (0.003, 0.01, 0.03):  # none of these motions rests
            data, deviations = [], []
            for Y in levels:
                x, phase = steady_state(ZETA, F0, Y, wn * (1 + severity))
                slope = (steady_state(ZETA, F0, Y * 1.001, wn)[0] - steady_state(ZETA, F0, Y, wn)[0]) / (0.001 * Y)
                data += [x, phase]
                deviations += [math.hypot(x_noise, slope * y_noise) / math.sqrt(2 * periods), math.hypot(x_noise / x, y_noise / Y) / math.sqrt(periods)]
            distance, zeta, friction = nearest(data, deviations, levels, wn)
            row = rows["detuning", severity]
            self.assertAlmostEqual(number(row["distance"]) / distance, 1, delta=1e-3)
            self.assertAlmostEqual(number(row["harm_zeta"]), zeta, delta=1e-3 * max(abs(zeta), 0.01))
            self.assertAlmostEqual(number(row["harm_F0"]), friction, delta=1e-3 * max(abs(friction), 0.01))

    def test_friction_that_drifts_between_sweeps(self):
        """Three sweeps of exact readings, friction 0.95, 1 and 1.05 F0: one line through all of them, and one slope for three lines."""
        scenario, wn = ROOT / "scenarios/stress/sweeps.yaml", math.sqrt(STIFFNESS / MASS)
        settings = ["--set", "analysis.laws=[drifting_friction]", "--set", "analysis.severities=[0.1]", "--set", "analysis.sensors=[{name: perfect}]",
                    "--set", "analysis.seeds=1", "--set", "analysis.methods=[resonance_least_squares, resonance_within_sweep]"]
        self.call("run", scenario, *settings, "--out", self.folder / "run", "--quiet")
        rows = {row["method"]: row for row in table(self.folder / "run/scores.csv") if row["law"] == "drifting_friction"}
        levels = [4.5e-3 + i * 3e-3 / 7 for i in range(8)]
        readings = [steady_state(ZETA, share * F0, Y, wn)[0] for share in (0.95, 1, 1.05) for Y in levels]
        zeta, friction = line(3 * levels, readings, MASS, STIFFNESS)
        self.assertAlmostEqual(number(rows["resonance_least_squares"]["zeta_bias"]), zeta / ZETA - 1, delta=1e-6)
        self.assertAlmostEqual(number(rows["resonance_least_squares"]["F0_bias"]), friction / F0 - 1, delta=1e-6)
        self.assertLess(abs(number(rows["resonance_within_sweep"]["zeta_bias"])), 0.002)
        self.call("stress", "export", scenario, *settings, "--out", self.folder / "export")
        sweeps = [[row["sweep"] for row in table(path)] for path in sorted((self.folder / "export/cases").iterdir())]
        self.assertEqual(sweeps, 3 * [8 * ["1"] + 8 * ["2"] + 8 * ["3"]])

    def test_a_law_that_made_a_record_is_not_in_the_library_of_any_law(self):
        record = """
        schema: dualdamp/1
        system: {mass: 1.042 kg, stiffness: 1568 N/m}
        excitation: {type: base_harmonic, frequency: natural}
        analysis: {type: identify, data: %s, methods: [any_law]%s}
        """
        pair = "analysis.pairs=[{law: lugre, beside: displacement_gain}]"
        settings = ["--set", "analysis.laws=[lugre]", "--set", "analysis.severities=[0.1]", "--set", "analysis.rigs.count=1", "--set", pair]
        scenario = ROOT / "scenarios/stress/any_law.yaml"
        self.call("run", scenario, *settings, "--set", "analysis.seed=5", "--set", "analysis.methods=[any_law]", "--out", self.folder / "run", "--quiet")
        self.call("stress", "export", scenario, *settings, "--seed", 5, "--out", self.folder / "export")
        numbers = json.loads((self.folder / "export/key.json").read_text())["numbers"]
        lines = [json.loads(line) for line in (self.folder / "run/cases.jsonl").read_text().splitlines()[1:]]
        self.assertEqual([line["law"] for line in lines], ["coulomb_viscous", "lugre", "lugre + displacement_gain"])
        # 4: a gain that is off contradicts the stated constants, too, and there is no answer.
        for place, option, status in ((0, "", 0), (1, ", without: [lugre]", 0), (2, ", without: [lugre]", 4)):
            path = self.folder / f"{place}.yaml"
            path.write_text(record % (f"export/cases/{numbers.index(place) + 1:06d}.csv", option))
            self.call("run", path, "--out", self.folder / str(place), "--quiet", status=status)
            estimate = next(e for e in json.loads((self.folder / str(place) / "result.json").read_text())["result"]["estimates"] if e["method"] == "any_law")
            for name, key in (("zeta", "zeta95"), ("F0", "F095")):
                low, high = lines[place]["estimates"][0][key]
                for end, expected in zip((low, high), estimate["hull95"][name]):
                    self.assertAlmostEqual(end / expected, 1, delta=1e-6)
                # An answer also holds the estimate with the departure set free: its interval may be wider.
                wide_low, wide_high = estimate["interval95"][name]
                self.assertLessEqual(wide_low, low * (1 + 1e-6))
                self.assertGreaterEqual(wide_high, high * (1 - 1e-6))

    def test_consequences(self):
        out, _ = self.score()
        rows = {(row["law"], float(row["severity"])): row for row in table(out / "consequences.csv")}
        self.assertEqual(number(rows["coulomb_viscous", 0]["distance"]), 0)
        self.assertLess(number(rows["static_friction", 0.3]["harm"]), 1e-12)  # the motion never rests
        for law in ("contact_compliance", "detuning"):
            distances = [number(rows[law, s]["distance"]) for s in (0.01, 0.1, 0.3)]
            self.assertEqual(distances, sorted(distances))
        for row in rows.values():
            distance = number(row["distance"])
            power = 0.5 * math.erfc(-(distance - 1.6448536269514722) / math.sqrt(2))
            self.assertAlmostEqual(number(row["attainable_power"]), power, delta=1e-12)

    def test_examples_of_programs_outside(self):
        python = self.folder / "python.csv"
        self.call(command=[sys.executable, str(ROOT / "docs/benchmark/answers.py"), str(self.export), str(python)])
        entries = [f"python={python}"]
        octave = shutil.which("octave-cli") or shutil.which("octave")
        if octave:
            matlab = self.folder / "octave.csv"
            self.call(command=[octave, "--no-gui", "--norc", str(ROOT / "docs/benchmark/answers.m"), str(self.export), str(matlab)])
            entries.append(f"octave={matlab}")
        out, _ = self.score(*entries)
        rows = {row["method"]: row for row in table(out / "ranking.csv")}
        inside = rows["resonance_least_squares"]
        for entry in (entry.split("=")[0] for entry in entries):
            # A line through the same points by a law of first order: intervals about as good, and no rejection.
            self.assertLess(abs(float(rows[entry]["interval_score_zeta"]) - float(inside["interval_score_zeta"])), 5)
            self.assertEqual(float(rows[entry]["power"]), 0)
        if octave:
            self.assertEqual(plain(rows["python"])["interval_score"][:8], plain(rows["octave"])["interval_score"][:8])
        page = (out / "report.html").read_text()
        self.assertIn("python", page)

    def test_answers_are_refused_with_their_place(self):
        for text, message in [("zeta\n1\n", "the column 'case' is missing"), ("case,beta\n1,2\n", "there is no column of this name"),
                              ("case,zeta\n41,1\n", "there is no such case"), ("case,zeta\n1,1\n1,2\n", "answered twice"),
                              ("case,zeta\n1,abc\n", "is no number"), ("case,zeta,F0\n1,1e308,-1e308\n", "too large to compute with"), ("case,zeta_low,zeta_high\n1,3,2\n", "ends below its start"),
                              ("case,zeta_low\n1,3\n", "one end"), ("case,p_value\n1,1.5\n", "out of range"), ("case,usable\n1,perhaps\n", "neither yes nor no"),
                              ("case,zeta\n1\n", "another number of fields"), ("", "no header")]:
            path = self.folder / "bad.csv"
            path.write_text(text)
            _, result = self.score(f"bad={path}", out=f"bad{hash(text)}", status=3)
            self.assertIn(message, result.stderr)
            self.assertIn("bad.csv", result.stderr)
        good = self.write("good.csv", [], ["case"])
        for answers, message in [([f"{good}"], "answers need a name"), ([f" ={good}"], "answers need a name"), ([f"a\x1b[31m={good}"], "answers need a name"), ([f"a={good}", f"a={good}"], "two entries have the same name"),
                                 ([f"resonance_two_point={good}"], "two entries have the same name")]:
            _, result = self.score(*answers, out=f"name{hash(message + answers[0])}", status=3)
            self.assertIn(message, result.stderr)
        result = self.call("stress", "score", SCENARIO, "--set", "analysis.seeds=5", "--key", self.export / "key.json", status=3)
        self.assertIn("another stress test", result.stderr)
        # A key that lacks cases, has more of them or another order would sort the answers to other truths.
        for numbers in (self.key["numbers"][::-1], list(range(10)), list(range(41)), []):
            changed = self.folder / "changed.json"
            changed.write_text(json.dumps({**self.key, "numbers": numbers}))
            result = self.call("stress", "score", SCENARIO, "--key", changed, "--answers", f"a={good}", "--out", self.folder / "k", status=3)
            self.assertIn("changed.json: error: the key was changed after the export", result.stderr)
            self.assertIn("whose cases are 40", result.stderr)
        result = self.call("stress", "export", ROOT / "scenarios/examples/coulomb.yaml", "--out", self.folder / "x", status=3)
        self.assertNotEqual(result.stderr, "")

    def test_nobody_answers(self):
        out, _ = self.score(f"silent={self.write('silent.csv', [], ['case'])}")
        row = next(row for row in table(out / "ranking.csv") if row["method"] == "silent")
        self.assertEqual([float(row[name]) for name in ("interval_score", "power", "false_alarm", "selective_risk_area")], [2, 1, 1, 1])
        self.assertEqual(row["coverage_F0"], "")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
