#!/usr/bin/env python3
"""What options and scenarios state and a run would ignore, or could not take: refused, with its place.

usage: test_ignored.py PROGRAM ROOT [TEST...]
"""

import json
import math
import sys
import unittest
from pathlib import Path

import case
from case import BASE

ROOT = Path(sys.argv[2]).resolve()


class Ignored(case.Case):
    timeout = 120

    def setUp(self):
        super().setUp()
        self.write("base.yaml", BASE)

    def test_empty_names(self):
        for arguments in (["run", ""], ["check", ""], ["identify", ""], ["fit", "", "x.csv"], ["report", ""], ["laws", ""], ["new", ""],
                          *(["identify", "x.csv", option, text] for option in ("--mass", "--frequency", "--decimal", "--sigma-x", "--coordinate") for text in ("", " ")),
                          ["run", "base.yaml", "--set", ""], ["fit", "x.csv", "--stiffness", ""]):
            with self.subTest(arguments):
                self.assertIn("it is empty", self.run_program(*arguments, status=2).stderr)

    def test_a_value_that_two_options_state(self):
        """The earlier one would be ignored."""
        data = self.write("data.csv", "Y [mm],x [mm]\n4.5,4.7\n5,7.21\n5.5,9.76\n6,12.2\n")
        rig = ["identify", data, "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz"]
        sweep = self.write("sweep.yaml", BASE + "sweep: {system.mass: [1 kg, 2 kg]}\n")
        for arguments, found in ((["run", "base.yaml", "--set", "system.mass=2 kg", "--set", "system.mass=3 kg"], "--set: system.mass=2 kg"),
                                 (["run", "base.yaml", "--set", "system.mass=2 kg", "--set", "system={}"], "--set: system.mass=2 kg"),
                                 (["run", "base.yaml", "--set", "numerics={verify: false}", "--verify"], "--set: numerics={verify: false}"),
                                 (["run", sweep, "--set", "system.mass=3 kg"], "--set: system.mass=3 kg"),
                                 ([*rig, "--unit", "x=mm", "--unit", "x=um"], "--unit: analysis.units.x="),
                                 ([*rig, "--scale", "x=2", "--scale", "x=3"], "--scale: analysis.scale.x="),
                                 ([*rig, "--gain-uncertainty", "x=1 %", "--gain-uncertainty", "x=2 %"], "--gain-uncertainty: analysis.gain_uncertainty.x=1 %"),
                                 (["fit", "coulomb", data, "--mass", "1 kg", "--set", "system.mass=2 kg"], "--mass: system.mass=1 kg")):
            with self.subTest(arguments):
                result = self.run_program(*arguments, status=3)
                self.assertRegex(result.stderr, "is stated twice|an option states it")
                self.assertIn(f"found: {found}", result.stderr)
        self.run_program("run", "base.yaml", "--set", "system.friction={law: coulomb, kinetic: 1 N}", "--set", "system.friction.static=2 N")

    def test_a_column_with_the_uncertainty_of_each_reading(self):
        """It is ignored: the options that state one for all readings are named in the words of the command."""
        data = self.write("data.csv", "Y [mm],x [mm],u_x [mm]\n4.5,4.7,0.02\n5,7.21,0.02\n5.5,9.76,0.02\n6,12.2,0.03\n")
        rig = ["--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz"]
        for command, option in ((["identify", data, "--method", "resonance_deming"], "--sigma-x ..."), (["fit", "coulomb", data, "--no-profile"], "--sigma x=...")):
            self.assertIn(f"if it holds the uncertainty of each x, state one for all of them, such as its median: {option}", self.run_program(*command, *rig).stderr)

    def test_values_that_cannot_be_read(self):
        """Of a drive and of the bounds of a fit: each is told at its place, and nothing is made of the others."""
        self.write("drive.csv", "t [s],y [mm],x [mm]\n" + "".join(f"{i / 50},{i % 7},{i % 5}\n" for i in range(50)))
        measured = "excitation={type: measured_base, file: drive.csv, KEY}"
        chirp = "excitation={type: base_chirp, amplitude: 1 mm, from: 1 Hz, to: 2 Hz, duration: 1 s, KEY}"
        for drive, key, wrong in ((measured, "detrend", "trend"), (measured, "offset", "much"), (measured, "repeat", "often"), (measured, "unit", "[mm]"),
                                  (chirp, "spacing", "even"), (chirp, "phase", "late")):
            with self.subTest(key):
                found = self.run_program("run", "base.yaml", "--set", "analysis={type: simulate, duration: 1 s}", "--set", drive.replace("KEY", f"{key}: {wrong}"), status=3)
                self.assertIn(f"'excitation.{key}'", found.stderr)
        for bounds in ("[wide]", "[[1]]", "[{name: kinetic, low: 1 N}, 3]"):
            with self.subTest(bounds):
                found = self.run_program("fit", "coulomb", "drive.csv", "--mass", "1 kg", "--stiffness", "100 N/m", "--set", f"analysis.bounds={bounds}", status=3)
                self.assertRegex(found.stderr, r"'analysis.bounds\[\d\]' is of the wrong kind")

    def test_an_amplitude_that_a_list_replaces(self):
        """As an option of its own; beside the list in the file, or as a part of a section, it says what is replaced."""
        curve = ["run", self.write("curve.yaml", BASE.replace("{type: steady_state}", "{type: xy_curve, amplitudes: [0.1 m, 0.2 m]}"))]
        error = self.run_program(*curve, "--set", "excitation.amplitude=7 m", status=3).stderr
        self.assertIn("--set:1:12: error: 'excitation.amplitude' has no effect: 'analysis.amplitudes' replaces it", error)
        response = ["--set", "analysis={type: frequency_response, frequencies: [9 rad/s, 10 rad/s]}"]
        error = self.run_program(*curve, *response, "--set", "excitation.frequency=7 Hz", status=3).stderr
        self.assertIn("'excitation.frequency' has no effect: 'analysis.frequencies' replaces it", error)
        self.run_program(*curve)
        self.run_program(*curve, *response, "--set", "excitation.amplitude=0.2 m")
        self.run_program(*curve, "--set", "excitation={type: base_harmonic, amplitude: 7 m, frequency: 9 rad/s}")

    def test_a_gain_of_a_sensor_that_is_not_there(self):
        data = self.write("data.csv", "Y [mm],x [mm]\n4.5,4.7\n5,7.21\n5.5,9.76\n6,12.2\n")
        result = self.run_program("identify", data, "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz", "--gain-uncertainty", "a=1 %", status=3)
        self.assertIn("the record has no a", result.stderr)
        self.assertIn("allowed: signals of the record: Y, x", result.stderr)

    def test_the_frequency_of_a_free_vibration(self):
        """It is not used, and a warning says so."""
        rows = "".join(f"{i / 200},{10 * 0.93 ** (i / 10) * math.cos(0.3 * i)}\n" for i in range(300))
        data = self.write("decay.csv", "t [s],x [mm]\n" + rows)
        rig = ["identify", data, "--mass", "1 kg", "--stiffness", "3600 N/m", "--method", "output_error"]
        self.assertIn("the stated frequency of 8 Hz is not used", self.run_program(*rig, "--frequency", "8 Hz").stderr)
        self.assertNotIn("is not used", self.run_program(*rig).stderr)

    def test_numbers_that_a_fit_would_ignore(self):
        fit = ["fit", "coulomb", ROOT / "scenarios/examples/steady_states.csv", "--mass", "1.042 kg", "--stiffness", "1568 N/m"]
        for arguments, message in ((["--sigma", "v=1 m/s"], "steady_states.csv: 'sigma_v' states the noise of v, and the file has no v"),
                                   (["--frequency", "6.17 Hz"], "every reading has its own"),
                                   (["--frequency", "6.17 Hz", "--amplitude", "5 mm"], "'excitation.amplitude' is the drive of histories")):
            with self.subTest(arguments):
                told = self.run_program(*fit, *arguments, status=3).stderr
                self.assertIn(message, told)
                self.assertEqual(told.count("error:"), len(arguments) // 2, told)  # one for each option

    def test_the_noise_of_a_column_that_the_fit_does_not_compare(self):
        rows = "".join(f"{i / 200},{math.sin(0.1 * i)},{20 * math.cos(0.1 * i)},{math.copysign(2, math.cos(0.1 * i))}\n" for i in range(300))
        loop = self.write("loop.csv", "t [s],x [mm],v [mm/s],force [N]\n" + rows)
        told = self.run_program("fit", "coulomb", loop, "--loop", "--no-profile", "--sigma", "a=1 m/s^2", "--sigma", "phase=1 deg", status=3).stderr
        self.assertEqual(told.count("and the file has no"), 2, told)
        self.assertEqual(told.count("error:"), 2, told)

    def test_a_drive_and_a_first_state_that_a_loop_ignores(self):
        """Another record of the fit may need them."""
        rows = [(i / 200, math.sin(0.1 * i), 20 * math.cos(0.1 * i)) for i in range(300)]
        loop = self.write("loop.csv", "t [s],x [mm],v [mm/s],force [N]\n" + "".join(f"{t},{x},{v},{math.copysign(2, v)}\n" for t, x, v in rows))
        self.write("run.csv", "t [s],x [mm]\n" + "".join(f"{t},{x}\n" for t, x, _ in rows))
        fit = ["fit", "coulomb", loop, "--loop", "--no-profile"]
        for arguments in (["--frequency", "4 Hz", "--amplitude", "5 mm"], ["--frequency", "4 Hz"],
                          ["--set", "excitation={type: measured_force, file: loop.csv, column: force}"]):
            with self.subTest(arguments):
                self.assertIn("'excitation' is the drive of histories: the data hold no history, and a loop compares", self.run_program(*fit, *arguments, status=3).stderr)
        initial = ["--set", "initial={position: 1 mm, velocity: 0 m/s}"]
        self.assertIn("'initial' is the state at the first sample of a history: the data hold none", self.run_program(*fit, *initial, status=3).stderr)
        self.run_program(*fit)
        self.run_program("check", self.write("both.yaml", f"""schema: dualdamp/1
title: both
system: {{mass: 1 kg, stiffness: 400 N/m, friction: {{law: coulomb}}}}
excitation: {{type: base_harmonic, amplitude: 5 mm, frequency: 4 Hz}}
initial: {{position: 1 mm, velocity: 0 m/s}}
analysis: {{type: fit, data: [{{file: loop.csv, loop: true}}, {{file: run.csv}}]}}
"""))

    def test_an_amplitude_without_a_frequency(self):
        """It is one of the base: what is missing is the frequency, not the type of a drive."""
        rows = "".join(f"{0.01 * i},{math.cos(0.3 * i)}\n" for i in range(50))
        fit = ["fit", "coulomb", self.write("run.csv", "t [s],x [mm]\n" + rows), "--mass", "1 kg", "--stiffness", "1000 N/m", "--amplitude", "5 mm"]
        for more in ([], ["--set", "excitation.type=base_harmonic"]):
            self.assertIn("run.csv: a history under a harmonic drive needs 'excitation.frequency'", self.run_program(*fit, *more, status=3).stderr)

    def test_a_travel_that_loads_no_law(self):
        rows = "".join(f"{i / 100},{math.exp(-i / 100) * math.cos(0.3 * i):.6f}\n" for i in range(200))
        self.write("free.csv", "t [s],x [mm]\n" + rows)
        constants = ["free.csv", "--mass", "1 kg", "--stiffness", "900 N/m", "--set", "initial.travel=1 mm", "--starts", "1", "--no-profile"]
        said = self.run_program("fit", "coulomb", *constants, status=3).stderr
        self.assertIn("'initial.travel' has no effect: no law of this fit depends on earlier motion of the mass", said)
        self.run_program("fit", "contact_compliance", *constants, "--set", "system.friction.kinetic=0.1 N", "--set", "system.friction.contact_stiffness=900 N/m", status=0)

    def test_the_frequency_of_other_records(self):
        """Of a fit to readings with frequencies of their own: that of its first reading is not that of further pairs."""
        shipped = ROOT / "scenarios/examples"
        self.run_program("fit", "coulomb", shipped / "steady_states.csv", "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--no-profile", "--out", "fit")
        error = self.run_program("predict", "fit", shipped / "my_rig.csv", status=3).stderr
        self.assertIn("x-Y pairs need the forcing frequency at which they were measured", error)
        self.run_program("predict", "fit", shipped / "my_rig.csv", "--frequency", "6.17 Hz")
        others = self.write("others.csv", "".join((shipped / "steady_states.csv").read_text().splitlines(keepends=True)[:-1]))
        self.run_program("predict", "fit", others)

    def test_constants_beyond_all_machines(self):
        """A frequency ratio that is no number, and one at which a period of the drive is never over."""
        for mass in ("1e-320 kg", "1e300 kg"):
            result = self.run_program("run", "base.yaml", "--set", f"system.mass={mass}", "--set", "system.stiffness=1e-300 N/m" if "e300" in mass else "system.stiffness=1568 N/m", status=3)
            self.assertIn("the natural frequency of this mass and stiffness is out of range", result.stderr)
        # A damping ratio of these would be no damping, none at all, and no number.
        for mass, stiffness in (("1e185 kg", "1e190 N/m"), ("1e-170 kg", "1e-165 N/m")):
            for ratio in ("0", "0.2"):
                text = BASE.replace("damping: 4 N.s/m", f"damping_ratio: {ratio}")
                self.write("ratio.yaml", text)
                result = self.run_program("run", "ratio.yaml", "--set", f"system.mass={mass}", "--set", f"system.stiffness={stiffness}", status=3)
                self.assertIn("--set:1:13: error: the critical damping of this mass and stiffness is out of range", result.stderr)
                self.assertEqual(result.stderr.count("error:"), 1)
        for mass in ("1e-20 kg", "1e-70 kg"):
            result = self.run_program("run", "base.yaml", "--set", f"system.mass={mass}", "--set", "system.damping=0 N.s/m", status=4)
            self.assertIn("the computation was stopped", result.stderr)

    def test_the_reference_states_the_lengths_of_lists(self):
        """Of lists of maps only the message of the error had stated it."""
        reference = self.run_program("schema", "--markdown").stdout
        self.assertNotRegex(reference, r"a list of (maps|such maps|them)")
        self.assertIn("| `harmonics` | a list of 1 to 8 maps |", reference)
        self.assertIn("a map with the key 'law', or a list of 1 to 16 such maps", reference)
        self.assertIn("or a list of 1 to 64 of them", reference)
        harmonics = ", ".join(f"{{order: {order}, amplitude: 1 mm}}" for order in range(2, 11))
        error = self.run_program("run", "base.yaml", "--set", f"excitation.harmonics=[{harmonics}]", status=3).stderr
        self.assertIn("1 to 8", error)

    def test_loose_tolerances(self):
        """Steady states were off by up to 20 %, or called subharmonic, with status 0 and no warning."""
        for tolerance in ("1e-3", "1e-4", "1e-5"):
            document = json.loads(self.run_program("run", "base.yaml", "--json", "--set", f"numerics.tolerance={tolerance}").stdout)
            self.assertEqual(len([warning for warning in document["warnings"] if "is loose" in warning]), 1)
        text = BASE.replace("damping: 4 N.s/m", "damping: 0.01 N.s/m").replace("{law: coulomb, kinetic: 2 N}", "{law: dahl, kinetic: 2 N, sigma0: 1000 N/m}")
        self.assertIn("dahl", text)
        self.write("weak.yaml", text.replace("type: steady_state", "type: frequency_response, frequencies: [5 rad/s, 10 rad/s, 13 rad/s]").replace("frequency: 10 rad/s", "").replace("amplitude: 0.1 m, ", "amplitude: 0.1 m"))
        results = {}
        for tolerance in ("1e-6", "1e-11"):
            document = json.loads(self.run_program("run", "weak.yaml", "--json", "--set", f"numerics.tolerance={tolerance}").stdout)
            results[tolerance] = [point["x"] for point in document["result"]["points"]]
            said = [warning for warning in document["warnings"] if "the steady state may be off by" in warning]
            self.assertEqual(bool(said), tolerance == "1e-6", document["warnings"])
        off = max(abs(loose / tight - 1) for loose, tight in zip(results["1e-6"], results["1e-11"]))
        self.assertGreater(off, 1e-7)
        self.assertLess(off, 1e-3)

    def test_lengths_and_forces_beyond_all_machines(self):
        """Energies of zero and a LuGre force without its squares had left with status 0."""
        for scale, size in (("e-171", "small"), ("e-300", "small"), ("e70", "large")):
            for friction in (f"law: coulomb, kinetic: 2{scale} N", f"law: lugre, kinetic: 2{scale} N, stribeck_velocity: 0.1{scale} m/s, sigma0: 10000 N/m, sigma1: 10 N.s/m"):
                drive = f"excitation={{type: base_harmonic, amplitude: 0.1{scale} m, frequency: 7 rad/s}}"
                result = self.run_program("run", "base.yaml", "--set", drive, "--set", f"system.friction={{{friction}}}", "--set", f"initial.position=0.3{scale} m", status=3)
                for path in ("excitation.amplitude", "system.friction.kinetic", "initial.position"):
                    self.assertIn(f"'{path}' is too {size} to compute with", result.stderr)
                self.assertIn("allowed: 0, or 1e-60 to 1e60 in SI", result.stderr)
        curve = "analysis={type: xy_curve, amplitudes: [1e-171 m, 2e-171 m]}"
        result = self.run_program("run", "base.yaml", "--set", curve, status=3)
        self.assertIn("'analysis.amplitudes[1]' is too small to compute with", result.stderr)
        drive = "excitation={type: base_harmonic, amplitude: 0.1e-55 m, frequency: 7 rad/s}"
        result = self.run_program("run", "base.yaml", "--set", drive, "--set", "system.friction={law: coulomb, kinetic: 2e-55 N}", "--json")
        self.assertGreater(json.loads(result.stdout)["result"]["energy"]["friction"], 1e-111)

    def test_readings_beyond_all_machines(self):
        """Their squares are no numbers: an interval from -inf to inf, and a range that is nan, had left with status 0."""
        rig = ["--mass", "1.042 kg", "--stiffness", "1568 N/m"]
        for scale, size in (("1e200", "large"), ("1e-200", "small")):
            pairs = self.write("pairs.csv", "Y [m],x [m]\n" + "".join(f"{y}{scale[1:]},{x}{scale[1:]}\n" for y, x in ((4.5, 4.7), (5, 7.21), (5.5, 9.76), (6, 12.2))))
            error = self.run_program("identify", pairs, *rig, "--frequency", "6.17 Hz", status=3).stderr
            self.assertIn(f"pairs.csv:5:1: error: the largest number of column Y is too {size} to compute with", error)
            self.assertIn("allowed: 1e-60 to 1e60 in SI, or only zeros", error)
            history = self.write("drive.csv", "t [s],y [m]\n" + "".join(f"0.{i},{i % 3}{scale[1:]}\n" for i in range(10)))
            drive = "excitation={type: measured_base, file: drive.csv, column: y, unit: m}"
            error = self.run_program("run", "base.yaml", "--set", drive, "--set", "analysis={type: simulate, duration: 0.5 s}", status=3).stderr
            self.assertIn(f"the largest number of column y is too {size} to compute with", error)

    def test_files_of_the_user_are_kept(self):
        """A table, a document and a drawing that the program did not write, where it is about to write its own."""
        curve = BASE.replace("amplitude: 0.1 m, ", "").replace("{type: steady_state}", "{type: xy_curve, amplitudes: [0.1 m, 0.2 m]}")
        self.write("curve.svg", curve)
        self.write("out/curve.csv", "mine")
        self.write("out/result.json", "mine too")
        self.run_program("run", "curve.svg", "--out", "out", "--plot", "curve.svg")
        again = self.run_program("run", "curve.svg~", "--out", "out", "--plot", "curve.svg").stderr
        self.assertNotIn("kept as", again, "what this program wrote is replaced")
        for name, text in (("out/curve.csv~", "mine"), ("out/result.json~", "mine too"), ("curve.svg~", curve)):
            self.assertEqual((self.folder / name).read_text(), text)
        self.write("both/compare.csv", "a,b\n")
        self.assertIn("both/compare.csv that was there is kept as both/compare.csv~", self.run_program("compare", "out", "out", "--out", "both").stderr)
        self.write("out/report.html", "<p>mine</p>")
        self.assertIn("kept as out/report.html~", self.run_program("report", "out").stderr)
        self.assertNotIn("kept as", self.run_program("report", "out").stderr)
        self.assertEqual((self.folder / "out/report.html~").read_text(), "<p>mine</p>")
        # Data under the name of a table: what is identified stays.
        pairs = "Y [mm],x [mm]\n4.5,4.7\n5,7.21\n5.5,9.76\n6,12.2\n"
        self.write("rig/estimates.csv", pairs)
        self.run_program("identify", "rig/estimates.csv", "--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.17 Hz", "--out", "rig")
        self.assertEqual((self.folder / "rig/estimates.csv~").read_text(), pairs)

    def test_a_limit_that_is_none(self):
        for limit in ("nan", "NaN", "-nan", "inf", "0x10", "0"):
            with self.subTest(limit):
                self.run_program("run", "base.yaml", f"--isolate-plugins={limit}", status=2)

    def test_names_that_are_another_place(self):
        for name in ("..yaml", "...yaml"):
            self.write(name, BASE)
            self.run_program("run", name)
            self.assertTrue((self.folder / "results" / name / "result.json").is_file())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
