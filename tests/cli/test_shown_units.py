#!/usr/bin/env python3
"""Numbers whose unit stands beside them, in a cell or a text and not over a column, are shown in the units that the data
state or `--show-in` chooses: in the terminal and on the page. Files stay in SI.

The first argument is the program, the second the root of the sources."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

from browser import BROWSER, Browser, View
from case import Case

ROOT = Path(sys.argv[2]).resolve()
EXAMPLES = ROOT / "scenarios/examples"
FIT = ("fit", "coulomb", EXAMPLES / "free_run.csv", "--mass", "1 kg", "--stiffness", "1000 N/m", "--out", "fit")  # x is in mm

PAIRS = "Y [mm],x [mm]\n4,27.1\n5,37.2\n6,47.2\n7,57.3\n"
NEXT = """schema: dualdamp/1
system: {mass: 1 kg, stiffness: 1000 N/m}
excitation: {type: base_harmonic, frequency: 302 rpm}
analysis: {type: design, data: pairs.csv, without: [bouc_wen, contact_compliance, dahl, elasto_plastic, friction_lag, generalized_maxwell_slip, iwan, lugre, normal_vibration]}
"""


class Terminal(Case):
    def test_numbers_of_a_fit(self):
        said = self.run_program(*FIT, "--show-in", "mm,kN")
        self.assertRegex(said.stdout, r"residual\.rms +0\.0099\d+ +mm\n")
        self.assertRegex(said.stdout, r"position +mm +29\.99\d+ +0\.0017\d+ +29\.99\d+ +30\.00\d+")
        self.assertRegex(said.stdout, r"kinetic +kN +0\.000999\d+ ")
        self.assertIn("rms [mm]", said.stdout)
        self.assertNotRegex(said.stdout, r"residual\.unit| N | m ")
        self.assertNotIn("asked for", said.stderr)
        self.assertIn("asked for: GW", self.run_program(*FIT, "--show-in", "GW").stderr)

    def test_the_earlier_name_of_the_option_is_read_and_named_nowhere(self):
        """One letter from --unit, which states the unit of a column."""
        self.assertEqual(self.run_program(*FIT, "--units", "mm,kN").stdout, self.run_program(*FIT, "--show-in", "mm,kN").stdout)
        self.assertIn("--show-in", self.run_program(*FIT, "--units", "mm", "--show-in", "um", status=2).stderr)
        self.assertIn("is no unit of a result", self.run_program(*FIT, "--units", "mmm", status=2).stderr)
        for command in ("run", "identify", "next", "fit", "predict", "report", "compare"):
            text = self.run_program(command, "--help").stdout
            self.assertIn("--show-in UNITS", text)
            self.assertNotIn("--units", text)
        for pages in (("completion", "bash"), ("completion", "zsh"), ("completion", "fish"), ("manual",)):
            text = self.run_program(*pages).stdout.replace("\\", "")
            self.assertIn("show-in", text)
            self.assertNotRegex(text, "--units|-l units")

    def test_numbers_of_a_fit_are_in_the_units_of_the_data(self):
        self.assertRegex(self.run_program(*FIT).stdout, r"position +mm +29\.99")

    def test_units_of_readings_that_the_result_does_not_repeat(self):
        self.write("pairs.csv", PAIRS)
        self.write("next.yaml", NEXT)
        asked = "no quantity of the result is in a unit that was asked for: "
        repeats = "; what the data or the scenario states in such units is not repeated in the result"
        quantities = "its quantities are in 1/s, N, m, rad/s, s\n"
        self.assertIn(f"{asked}kg{repeats}; {quantities}", self.run_program("run", "next.yaml", "--out", "next", "--show-in", "kg").stderr)
        self.assertIn(f"{asked}kg/s; {quantities}", self.run_program("run", "next.yaml", "--out", "again", "--show-in", "kg/s").stderr)

    def test_what_to_do_next_is_in_the_units_of_the_user(self):
        self.write("pairs.csv", PAIRS)
        self.write("next.yaml", NEXT)
        usual, asked = (self.run_program("next", "next.yaml", "--out", out, *more, "--most-level", "7.5 mm") for out, more in (("next", []), ("asked", ["--show-in", "um,Hz"])))
        self.assertIn("left out, because the drive cannot do them by 'most_level' and 'most_frequency': the same states at levels twice as high", usual.stderr)
        self.assertNotIn("asked for", asked.stderr)
        for out, units in (("next", ("mm", "rpm")), ("asked", ("um", "Hz"))):
            result = json.loads((self.folder / out / "result.json").read_text())["result"]
            table = (self.folder / out / "candidates.csv").read_text()
            for candidate in result["candidates"]:
                self.assertLessEqual(max((state["Y"] for state in candidate.get("states", [])), default=0), 0.0075)
                self.assertIn(units[0], candidate["instruction"])
                self.assertIn(candidate["instruction"], table)
                self.assertIn(units[1], candidate["instruction"]) if "states" in candidate else None

    def test_files_of_a_fit_stay_in_si(self):
        self.run_program(*FIT, "--show-in", "mm,kN")
        self.assertEqual(json.loads((self.folder / "fit/result.json").read_text())["result"]["residual"]["unit"], "m")
        self.assertIn("position,m,0.0299", (self.folder / "fit/parameters.csv").read_text())
        self.assertIn("law,parameters,AICc,weight,rms,noise_units", (self.folder / "fit/laws.csv").read_text())

    def test_residuals_of_a_sweep_of_fits(self):
        self.write("free_run.csv", (EXAMPLES / "free_run.csv").read_text())
        self.write("fit.yaml", """schema: dualdamp/1
