#!/usr/bin/env python3
"""Records without a drive in which the mass is held before it moves.

usage: test_held_records.py PROGRAM ROOT [TEST...]
"""

import json
import math
import sys
import unittest

import case
import laboratory_records as laboratory

RIG = laboratory.SLOW
TRUTH = {"damping": 2 * RIG["zeta"] * math.sqrt(RIG["mass"] * RIG["stiffness"]), "kinetic": RIG["friction"]}
CONSTANTS = ("--mass", f"{RIG['mass']} kg", "--stiffness", f"{RIG['stiffness']!r} N/m")
HELD = 3.02  # s


class HeldRecords(case.Case):
    def record(self, name, held, after=0.0, start=0.1):
        times = [i / 50 for i in range(800) if i / 50 > after - 1e-9]
        values = laboratory.decay(times, held=held, start=start)
        rough = [x + 2e-5 * math.sin(977.0 * i * i) for i, x in enumerate(values)]
        return self.write(name, "t [s],x [m]\n" + "".join(f"{t!r},{x!r}\n" for t, x in zip(times, rough)))

    def fitted(self, *arguments, constants=CONSTANTS):
        return self.fit_of_coulomb(*arguments, *constants)

    def assert_true(self, result):
        for row in result["parameters"]:
            if row["name"] in TRUTH:
                self.assertAlmostEqual(row["value"], TRUTH[row["name"]], delta=max(4 * row["std"], 0.01 * TRUTH[row["name"]]))

    def test_a_fit_begins_where_the_mass_is_released(self):
        held = self.record("held.csv", HELD)
        result, warnings = self.fitted(held)
        self.assert_true(result)
        told = [w for w in warnings if "the free motion lasts from t = 3.06 to 15.98 s: samples outside it are left out" in w]
        self.assertEqual(len(told), 1, warnings)
        shown = self.run_program("fit", "coulomb", held, *CONSTANTS, "--no-profile", "--out", "fit").stderr
        self.assertIn(f"{held}: warning: the free motion lasts", shown)  # the file is named once
        # identify says the same, but leaves out the long rest at the end too.
        identified = self.run_program("identify", held, *CONSTANTS).stderr
        self.assertIn("the free motion lasts from t = 3.06 to ", identified)
        # Records that hold the free motion alone are fitted from their first sample on.
        for name, after in (("released.csv", HELD), ("moving.csv", 3.3)):
            result, warnings = self.fitted(self.record(name, HELD, after=after))
            self.assert_true(result)
            self.assertFalse([w for w in warnings if "free motion" in w], warnings)

    def test_a_hold_too_short_to_be_found_is_among_the_causes_of_what_is_left(self):
        warnings = self.fitted(self.record("short.csv", 0.3))[1]
        self.assertFalse([w for w in warnings if "left out" in w], warnings)
        self.assertTrue([w for w in warnings if "the mass was held or pushed at first" in w], warnings)

    def test_a_held_mass_is_told_where_the_first_state_is_stated(self):
        held = self.record("held.csv", HELD)
        warnings = self.fitted(held, "--set", "initial={position: 0.1 m}")[1]
        self.assertTrue([w for w in warnings if "cut the record there, or leave out 'initial'" in w], warnings)
        self.assertFalse([w for w in warnings if "left out" in w], warnings)

    def test_a_prediction_begins_where_the_mass_is_released(self):
        result, _ = self.fitted(self.record("free.csv", 0.0), "--validate", self.record("held.csv", HELD, start=0.08))
        self.assertLess(result["validation"]["error"], 0.01)
        predicted = json.loads(self.run_program("predict", "fit", "held.csv", "--json").stdout)
        self.assertLess(predicted["result"]["validation"]["error"], 0.01)
        self.assertIn("the free motion lasts from", "".join(predicted["warnings"]))

    def test_a_held_record_is_no_record_of_the_drive_of_the_fit(self):
        drive = "{type: base_harmonic, amplitude: 30 mm, frequency: 0.5 Hz}"
        rig = f"system: {{mass: {RIG['mass']} kg, stiffness: {RIG['stiffness']!r} N/m, damping: {TRUTH['damping']!r} N.s/m, friction: {{law: coulomb, kinetic: {TRUTH['kinetic']} N}}}}\n"
        self.write("motion.yaml", f"schema: dualdamp/1\n{rig}excitation: {drive}\nanalysis: {{type: simulate, duration: 20 s, sample_rate: 20 Hz}}\n")
        self.run_program("run", "motion.yaml", "--out", "motion")
        held = self.record("held.csv", HELD)
        self.run_program("fit", "coulomb", "motion/history.csv", *CONSTANTS, "--set", f"excitation={drive}", "--no-profile", "--out", "driven")
        refused = self.run_program("predict", "driven", held, status=4).stderr
        self.assertIn("nothing states the drive of this record", refused)
        self.assertIn("--set excitation='{type: none}'", refused)
        predicted = json.loads(self.run_program("predict", "driven", held, "--set", "excitation={type: none}", "--json").stdout)
        self.assertLess(predicted["result"]["validation"]["error"], 0.01)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
