#!/usr/bin/env python3
"""Fits, predictions and identifications of records with a hammer's blows of few samples.

usage: test_struck_records.py PROGRAM ROOT [TEST...]
"""

import json
import math
import sys
import unittest

import case
import laboratory_records as laboratory

MASS, STIFFNESS, DAMPING, FRICTION = 2.0, 20.0, 0.25, 0.05
TRUTH = {"damping": DAMPING, "kinetic": FRICTION}
CONSTANTS = ("--mass", f"{MASS} kg", "--stiffness", f"{STIFFNESS} N/m")
RIG = {"mass": MASS, "stiffness": STIFFNESS, "damping": DAMPING, "friction": FRICTION, "static": FRICTION}
RATE, COUNT = 50, 800  # Hz, samples: 16 s, seven swings


def struck(blow, begin=0.31, speed=0.3):
    """t, x, v, a and force of a mass at rest that a half sine of so many samples strikes."""
    length = blow / RATE
    peak = MASS * speed * math.pi / 2 / length

    def force(t):
        return peak * math.sin(math.pi * (t - begin) / length) if begin < t < begin + length else 0.0

    return laboratory.forced(force, RATE, COUNT, RIG)


def struck_again(blows, count=1300):
    """The same struck several times: each blow has its start, its length in samples and the speed that it gives."""
    halves = [(begin, length / RATE, MASS * speed * math.pi / 2 / (length / RATE)) for begin, length, speed in blows]

    def force(t):
        return sum(peak * math.sin(math.pi * (t - begin) / length) for begin, length, peak in halves if begin < t < begin + length)

    return laboratory.forced(force, RATE, count, RIG)


SEVERAL = ((0.31, 4.3, 0.3), (8.13, 2.6, -0.27), (16.44, 5.8, 0.33))


