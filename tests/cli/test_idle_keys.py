#!/usr/bin/env python3
"""Beside data, each key of a scenario has an effect on the result, or is told to have none, or is refused at its place.

usage: test_idle_keys.py PROGRAM ROOT [TEST...]
"""

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import case

ROOT = Path(sys.argv[2]).resolve()
RIG = "mass: 3.7 kg, stiffness: 5200 N/m"
WHOLE_RIG = RIG + ", damping: 20 N.s/m, friction: {law: coulomb, kinetic: 5 N}"
DRIVE = "excitation: {type: base_harmonic, frequency: natural}\n"
PAIRS = "Y [mm],x [mm]\n4.0,4.76827\n5.2,7.11\n6.4,9.53\n7.6,11.94\n8.8,14.39\n10.0,16.8\n"
ESTIMATES = ", ".join(f"{{share: {share}, zeta: {zeta}, F0: {F0} N, zeta_std: 0.001, F0_std: 0.05 N}}"
                      for share, zeta, F0 in ((1, 0.0889, 8.65), (0.8, 0.1066, 7.87), (0.6, 0.125, 7.25), (0.4, 0.1439, 6.76)))
MECHANISMS_RIG = "mass: 2.3 kg, stiffness: 4 kN/m, damping: 25 N.s/m, friction: {law: coulomb, kinetic: 7 N}"

# Rig and analysis of each question. The methods of identify and of the stress test are quick ones: none of them gets more of the scenario than the others.
QUESTIONS = {
    "identify": (RIG, "{type: identify, data: pairs.csv, methods: [resonance_least_squares, den_hartog_fit]}"),
    "fit": (WHOLE_RIG, "{type: fit, data: pairs.csv, free: 'damping, kinetic', profile: false, starts: 1}"),
    "predict": (WHOLE_RIG, "{type: predict, data: pairs.csv, free: 'damping, kinetic'}"),
    "mechanisms": (MECHANISMS_RIG, f"{{type: mechanisms, amplitudes: [3 mm, 4 mm, 5 mm, 6 mm, 7 mm], mechanisms: [coulomb_viscous], estimates: [{ESTIMATES}]}}"),
    "stress_test": (WHOLE_RIG, "{type: stress_test, laws: [detuning], severities: [0.1], ranges: [{name: p, amplitudes: [4 mm, 6 mm, 8 mm]}], methods: [den_hartog_fit]}"),
}

# A value of each key that is neither its default nor that of the rigs above.
VALUES = {
    "system": {"coordinate": "angle", "mass": "3.9 kg", "mass_uncertainty": "0.01 kg", "stiffness": "5300 N/m", "stiffness_uncertainty": "10 N/m", "damping": "11 N.s/m",
               "damping_ratio": "0.05", "cubic_stiffness": "1e5 N/m^3", "gravity_stiffness": "1 N.m", "loss_factor": "0.05", "damper_to": "base",
               "friction": "{law: coulomb, kinetic: 3 N}"},
    "excitation": {"amplitude": "2 mm", "frequency": "6.1 Hz", "frequency_uncertainty": "0.01 Hz", "phase": "1 rad", "harmonics": "[{order: 3, amplitude: 0.3 mm}]"},
    "initial": {"position": "3 mm", "velocity": "10 mm/s", "travel": "3 mm"},
    "numerics": {"tolerance": "1e-7", "solver": "explicit", "verify": "true"},
}

# numerics may stand in any scenario; an accuracy that is reached anyway does not show.
ANYWHERE = ("numerics.tolerance", "numerics.solver")


