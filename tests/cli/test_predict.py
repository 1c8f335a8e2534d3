#!/usr/bin/env python3
"""A prediction knows all that the fit before it found, and what that fit lacked.

usage: test_predict.py PROGRAM ROOT [TEST...]
"""

import csv
import json
import math
import sys
import unittest

import case

RIG = "system: {mass: 1 kg, stiffness: 1000 N/m, damping: 1 N.s/m, friction: {law: coulomb, kinetic: %s N}}\n"
CONSTANTS = ("--mass", "1 kg", "--stiffness", "1000 N/m")


class Prediction(case.Case):
    def record(self, name, drive, kinetic=1.0, after=0.0, base=None, initial=0.0):
        """A motion of the rig, 200 samples a second from the time `after` on, with a rough error of 2 um; `base`: y [m] at t."""
        text = f"schema: dualdamp/1\n{RIG % kinetic}excitation: {drive}\ninitial: {{position: {initial} m}}\nanalysis: {{type: simulate, duration: 1 s, sample_rate: 200 Hz}}\n"
        self.run_program("run", self.write("motion.yaml", text), "--out", "motion")
        with open(self.folder / "motion/history.csv") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        column = {key.split(" ")[0]: key for key in rows[0]}
        lines = ["t [s],x [m]" + (",y [m]" if base else "")]
        for i, row in enumerate(rows):
            t, x = float(row[column["t"]]), float(row[column["x"]]) + 2e-6 * math.sin(977.0 * i * i)
            if t > after - 1e-9:
                lines.append(f"{t!r},{x!r}" + (f",{base(t)!r}" if base else ""))
        return self.write(name, "\n".join(lines) + "\n")

    def predicted(self, *arguments, **options):
        return json.loads(self.run_program("predict", *arguments, "--json", **options).stdout)["result"]["validation"]

    def assert_right(self, validation):
        self.assertFalse(validation["wrong"], validation["text"])
        self.assertLess(validation["error"], 0.01)

    def test_more_friction_than_in_the_fitted_record_is_a_changed_rig_and_no_wrong_law(self):
        """The static level is by default the kinetic one: held at its old value it would keep the kinetic one below itself."""
        drive = "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}"
        driven = ("--frequency", "4 Hz", "--amplitude", "5 mm")
        first, second = self.record("one.csv", drive), self.record("more.csv", drive, 1.3)
        self.run_program("fit", "coulomb", first, *CONSTANTS, *driven, "--no-profile", "--validate", second, "--out", "fit")
        fit = json.loads((self.folder / "fit/result.json").read_text())["result"]
        self.assertNotIn("static", fit["scenario"])
        for found in (fit["validation"], self.predicted("fit", second)):
            self.assertTrue(found["wrong"])
            self.assertIn("the rig has changed", found["text"])
            self.assertLess(found["attainable"], 0.01)

    def test_a_fitted_phase_and_a_fitted_force_are_those_of_the_prediction(self):
        for drive, told, more, free in (
            ("{type: base_harmonic, amplitude: %s mm, frequency: 4 Hz, phase: -0.9}", ("--frequency", "4 Hz", "--amplitude", "5 mm"), ("--amplitude", "8 mm"), "phase"),
            ("{type: force_harmonic, amplitude: %s N, frequency: 4 Hz, offset: 2 N}", ("--set", "excitation={type: force_harmonic, amplitude: 5 N, frequency: 4 Hz}"), ("--amplitude", "8 N"), "force_offset"),
        ):
            with self.subTest(free):
                first, second = self.record("first.csv", drive % 5), self.record("second.csv", drive % 8)
                self.run_program("fit", "coulomb", first, *CONSTANTS, *told, "--free", free, "--no-profile", "--out", free)
                self.assert_right(self.predicted(free, second, *more))

    def test_a_fit_without_mass_and_spring_predicts_without_them(self):
        def loop(name, amplitude):
            rows = []
            for i in range(1000):
                t = i / 500
                x, v = amplitude * math.sin(12 * t), 12 * amplitude * math.cos(12 * t)
                rows.append(f"{t!r},{x!r},{v!r},{math.copysign(1.0, v) + 2.0 * v + 1e-3 * math.sin(977.0 * i * i)!r}")
            return self.write(name, "\n".join(["t [s],x [m],v [m/s],force [N]", *rows]) + "\n")

        first, second = loop("loop1.csv", 0.02), loop("loop2.csv", 0.03)
        self.run_program("fit", "coulomb", first, "--loop", "--free", "damping", "--damping", "0 N.s/m", "--no-profile", "--out", "fit")
        self.assert_right(self.predicted("fit", second, "--loop"))
        motion = self.record("motion.csv", "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}")
        refused = self.run_program("predict", "fit", motion, "--frequency", "4 Hz", "--amplitude", "5 mm", status=3).stderr
        self.assertIn("'system' lacks mass, stiffness", refused)

    def test_a_record_that_was_fitted_is_no_prediction(self):
        """Also under another name, in another unit, beside a record that was not fitted, and as one of several that were."""
        drive = "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}"
        driven = ("--frequency", "4 Hz", "--amplitude", "5 mm")
        first, second, third = (self.record(f"{n}.csv", drive, initial=0.001 * n) for n in range(3))
        rows = [line.split(",") for line in first.read_text().splitlines()]
        in_mm = self.write("in_mm.csv", "\n".join(["t [s],x [mm]", *(f"{t},{float(x) * 1e3!r}" for t, x in rows[1:])]) + "\n")
        self.run_program("fit", "coulomb", first, second, *CONSTANTS, *driven, "--no-profile", "--out", "fit")
        for given in ([first], [second], [in_mm], [third, first]):
            refused = self.run_program("predict", "fit", *given, *driven, status=3).stderr
            self.assertIn(f"{given[-1]} holds readings that were fitted", refused)
            self.assertIn("a record that was not fitted", refused)
        self.assert_right(self.predicted("fit", third, *driven))

    def test_a_record_that_holds_another_drive_is_refused(self):
        def moved(millimetres):
            return lambda t: millimetres * 1e-3 * math.cos(8.0 * math.pi * t)

        drive = "{type: base_harmonic, amplitude: %s mm, frequency: 4 Hz}"
        first, second = self.record("y5.csv", drive % 5, base=moved(5)), self.record("y8.csv", drive % 8, base=moved(8))
        measured = "excitation={type: measured_base, file: %s, column: y, interpolation: cubic}"
        self.run_program("fit", "coulomb", first, *CONSTANTS, "--set", measured % "y5.csv", "--no-profile", "--out", "fit")
        refused = self.run_program("predict", "fit", second, "--frequency", "4 Hz", "--amplitude", "5 mm", status=3).stderr
        self.assertIn("the record holds y, and it differs from the drive by 37 % of y", refused)
        self.assert_right(self.predicted("fit", second, "--set", measured % "y8.csv"))
        self.assert_right(self.predicted("fit", second))
        for arguments in ([second, "--frequency", "4 Hz", "--amplitude", "5 mm"], [first, second, "--set", measured % "y5.csv"]):
            self.assertIn("differs from the drive", self.run_program("fit", "coulomb", *arguments, *CONSTANTS, "--no-profile", status=3).stderr)
        # The phase of the drive is found, not stated.
        late = self.record("late.csv", "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz, phase: 0.9}", base=lambda t: 5e-3 * math.cos(8.0 * math.pi * t + 0.9))
        driven = (late, *CONSTANTS, "--frequency", "4 Hz", "--amplitude", "5 mm", "--no-profile")
        self.run_program("fit", "coulomb", *driven, "--free", "phase")
        self.assertIn("differs from the drive", self.run_program("fit", "coulomb", *driven, status=3).stderr)

    def test_the_motion_of_the_base_in_the_file_is_the_drive(self):
        drive = "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}"
        record = self.record("run.csv", drive, base=lambda t: 5e-3 * math.cos(8.0 * math.pi * t))
        rows = [line.split(",") for line in record.read_text().splitlines()[1:]]
        renamed = self.write("renamed.csv", "clock,x [m],table\n" + "".join(f"{1e3 * float(t)!r},{x},{1e3 * float(y)!r}\n" for t, x, y in rows))
        columns = ("--column", "y=table", "--column", "t=clock", "--unit", "y=mm", "--unit", "t=ms")
        stated = ("--set", "excitation={type: measured_base, file: run.csv, column: y, interpolation: cubic}")
        found = []
        for arguments in ((record, *stated), (record,), (renamed, *columns)):
            self.run_program("fit", "coulomb", *arguments, *CONSTANTS, "--no-profile", "--out", "fit")
            found.append(json.loads((self.folder / "fit/result.json").read_text())["result"]["parameters"])
        self.assertEqual(found[0], found[1])
        for one, other in zip(found[0], found[2]):
            self.assertAlmostEqual(one["value"], other["value"], delta=1e-3 * one["std"])
        # What is stated stands: none, or the force of a column that may also be that of a friction loop.
        self.assertIn("nothing drives the model", self.run_program("fit", "coulomb", record, *CONSTANTS, "--set", "excitation={type: none}", status=3).stderr)
        forced = self.write("forced.csv", record.read_text().replace("y [m]", "force [N]"))
        self.assertIn("or --loop for a friction loop", self.run_program("fit", "coulomb", forced, *CONSTANTS, status=3).stderr)
        springless = ("--mass", "1 kg", "--stiffness", "0 N/m", "--drive", "force")
        self.assertIn("--loop compares the force", self.run_program("fit", "coulomb", forced, *springless, status=3).stderr)
        both = self.write("both.csv", "t [s],x [m],y [m],force [N]\n" + "".join(",".join((*row, str(1.5 * float(row[2])))) + "\n" for row in rows))
        self.assertIn("or leave out y", self.run_program("fit", "coulomb", both, *CONSTANTS, status=3).stderr)
        # Of a file with a gap the longest stretch is used, with its part of the drive.
        torn = "".join(",".join(row) + "\n" for i, row in enumerate(rows) if not 40 <= i < 60)
        self.run_program("fit", "coulomb", self.write("torn.csv", "t [s],x [m],y [m]\n" + torn), *CONSTANTS, "--no-profile", "--out", "fit")
        for part, whole in zip(json.loads((self.folder / "fit/result.json").read_text())["result"]["parameters"][:2], found[0]):
            self.assertAlmostEqual(part["value"], whole["value"], delta=4.0 * part["std"])

    def test_records_with_motions_of_the_base_of_their_own_are_fitted_and_predicted_together(self):
        drive = "{type: base_harmonic, amplitude: 5 mm, frequency: %s Hz}"
        files = [self.record(f"run{f}.csv", drive % f, base=lambda t, f=f: 5e-3 * math.cos(2.0 * f * math.pi * t)).name for f in (3, 4, 5)]
        forced = self.write("forced.csv", (self.folder / files[2]).read_text().replace("y [m]", "force [kN]"))  # 1000 N/m times y
        self.run_program("fit", "coulomb", *files[:2], *CONSTANTS, "--no-profile", "--validate", files[2], "--out", "fit")
        result = json.loads((self.folder / "fit/result.json").read_text())["result"]
        self.assertEqual([row["name"] for row in result["parameters"]], ["damping", "kinetic", "position[0]", "velocity[0]", "position[1]", "velocity[1]"])
        self.assertFalse(result["validation"]["wrong"])
        for scenario in result["scenarios"]:
            self.run_program("run", self.write("again.yaml", scenario), "--out", "again")
        again = self.record("again.csv", drive % 4, base=lambda t: 5e-3 * math.cos(8.0 * math.pi * t), initial=0.001).name
        predicted = json.loads(self.run_program("predict", "fit", again, files[2], "--json").stdout)["result"]["validation"]
        self.assertFalse(predicted["wrong"])
        # A force beside a motion of the base: of the files with this column only.
        self.assertIn("--drive force", self.run_program("predict", "fit", again, forced, status=3).stderr)
        self.run_program("predict", "fit", again, forced, "--drive", "force")
        self.run_program("fit", "coulomb", files[0], forced, *CONSTANTS, "--no-profile", "--drive", "force", "--out", "both")
        self.assertIn("excludes", self.run_program("fit", "coulomb", forced, *CONSTANTS, "--drive", "force", "--loop", status=2).stderr)

    def test_a_sought_zero_of_a_velocity_is_no_parameter_of_the_rig(self):
        record = self.record("run.csv", "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}", base=lambda t: 5e-3 * math.cos(8.0 * math.pi * t))
        rows = [line.split(",") for line in record.read_text().splitlines()[1:]]
        x = [float(row[1]) for row in rows]
        t = [float(row[0]) for row in rows]
        inner = range(1, len(rows) - 1)
        lines = "".join(f"{t[i]!r},{x[i]!r},{(x[i + 1] - x[i - 1]) / (t[i + 1] - t[i - 1])!r},{rows[i][2]}\n" for i in inner)
        with_v = self.write("with_v.csv", "t [s],x [m],v [m/s],y [m]\n" + lines)
        self.run_program("fit", "coulomb", with_v, *CONSTANTS, "--no-profile", "--free", "offset_v", "--out", "fit")
        self.assertIn("offset_v", (self.folder / "fit/result.json").read_text())
        self.run_program("predict", "fit", record)

    def test_a_zero_of_the_predicted_record_is_fitted_to_it_if_the_fit_sought_it_or_the_record_shows_it(self):
        drive, driven = "{type: base_harmonic, amplitude: %s mm, frequency: 4 Hz}", ("--frequency", "4 Hz", "--amplitude")
        first, second = self.record("one.csv", drive % 5), self.record("two.csv", drive % 8)
        rows = [line.split(",") for line in second.read_text().splitlines()]
        shifted = self.write("shifted.csv", "\n".join([",".join(rows[0])] + [f"{t},{float(x) + 4e-4!r}" for t, x in rows[1:]]) + "\n")
        fitted = "the zero of x is fitted to this record, "
        for free, plain in ((("--free", "offset"), fitted), ((), "describes this record")):
            self.run_program("fit", "coulomb", first, *CONSTANTS, *driven, "5 mm", "--no-profile", *free, "--out", "fit")
            for record, text in ((second, plain), (shifted, fitted + "(0.0004|0.000399.|0.000400.) .*with no zero but 0, the prediction misses by")):
                found = self.predicted("fit", record, "--amplitude", "8 mm")
                self.assert_right(found)
                self.assertRegex(found["text"], text)

    def test_no_law_is_called_wrong_where_only_the_drive_of_the_fit_was_assumed(self):
        drive = "{type: base_harmonic, amplitude: %s mm, frequency: 4 Hz}"
        told = ("--frequency", "4 Hz", "--amplitude", "5 mm")
        first, second = self.record("driven.csv", drive % 5), self.record("larger.csv", drive % 8)
        repeated = self.record("repeated.csv", drive % 5, initial=0.002)
        decay = self.record("decay.csv", "{type: none}", initial=0.04)
        sampled = self.record("base.csv", drive % 5, base=lambda t: 5e-3 * math.cos(8.0 * math.pi * t))
        measured = ("--set", "excitation={type: measured_base, file: base.csv, column: y, interpolation: cubic}")
        none = ("--set", "excitation={type: none}")
        for name, record, stated, assumed in (("by_harmonic", first, told, "base_harmonic, 0.005 m, 4 Hz"), ("by_file", sampled, measured, "measured_base, file base.csv")):
            self.run_program("fit", "coulomb", record, *CONSTANTS, *stated, "--no-profile", "--out", name)
            refused = self.run_program("predict", name, decay, status=4).stderr
            self.assertIn(f"Under the drive of the fit ({assumed})", refused)
            self.assertIn("--set excitation='{type: none}'", refused)
            self.assertNotIn("wrong", refused)
            self.assert_right(self.predicted(name, decay, *none))
            told_back = self.predicted(name, repeated)
            self.assert_right(told_back)
            self.assertIn("this holds if the record had the drive of the fit, which was assumed: " + assumed, told_back["text"])
        # Another amplitude: the record goes with neither drive.
        self.assertIn("which was assumed", self.predicted("by_harmonic", second)["text"])
        self.assertNotIn("assumed", self.predicted("by_harmonic", second, "--amplitude", "8 mm")["text"])
        self.run_program("fit", "coulomb", decay, *CONSTANTS, "--no-profile", "--out", "by_decay")
        refused = self.run_program("predict", "by_decay", first, status=4).stderr
        self.assertIn("a drive seems to be missing", refused)
        self.assertNotIn("wrong", refused)
        self.assert_right(self.predicted("by_decay", first, *told))
        self.assert_right(self.predicted("by_decay", self.record("again.csv", "{type: none}", initial=0.03)))

    def test_an_assumed_drive_of_an_angle_has_the_units_of_a_rotation(self):
        drive = "{type: %s, amplitude: %s, frequency: 4 Hz}"
        decay = self.record("decay.csv", "{type: none}", initial=0.04)
        turning = ("--mass", "1 kg.m^2", "--stiffness", "1000 N.m/rad")
        for kind, amplitude, unit in (("base_harmonic", "5 mm", "rad"), ("force_harmonic", "5 N", "N.m")):
            for record in (decay, self.record("driven.csv", drive % (kind, amplitude))):
                record.write_text(record.read_text().replace("x [m]", "x [rad]"))
            told = ("--set", "excitation=" + drive % (kind, amplitude.split()[0] + ("e-3 rad" if unit == "rad" else " N.m")))
            self.run_program("fit", "coulomb", "driven.csv", *turning, *told, "--no-profile", "--starts", "2", "--out", kind)
            self.assertRegex(self.run_program("predict", kind, decay, status=4).stderr, rf"\({kind}, [0-9.]+ {unit}, 4 Hz\)")

    def test_the_times_of_a_record_are_those_of_its_drive(self):
        for drive in ("{type: base_chirp, amplitude: 5 mm, from: 2 Hz, to: 6 Hz, duration: 2 s}",
                      "{type: base_chirp, amplitude: 5 mm, from: 2 Hz, to: 6 Hz, duration: 2 s, spacing: log}",
                      "{type: force_ramp, rate: 3 N/s}"):
            with self.subTest(drive):
                record = self.record("late.csv", drive, after=0.5)
                fit = self.run_program("fit", "coulomb", record, *CONSTANTS, "--set", f"excitation={drive}", "--no-profile", "--out", "late", "--json")
                found = json.loads(fit.stdout)["result"]
                self.assertLess(found["residual"]["rms"], 2e-6)
                self.write("again.yaml", found["scenario"])
                self.run_program("run", "again.yaml", "--out", "again")
                with open(self.folder / "again/history.csv") as file:
                    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
                x = [float(value) for key in rows[0] if key.split(" ")[0] == "x" for value in (row[key] for row in rows)]
                with open(self.folder / "late/fit_0_x.csv") as file:
                    fitted = list(csv.DictReader(line for line in file if not line.startswith("#")))
                key = next(key for key in fitted[0] if key.startswith("fitted"))
                self.assertEqual(len(x), len(fitted))
                self.assertLess(max(abs(a - float(row[key])) for a, row in zip(x, fitted)), 1e-7)
        drive = self.record("drive.csv", "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}", base=lambda t: 5e-3 * math.cos(8.0 * math.pi * t))
        late = self.record("late.csv", "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}", after=0.5)
        measured = "excitation={type: measured_base, file: %s, column: y, interpolation: cubic}" % drive.name
        refused = self.run_program("fit", "coulomb", late, *CONSTANTS, "--set", measured, "--no-profile", status=3).stderr
        self.assertIn("the record begins at t = 0.5 s, and the drive at t = 0 s", refused)

    def test_levels_under_a_force_are_forces(self):
        """The curve of a rig under a force of k Y is that under a motion Y of its base."""
        levels = ((4.5, 4.7), (5.0, 7.21), (5.5, 9.76), (6.0, 12.2))
        lengths = self.write("lengths.csv", "Y [mm],x [mm]\n" + "".join(f"{Y},{x}\n" for Y, x in levels))
        forces = self.write("forces.csv", "Y [N],x [mm]\n" + "".join(f"{1.568 * Y!r},{x}\n" for Y, x in levels))
        rig = ("--mass", "1.042 kg", "--stiffness", "1568 N/m", "--no-profile")
        by_force = ("--set", "excitation={type: force_harmonic, frequency: 6.17 Hz}")
        found = [json.loads(self.run_program("fit", "coulomb", *arguments, *rig, "--json").stdout)["result"]["parameters"]
                 for arguments in ((lengths, "--frequency", "6.17 Hz"), (forces, *by_force))]
        for motion, force in zip(*found):
            self.assertAlmostEqual(force["value"] / motion["value"], 1.0, delta=1e-6)
        refused = self.run_program("fit", "coulomb", lengths, *by_force, *rig, status=3).stderr
        self.assertIn("the unit of column Y, the amplitude of the force", refused)

    def test_a_bound_without_an_end(self):
        record = self.record("first.csv", "{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}")
        bounds = ("--set", "analysis.bounds=[{name: kinetic}]")
        refused = self.run_program("fit", "coulomb", record, *CONSTANTS, "--frequency", "4 Hz", "--amplitude", "5 mm", *bounds, status=3).stderr
        self.assertIn("the entry of 'kinetic' states no bound", refused)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
