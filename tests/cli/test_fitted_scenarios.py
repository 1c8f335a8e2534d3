#!/usr/bin/env python3
"""The scenarios that a fit writes run where they lie, and give the fitted curves.

usage: test_fitted_scenarios.py PROGRAM [TEST...]
"""

import cmath
import csv
import json
import math
import sys
import unittest

import case

CONSTANTS = ("--mass", "1 kg", "--stiffness", "1000 N/m")


class FittedScenarios(case.Case):
    def table(self, name):
        """Columns of a table by their names without units."""
        with open(self.folder / name) as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        return {key.split(" ")[0]: [float(row[key]) for row in rows] for key in rows[0]}

    def record(self, name, frequency, system="", drive="y [m]", size=0.005, rough=0.0):
        """A response to a drive that the file holds, 250 samples a second, with a rough error; `rough`: error of the recorded drive."""
        samples = [(i / 250, size * math.sin(2 * math.pi * frequency * i / 250) * min(1.0, i / 100)) for i in range(400)]
        kind, unit = ("base", "m") if drive.startswith("y") else ("force", "N")
        if "angle" in system:
            unit = {"m": "rad", "N": "N.m"}[unit]
        self.write("made/drive.csv", "\n".join([f"t [s],{drive}", *(f"{t!r},{y!r}" for t, y in samples)]) + "\n")
        constants = "mass: 1 kg.m^2, stiffness: 1000 N.m/rad, damping: 2 N.m.s/rad, friction: {law: coulomb, kinetic: 0.5 N.m}" if "angle" in system else (
            "mass: 1 kg, stiffness: 1000 N/m, damping: 2 N.s/m, friction: {law: coulomb, kinetic: 0.5 N}")
        self.write("made/motion.yaml", f"schema: dualdamp/1\nsystem: {{{system}{constants}}}\nexcitation: {{type: measured_{kind}, file: drive.csv, interpolation: cubic}}\n"
                   "analysis: {type: simulate, duration: 1.596 s, sample_rate: 250 Hz}\n")
        self.run_program("run", "made/motion.yaml", "--out", "made/motion")
        motion = self.table("made/motion/history.csv")
        length = "rad" if "angle" in system else "m"
        lines = [f"t [s],x [{length}],{drive}"]
        lines += [f"{t!r},{x + 1e-5 * math.sin(977.0 * i * i)!r},{y + rough * math.sin(613.0 * i * i)!r}" for i, (t, x, (_, y)) in enumerate(zip(motion["t"], motion["x"], samples))]
        return self.write(name, "\n".join(lines) + "\n")

    def assert_gives_the_fitted_curve(self, directory, scenario, curve):
        """Also after the directory was moved, and without the record."""
        self.run_program("run", f"{directory}/{scenario}", "--out", "again")
        fitted, motion = self.table(f"{directory}/{curve}")["fitted"], self.table("again/history.csv")["x"]
        self.assertEqual(len(fitted), len(motion))
        largest = max(abs(x) for x in fitted)
        self.assertLess(max(abs(a - b) for a, b in zip(fitted, motion)), 1e-11 * largest)

    def states(self, name, levels, frequencies, pairs=None):
        """Pairs at several amplitudes and frequencies, in any order; `pairs`: numbers of those that are measured."""
        listed = ", ".join(f"{omega} rad/s" for omega in frequencies)
        self.write("made/states.yaml", "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 2 N.s/m, friction: {law: coulomb, kinetic: 0.5 N}}\n"
                   f"excitation: {{type: base_harmonic}}\nanalysis: {{type: frequency_response, frequencies: [{listed}]}}\nsweep: {{excitation.amplitude: {levels}}}\n")
        self.run_program("run", "made/states.yaml", "--out", "made/states", "--overwrite")
        made = self.table("made/states/sweep_points.csv")
        rows = [f"{omega!r},{level!r},{x * (1 + 1e-4 * math.sin(613.0 * i * i))!r}" for i, (omega, level, x) in enumerate(zip(made["omega"], made["excitation.amplitude"], made["x"]))]
        chosen = [rows[i] for i in pairs or range(len(rows))]
        self.write(name, "\n".join(["omega [rad/s],Y [m],x [m]", *chosen[1::2], *chosen[::2]]) + "\n")

    def test_of_steady_states_at_several_frequencies_and_amplitudes(self):
        """All of them, by curves over the quantity with more values: the scenario had given those at the first frequency alone."""
        for levels, frequencies, over, swept in ((3, 5, "omega", "excitation.amplitude"), (5, 3, "Y", "excitation.frequency")):
            self.states("grid.csv", [0.003 + 0.002 * i for i in range(levels)], [24.0 + 2.5 * i for i in range(frequencies)])
            result = self.run_program("fit", "coulomb", "grid.csv", *CONSTANTS, "--no-profile", "--out", "fit")
            self.assertNotIn("does not give", result.stderr)
            self.assertNotIn("Of the fitted states", (self.folder / "fit/fitted.yaml").read_text())
            self.run_program("run", "fit/fitted.yaml", "--out", "again", "--overwrite")
            again, fit = self.table("again/sweep_points.csv"), self.table("fit/fit_0_x.csv")
            beside = "Y" if over == "omega" else "omega"
            states = {(a, b): x for a, b, x in zip(again[over], again[swept], again["x"])}
            self.assertEqual(len(states), 15)
            for a, b, fitted in zip(fit[over], fit[beside], fit["fitted"]):
                self.assertAlmostEqual(states[a, b] / fitted, 1.0, delta=1e-6)

    def test_of_scattered_steady_states(self):
        """What the scenario gives beyond the states, or leaves out, is said."""
        self.states("few.csv", [0.003, 0.005, 0.007], [24.0, 27.0, 30.0, 33.0], [0, 1, 2, 3, 5, 6, 10, 11])
        self.run_program("fit", "coulomb", "few.csv", *CONSTANTS, "--no-profile", "--out", "fit")
        self.assertIn("# Of the fitted states: it also gives states that were not measured", (self.folder / "fit/fitted.yaml").read_text())
        count = 12  # each amplitude at a frequency of its own
        self.states("own.csv", [0.003 + 4e-4 * i for i in range(count)], [24.0 + i for i in range(count)], [i * count + i for i in range(count)])
        said = self.run_program("fit", "coulomb", "own.csv", *CONSTANTS, "--no-profile", "--out", "fit").stderr
        told = "it gives the states at 25 rad/s alone: each amplitude was measured at few of the 12 frequencies"
        self.assertIn("fitted.yaml does not give the whole fitted curve: " + told, " ".join(said.split()))
        self.assertIn(told, (self.folder / "fit/fitted.yaml").read_text())

    def test_of_a_record_elsewhere_with_its_drive(self):
        path = self.record("data/far/run.csv", 4.0)
        self.run_program("fit", "coulomb", path, *CONSTANTS, "--no-profile", "--out", "fit")
        path.unlink()
        (self.folder / "fit").rename(self.folder / "moved")
        self.assert_gives_the_fitted_curve("moved", "fitted.yaml", "fit_0_x.csv")

    def test_noise_of_a_measured_drive_is_named_as_a_cause_of_residuals_that_are_not_noise(self):
        path = self.record("data/rough.csv", 4.0, rough=1e-4)
        result = self.run_program("fit", "coulomb", path, *CONSTANTS, "--no-profile", "--out", "fit")
        self.assertIn("are not noise", result.stderr)
        self.assertIn("the measured drive has noise, to which the rig responds", result.stderr)

    def test_forces_that_nothing_states_are_named_as_a_cause(self):
        """In a loop they are taken as zero. What warnings say of an angle is in the units of an angle."""
        rows = ["t [s],x [rad],v [rad/s],a [rad/s^2],force [N.m]"]
        for i in range(1200):
            t = i / 200
            x, v, a = 0.3 * math.sin(3 * t), 0.9 * math.cos(3 * t), -2.7 * math.sin(3 * t)
            rows.append(f"{t},{x!r},{v!r},{a!r},{0.3 * a + 0.04 * v + 12 * x + math.copysign(0.2, v) + 0.002 * math.sin(613.0 * i * i)!r}")
        self.write("loop.csv", "\n".join(rows) + "\n")
        loop = ["fit", "coulomb", "loop.csv", "--loop", "--no-profile", "--mass", "0.3 kg.m^2", "--sigma", "force=1e-4 N.m"]
        found = self.run_program(*loop, "--stiffness", "12 N.m/rad", "--out", "fit").stderr
        self.assertIn("the force has a part of damping, which is neither stated nor sought ('free' with damping seeks it)", found)
        self.assertIn("0.0001 N.m is stated", found)
        found = self.run_program(*loop, "--out", "fit").stderr
        self.assertIn("a part of stiffness or damping, which are neither stated nor sought ('free' with stiffness, damping seeks them)", found)
        found = self.run_program(*loop, "--stiffness", "12 N.m/rad", "--free", "damping", "--out", "fit").stderr
        self.assertNotIn("neither stated", found)

    def test_a_contact_that_reverses_is_no_stiffer_in_a_loop_of_positions(self):
        """The filter of the positions rounds the bend of the velocity at a reversal: with a low cut-off alone, 10000 N/m had come out as 10237 +- 17 N/m."""
        self.write("motion.yaml", "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 1.5 N.s/m, friction: {law: contact_compliance, kinetic: 1 N, contact_stiffness: 10 kN/m}}\n"
                   "excitation: {type: force_harmonic, amplitude: 3 N, frequency: 28 rad/s, harmonics: [{order: 2, amplitude: 1 N, phase: 40 deg}]}\n"
                   "analysis: {type: simulate, duration: 2 s, sample_rate: 1 kHz}\n")
        self.run_program("run", "motion.yaml", "--out", "motion")
        motion = self.table("motion/history.csv")
        rows = [f"{t!r},{x!r},{f + 0.014 * math.sin(613.0 * i * i)!r}" for i, (t, x, f) in enumerate(zip(motion["t"], motion["x"], motion["force"]))]
        self.write("loop.csv", "\n".join(["t [s],x [m],force [N]", *rows]) + "\n")
        self.run_program("fit", "contact_compliance", "loop.csv", "--loop", "--free", "mass,stiffness,damping", "--no-profile", "--out", "fit")
        fitted = {row["name"]: row for row in json.loads((self.folder / "fit/result.json").read_text())["result"]["parameters"]}
        for name, truth in (("contact_stiffness", 1e4), ("kinetic", 1.0), ("mass", 1.0)):
            self.assertAlmostEqual(fitted[name]["value"], truth, delta=4 * fitted[name]["std"], msg=name)
        self.assertLess(fitted["contact_stiffness"]["std"], 30)

    def test_exact_positions_beside_a_rest_do_not_stop_a_contact(self):
        """Strokes with rests between them, of x alone: the filter leaves positions that go against their velocity beside a rest. The contact stiffness had come out 93 % too small."""
        rows, friction, start, before, fine = ["t [s],x [m],force [N]"], 0.0, 0.0, 0.0, 20
        for stroke, end in enumerate((0.008, -0.006, 0.003, 0.009, -0.009, 0.001, -0.004, 0.006)):
            for i in range(300):
                for k in range(fine):
                    s = min(1.0, (i + k / fine) / 200)
                    x = start + (end - start) * s ** 3 * (10 + s * (6 * s - 15))
                    friction = max(-3.0, min(3.0, friction + 5000 * (x - before)))
                    before = x
                    if k == 0:
                        rows.append(f"{(len(rows) - 1) / 500},{x!r},{friction + 0.014 * math.sin(613.0 * len(rows) ** 2)!r}")
            start = end
        self.write("loop.csv", "\n".join(rows) + "\n")
        self.run_program("fit", "contact_compliance", "loop.csv", "--loop", "--no-profile", "--out", "fit")
        fitted = {row["name"]: row["value"] for row in json.loads((self.folder / "fit/result.json").read_text())["result"]["parameters"]}
        self.assertAlmostEqual(fitted["contact_stiffness"], 5000, delta=50)
        self.assertAlmostEqual(fitted["kinetic"], 3.0, delta=0.01)

    def test_names_of_parameters_are_a_list_or_a_text(self):
        path = self.record("run.csv", 4.0).name
        parameters = []
        for free in ("[mass, damping]", '"mass,damping"', '" damping , mass "'):
            self.write("fit.yaml", "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 2 N.s/m}\n"
                       f"analysis: {{type: fit, data: {path}, laws: coulomb, free: {free}, profile: false}}\n")
            document = json.loads(self.run_program("run", "fit.yaml", "--json").stdout)
            self.assertEqual(document["scenario"]["analysis"]["laws"], ["coulomb"])
            parameters.append([row["name"] for row in document["result"]["parameters"]])
            self.assertLessEqual({"mass", "damping", "kinetic"}, set(parameters[-1]))
        self.assertEqual(parameters[0], parameters[1])

    def test_a_parameter_of_one_of_several_laws_can_be_stated_and_freed(self):
        """By the name of the law, or by its own name if one law has it. Each fit is then that of the law alone."""
        path = self.record("run.csv", 4.0)

        def fitted(laws, *more, status=0):
            said = self.run_program("fit", laws, path, *CONSTANTS, *more, "--no-profile", "--json", "--out", "fit", status=status)
            if status:
                return said.stderr
            return {row["law"]: row for row in json.loads(said.stdout)["result"]["laws"]}

        alone = fitted("stribeck", "--set", "system.friction.exponent=1.5", "--set", "stribeck.stribeck_velocity=20 mm/s", "--free", "exponent")
        for settings in (("stribeck.exponent=1.5", "stribeck.stribeck_velocity=20 mm/s"), ("system.friction.exponent=1.5", "system.friction.stribeck_velocity=20 mm/s")):
            both = fitted("coulomb,stribeck", *(word for one in settings for word in ("--set", one)), "--free", "stribeck.exponent")
            self.assertEqual(both["stribeck"]["parameters"], alone["stribeck"]["parameters"])
            self.assertAlmostEqual(both["stribeck"]["rms"] / alone["stribeck"]["rms"], 1.0, delta=1e-6)
            self.assertEqual(both["coulomb"]["parameters"], 4)  # damping, kinetic, position, velocity

        for setting, told in (("system.friction.kinetic=1 N", "'kinetic' is a parameter of several laws: write coulomb.kinetic or stribeck.kinetic"),
                              ("system.friction.sigma0=1 N/m", "no law of this fit has a parameter 'sigma0'"),
                              ("stribeck.sigma0=1 N/m", "no law of this fit has a parameter 'stribeck.sigma0'"),
                              ("stribeck.kinetic=-1 N", "'-1 N' of stribeck.kinetic: allowed is >= 0 N"),
                              ("stribeck.kinetic=1 kg", "'1 kg' of stribeck.kinetic: ")):
            self.assertIn(told, fitted("coulomb,stribeck", "--set", setting, status=3))
        self.assertIn("'friction.kinetic' has bounds and is not sought", fitted("coulomb,stribeck", "--set", "stribeck.kinetic=1 N", "--set", "analysis.bounds=[{name: stribeck.kinetic, low: 0.1 N}]", status=3))
        self.assertIn("unless 'analysis.stated' states it", fitted("coulomb,stribeck", "--set", "system.friction={law: dahl}", status=3))
        self.write("fit.yaml", "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 2 N.s/m, friction: {law: coulomb}}\n"
                   f"analysis: {{type: fit, data: {path.name}, stated: [{{name: kinetic, value: 1 N}}]}}\n")
        self.assertIn("'stated' is for laws that are compared", self.run_program("run", "fit.yaml", status=3).stderr)

    def test_a_zero_within_the_friction_is_named_as_a_cause(self):
        """The mean of the residuals says nothing of it: they are those of a slow motion, and few of them are independent."""
        def decay(offset):
            self.write("made/motion.yaml", "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, cubic_stiffness: 3e5 N/m^3, damping: 1 N.s/m, friction: {law: coulomb, kinetic: 2 N}}\n"
                       "initial: {position: 40 mm}\nanalysis: {type: simulate, duration: 4 s, sample_rate: 100 Hz}\n")
            self.run_program("run", "made/motion.yaml", "--out", "made/motion")
            motion = self.table("made/motion/history.csv")
            return self.write("decay.csv", "\n".join(["t [s],x [m]", *(f"{t!r},{x + offset + 2e-5 * math.sin(977.0 * i * i)!r}" for i, (t, x) in enumerate(zip(motion["t"], motion["x"])))]) + "\n")

        fit = ("fit", "coulomb", decay(1.6e-3), *CONSTANTS, "--no-profile", "--free", "cubic_stiffness")
        said = self.run_program(*fit).stderr
        self.assertIn("Seek the zero: 'free' with offset", said)
        self.assertIn("the zero of the sensor is off ('free' with offset seeks it)", said)
        self.assertNotIn("the zero", self.run_program(*fit[:-1], "cubic_stiffness,offset").stderr)

    def test_of_a_record_that_begins_with_a_loaded_contact(self):
        friction = "{law: free_play, kinetic: 1.5 N, play: 3 mm}"
        motion = ("schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 1 N.s/m, friction: %s}\nexcitation: {type: base_harmonic, frequency: 4 Hz, amplitude: 6 mm}\n"
                  "initial: {position: 3 mm, velocity: 0.05 m/s, travel: %s}\nanalysis: {type: simulate, duration: 1.596 s, sample_rate: 250 Hz}\n")
        self.write("made/motion.yaml", motion % (friction, "1 mm"))
        self.run_program("run", "made/motion.yaml", "--out", "made/motion")
        made = self.table("made/motion/history.csv")
        lines = ["t [s],x [m]"] + [f"{t!r},{x + 1e-5 * math.sin(977.0 * i * i)!r}" for i, (t, x) in enumerate(zip(made["t"], made["x"]))]
        self.write("run.csv", "\n".join(lines) + "\n")
        drive = ("--frequency", "4 Hz", "--amplitude", "6 mm")
        result = self.run_program("fit", "free_play", "run.csv", *CONSTANTS, *drive, "--no-profile", "--out", "fit")
        self.assertIn("the contacts were loaded when the record began", result.stderr)
        self.assertAlmostEqual(self.named_value("fit/parameters.csv", "travel"), 1e-3, delta=5e-5)
        self.assertAlmostEqual(self.named_value("fit/parameters.csv", "kinetic"), 1.5, delta=0.02)
        self.assertIn("travel:", (self.folder / "fit/fitted.yaml").read_text())
        self.assert_gives_the_fitted_curve("fit", "fitted.yaml", "fit_0_x.csv")

    def named_value(self, table, name):
        with open(self.folder / table) as file:
            return float(next(row["value"] for row in csv.DictReader(line for line in file if not line.startswith("#")) if row["name"] == name))

    def test_of_samples_without_times(self):
        path = self.record("run.csv", 4.0)
        path.write_text("\n".join(line.split(",", 1)[1] for line in path.read_text().splitlines()) + "\n")
        options = ("run.csv", "--sample-rate", "250 Hz", *CONSTANTS, "--no-profile", "--out", "fit")
        scenario = json.loads(self.run_program("fit", "coulomb", *options, "--json").stdout)["result"]["scenario"]
        self.assert_gives_the_fitted_curve("fit", "fitted.yaml", "fit_0_x.csv")
        self.write("named.yaml", scenario)
        self.assert_gives_the_fitted_curve(".", "named.yaml", "fit/fit_0_x.csv")

    def test_of_a_loss_factor(self):
        """The closed form of a complex stiffness gives the records; a motion in time is refused, and so is a second damper."""
        def response(name, force):
            rows = ["f [rad/s],Y [N],x [m],phase [rad]"]
            for i in range(13):
                omega = 50.0 + 2.0 * i
                x = force / (8000.0 * (1.0 + 0.05j) - 2.0 * omega ** 2)
                rows.append(f"{omega!r},{force!r},{abs(x)!r},{-cmath.phase(x)!r}")
            return self.write(name, "\n".join(rows) + "\n")

        response("response.csv", 3.0)
        response("other.csv", 5.0)
        rig = ("--mass", "2 kg", "--stiffness", "8000 N/m", "--damping", "0 N.s/m", "--set", "system.friction.kinetic=0 N", "--free", "loss_factor")
        force = ("--set", "excitation={type: force_harmonic}")
        self.run_program("fit", "coulomb", "response.csv", *rig, *force, "--no-profile", "--out", "fit")
        result = json.loads((self.folder / "fit/result.json").read_text())["result"]
        values = {each["name"]: each["value"] for each in result["parameters"]}
        self.assertAlmostEqual(values["loss_factor"], 0.05, delta=1e-6)
        self.run_program("run", "fit/fitted.yaml", "--out", "again")
        fitted, again = self.table("fit/fit_0_x.csv"), self.table("again/curve.csv")
        for a, b in zip(fitted["fitted"], again["x"]):
            self.assertAlmostEqual(a / b, 1.0, delta=1e-9)
        self.assertIn("describes this record", self.run_program("predict", "fit", "other.csv", "--out", "predicted").stdout)
        self.write("decay.csv", "t [s],x [m]\n" + "\n".join(f"{i / 100!r},{0.01 * math.exp(-0.02 * i) * math.cos(0.6324 * i)!r}" for i in range(200)) + "\n")
        refused = self.run_program("fit", "coulomb", "decay.csv", *rig, "--out", "none", status=3)
        self.assertIn("no motion in time", refused.stderr)
        self.write("base.csv", (self.folder / "response.csv").read_text().replace("Y [N]", "Y [m]"))
        refused = self.run_program("fit", "coulomb", "base.csv", "--mass", "2 kg", "--stiffness", "8000 N/m", "--free", "loss_factor", "--out", "none", status=3)
        self.assertIn("the system has one damper", refused.stderr)

    def test_of_a_driving_torque(self):
        path = self.record("data/turn.csv", 4.0, "coordinate: angle, ", "force [N.m]", 5.0)
        self.run_program("fit", "coulomb", path, "--mass", "1 kg.m^2", "--stiffness", "1000 N.m/rad", "--drive", "force", "--no-profile", "--out", "fit")
        self.assert_gives_the_fitted_curve("fit", "fitted.yaml", "fit_0_x.csv")

    def test_of_several_records_and_what_a_later_fit_leaves_of_them(self):
        paths = [self.record("data/a.csv", 4.0), self.record("data/b.csv", 7.0)]
        self.run_program("fit", "coulomb", *paths, *CONSTANTS, "--no-profile", "--out", "fit")
        for number in range(2):
            self.assert_gives_the_fitted_curve("fit", f"fitted_{number}.yaml", f"fit_{number}_x.csv")
        changed = (self.folder / "fit/fitted_1.yaml").read_text().replace("duration", "duration ")
        self.write("fit/fitted_1.yaml", changed)
        for files, kept in ((paths, "fitted_1.yaml~"), (paths[:1], "fitted_1.yaml~")):
            self.run_program("fit", "coulomb", *files, *CONSTANTS, "--no-profile", "--out", "fit")
            self.assertEqual((self.folder / "fit" / kept).read_text(), changed)
        self.assertEqual(sorted(path.name for path in (self.folder / "fit").glob("fitted*")), ["fitted.yaml", "fitted_1.yaml~"])
        self.assertEqual(sorted(path.name for path in (self.folder / "fit").glob("drive*")), ["drive.csv"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=1)
