#!/usr/bin/env python3
"""Charts without a browser: the main chart of a result as SVG, and the curves of several results over each other.

usage: test_charts.py PROGRAM ROOT [TEST...]
"""

import copy
import csv
import hashlib
import json
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from case import PROGRAM, Case

ROOT = Path(sys.argv[2]).resolve()
SVG = "{http://www.w3.org/2000/svg}"

CURVE = """schema: dualdamp/1
title: a rig
system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}
excitation: {type: base_harmonic, frequency: 10 rad/s}
analysis: {type: xy_curve, amplitudes: {from: 10 cm, to: 30 cm, count: 5}}
"""


class Charts(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "curve.yaml").write_text(CURVE)

    def drawing(self, name):
        """Texts, and the places of each series in pixels."""
        root = ElementTree.parse(self.folder / name).getroot()
        texts = ["".join(element.itertext()) for element in root.iter(f"{SVG}text")]
        clipped = next(g for g in root.iter(f"{SVG}g") if g.get("clip-path"))
        series = []
        for path in clipped.iter(f"{SVG}path"):
            numbers = re.findall(r"[ML](-?[\d.]+),(-?[\d.]+)", path.get("d"))
            series.append([(float(x), float(y)) for x, y in numbers])
        return texts, series

    def test_plot_of_a_run(self):
        result = self.run_program("run", "curve.yaml", "--out", "out", "--plot", "charts/curve.svg")
        self.assertIn("wrote charts/curve.svg", result.stderr)
        texts, series = self.drawing("charts/curve.svg")
        # In the unit that the user wrote, on both axes.
        for text in ("a rig", "input amplitude Y [cm]", "output amplitude x [cm]", "10", "30"):
            self.assertIn(text, texts)
        self.assertEqual(len(series), 1)
        points = series[0]
        self.assertEqual(len(points), 5)
        # Levels are equally far apart, and where friction is the same x grows linearly with Y, nearly: so do pixels.
        steps = [b[0] - a[0] for a, b in zip(points, points[1:])]
        self.assertLess(max(steps) - min(steps), 0.02)
        rises = [a[1] - b[1] for a, b in zip(points, points[1:])]
        self.assertLess(max(rises) / min(rises), 1.01)

    def test_values_that_differ_by_rounding_have_labels_that_fit(self):
        self.run_program("run", "curve.yaml", "--out", "out", "--set", "analysis.amplitudes=[20 cm, 20.00000005 cm, 20.0000001 cm]", "--plot", "a.svg")
        texts, (points,) = self.drawing("a.svg")
        self.assertLessEqual({"18", "20", "22"}, set(texts))
        self.assertLess(max(len(text) for text in texts if re.fullmatch(r"[\d.]+", text)), 8)
        self.assertLess(points[-1][0] - points[0][0], 0.05)

    def test_points_in_any_order_are_joined_in_that_of_x(self):
        """Also those of two results over each other, and of a sweep. The table keeps the order of the scenario."""
        shuffled = "analysis.amplitudes=[25 cm, 10 cm, 30 cm, 15 cm, 20 cm]"
        self.run_program("run", "curve.yaml", "--out", "out", "--plot", "a.svg")
        self.run_program("run", "curve.yaml", "--out", "shuffled", "--set", shuffled, "--plot", "b.svg")
        self.assertEqual(self.drawing("a.svg")[1], self.drawing("b.svg")[1])
        rows = [line.split(",")[0] for line in (self.folder / "shuffled/curve.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(rows[1:], ["0.25", "0.1", "0.3", "0.15", "0.2"])
        self.run_program("compare", "shuffled", "out", "--out", "both")
        first, second = self.drawing("both/compare.svg")[1]
        self.assertEqual(first, second)
        for name, more in (("curves", ()), ("numbers", ("--set", "analysis={type: steady_state}", "--set", "excitation.amplitude=20 cm"))):
            self.run_program("run", "curve.yaml", "--out", name, "--set", "sweep={system.mass: [3, 1, 2]}", *(more or ("--set", shuffled)), "--plot", f"{name}.svg")
            for line in self.drawing(f"{name}.svg")[1]:
                self.assertEqual(line, sorted(line), name)

    def test_plot_of_a_directory(self):
        self.run_program("run", "curve.yaml", "--out", "out", "--plot", "a.svg")
        self.run_program("report", "out", "--plot", "b.svg")
        self.assertEqual((self.folder / "a.svg").read_bytes(), (self.folder / "b.svg").read_bytes())

    def test_every_analysis_with_a_chart(self):
        for name, words in [("regime_map", ["slides through", "frequency [rad/s]"]), ("free_decay", ["time t [s]", "extreme x [mm]"]),
                            ("simulate", ["time t [s]"]), ("steady_state", ["displacement [mm]"]), ("xy_branch", ["input amplitude Y [m]"]),
                            ("frequency_branch", ["frequency [rad/s]"]), ("my_rig", ["input amplitude Y [mm]", "fitted"]),
                            ("sweep", ["system.friction.kinetic [N]", "amplitude = 10 cm"]),
                            ("sweep_curves", ["frequency [Hz]", "kinetic = 6 N"]), ("stepped_response", ["frequency [Hz]", "up", "down"])]:
            with self.subTest(name):
                result = subprocess.run([PROGRAM, "run", ROOT / f"scenarios/examples/{name}.yaml", "--out", name, "--plot", f"{name}.svg", "--quiet"],
                                        cwd=self.folder, capture_output=True, text=True, timeout=300)
                self.assertIn(result.returncode, (0, 4), result.stderr)
                texts, series = self.drawing(f"{name}.svg")
                self.assertTrue(series)
                for word in words:
                    self.assertIn(word, texts)
                self.assertIsNone(re.search(r"\b(nan|inf)\b", (self.folder / f"{name}.svg").read_text()))

    def test_long_histories_are_thinned_out(self):
        text = CURVE.replace("{type: base_harmonic, frequency: 10 rad/s}", "{type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}")
        text = re.sub("analysis: .*", "analysis: {type: simulate, duration: 100 s, sample_rate: 2000 Hz}", text)
        (self.folder / "long.yaml").write_text(text)
        self.run_program("run", "long.yaml", "--out", "out", "--plot", "long.svg")
        self.assertLess((self.folder / "long.svg").stat().st_size, 400_000)

    def test_refused(self):
        (self.folder / "other.yaml").write_text(CURVE)
        self.assertIn("does not end in .svg", self.run_program("run", "curve.yaml", "--plot", "a.png", status=2).stderr)
        self.assertIn("of one scenario", self.run_program("run", "curve.yaml", "other.yaml", "--plot", "a.svg", status=2).stderr)
        formula = ROOT / "scenarios/examples/formula.yaml"
        self.assertIn("has no chart", self.run_program("run", formula, "--out", "formula", "--plot", "a.svg", status=2).stderr)
        sparse = re.sub("analysis: .*", "analysis: {type: simulate, duration: 1 s}", CURVE.replace("frequency: 10", "amplitude: 0.1 m, frequency: 10"))
        (self.folder / "sparse.yaml").write_text(sparse)
        refusal = self.run_program("run", "sparse.yaml", "--out", "sparse", "--plot", "a.svg", status=2).stderr
        self.assertIn("a result with history.csv of the same run beside it, which needs the key analysis.sample_rate", refusal)

    def compare(self, *assignments, status=0):
        names = []
        for i, assignment in enumerate(assignments):
            names.append(f"out{i}")
            self.run_program("run", "curve.yaml", "--out", names[-1], "--set", assignment)
        return self.run_program("compare", *names, "--out", "both", status=status)

    def test_units_that_are_asked_for(self):
        # Before those of the file, in the terminal, the chart, the page, and of a stored result.
        result = self.run_program("run", "curve.yaml", "--out", "out", "--plot", "curve.svg", "--show-in", "um, Hz")
        self.assertIn("Y [um]", result.stdout)
        self.assertIn("no quantity of the result is in a unit that was asked for: Hz", result.stderr)
        texts, _ = self.drawing("curve.svg")
        self.assertIn("input amplitude Y [um]", texts)
        self.assertIn('"asked":true', (self.folder / "out/report.html").read_text().replace(" ", ""))
        with open(self.folder / "out/curve.csv") as lines:
            self.assertIn("Y [m]", next(line for line in lines if not line.startswith("#")))
        self.run_program("report", "out", "--plot", "again.svg", "--show-in", "mm")
        self.assertIn("input amplitude Y [mm]", self.drawing("again.svg")[0])
        self.run_program("run", "curve.yaml", "--out", "other", "--set", "system.friction.kinetic=1 N")
        self.run_program("compare", "out", "other", "--out", "both", "--show-in", "km")
        self.assertIn("input amplitude Y [km]", self.drawing("both/compare.svg")[0])
        for wrong in ("foo", "mm,,Hz", "%"):
            self.assertIn("is no unit of a result", self.run_program("run", "curve.yaml", "--show-in", wrong, status=2).stderr)

        for two in ("mm,um", "Hz,rad/s", "deg, N, mrad"):
            self.assertIn("are two units of one quantity", self.run_program("run", "curve.yaml", "--show-in", two, status=2).stderr)

    def test_compare_names_units_of_bare_numbers(self):
        self.compare("system.friction.kinetic=1", "system.friction.kinetic=3")
        texts, _ = self.drawing("both/compare.svg")
        for text in ("kinetic = 1 N, static = 1 N", "kinetic = 3 N, static = 3 N"):
            self.assertIn(text, texts)

        self.compare("system.mass=1", "system.mass=2")
        self.assertIn("mass = 2 kg", self.drawing("both/compare.svg")[0])

    def test_compare_without_the_plugin_of_a_law(self):
        """The program then does not know the dimension of its parameters: only units without a factor are told."""
        for name, kinetic in (("out1", "1 N"), ("out2", "0.25 lbf")):
            self.run_program("run", "curve.yaml", "--set", f"system.friction.kinetic={kinetic}", "--out", name)
            path = self.folder / name / "result.json"
            path.write_text(path.read_text().replace('"coulomb"', '"law_of_a_plugin"'))
        self.run_program("compare", "out1", "out2", "--out", "both")
        texts, _ = self.drawing("both/compare.svg")
        for text in ("kinetic = 1 N", "kinetic = 1.11206 in SI"):
            self.assertIn(text, texts)

    def test_compare(self):
        self.compare("system.friction.kinetic=1 N", "system.friction.kinetic=3 N")
        texts, series = self.drawing("both/compare.svg")
        self.assertEqual([len(points) for points in series], [5, 5])
        for text in ("kinetic = 1 N", "kinetic = 3 N", "input amplitude Y [cm]"):
            self.assertIn(text, texts)
        lines = [line for line in (self.folder / "both/compare.csv").read_text().splitlines() if not line.startswith("#")]
        table = list(csv.DictReader(lines))
        self.assertEqual(list(table[0]), ["result", "input amplitude Y [cm]", "output amplitude x [cm]"])
        self.assertEqual([row["result"] for row in table], ["kinetic = 1 N"] * 5 + ["kinetic = 3 N"] * 5)
        alone = [line for line in (self.folder / "out1/curve.csv").read_text().splitlines() if not line.startswith("#")]
        for row, line in zip(table[5:], list(csv.DictReader(alone))):
            self.assertAlmostEqual(float(row["output amplitude x [cm]"]), 100 * float(line["x [m]"]), delta=1e-12)
        self.assertIn("system.friction.kinetic", (self.folder / "both/compare.html").read_text())

    def test_compare_with_a_sweep(self):
        """Its curves state the swept values; a result without the sweep states its own."""
        self.run_program("run", "curve.yaml", "--out", "one", "--set", "system.friction.kinetic=1 N", "--set", "title=T")
        self.run_program("run", "curve.yaml", "--out", "many", "--set", "sweep={system.friction.kinetic: [2 N, 3 N]}", "--set", "title=T")
        self.run_program("compare", "one", "many", "--out", "both")
        self.assertEqual([text for text in self.drawing("both/compare.svg")[0] if "kinetic" in text],
                         ["kinetic = 1 N", "sweep, kinetic = 2 N", "sweep, kinetic = 3 N"])
        self.assertIn('"swept"', (self.folder / "both/compare.html").read_text())

    def test_compare_writes_si_where_no_unit_is_stated(self):
        """The chart may then have a prefix, the table has none."""
        bare = CURVE.replace("{from: 10 cm, to: 30 cm, count: 5}", "[0.05, 0.06]").replace("kinetic: 2 N", "kinetic: 1 N")
        (self.folder / "curve.yaml").write_text(bare)
        self.compare("system.mass=1", "system.mass=2")
        lines = [line for line in (self.folder / "both/compare.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(lines[0], "result,input amplitude Y [m],output amplitude x [m]")
        self.assertEqual([float(line.split(",")[-2]) for line in lines[1:]], [0.05, 0.06] * 2)
        self.assertIn("input amplitude Y [mm]", self.drawing("both/compare.svg")[0])

    def test_units_that_no_quantity_has(self):
        self.run_program("run", "curve.yaml", "--out", "out", "--quiet")
        told = "no quantity of the result is in a unit that was asked for: s"
        self.assertIn(told, self.run_program("report", "out", "--show-in", "s,mm").stderr)
        self.assertIn(told, self.run_program("compare", "out", "out", "--out", "both", "--show-in", "s").stderr)
        self.assertNotIn(told, self.run_program("compare", "out", "out", "--out", "both", "--show-in", "mm").stderr)

    def test_twelve_of_many_curves(self):
        """Evenly spaced values of each key, all of them combined, and the number of those that are left out."""
        short = ("--set", "analysis.amplitudes=[20 cm, 30 cm]")
        many = "sweep={system.mass: {from: 1, to: 30, count: 30}}"
        result = self.run_program("run", "curve.yaml", "--out", "many", "--set", many, *short, "--plot", "many.svg")
        self.assertIn("many.svg: 12 of 30 curves", result.stderr)
        texts, series = self.drawing("many.svg")
        self.assertIn("a rig: 12 of 30 curves", texts)
        self.assertEqual(len(series), 12)
        pairs = "sweep={system.mass: {from: 1, to: 10, count: 10}, system.damping: [3, 4]}"
        self.run_program("run", "curve.yaml", "--out", "pairs", "--set", pairs, *short, "--plot", "pairs.svg")
        labels = [text for text in self.drawing("pairs.svg")[0] if text.startswith("mass = ")]
        masses = (1, 3, 5, 6, 8, 10)  # Math.round(0, 1.8, 3.6, 5.4, 7.2, 9) values after the first
        self.assertEqual(labels, [f"mass = {mass}, damping = {damping}" for mass in masses for damping in (3, 4)])
        self.assertNotIn("curves", self.run_program("run", "curve.yaml", "--out", "few", "--set", "sweep={system.mass: [1, 2]}", "--plot", "few.svg").stderr)

    def test_compare_a_sweep_of_curves_with_a_curve(self):
        self.run_program("run", "curve.yaml", "--out", "one")
        self.run_program("run", "curve.yaml", "--out", "sweep", "--set", "sweep={system.mass: [1, 2]}", "--plot", "sweep.svg")
        self.assertIn("input amplitude Y [cm]", self.drawing("sweep.svg")[0])
        self.run_program("compare", "one", "sweep", "--out", "both")
        texts, series = self.drawing("both/compare.svg")
        self.assertIn("input amplitude Y [cm]", texts)
        self.assertEqual(len(series), 3)

    def test_compare_by_title(self):
        self.compare("title=one", "title=another")
        texts, _ = self.drawing("both/compare.svg")
        self.assertIn("one", texts)
        self.assertIn("another", texts)

    def test_titles_and_names_are_text(self):
        title = "<script>alert(1)</script>]]>&\"'"
        names = [b"<b>a\nb", b"not \xff utf-8"]
        for name in names:
            self.run_program("run", "curve.yaml", "--set", f"title='{title.replace(chr(39), chr(39) * 2)}'", "--out", name)
        self.run_program("compare", *names, "--out", "both")
        texts, series = self.drawing("both/compare.svg")
        self.assertIn(title, texts)
        self.assertIn("<b>a b", texts)
        self.assertIn("not \ufffd utf-8", texts)
        self.assertEqual(len(series), 2)
        self.assertNotIn("<script>alert", (self.folder / "both/compare.html").read_text())
        lines = (self.folder / "both/compare.csv").read_text().splitlines()
        self.assertEqual([line for line in lines if not line.startswith("#")][0].split(",")[0], "result")

    def test_results_that_were_changed(self):
        self.run_program("run", "curve.yaml", "--out", "curve")
        document = json.loads((self.folder / "curve/result.json").read_text())
        (self.folder / "changed").mkdir()
        for section, key, value in (("provenance", "scenario_sha256", 5), ("provenance", "written_units", [1]), ("scenario", "title", {}), ("scenario", "excitation", "x")):
            with self.subTest(f"{section}.{key}"):
                changed = copy.deepcopy(document)
                changed[section][key] = value
                (self.folder / "changed/result.json").write_text(json.dumps(changed))
                for line in (["compare", "curve", "changed"], ["compare", "changed", "curve"]):
                    self.assertIn("changed/result.json: error: ", self.run_program(*line, status=3).stderr)

    def test_a_table_that_was_changed_is_refused(self):
        """One digit, by hand; also without its lines of provenance. A run anew takes no table of the user's away."""
        numbers = CURVE.replace("analysis: {type: xy_curve, amplitudes: {from: 10 cm, to: 30 cm, count: 5}}", "analysis: {type: steady_state}").replace("{type: base_harmonic,", "{type: base_harmonic, amplitude: 0.2 m,")
        (self.folder / "numbers.yaml").write_text(numbers)
        out = self.folder / "by_hand"
        self.run_program("run", "curve.yaml", "--out", out, "--quiet")
        table = out / "curve.csv"
        written = table.read_text()
        self.assertEqual(json.loads((out / "result.json").read_text())["provenance"]["tables"]["curve.csv"], hashlib.sha256(written.encode()).hexdigest())
        at = max(written.rindex(digit) for digit in "123456789")
        digit = written[:at] + str(10 - int(written[at])).replace("5", "6") + written[at + 1:]
        rows = "".join(line for line in written.splitlines(True) if not line.startswith("#"))
        for changed in (digit, rows, ""):
            table.write_text(changed)
            for line in (["report", out], ["report", out, "--plot", self.folder / "a.svg"], ["compare", out, out, "--out", self.folder / "both"]):
                with self.subTest(f"{line[0]} of {len(changed)} characters"):
                    self.assertIn("curve.csv: error: the table is not as the run wrote it", self.run_program(*line, status=3).stderr)
        self.run_program("run", "numbers.yaml", "--out", out, "--quiet")
        self.assertEqual(table.read_text(), "")
        table.unlink()
        self.run_program("run", "curve.yaml", "--out", out, "--quiet")
        self.run_program("run", "numbers.yaml", "--out", out, "--quiet")
        self.assertFalse(table.exists())

    def test_sweeps_that_were_changed(self):
        """A swept key that is none, a table without its columns, points that are no list: a refusal, no signal."""
        curves = CURVE + "sweep: {system.friction.kinetic: [1 N, 2 N]}\n"
        numbers = curves.replace("analysis: {type: xy_curve, amplitudes: {from: 10 cm, to: 30 cm, count: 5}}", "analysis: {type: steady_state}").replace("{type: base_harmonic,", "{type: base_harmonic, amplitude: 0.2 m,")
        for name, text in (("curves", curves), ("numbers", numbers)):
            (self.folder / f"{name}.yaml").write_text(text)
            self.run_program("run", f"{name}.yaml", "--out", name)

        def changed(name, document=None, table=None):
            shutil.rmtree(self.folder / "changed", ignore_errors=True)
            shutil.copytree(self.folder / name, self.folder / "changed")
            content = json.loads((self.folder / "changed/result.json").read_text())
            if document:
                document(content)
            content["provenance"].pop("tables", None)  # who changes a table changes its sum, too
            (self.folder / "changed/result.json").write_text(json.dumps(content))
            for path in (self.folder / "changed").glob("*.csv") if table else ():
                lines = path.read_text().splitlines()
                path.write_text("".join((line if line.startswith("#") else table(line)) + "\n" for line in lines))
            for line in (["report", "changed", "--plot", "a.svg"], ["compare", name, "changed"]):
                error = self.run_program(*line, status=3).stderr
                self.assertIn("changed/result.json: error: ", error)
                self.assertIn("not as a run wrote it", error)

        for sweep in ({}, [], 3, {"a.b": [1]}, {f"x.{i}": 1 for i in range(500)}):
            with self.subTest(f"what is swept is {str(sweep)[:20]}"):
                changed("numbers", lambda content: content["scenario"].update(sweep=sweep))
                changed("curves", lambda content: content["scenario"].update(sweep=sweep))
        for points in (3, [3], {"a": 1}, None):
            with self.subTest(f"points are {points}"):
                changed("numbers", lambda content: content["result"].update(sweep=points))
        changed("numbers", table=lambda line: line.split(",")[-1])
        for point in ("abc", "-5", "99", "1e300", ""):
            with self.subTest(f"a curve of point {point}"):
                changed("curves", table=lambda line: re.sub(r"^1,", f"{point},", line))
        # A table that is not there is named.
        (self.folder / "curves/sweep.csv").unlink()
        self.assertIn("allowed: a result with sweep.csv of the same run beside it", self.run_program("compare", "curves", "curves", status=3).stderr)

    def test_a_response_lies_on_its_branch(self):
        frequency = ["--set", "excitation.amplitude=10 cm", "--set"]
        kinds = {"xy": ["--set", "analysis={type: xy_branch, amplitudes: {from: 10 cm, to: 30 cm}}"],
                 "response": [*frequency, "analysis={type: frequency_response, frequencies: [8 rad/s, 12 rad/s]}"],
                 "branch": [*frequency, "analysis={type: frequency_branch, frequencies: {from: 8 rad/s, to: 12 rad/s}}"]}
        self.run_program("run", "curve.yaml", "--out", "curve")
        for name, changes in kinds.items():
            self.run_program("run", "curve.yaml", *changes, "--out", name)
        for curve, branch, both in (("curve", "xy", "one"), ("branch", "response", "two")):
            with self.subTest(curve):
                self.run_program("compare", curve, branch, "--out", both)
                series = {}
                lines = [line for line in (self.folder / both / "compare.csv").read_text().splitlines() if line[0] != "#"]
                for label, x, y in list(csv.reader(lines))[1:]:
                    series.setdefault(label, []).append((float(x), float(y)))
                first, second = series.values()
                self.assertEqual(first[0][0], second[0][0])
                self.assertAlmostEqual(first[0][1] / second[0][1], 1.0, delta=1e-9)
        self.assertIn('"analysis":"frequency_branch, frequency_response"', (self.folder / "two/compare.html").read_text())
        self.assertIn("another analysis", self.run_program("compare", "curve", "response", status=3).stderr)

    def test_results_of_different_kinds(self):
        self.run_program("run", "curve.yaml", "--out", "curve")
        self.run_program("run", ROOT / "scenarios/examples/free_decay.yaml", "--out", "decay")
        result = self.run_program("compare", "curve", "decay", "--out", "both", status=3)
        self.assertIn("decay/result.json: error: this is the result of another analysis", result.stderr)
        self.assertIn("found: free_decay", result.stderr)
        self.assertFalse((self.folder / "both").exists())
        self.run_program("run", ROOT / "scenarios/examples/regime_map.yaml", "--out", "map")
        self.assertIn("maps cannot be laid over each other", self.run_program("compare", "map", "map", status=3).stderr)
        self.assertIn("cannot be opened", self.run_program("compare", "curve", "nowhere", status=3).stderr)
        self.run_program("compare", "curve", status=2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
