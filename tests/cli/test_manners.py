#!/usr/bin/env python3
"""What a user sees on the terminal: units, order, hints, a scenario to begin with.

usage: test_manners.py PROGRAM ROOT [TEST...]
"""

import json
import math
import re
import sys
import unittest
from pathlib import Path

from case import BASE, Case

ROOT = Path(sys.argv[2]).resolve()


class Manners(Case):
    def test_the_units_of_the_user_are_shown(self):
        text = (ROOT / "scenarios/examples/stepped_response.yaml").read_text().replace("count: 61", "count: 3")
        self.write("hz.yaml", text[: text.index("expect:")].replace("amplitude: 1.2 N", "amplitude: 1200 mN") + "initial: {position: 0 mm}\n")
        shown = self.run_program("run", "hz.yaml").stdout
        self.assertRegex(shown, r"omega \[Hz\] +x \[mm\] +phase \[rad\]")
        self.assertRegex(shown, r"\n +1\.4 +31\.238631\d +0\.29296545")
        # The table is SI, whatever is shown.
        self.assertIn("\nomega [rad/s],x [m],phase [rad],", (self.folder / "results/hz/curve.csv").read_text())
        # A number that cannot be read in the unit stays SI: 0.03 m are 3e-5 km.
        self.write("km.yaml", (self.folder / "hz.yaml").read_text().replace("0 mm", "0 km"))
        self.assertRegex(self.run_program("run", "km.yaml").stdout, r"omega \[Hz\] +x \[m\]")

    def test_empty_lines_stand_between_texts_only(self):
        for name, text in (("base", BASE), ("other", BASE), ("bad", "schema: dualdamp/1\n"), ("worse", "schema: dualdamp/1\n")):
            self.write(f"{name}.yaml", text)
        self.assertEqual(self.run_program("run", "bad.yaml", "worse.yaml", status=3).stdout, "")
        alone = self.run_program("run", "base.yaml").stdout
        self.assertEqual(self.run_program("run", "bad.yaml", "base.yaml", "worse.yaml", status=3).stdout, alone)
        several = self.run_program("run", "base.yaml", "bad.yaml", "other.yaml", "--dry-run", status=3).stdout
        self.assertEqual(several.count("\n\n"), 1)

    def test_the_answer_stands_first_and_the_certificate_last(self):
        lines = self.run_program("run", ROOT / "scenarios/examples/xy_curve.yaml", "--out", "xy").stdout.splitlines()
        self.assertRegex(lines[2], r"^ +Y \[mm\] +x \[mm\]")
        self.assertRegex(lines[-1], r"^certificate: \d+ searches, \d+ panels, \d+ splits, 0 grazings$")

    def test_the_line_behind_an_estimate_is_told(self):
        shown = self.run_program("run", ROOT / "scenarios/examples/identify_xy_curve.yaml", "--out", "line").stdout
        self.assertRegex(shown, r"x = a \+ b Y by +slope b +intercept a \[\w+\] +G\n")
        estimate = next(e for e in json.loads((self.folder / "line/result.json").read_text())["result"]["estimates"] if "line" in e["diagnostics"])
        line = estimate["diagnostics"]["line"]
        # b = 1/(2 zeta) and a = -G x_f, but for the small correction by the exact law.
        self.assertAlmostEqual(line["slope"], 1 / (2 * estimate["zeta"]), delta=2e-3 * line["slope"])
        self.assertAlmostEqual(-line["intercept"] / line["G"], estimate["x_f"], delta=2e-3 * estimate["x_f"])
        row = next(text for text in shown.splitlines() if text.split()[:1] == [estimate["method"]] and "(" not in text)
        self.assertAlmostEqual(float(row.split()[1]), line["slope"], delta=1e-8 * line["slope"])

    def test_lengths_are_shown_in_the_unit_of_the_data(self):
        for unit, size in (("mm", 1e3), ("in", 1 / 0.0254)):
            with self.subTest(unit):
                rows = "".join(f"{Y * size},{x * size}\n" for Y, x in ((0.0045, 0.0047), (0.005, 0.0072), (0.0055, 0.0098), (0.006, 0.0123)))
                self.write("data.csv", f"Y [{unit}],x [{unit}]\n{rows}")
                shown = self.run_program("identify", "data.csv", "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz", "--out", unit).stdout
                self.assertRegex(shown, rf"intercept a \[{unit}\] +G\n")
                self.assertIn(f'"m":{{"unit":"{unit}"', (self.folder / unit / "report.html").read_text().replace(" ", ""))

    def test_lists_suggest_the_name_that_was_meant(self):
        for line, message in {"laws coulom": "there is no law 'coulom'; did you mean 'coulomb'?\n", "laws gravity": "; or that of a plugin, with --plugin LIB\n",
                              "methods output_eror": "there is no method 'output_eror'; did you mean 'output_error'?\n",
                              "new xy_curv": "there is no analysis 'xy_curv'; did you mean 'xy_curve'?\n"}.items():
            with self.subTest(line):
                self.assertIn(message, self.run_program(*line.split(), status=2).stderr)

    def test_sentences_of_a_list_are_folded(self):
        for analysis in ("stress_test", "identify"):
            text = self.run_program("analyses", analysis).stdout
            self.assertLess(max(len(line) for line in text.splitlines()), 160)
            self.assertIn("viscous_saturating", text)

    def test_a_scenario_in_place_of_a_command_is_told_how_it_runs(self):
        for line in (["mine.yaml"], ["stress", "mine.yaml"]):
            self.assertIn("'dualdamp run mine.yaml' runs a scenario file", self.run_program(*line, status=2).stderr)

    def test_a_linear_motion_with_structural_damping_is_not_called_nonlinear(self):
        self.write("tuned.yaml", "schema: dualdamp/1\n"
                   "system: {mass: 10 kg, stiffness: 40 kN/m, damping: 0, loss_factor: 0.02, friction: {law: attached_mass, mass: 0.5 kg, stiffness: 1.8 kN/m}}\n"
                   "excitation: {type: base_harmonic, amplitude: 1 mm}\n"
                   "analysis: {type: frequency_response, frequencies: [9 Hz]}\n")
        warnings = self.run_program("run", "tuned.yaml").stderr
        self.assertIn("if the motion has a harmonic of order n", warnings)
        self.assertNotIn("nonlinear", warnings)

    def test_the_help_has_no_words_of_the_library_that_parses_the_line(self):
        self.assertNotRegex(self.run_program("run", "--help").stdout, r"Excludes:\s+[^-\s]|FLOAT")

    def test_an_unknown_law_may_be_that_of_a_plugin(self):
        self.write("plugin.yaml", (ROOT / "scenarios/examples/xy_curve.yaml").read_text().replace("law: coulomb", "law: bliman_sorine"))
        self.assertIn("; or the law of a plugin, with --plugin LIB\n", self.run_program("check", "plugin.yaml", status=3).stderr)
        self.assertIn("or that of a plugin, with --plugin LIB", self.run_program("laws", "bliman_sorine", status=2).stderr)

    def test_a_fit_that_ends_beside_all_motions_says_where_and_what_helps(self):
        """A loop under rigid friction with rests, fitted with a contact that yields: its stiffness runs to the end of the search."""
        def force(t):
            return 6 * math.sin(2 * math.pi * 0.6 * t) + 4 * math.sin(2 * math.pi * 1.7 * t + 0.5)

        times = [i / 100 for i in range(602)]
        self.write("motion.yaml", f"""schema: dualdamp/1
system: {{mass: 2 kg, stiffness: 300 N/m, damping: 3 N.s/m, friction: {{law: coulomb, kinetic: 4 N}}}}
excitation: {{type: force_table, times: {times}, values: {[round(force(t), 6) for t in times]}, interpolation: cubic}}
initial: {{position: 10 mm}}
analysis: {{type: simulate, duration: 6 s, sample_rate: 500 Hz}}
""")
        self.run_program("run", "motion.yaml", "--out", "motion")
        rows = [line.split(",") for line in (self.folder / "motion/history.csv").read_text().splitlines() if line[0].isdigit()]
        for seed in range(4):  # the end of the search is a matter of rounding
            lines = "".join(f"{t},{float(x):.8f},{float(v):.7f},{force(float(t)) + 0.014 * math.sin(977.0 * (i + 3000 * seed) ** 2):.4f}\n" for i, (t, x, v, *_) in enumerate(rows))
            data = self.write("loop.csv", "t [s],x [m],v [m/s],force [N]\n" + lines)
            ran = self.run_program("fit", "contact_compliance,coulomb", data, "--loop", "--free", "mass,damping,stiffness", "--no-profile", "--json")
            reasons = [row["reason"] for row in json.loads(ran.stdout)["result"]["laws"] if row.get("reason")]
            for reason in reasons:
                self.assertIn("no uncertainty can be computed: the motion cannot be simulated for values close to the estimate. ", reason)
                self.assertIn(". The mass sticks in this loop", reason)
            if any("estimate. contact_stiffness = " in reason and "State a value or bounds, or fit a law without it" in reason for reason in reasons):
                return
        self.fail("no search ended there")

    def test_no_name_is_a_command_of_the_terminal(self):
        """A line of a file, its name, a column: ESC and CSI are shown as replaced characters."""
        self.write("\x1b[31mred.yaml", "schema: dualdamp/1\n\x1b[31mred: 1\n")
        pairs = self.write("pairs.csv", "Y [mm],x [mm],\x9b31mred\n4.5,4.7,1\n5,7.21,1\n5.5,9.8,1\n6,12.2,2\n")
        for line, status in ((["check", "\x1b[31mred.yaml"], 3), (["run", "\x1b]0;no\x07.yaml"], 3),
                             (["identify", pairs, "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz"], 0)):
            with self.subTest(line[:2]):
                result = self.run_program(*line, status=status)
                self.assertIn("\ufffd", result.stderr)
                self.assertFalse(set("\x1b\x07\x9b") & set(result.stderr + result.stdout))

    def result_of(self, text):
        return json.loads(self.run_program("run", self.write("motion.yaml", "schema: dualdamp/1\n" + text), "--json").stdout)

    def test_a_late_velocity_follows_the_mass_while_the_load_is_lost(self):
        motion = ("""system: {mass: 1 kg, stiffness: 100 N/m, damping: 0, friction: {law: friction_lag, kinetic: 2 N, static: %s N, stribeck_velocity: 0.5 m/s, lag: %s ms, load_gradient: 5 1/m}}
initial: {position: 0.5 m}
analysis: {type: simulate, duration: 1 s}
""")
        final = self.result_of(motion % (3, 50))["result"]["final"]
        # SciPy, DOP853, steps that end at v = 0 and at the loss of the load.
        self.assertAlmostEqual(final["x"], -0.32883853, delta=1e-8)
        self.assertAlmostEqual(final["v"], 1.25061707, delta=1e-8)
        # A level that does not fall with speed does not depend on the lag.
        constant = [self.result_of(motion % (2, lag))["result"]["final"] for lag in (5, 500)]
        self.assertAlmostEqual(constant[0]["x"], constant[1]["x"], delta=1e-9)

    def test_a_dead_time_reaches_over_the_end_of_a_period(self):
        """Samples and work of the last step of a period: the past velocity is that of a dead time before them."""
        motion = """system: {mass: 1 kg, stiffness: 100 N/m, damping: 4, friction: {law: friction_lag, kinetic: 2 N, static: 3 N, stribeck_velocity: 0.5 m/s, lag: 50 ms, delay: true}}
excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}
analysis: {type: simulate, cycles: 3, sample_rate: 1000}
"""
        result = self.result_of(motion)["result"]
        self.assertLess(abs(result["energy"]["defect"]), 1e-9 * result["energy"]["input"])

    def test_a_free_decay_ends_where_the_tolerance_of_the_solver_does(self):
        decay = """system: {mass: 1 kg, stiffness: 100 N/m, damping: 4, friction: {law: viscous_power, coefficient: 0 N, exponent: 2}}
initial: {position: 1 m}
analysis: {type: free_decay, peaks: 100}
"""
        document = self.result_of(decay)
        result = document["result"]
        self.assertTrue(result["fades"])
        self.assertFalse(result["creeps"] or result["came_to_rest"])
        self.assertIn("below the error of the solver", json.dumps(document["warnings"]))
        x = [peak["x"] for peak in result["peaks"]]
        ratio = -math.exp(-math.pi * 0.2 / math.sqrt(1 - 0.2**2))
        self.assertGreater(len(x), 25)
        for before, after in zip(x, x[1:]):
            self.assertAlmostEqual(after / before, ratio, delta=0.02)
        # A verification at another tolerance follows the decay further and agrees.
        verified = self.result_of(decay + "numerics: {verify: true}\n")
        self.assertTrue(verified["result"]["fades"])
        self.assertTrue(verified["verification"]["agrees"])

    def test_a_scenario_to_begin_with(self):
        names = [line.split()[0] for line in self.run_program("analyses").stdout.splitlines()]
        self.assertIn("xy_curve", names)
        needs_data = {"fit", "mechanisms", "predict"}
        for name in names:
            with self.subTest(name):
                text = self.run_program("new", name).stdout
                self.write("mine.yaml", text)
                if name not in needs_data:
                    self.run_program("check", "mine.yaml")
                self.assertIn(f"  type: {name}  # ", text)
                self.assertRegex(text, r"\n  mass: [\d.]+ kg  # ") if "\nsystem:" in text else None
        self.assertIn("there are: ", self.run_program("new", "curve", status=2).stderr)
        # Values are those of the example: the same numbers.
        self.write("mine.yaml", self.run_program("new", "xy_curve").stdout)
        self.run_program("run", "mine.yaml", "--out", "mine")
        self.run_program("run", ROOT / "scenarios/examples/xy_curve.yaml", "--out", "example")
        rows = [[line for line in (self.folder / out / "curve.csv").read_text().splitlines() if not line.startswith("#")] for out in ("mine", "example")]
        self.assertEqual(*rows)

    def test_messages_on_the_pages_are_those_of_the_program(self):
        """Each block of a page that begins with FILE.yaml:LINE:COLUMN: the file is made anew from the line that it shows."""
        found = []
        for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
            for block in re.findall(r"```\w*\n(.*?)```", page.read_text(), re.DOTALL):
                message = re.match(r"([\w.-]+\.yaml):(\d+):\d+: (?:error|warning): [^\n]*\n  \| ([^\n]*)\n", block)
                if not message:
                    continue
                name, number, line = message.groups()
                lines = ["schema: dualdamp/1", *[""] * (int(number) - 2), line]
                self.write(name, "\n".join(lines[-int(number):]) + "\n")
                with self.subTest(page=str(page), block=block):
                    self.assertIn(block, self.run_program("check", name, status=3).stderr)
                found.append(page.name)
        self.assertIn("user-guide.md", found)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