class IdleKeys(case.Case):
    timeout = 120

    def setUp(self):
        super().setUp()
        self.write("pairs.csv", PAIRS)

    def scenario(self, name):
        rig, analysis = QUESTIONS[name]
        return self.write(f"{name}.yaml", f"schema: dualdamp/1\nsystem: {{{rig}}}\n{DRIVE}analysis: {analysis}\n")

    def answer(self, *arguments):
        """Status, the result without the texts that repeat the scenario, and the warnings."""
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        run = subprocess.run([case.PROGRAM, "run", *arguments, "--json", "--out", "out"], cwd=self.folder, capture_output=True, text=True, timeout=self.timeout)
        document = json.loads(run.stdout)
        result = document["result"] or {}
        return run.returncode, {key: value for key, value in result.items() if key not in ("rig", "scenario", "scenarios")}, document["warnings"]

    def test_the_table_has_every_key(self):
        sections = json.loads((ROOT / "scenarios/scenario.schema.json").read_text())["properties"]
        drives = [one["then"] for one in sections["excitation"]["allOf"] if one["if"]["properties"]["type"]["const"] == "base_harmonic"]
        for name, section in (*((name, sections[name]) for name in ("system", "initial", "numerics")), ("excitation", drives[0])):
            self.assertEqual(set(VALUES[name]), set(section["properties"]) - {"type"})

    def test_every_key(self):
        for name in QUESTIONS:
            scenario = self.scenario(name)
            status, plain, _ = self.answer(scenario)
            self.assertEqual(status, 0)
            for path, value in ((f"{section}.{key}", value) for section, keys in VALUES.items() for key, value in keys.items()):
                if path in ANYWHERE:
                    continue
                with self.subTest(f"{name}: {path}"):
                    status, found, warnings = self.answer(scenario, "--set", f"{path}={value}")
                    is_told = any(f"'{path}' has no effect" in warning for warning in warnings)
                    self.assertTrue(status == 3 or found != plain or is_told, "it is ignored")

    def test_the_reasons(self):
        rig = f"schema: dualdamp/1\nsystem: {{{RIG}, KEY}}\n{DRIVE}analysis: {{type: TYPE, data: pairs.csv}}\n"
        for kind in ("identify", "design"):
            for key, reason in (("damper_to: base", "the methods take the damper between mass and ground"), ("cubic_stiffness: 2e6 N/m^3", "the methods take a linear spring")):
                with self.subTest(f"{kind}: {key}"):
                    error = self.run_program("check", self.write("rig.yaml", rig.replace("KEY", key).replace("TYPE", kind)), status=3).stderr
                    self.assertIn(f"'system.{key.split(':')[0]}' has no effect: {reason}", error)
                    self.assertIn("analysis 'fit' takes it as stated", error)
                    self.assertEqual(error.count("error:"), 1)
            # A default may be stated, and a damped frequency is that of the stated damping.
            self.run_program("check", self.write("rig.yaml", rig.replace("KEY", "damper_to: ground, cubic_stiffness: 0").replace("TYPE", kind)))
            damped = rig.replace("KEY", "damping: 3 N.s/m").replace("TYPE", kind).replace("natural", "damped")
            self.run_program("check", self.write("rig.yaml", damped))

    def test_values_that_do_no_harm_are_told(self):
        scenario = self.scenario("identify")
        for key, value, reason in (("damping", "3 N.s/m", "the damping is what the methods seek"), ("friction", "{law: coulomb, kinetic: 1 N}", "friction is what the methods seek")):
            with self.subTest(key):
                told = self.run_program("run", scenario, "--set", f"system.{key}={value}").stderr
                self.assertIn(f"warning: 'system.{key}' has no effect: {reason}", told)
                self.assertIn("analysis 'fit' takes it as stated", told)

    def test_the_damper_of_a_simulated_rig(self):
        """The rig is the truth, which may depart from what the methods assume: it is told."""
        curve = f"schema: dualdamp/1\nsystem: {{{WHOLE_RIG}}}\n{DRIVE}analysis: {{type: identify, measurement: {{type: xy_curve, amplitudes: [4 mm, 6 mm, 8 mm]}}, methods: [den_hartog_fit]}}\n"
        scenario = self.write("curve.yaml", curve)
        told = "the methods take the damper between mass and ground"
        self.assertNotIn(told, self.run_program("run", scenario).stderr)
        base = ["run", scenario, "--set", "system.damper_to=base"]
        found = self.run_program(*base, "--set", "system.damping=2 N.s/m")
        self.assertIn(told, found.stderr)

    def test_the_truth_of_a_stress_test(self):
        for path, value in (("system.cubic_stiffness", "1e5 N/m^3"), ("system.damper_to", "base"), ("excitation.harmonics", "[{order: 3, amplitude: 0.3 mm}]")):
            error = self.run_program("run", self.scenario("stress_test"), "--set", f"{path}={value}", status=3).stderr
            self.assertIn(f"'{path}' would be a departure of its own", error)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