class StruckRecords(case.Case):
    def record(self, name, blow, signals="x", more="", rows=None):
        units = {"x": "m", "v": "m/s", "a": "m/s^2"}
        columns = list(zip(*(rows or struck(blow))))
        held = [columns["txvaf".index(s)] for s in signals]
        lines = [",".join(["t [s]", *(f"{s} [{units[s]}]" for s in signals), "force [N]"])]
        for row in zip(columns[0], *map(laboratory.rough, held), columns[4]):
            lines.append(",".join(map(repr, row)))
        return self.write(name, "\n".join(lines) + "\n" + more)

    def decay(self, name="decay.csv", start=0.1):
        rig = {"mass": MASS, "stiffness": STIFFNESS, "zeta": DAMPING / 2 / math.sqrt(MASS * STIFFNESS), "friction": FRICTION}
        times = [i / RATE for i in range(COUNT)]
        values = laboratory.rough(laboratory.decay(times, rig, start))
        return self.write(name, "t [s],x [m]\n" + "".join(f"{t!r},{x!r}\n" for t, x in zip(times, values)))

    def fitted(self, *arguments, constants=CONSTANTS):
        return self.fit_of_coulomb(*arguments, *constants)

    def assert_true(self, result):
        for row in result["parameters"]:
            if row["name"] in TRUTH:
                self.assertAlmostEqual(row["value"], TRUTH[row["name"]], delta=4 * row["std"], msg=row)
                self.assertLess(row["std"], 0.01 * TRUTH[row["name"]], row)

    def assert_told(self, part, warnings, count=1):
        self.assertEqual(len([w for w in warnings if part in w]), count, warnings)

    def test_the_motion_after_a_short_blow_is_fitted_as_a_free_vibration(self):
        for blow in (1.6, 4.3, 11.0, 20.0):
            with self.subTest(blow=blow):
                result, warnings = self.fitted(self.record("struck.csv", blow), "--drive", "force")
                self.assert_true(result)
                self.assert_told("too few to know its impulse: force is left out, and the motion after it is read as a free vibration", warnings)
                self.assert_told("struck.csv: the free motion lasts from t = ", warnings)
                self.assertLess(result["residual"]["noise_units"], 1.1)
                self.assertIn("type: none", result["scenario"])
                self.run_program("run", "fit/fitted.yaml")

    def test_a_velocity_or_an_acceleration_shows_the_motion_too(self):
        for signal in "va":
            with self.subTest(signal=signal):
                result, warnings = self.fitted(self.record("struck.csv", 4.3, signal), "--drive", "force")
                self.assert_true(result)
                self.assert_told("too few to know its impulse", warnings)

    def test_a_scenario_may_state_the_force(self):
        record = self.record("struck.csv", 4.3)
        rig = f"schema: dualdamp/1\nsystem: {{mass: {MASS} kg, stiffness: {STIFFNESS} N/m, friction: {{law: coulomb}}}}\n"
        drive = "excitation: {type: measured_force, file: struck.csv}\n"
        fit = "analysis: {{type: fit, profile: false, data: {}}}\n"
        for name, text in (("column.yaml", rig + fit.format("[{file: struck.csv, drive: force}]")), ("drive.yaml", rig + drive + fit.format("struck.csv"))):
            with self.subTest(name=name):
                answer = json.loads(self.run_program("run", self.write(name, text), "--json").stdout)
                self.assert_true(answer["result"])
                self.assert_told("too few to know its impulse", answer["warnings"])
        self.decay()
        both = fit.format("[{file: struck.csv, drive: force}, {file: decay.csv, drive: none}]")
        answer = json.loads(self.run_program("run", self.write("both.yaml", rig + both), "--json").stdout)
        self.assert_true(answer["result"])
        self.assertEqual(record.name, "struck.csv")

    def test_where_the_force_is_needed_the_error_of_its_impulse_is_told(self):
        record = self.record("struck.csv", 4.3)
        error = "has 4 samples: its impulse may be wrong by 5 %"
        for constants in ((*CONSTANTS, "--set", "initial={position: 0 m}"), ()):
            warnings = self.fitted(record, "--drive", "force", constants=constants)[1]
            self.assert_told(error, warnings)
            self.assert_told("left out", warnings, 0)

    def test_a_long_blow_drives_as_it_was_measured(self):
        result, warnings = self.fitted(self.record("struck.csv", 70.0), "--drive", "force")
        self.assert_true(result)
        self.assert_told("impulse", warnings, 0)
        self.assertIn("type: measured_force", result["scenario"])

    def test_the_motions_after_several_short_blows_are_fitted_together(self):
        rows = struck_again(SEVERAL)
        for signal in "xa":
            with self.subTest(signal=signal):
                result, warnings = self.fitted(self.record("again.csv", 0, signal, rows=rows), "--drive", "force")
                self.assert_true(result)
                self.assert_told("the 3 blows of force at t = 0.32, 8.14, 16.46 s have 3 to 5 samples, too few to know their impulses", warnings)
                self.assert_told("the motion after them is read as 3 free vibrations, each with a first state of its own", warnings)
                self.assertLess(result["residual"]["noise_units"], 1.1)
                self.assertIn("velocity[2]", [row["name"] for row in result["parameters"]])
                self.assertIn("type: none", result["scenario"])

    def test_several_short_blows_are_validated_and_predicted_together(self):
        again = self.record("again.csv", 0, rows=struck_again(SEVERAL))
        result, warnings = self.fitted(self.decay(), "--validate", again, "--drive", "force")
        self.assert_told("again.csv: the 3 blows of force", warnings)
        self.assertLess(result["validation"]["error"], 2e-3)
        ran = json.loads(self.run_program("predict", "fit", again, "--drive", "force", "--json").stdout)
        self.assertLess(ran["result"]["validation"]["error"], 2e-3)
        self.assertFalse(ran["result"]["validation"]["wrong"])
        self.assert_told("again.csv: the 3 blows of force", ran["warnings"])

    def test_where_several_blows_are_needed_the_error_of_their_impulses_is_told(self):
        again = self.record("again.csv", 0, rows=struck_again(SEVERAL))
        warnings = self.fitted(again, "--drive", "force", constants=(*CONSTANTS, "--set", "initial={position: 0 m}"))[1]
        self.assert_told("have 3 to 5 samples: an impulse may be wrong by 8.9 %", warnings)
        self.assert_told("left out", warnings, 0)
        # Blows that follow each other closely leave no vibration that could be read.
        often = tuple((0.31 + 0.31 * i, 2.6, 0.05) for i in range(40))
        warnings = self.fitted(self.record("often.csv", 0, rows=struck_again(often, 640)), "--drive", "force", "--set", "analysis.starts=2")[1]
        self.assert_told("an impulse may be wrong by ", warnings)

    def identified(self, record):
        return json.loads(self.run_program("identify", record, *CONSTANTS, "--json").stdout)

    def test_identify_uses_the_motions_after_several_short_blows_together(self):
        answer = self.identified(self.record("again.csv", 0, rows=struck_again(SEVERAL)))
        self.assert_told("the motion after them is read as 3 free vibrations", answer["warnings"])
        estimate = answer["result"]["answer"]
        self.assertEqual(estimate["method"], "joint_fit")
        for name, truth in (("c", DAMPING), ("F0", FRICTION)):
            self.assertAlmostEqual(estimate[name], truth, delta=0.03 * truth)
        self.assertIn("3 histories", answer["result"]["tested"])

    def test_a_prediction_begins_after_the_blow(self):
        record = self.record("struck.csv", 4.3)
        self.fitted(self.decay())
        ran = json.loads(self.run_program("predict", "fit", record, "--drive", "force", "--json").stdout)
        self.assertLess(ran["result"]["validation"]["error"], 2e-3)
        self.assertFalse(ran["result"]["validation"]["wrong"])
        self.assert_told("too few to know its impulse", ran["warnings"])
        # The rig of the fit to a struck record has no drive, and what was fitted is no prediction.
        self.fitted(record, "--drive", "force")
        refused = self.run_program("predict", "fit", record, "--drive", "force", status=3).stderr
        self.assertIn("holds readings that were fitted", refused)
        ran = json.loads(self.run_program("predict", "fit", self.decay("other.csv", 0.07), "--json").stdout)
        self.assertLess(ran["result"]["validation"]["error"], 2e-3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