system: {mass: 1 kg, stiffness: 1000 N/m, friction: {law: coulomb}}
excitation: {type: none}
analysis: {type: fit, data: [{file: free_run.csv}]}
sweep: {system.mass: [1 kg, 1.01 kg]}
""")
        said = self.run_program("run", "fit.yaml", "--out", "sweep", "--show-in", "um,kN")
        self.assertRegex(said.stdout, r"residual\.rms \[um\][^\n]*\n +1 +0 +9\.99")
        self.assertNotIn("asked for", said.stderr)
        rows = [line for line in (self.folder / "sweep/sweep.csv").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(len(rows), 3)  # the heading, and a row for each point
        for name in ("fitted_readings", "scenario", "rig"):
            self.assertNotIn(name, said.stdout + rows[0])

    def test_estimates_with_their_intervals(self):
        said = self.run_program("run", EXAMPLES / "identify_free_decay.yaml", "--out", "decay", "--show-in", "kN,N.s/mm")
        self.assertIn("c (95 %) [N.s/mm]", said.stdout)
        self.assertIn("0.011047 (0.011047 to 0.011047)  0.00352 (0.00352 to 0.00352)", said.stdout)

    def test_parameters_of_mechanisms_within_a_text(self):
        said = self.run_program("run", EXAMPLES / "mechanisms.yaml", "--out", "study", "--show-in", "mm/s")
        self.assertRegex(said.stdout, r"saturation_velocity 80\d(\.\d)? mm/s")
        self.assertNotIn("asked for", said.stderr)
        self.assertRegex((self.folder / "study/mechanisms.csv").read_text(), r"saturation_velocity 0\.80\d+ m/s")


@unittest.skipIf(BROWSER is None, "there is no Chromium on this machine")
class Page(Case):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.browser = Browser(Path(temporary.name))
        cls.addClassCleanup(cls.browser.close)

    def values(self, directory, *expressions):
        """The values of JavaScript expressions in the page of a result."""
        with View(self.browser, self.folder / directory / "report.html", (1000, 800)) as view:
            values = [view.value(expression) for expression in expressions]
            self.assertEqual(view.console(), [])
        return values

    def test_numbers_of_a_fit(self):
        self.run_program(*FIT, "--show-in", "mm,kN")
        rows, notes, files, exact = self.values(
            "fit", "[...document.querySelectorAll('[aria-label=\"Fitted numbers\"] tbody tr')].map((row) => [...row.children].map((cell) => cell.textContent))",
            "[...document.querySelectorAll('p.soft, p.note')].map((p) => p.textContent)",
            "['parameters.csv', 'laws.csv'].map((name) => document.querySelector(`[aria-label=\"${name}\"]`).textContent)",
            "document.querySelector(\"[data-path='parameters[2].value']\").dataset.value")
        cells = {name: (value, unit) for name, value, unit, _ in rows}
        self.assertRegex(cells["position"][0], r"^29\.99\d*29\.99\d* to 30\.00\d*$")
        self.assertRegex(cells["kinetic"][0], r"^0\.000999\d*0\.000999\d* to 0\.00100\d*$")
        self.assertEqual((cells["position"][1], cells["kinetic"][1]), ("mm", "kN"))
        self.assertTrue(exact.startswith("0.0299"))  # what the number stands for is SI
        self.assertTrue(any(text.startswith("Residuals: 0.009999 mm,") for text in notes), notes)
        self.assertFalse(any("asked for" in text for text in notes), notes)
        self.assertIn("positionmm29.9994", files[0])
        self.assertRegex(files[1], r"rms \[mm\].*0\.009998")

    def test_what_to_measure_next(self):
        self.write("pairs.csv", PAIRS)
        self.write("next.yaml", NEXT)
        self.run_program("run", "next.yaml", "--out", "next")
        result = json.loads((self.folder / "next/result.json").read_text())["result"]
        box, rows, titles = self.values(
            "next", "document.querySelector('section.answer').textContent",
            "[...document.querySelectorAll('[aria-label=\"Measurements\"] tbody tr')].map((row) => row.children[1].textContent)",
            "[...document.querySelectorAll('.charts figcaption .row')].map((title) => title.firstChild.textContent)")
        self.assertIn(result["advice"], box)
        self.assertIn("%.4g" % result["hull95"]["zeta"][1], box)
        self.assertEqual(rows, [f"{candidate['measurement']} {candidate['instruction']}" for candidate in result["candidates"]])
        self.assertEqual(titles, ["How far the ranges shrink", "ζ, law by law", "F0, law by law"])

    def test_estimates(self):
        self.run_program("run", EXAMPLES / "identify_free_decay.yaml", "--show-in", "kN", "--out", "decay")
        page, = self.values("decay", "document.body.textContent")
        self.assertIn("F0 [kN] (95 %)", page)
        self.assertIn("0.00352 kN", page)

    def test_parameters_of_mechanisms(self):
        self.run_program("run", EXAMPLES / "mechanisms.yaml", "--show-in", "kN,mm/s", "--out", "study")
        table, = self.values("study", "fitTable(run.result)[2].textContent")
        self.assertRegex(table, r"F0 \[kN\].*saturation_velocity 80\d mm/s.*0\.006")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
