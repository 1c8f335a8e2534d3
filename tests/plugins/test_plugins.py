#!/usr/bin/env python3
"""Laws from outside: what a sound plugin gets, and what each way of breaking the interface gives: its own message and
exit status, and never a crash.

usage: test_plugins.py PROGRAM TEST_LAW EMPTY [TEST...]
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM, TEST_LAW, EMPTY = (str(Path(argument).resolve()) for argument in sys.argv[1:4])

SCENARIO = """schema: dualdamp/1
system:
  mass: 1 kg
  stiffness: 100 N/m
  damping: 4 N.s/m
  friction: {law: test_slider, kinetic: 2 N, contact_stiffness: 1000 N/m}
excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}
analysis: {type: steady_state}
"""
VALUES = ["--set", "kinetic=2 N", "--set", "contact_stiffness=1 N/mm"]

# What is wrong with the library: part of the message. All are refused when the library is loaded, with status 2.
REFUSED = {
    "query throws": "dualdamp_law() threw an exception",
    "no table": "dualdamp_law() returned no table",
    "version": "it was built for another version of the interface",
    "size": "its table has another size than version 1 of the interface",
    "name taken": "there is a law 'coulomb' already",
    "name": "the law's name is no key of a scenario",
    "no name": "the law's name is no key of a scenario",
    "no summary": "the table has no summary",
    "text": "the table's summary is not printable ASCII",
    "states": "the law has too many states",
    "no modes": "the law has no mode",
    "no respond": "the table lacks the function respond()",
    "no scales": "the table lacks the function scales()",
    "no jump": "the table lacks the function jump()",
    "no parameters": "the table of parameters is missing",
    "parameter name": "the name of parameter 1 is no key of a scenario",
    "parameter taken": "parameter 'kinetic' has a name that is taken",
    "parameter of a modifier": "parameter 'drift' has a name that is taken",
    "unit": "parameter 'kinetic' has a unit that is not known, or not SI",
    "no unit": "parameter 'kinetic' has no unit",
    "meaning": "parameter 'kinetic' has no meaning",
    "range": "parameter 'kinetic' has an empty range",
    "range NaN": "parameter 'kinetic' has an empty range",
    "default": "parameter 'kinetic' has a default out of range",
}

# What the law does at work: part of the message. Status 4.
FAILED = {
    "status": "law 'test_slider' of a plugin: respond() returned status 7",
    "throws": "respond() threw an exception, which no C function may: what a C function must not do",
    "throws a number": "respond() threw an exception, which no C function may",
    "create throws": "create() threw an exception, which no C function may: out of memory",
    "NaN": "respond() gave a value that is no number, at t = 0.1",
    "infinite": "the force of friction (law 'test_slider' of a plugin) is not finite at x = 0.05",
    "rate NaN": "respond() gave a value that is no number",
    "guard NaN": "guard() gave a value that is no number",
    "jump NaN": "jump() left a state that is no number",
    "mode": "jump() went to mode 5, but the table declares modes 0 to 2",
    "start mode": "start() went to mode -1, but the table declares modes 0 to 2",
    "scale": "scales() gave a size that is not above 0",
    "limit": "static_limit() gave -1, which is below 0",
    "guard lies": "a guard of friction (law 'test_slider' of a plugin) changed its sign between two calls",
    "endless": "the mode changes of friction (law 'test_slider' of a plugin) did not come to an end at t = ",
}


class Case(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)
        self.write("slider.yaml", SCENARIO)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def run_program(self, *arguments, status=0, fault="", **environment):
        result = subprocess.run(
            [PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120,
            env={**os.environ, "FAULT": fault, **environment},
        )
        self.assertEqual(result.returncode, status, f"{fault}: {result.stdout}{result.stderr}")
        return result

    def document(self, *arguments, **options):
        return json.loads(self.run_program("run", *arguments, "--json", "--plugin", TEST_LAW, **options).stdout)


class Sound(Case):
    def test_option_before_and_after_the_command_and_environment(self):
        self.assertIn("test_slider", self.run_program("laws", "--plugin", TEST_LAW).stdout)
        self.assertIn("test_slider", self.run_program("--plugin", TEST_LAW, "laws").stdout)
        self.assertIn("test_slider", self.run_program("laws", DUALDAMP_PLUGINS=f":{TEST_LAW}:").stdout)
        self.assertNotIn("test_slider", self.run_program("laws").stdout)

    def test_a_library_named_twice_is_loaded_once(self):
        self.run_program("check", "slider.yaml", "--plugin", TEST_LAW, "--plugin", TEST_LAW, DUALDAMP_PLUGINS=TEST_LAW)

    def test_names_are_paths_and_never_looked_up(self):
        (self.folder / "law.so").symlink_to(TEST_LAW)
        self.run_program("check", "slider.yaml", "--plugin", "law.so")
        self.run_program("check", "slider.yaml", "--plugin", "libm.so.6", status=2)

    def test_the_motion_is_that_of_the_built_in_law(self):
        # The known peak of contact_compliance, 2 N and 1 kN/m, by the smooth engine: modes, guards and jumps.
        peak = self.document("slider.yaml")["result"]["peak"]
        self.assertAlmostEqual(peak / 0.18715434612621097, 1.0, delta=1e-9)

    def test_modifiers(self):
        built_in = SCENARIO.replace("test_slider", "contact_compliance")
        for modifier in ("position_slope=1.5 N/m", "fluctuation={ratio: 0.2, correlation_time: 1 s, seed: 3}"):
            change = ["--set", "system.friction." + modifier, "--set", "analysis={type: simulate, duration: 3 s}"]
            here = self.document("slider.yaml", *change)["result"]
            there = self.document(self.write("built_in.yaml", built_in), *change)["result"]
            for name in ("x", "v"):
                self.assertAlmostEqual(here["final"][name], there["final"][name], delta=1e-8, msg=modifier)
        drifting = self.document("slider.yaml", "--set", "system.friction.drift=-0.05", status=4)
        self.assertIn("its force limits drift", drifting["errors"][0]["message"])

    def test_curves_in_parallel(self):
        document = self.document("slider.yaml", "--set", "analysis={type: xy_curve, amplitudes: [0.05, 0.1, 0.2]}")
        self.assertEqual(len(document["result"]["points"]), 3)

    def test_listing_and_schema(self):
        text = self.run_program("laws", "test_slider", "--plugin", TEST_LAW).stdout
        for part in ("contact_stiffness", "stiffness of the contact", "> 0 N/m", "version 0.3", "position_slope"):
            self.assertIn(part, text)
        schema = json.loads(self.run_program("schema", "--plugin", TEST_LAW).stdout)
        self.assertIn('"test_slider"', json.dumps(schema))

    def test_parameters_are_checked_as_those_of_a_built_in_law(self):
        wrong = SCENARIO.replace("2 N", "-2 N").replace("contact_stiffness: 1000 N/m", "contact_stifness: 3 N")
        result = self.run_program("check", self.write("wrong.yaml", wrong), "--plugin", TEST_LAW, status=3)
        self.assertIn("wrong.yaml:6:41: error:", result.stderr)
        self.assertIn("did you mean 'contact_stiffness'?", result.stderr)

    def test_warnings(self):
        self.assertEqual(self.document("slider.yaml")["warnings"], [])
        self.assertEqual(self.document("slider.yaml", fault="warns")["warnings"], ["test_slider: the contact is soft"])

    def test_provenance_names_the_plugin(self):
        expected = {
            "law": "test_slider",
            "version": "0.3",
            "file": TEST_LAW,
            "sha256": hashlib.sha256(Path(TEST_LAW).read_bytes()).hexdigest(),
        }
        document = self.document("slider.yaml", "--set", "analysis={type: xy_curve, amplitudes: [0.1]}", "--out", "out")
        self.assertEqual(document["provenance"]["plugins"], [expected])
        self.assertIn(expected["sha256"], (self.folder / "out/curve.csv").read_text())

    def test_conformance_suite(self):
        result = self.run_program("laws", "test_slider", "--check", *VALUES, "--plugin", TEST_LAW)
        self.assertIn("keeps the law contract", result.stdout)
        self.run_program("laws", "test_slider", "--check", *VALUES, "--plugin", TEST_LAW, fault="open infinity")
        active = self.run_program("laws", "test_slider", "--check", *VALUES, "--plugin", TEST_LAW, status=1, fault="active")
        self.assertIn("it gives out more work than it took in", active.stdout)

    def test_conformance_suite_for_built_in_laws(self):
        self.run_program("laws", "coulomb", "--check", "--set", "kinetic=2 N", "--stroke", "1 cm", "--stroke-time", "0.1 s")
        self.run_program("laws", "iwan", "--check", "--set", "elements=[{stiffness: 1 N/mm, limit: 2 N}]")
        self.run_program("laws", "nosuch", "--check", status=2)
        self.run_program("laws", "--check", status=2)
        self.assertIn("--set", self.run_program("laws", "coulomb", "--check", "--set", "kinetic=2 m", status=3).stderr)
        self.assertEqual(self.run_program("laws", "coulomb", "--check", status=3).stderr.splitlines()[0], "coulomb: error: 'system.friction.kinetic' is missing")
        self.run_program("laws", "coulomb", "--check", "--set", "kinetic=2 N", "--stroke", "1 s", status=3)


class Broken(Case):
    def refusal(self, file, part, **options):
        for command in (["run", "slider.yaml"], ["check", "slider.yaml"], ["laws"], ["schema"]):
            result = self.run_program(*command, "--plugin", file, status=2, **options)
            self.assertIn(f"{file}: error: plugin refused: ", result.stderr)
            self.assertIn(part, result.stderr)
            self.assertEqual(result.stdout, "")
        self.assertFalse((self.folder / "results").exists())

    def test_files(self):
        self.refusal("missing.so", "there is no such file")
        self.refusal(".", "it is not a file")
        self.refusal("slider.yaml", "it is no shared library that can be loaded here")
        self.refusal(EMPTY, "it does not export the function dualdamp_law()")

    def test_a_refusal_is_json_where_json_is_wanted(self):
        document = self.document("slider.yaml", status=2, fault="version")
        self.assertEqual(document["errors"][0]["found"], "version 99")
        self.assertEqual(document["errors"][0]["allowed"], "version 1")

    def test_libraries_that_are_refused(self):
        for fault, part in REFUSED.items():
            with self.subTest(fault):
                self.refusal(TEST_LAW, part, fault=fault)

    def test_values_that_the_law_refuses(self):
        result = self.run_program("run", "slider.yaml", "--plugin", TEST_LAW, status=3, fault="refuses values")
        self.assertIn("slider.yaml:6:19: error:", result.stderr)
        self.assertIn("it does not like them", result.stderr)

    def test_laws_that_fail_at_work(self):
        for fault, part in FAILED.items():
            with self.subTest(fault):
                document = self.document("slider.yaml", status=4, fault=fault)
                self.assertIn(part, document["errors"][0]["message"])
                self.assertIsNone(document["result"])

    def test_a_fit_says_which_law_fails_and_how(self):
        self.write("decay.csv", "x [mm]\n30\n-28\n26\n-24\n22\n-20\n18\n-16\n")
        rig = ("--mass", "1 kg", "--stiffness", "100 N/m", "--damping", "0 N.s/m", "--no-profile", "--plugin", TEST_LAW)
        for fault in ("status", "throws"):
            failed = self.run_program("fit", "test_slider", "decay.csv", *rig, status=4, fault=fault).stderr
            self.assertIn(FAILED[fault], failed)

    def test_one_law_that_fails_spoils_no_other_file(self):
        self.write("good.yaml", SCENARIO.replace("test_slider", "contact_compliance"))
        documents = self.document("slider.yaml", "good.yaml", "--jobs", "2", status=4, fault="throws")
        self.assertEqual([document["status"] for document in documents], [4, 0])

    def test_failures_in_the_threads_of_a_curve(self):
        curve = ["--set", "analysis={type: xy_curve, amplitudes: {from: 0.01, to: 0.1, count: 50}}"]
        document = self.document("slider.yaml", *curve, status=4, fault="throws")
        self.assertIn("threw an exception", document["errors"][0]["message"])

    def test_the_conformance_suite_ends_with_a_law_that_fails(self):
        for fault in ("status", "throws", "mode", "rate NaN"):
            result = self.run_program("laws", "test_slider", "--check", *VALUES, "--plugin", TEST_LAW, status=4, fault=fault)
            self.assertIn(FAILED[fault], result.stderr)


class Isolated(Case):
    def test_a_sound_law_gives_the_same_bits(self):
        alone = self.document("slider.yaml", "--isolate-plugins")
        self.assertEqual(alone["result"], self.document("slider.yaml")["result"])

    def test_the_status_of_a_refusal_is_passed_on(self):
        self.run_program("run", "missing.yaml", "--isolate-plugins", status=3)

    def test_a_crash_is_a_message(self):
        document = self.document("slider.yaml", "--isolate-plugins", status=4, fault="crashes")
        # A sanitizer reports the fault itself, and then aborts.
        self.assertIn("Aborted" if "DUALDAMP_SANITIZED" in os.environ else "Segmentation fault", document["errors"][0]["message"])
        self.assertIn(TEST_LAW, document["errors"][0]["message"])
        self.assertFalse(any(self.folder.glob("results/*/*")))

    def test_a_law_that_does_not_return_is_stopped(self):
        document = self.document("slider.yaml", "--isolate-plugins=0.5", status=4, fault="does not return")
        self.assertIn("did not end within 0.5 s", document["errors"][0]["message"])

    def test_a_law_that_calls_exit_is_no_success(self):
        isolated = ["--isolate-plugins"]
        for options, fault in (([], "calls exit"), (isolated, "calls exit"), (isolated, "calls _exit")):
            document = self.document("slider.yaml", *options, status=4, fault=fault)
            self.assertIn("a plugin ended the program", document["errors"][0]["message"])
            self.assertIn(TEST_LAW, document["errors"][0]["message"])

    def test_signals_reach_the_child(self):
        process = subprocess.Popen(
            [PROGRAM, "run", "slider.yaml", "--plugin", TEST_LAW, "--isolate-plugins"], cwd=self.folder,
            stderr=subprocess.PIPE, text=True, env={**os.environ, "FAULT": "does not return"},
        )
        self.addCleanup(process.kill)
        while len(Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()) == 0:
            pass
        time.sleep(0.2)  # until the child watches for signals
        process.terminate()
        self.assertEqual(process.wait(20), 130)
        self.assertIn("interrupted", process.stderr.read())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
