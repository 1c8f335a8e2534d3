#!/usr/bin/env python3
"""Charts of fits and predictions: measured points, and the curves that were computed for them.

usage: test_fit_charts.py PROGRAM [TEST...]
"""

import csv
import math
import re
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from case import Case

SVG = "{http://www.w3.org/2000/svg}"
RIG = ("--mass", "1 kg", "--stiffness", "400 N/m")
SYSTEM = "system: {mass: 1 kg, stiffness: 400 N/m, damping: 2 N.s/m, friction: {law: coulomb, kinetic: 0.5 N}}\n"


class FitCharts(Case):
    def drawing(self, name):
        """Texts, and for each series the places of its lines, in pixels."""
        root = ElementTree.parse(self.folder / name).getroot()
        texts = ["".join(element.itertext()) for element in root.iter(f"{SVG}text")]
        clipped = next(g for g in root.iter(f"{SVG}g") if g.get("clip-path"))
        series = []
        for path in clipped.iter(f"{SVG}path"):
            lines = [re.findall(r"(-?[\d.]+),(-?[\d.]+)", line) for line in re.split("M", re.sub("m[^M]*", "", path.get("d"))) if line]
            series.append([[(float(x), float(y)) for x, y in line] for line in lines])
        return texts, series

    def rows(self, name):
        lines = [line for line in (self.folder / name).read_text().splitlines() if not line.startswith("#")]
        return list(csv.reader(lines))

    def motion(self, name, analysis, excitation="{type: base_harmonic, amplitude: 10 mm, frequency: 3 Hz}", initial=""):
        """Rows of the table of a simulated motion."""
        self.write("made.yaml", f"schema: dualdamp/1\n{SYSTEM}{f'excitation: {excitation}' if excitation else ''}\n{initial}\nanalysis: {analysis}\n")
        self.run_program("run", "made.yaml", "--out", "made")
        heading, *rows = self.rows(f"made/{name}.csv")
        return [dict(zip([field.split(" ")[0] for field in heading], map(float, row))) for row in rows]

    def history(self, name, damping_after=0.0):
        rows = self.motion("history", "{type: simulate, duration: 1 s, sample_rate: 200 Hz}")
        lines = [f"{row['t']!r},{row['x'] * 1e3 + damping_after * math.sin(700.0 * i * i)!r},{row['y'] * 1e3!r}" for i, row in enumerate(rows)]
        self.write(name, "t [s],x [mm],y [mm]\n" + "\n".join(lines) + "\n")

    def fit(self, law, data, out, *more):
        self.run_program("fit", law, data, *more, "--no-profile", "--quiet", "--out", out)

    def test_fits_of_a_history_are_compared_by_their_curves(self):
        """Not by the drive. The measured motion stands there once."""
        self.history("run.csv", 0.01)
        self.fit("coulomb", "run.csv", "one", *RIG)
        self.fit("viscous_power", "run.csv", "two", *RIG, "--damping", "0 N.s/m")
        self.run_program("compare", "one", "two", "--out", "both")
        texts, series = self.drawing("both/compare.svg")
        for text in ("measured", "one, fitted", "two, fitted", "displacement x [mm]"):
            self.assertIn(text, texts)
        self.assertEqual(len(series), 3)
        heading, *table = self.rows("both/compare.csv")
        self.assertEqual(heading, ["result", "time t [s]", "displacement x [mm]"])
        for label, out in (("one, fitted", "one"), ("two, fitted", "two")):
            curve = [float(row[2]) for row in table if row[0] == label]
            fitted = [1e3 * float(row[2]) for row in self.rows(f"{out}/fit_0_x.csv")[1:]]
            self.assertEqual(len(curve), len(fitted))
            self.assertLess(max(abs(a - b) for a, b in zip(curve, fitted)), 1e-9)

    def test_the_residuals_of_a_swept_fit_have_their_unit(self):
        self.history("run.csv", 0.01)
        self.write("swept.yaml", "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 400 N/m, friction: {law: coulomb}}\n"
                   "analysis: {type: fit, data: run.csv, profile: false}\nsweep: {system.mass: [0.99 kg, 1.01 kg]}\n")
        self.run_program("run", "swept.yaml", "--out", "swept", "--plot", "swept.svg")
        self.assertRegex(" ".join(self.drawing("swept.svg")[0]), r"residual.rms \[.?m\]")

    def test_fits_of_different_records_have_their_own_points(self):
        for name, noise in (("a", 0.01), ("b", 0.02)):
            self.history(f"{name}.csv", noise)
            self.fit("coulomb", f"{name}.csv", name, *RIG)
        self.run_program("compare", "a", "b", "--out", "both")
        self.assertEqual({row[0] for row in self.rows("both/compare.csv")[1:]}, {"a, measured", "a, fitted", "b, measured", "b, fitted"})

    def test_a_prediction_is_drawn_like_a_fit(self):
        self.history("run.csv", 0.01)
        self.fit("coulomb", "run.csv", "fit", *RIG)
        self.history("other.csv", 0.02)
        self.run_program("predict", "fit", "other.csv", "--out", "prediction")
        self.run_program("report", "prediction", "--plot", "a.svg")
        texts, series = self.drawing("a.svg")
        self.assertEqual([text for text in texts if text in ("measured", "predicted")], ["measured", "predicted"])
        self.assertEqual(len(series), 2)

    def test_steady_states_are_joined_level_by_level_in_the_order_of_the_abscissa(self):
        """Not in that of the file. Levels that a measurement of them spreads by a percent are one."""
        rows = []
        for level in (0.004, 0.008):
            made = self.motion("curve", "{type: frequency_response, frequencies: [2.6 Hz, 2.9 Hz, 3.2 Hz, 3.5 Hz, 3.8 Hz]}", f"{{type: base_harmonic, amplitude: {level}}}")
            rows += [f"{row['omega']!r},{level * (1 + 0.005 * (i % 2))!r},{row['x']!r}" for i, row in enumerate(made)]
        shuffled = [rows[7 * i % 10] for i in range(10)]
        self.write("grid.csv", "\n".join(["omega [rad/s],Y [m],x [m]", *shuffled]) + "\n")
        self.fit("coulomb", "grid.csv", "fit", *RIG)
        table = self.rows("fit/fit_0_x.csv")
        self.assertEqual([field.split(" ")[0] for field in table[0]], ["omega", "Y", "measured", "fitted", "residual"])
        self.assertEqual([float(row[0]) for row in table[1:]], [float(row.split(",")[0]) for row in shuffled])
        self.run_program("report", "fit", "--plot", "a.svg")
        texts, (points, curve) = self.drawing("a.svg")
        self.assertIn("output amplitude x [m]", texts)
        self.assertIn("frequency [rad/s]", texts)
        self.assertEqual(len(points), 10)
        self.assertEqual([len(line) for line in curve], [5, 5])
        for line in curve:
            self.assertEqual(line, sorted(line))
        # Of the lower level the whole line is below, in pixels.
        self.assertTrue(all(low[1] > high[1] for low, high in zip(*curve)))

    def test_more_amplitudes_than_frequencies_are_curves_over_the_amplitude(self):
        rows = []
        for frequency in ("2.8 Hz", "3.3 Hz"):
            made = self.motion("curve", "{type: xy_curve, amplitudes: [4 mm, 6 mm, 8 mm, 10 mm]}", f"{{type: base_harmonic, frequency: {frequency}}}")
            rows += [f"{2 * math.pi * float(frequency[:3])!r},{row['Y']!r},{row['x']!r}" for row in made]
        self.write("pairs.csv", "\n".join(["omega [rad/s],Y [m],x [m]", *rows[1:], rows[0]]) + "\n")  # the first and the last one at the same frequency
        self.fit("coulomb", "pairs.csv", "fit", *RIG)
        self.run_program("report", "fit", "--plot", "a.svg")
        texts, (_, curve) = self.drawing("a.svg")
        self.assertIn("input amplitude Y [m]", texts)
        self.assertEqual([len(line) for line in curve], [4, 4])

    def test_a_decay_by_its_extremes_and_a_loop_by_its_displacement(self):
        made = self.motion("peaks", "{type: free_decay, peaks: 12}", None, "initial: {position: 30 mm, velocity: 0 m/s}")
        self.write("decay.csv", "\n".join(["t [s],x [m]", *(f"{row['t']!r},{row['x']!r}" for row in made)]) + "\n")
        self.fit("coulomb", "decay.csv", "decay", *RIG)
        self.run_program("report", "decay", "--plot", "decay.svg")
        texts, (points, curve) = self.drawing("decay.svg")
        self.assertIn("time t [s]", texts)
        self.assertEqual((len(points), len(curve[0])), (len(made), len(made)))
        loop = ["t [s],x [m],force [N]"]
        for i in range(400):
            t = i / 100
            loop.append(f"{t},{0.01 * math.sin(3 * t)!r},{math.copysign(0.5, math.cos(3 * t)) + 4 * math.sin(3 * t) + 0.01 * math.sin(613.0 * i * i)!r}")
        self.write("loop.csv", "\n".join(loop) + "\n")
        self.fit("coulomb", "loop.csv", "loop", "--loop", "--free", "stiffness")
        self.run_program("report", "loop", "--plot", "loop.svg")
        texts, _ = self.drawing("loop.svg")
        for text in ("force [N]", "displacement x [m]"):
            self.assertIn(text, texts)

    def test_the_chart_of_several_records_is_that_of_the_first_and_says_so(self):
        self.history("a.csv", 0.01)
        self.history("b.csv", 0.02)
        self.run_program("fit", "coulomb", "a.csv", "b.csv", *RIG, "--no-profile", "--quiet", "--out", "fit")
        self.assertIn("a.svg: the first of 2 records", self.run_program("report", "fit", "--plot", "a.svg").stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
