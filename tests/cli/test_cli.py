#!/usr/bin/env python3
"""The program as a user meets it: exit status, what stands on stdout and stderr, what is written and what is not.

usage: test_cli.py PROGRAM ROOT [TEST...]
"""

import hashlib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import case
from case import BASE, PATIENCE, PROGRAM

ROOT = Path(sys.argv[2]).resolve()

LONG = BASE.replace("steady_state", "xy_curve, amplitudes: {from: 0 m, to: 0.6 m, count: 1000000}").replace(
    "{law: coulomb, kinetic: 2 N}", "{law: contact_compliance, kinetic: 2 N, contact_stiffness: 1 kN/m}")  # runs for minutes

FILES = ["orbit.csv", "report.html", "result.json"]  # of a steady state
KEYS = ["program", "provenance", "scenario", "analysis", "status", "result", "warnings", "checks", "errors"]


def wait_until_it_watches(process):
    """Waits until the program has blocked SIGINT for all threads but the one that waits for it."""
    deadline = time.monotonic() + 60.0
    while process.poll() is None and time.monotonic() < deadline:
        blocked = re.search(r"^SigBlk:\s*(\w+)", Path(f"/proc/{process.pid}/status").read_text(), re.MULTILINE)
        if blocked and int(blocked.group(1), 16) >> (signal.SIGINT - 1) & 1:
            return
        time.sleep(0.01)


def tree(folder):
    """Every file below a folder with the digest of its content."""
    return {
        str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest()
        for p in sorted(Path(folder).rglob("*"))
        if p.is_file()
    }


class Case(case.Case):
    timeout = 120

    def setUp(self):
        super().setUp()
        self.write("base.yaml", BASE)

    def document(self, *arguments, status=0):
        """The one JSON document on stdout."""
        result = self.run_program(*arguments, status=status)
        document = json.loads(result.stdout, parse_constant=self.fail)
        if isinstance(document, dict):
            self.assertEqual(list(document), KEYS)
            self.assertEqual(document["status"], status)
        return document


class Run(Case):
    def test_results_go_to_results_and_the_stem(self):
        result = self.run_program("run", "base.yaml")
        self.assertEqual(list(tree(self.folder / "results")), [f"base/{name}" for name in FILES])
        self.assertIn("peak", result.stdout)
        self.assertIn("wrote results/base/result.json", result.stderr)

    def test_out_is_used_directly_for_one_file(self):
        self.run_program("run", "base.yaml", "--out", "a/b")
        self.assertEqual(list(tree(self.folder / "a")), [f"b/{name}" for name in FILES])
        self.assertFalse((self.folder / "results").exists())

    def test_out_gets_a_folder_a_file_for_several(self):
        self.write("other.yaml", BASE)
        result = self.run_program("run", "base.yaml", "other.yaml", "--out", "out", "--jobs", "2")
        self.assertEqual(list(tree(self.folder / "out")), [f"{stem}/{name}" for stem in ("base", "other") for name in FILES])
        self.assertLess(result.stdout.index("base.yaml"), result.stdout.index("other.yaml"))

    def test_two_files_of_one_name_do_not_overwrite_each_other(self):
        self.write("sub/base.yaml", BASE)
        result = self.run_program("run", "base.yaml", "sub/base.yaml", status=2)
        self.assertIn("would both write", result.stderr)
        self.assertFalse((self.folder / "results").exists())

    def test_quiet_leaves_stderr_empty(self):
        self.assertEqual(self.run_program("run", "base.yaml", "--quiet").stderr, "")

    def test_json_is_one_document(self):
        document = self.document("run", "base.yaml", "--json")
        self.assertAlmostEqual(document["result"]["peak"], 0.1860780979567862, delta=1e-15)
        self.assertEqual(document["scenario"]["system"]["mass"], 1.0)
        self.assertEqual(document["analysis"], "steady_state")
        written = json.loads((self.folder / "results/base/result.json").read_text())
        self.assertEqual(written, document)

    def test_json_of_several_files_is_one_list(self):
        self.write("bad.yaml", "schema: dualdamp/1\n")
        documents = self.document("run", "base.yaml", "bad.yaml", "--json", status=3)
        self.assertEqual([d["status"] for d in documents], [0, 3])
        self.assertIsNone(documents[1]["result"])

    def test_the_worst_status_counts_and_good_files_still_run(self):
        self.write("bad.yaml", "schema: dualdamp/1\n")
        self.run_program("run", "bad.yaml", "base.yaml", status=3)
        self.assertEqual(list(tree(self.folder / "results")), [f"base/{name}" for name in FILES])

    def test_set(self):
        document = self.document("run", "base.yaml", "--json", "--set", "system.mass=2 kg", "--set", "numerics.tolerance=1e-12")
        self.assertEqual(document["scenario"]["system"]["mass"], 2.0)
        self.assertEqual(document["provenance"]["set"], ["system.mass=2 kg", "numerics.tolerance=1e-12"])

    def test_set_errors_are_located(self):
        result = self.run_program("run", "base.yaml", "--set", "system.mas=2 kg", status=3)
        self.assertIn("--set:1:8: error: unknown key 'mas'", result.stderr)
        self.run_program("run", "base.yaml", "--set", "system.mass", status=2)

    def test_dry_run_writes_nothing(self):
        self.assertIn("valid", self.run_program("run", "base.yaml", "--dry-run").stdout)
        self.assertIsNone(self.document("run", "base.yaml", "--dry-run", "--json")["result"])
        told = self.run_program("run", "base.yaml", "--dry-run", "--plot", "a.svg", "--mat", "a.mat", "--verify").stdout
        self.assertIn(", the chart to a.svg, the tables to a.mat, and each result would be computed again", told)
        self.assertEqual(list(tree(self.folder)), ["base.yaml"])

    def test_expectations(self):
        self.write("off.yaml", BASE + "expect:\n  - {value: peak, equals: 0.2, within: 1.0e-3, source: page 7}\n")
        result = self.run_program("run", "off.yaml", status=1)
        self.assertRegex(result.stdout, r"value +expected +found +difference")
        self.assertRegex(result.stdout, r"peak +0\.2 +0\.18\d+ +-0\.0139 +NO +page 7")
        self.assertTrue((self.folder / "results/off/result.json").exists())
        self.document("run", "off.yaml", "--json", status=1)

    def test_expectation_beyond_the_result(self):
        self.write("off.yaml", BASE.replace("steady_state", "simulate, cycles: 1") + 'expect: [{value: "events[99].t", equals: 1}]\n')
        result = self.run_program("run", "off.yaml", status=3)
        self.assertIn("off.yaml:6:18: error:", result.stderr)
        self.assertFalse((self.folder / "results").exists())

    def test_numerical_failure(self):
        self.write("grow.yaml", BASE.replace("damping: 4", "damping: -40"))
        document = self.document("run", "grow.yaml", "--json", status=4)
        self.assertIsNone(document["result"])
        self.assertTrue(document["errors"][0]["message"])
        self.assertIn("error:", self.run_program("run", "grow.yaml", status=4).stderr)

    def test_a_good_point_survives_a_bad_one(self):
        # Below the break-away amplitude nothing moves; above it the negative damping wins.
        self.write("mixed.yaml", BASE.replace("damping: 4", "damping: -0.5").replace("steady_state", "xy_curve, amplitudes: [0.001, 0.5]"))
        document = self.document("run", "mixed.yaml", "--json")
        good, bad = document["result"]["points"]
        self.assertEqual(good["x"], 0.0)
        self.assertIsNone(bad["x"])
        self.assertTrue(bad["reason"])
        self.assertTrue(document["warnings"])

    def test_verify_computes_the_result_again(self):
        result = self.run_program("run", "base.yaml", "--verify", "--out", "a")
        self.assertIn("agrees", result.stdout)
        document = json.loads((self.folder / "a/result.json").read_text())
        self.assertTrue(document["verification"]["agrees"])
        self.assertLessEqual(document["verification"]["largest_difference"], document["verification"]["tolerance"])
        self.assertIn("smooth engine", document["verification"]["engine"])
        self.assertIn('"verification"', (self.folder / "a/report.html").read_text())

    def test_verify_is_refused_where_nothing_can_be_computed_again(self):
        self.write("branch.yaml", BASE.replace("steady_state", "xy_branch, amplitudes: {from: 0.05, to: 0.1}"))
        self.assertIn("numerics.verify", self.run_program("run", "branch.yaml", "--verify", status=3).stderr)

    def test_tables_open_with_provenance(self):
        self.run_program("run", "base.yaml", "--set", "analysis={type: simulate, cycles: 2, sample_rate: 100 Hz}")
        for name in ["events", "history"]:
            lines = (self.folder / f"results/base/{name}.csv").read_text().splitlines()
            self.assertRegex(lines[0], r"^# program: dualdamp \d")
            head = next(line for line in lines if not line.startswith("#"))
            self.assertTrue(head.startswith("t [s],"))

    def test_the_resolved_scenario_runs_again_to_the_same_bits(self):
        first = self.document("run", "base.yaml", "--json")
        self.write("again.yaml", json.dumps(first["scenario"]))
        second = self.document("run", "again.yaml", "--json")
        self.assertEqual(second["result"], first["result"])
        self.assertEqual(second["provenance"]["scenario_sha256"], first["provenance"]["scenario_sha256"])


class Refusals(Case):
    def test_invalid_files_change_nothing(self):
        self.run_program("run", "base.yaml")
        before = tree(self.folder)
        for folder in ("tests/invalid", "tests/invalid_text"):
            paths = sorted((ROOT / folder).glob("*.yaml"))
            result = self.run_program("run", *paths, "--out", "results", "--jobs", 1, status=3)
            self.assertEqual(result.stdout.strip(), "")
            problems = re.split(f"(?m)^(?={re.escape(str(ROOT / folder))}/)", result.stderr)
            for path in paths:
                place, _, message = path.read_text().splitlines()[0].removeprefix("# expect: ").partition(": ")
                with self.subTest(path.name):
                    said = "".join(problem for problem in problems if problem.startswith(f"{path}:"))
                    self.assertIn(f"{path}:{place}: error: ", said)
                    self.assertIn(message, said)
                    self.assertRegex(said, r"\n  \| .*\n  \| +\^")
        self.assertEqual(tree(self.folder), before)

    def test_refusal_as_json(self):
        self.write("bad.yaml", BASE.replace("mass: 1 kg", "mass: -1 kg").replace("stiffness", "stifness"))
        document = self.document("run", "bad.yaml", "--json", status=3)
        self.assertIsNone(document["result"])
        error = document["errors"][1]
        self.assertEqual([error["file"], error["line"], error["column"]], ["bad.yaml", 3, 16])
        self.assertEqual([error["allowed"], error["found"]], ["> 0 kg", "-1 kg"])
        self.assertEqual(document["errors"][2]["suggestion"], "stiffness")

    def test_files_that_cannot_be_read(self):
        self.assertIn("No such file", self.run_program("run", "none.yaml", status=3).stderr)
        self.assertIn("is a directory", self.run_program("run", ".", status=3).stderr)
        self.assertIn("No such file", self.document("run", "none.yaml", "--json", status=3)["errors"][0]["message"])
        if os.geteuid() != 0:
            self.write("secret.yaml", BASE).chmod(0)
            self.assertIn("Permission denied", self.run_program("run", "secret.yaml", status=3).stderr)

    def test_a_device_without_end_is_refused(self):
        self.assertIn("larger than", self.run_program("run", "/dev/zero", status=3).stderr)

    def test_places_that_cannot_be_written(self):
        self.write("taken", "keep me")
        for out in ["taken", "taken/below", "/proc/nothing"]:
            with self.subTest(out):
                self.assertIn("error:", self.run_program("run", "base.yaml", "--out", out, status=2).stderr)
                self.assertIsNone(self.document("run", "base.yaml", "--out", out, "--json", status=2)["result"])
        self.assertEqual((self.folder / "taken").read_text(), "keep me")

    def test_a_full_standard_output_is_no_success(self):
        if not Path("/dev/full").exists():
            self.skipTest("no /dev/full")
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "laws"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=PATIENCE * 60)
        self.assertEqual(result.returncode, 2)
        self.assertIn("standard output", result.stderr)

    def test_wrong_usage(self):
        for arguments in [[], ["run"], ["fly"], ["run", "base.yaml", "--fly"], ["run", "base.yaml", "--jobs", "0"],
                          ["run", "base.yaml", "--jobs", "two"],
                          *(["run", "base.yaml", "--jobs", number] for number in ("0x2", " 2", "+2", "2.0")), ["run", "base.yaml", "--out"], ["identify"],
                          ["laws", "gravity"], ["methods", "guess"], ["run", "base.yaml", "--resume"],
                          ["run", "base.yaml", "--plugin", "x.so"], ["run", "base.yaml", "--out", ""]]:
            with self.subTest(arguments):
                result = self.run_program(*arguments, status=2)
                self.assertEqual(result.stdout, "")
                self.assertIn("error:", result.stderr)
        self.assertEqual(self.document("run", "--json", status=2)["scenario"], None)
        self.assertFalse((self.folder / "results").exists())

    def test_a_command_or_option_that_is_none_is_named(self):
        for line, message in {"fly base.yaml": "there is no command 'fly'; there are: run, stress, check,", "": "a command is missing; there are: run, stress, check,",
                              "runn base.yaml": "there is no command 'runn'; did you mean 'run'?", "stress exprt": "there is no command 'exprt'; did you mean 'export'?",
                              "--versoin": "there is no option '--versoin'; did you mean '--version'?", "run base.yaml -o x": "'run' has no option '-o'; it has: --help, --out,",
                              "run x.yaml --output y": "'run' has no option '--output'; did you mean '--out'?\n", "stress export --fly": "dualdamp stress export --help\n", "identify x.csv --mas=1 kg": "the command 'identify' has no option '--mas'; did you mean '--mass'?"}.items():
            with self.subTest(line):
                self.assertIn(message, self.run_program(*line.split(), status=2).stderr)

    def test_interrupt(self):
        """Each of these runs for minutes; the time it may take to end is generous because the machine may be busy."""
        smooth = BASE.replace("{law: coulomb, kinetic: 2 N}", "{law: lugre, kinetic: 2 N, static: 2.5 N, stribeck_velocity: 1 mm/s, sigma0: 1e6 N/m, sigma1: 300 N.s/m}")
        grid = "regime_map, frequencies: {from: 5 rad/s, to: 15 rad/s, count: 100}, amplitudes: {from: 0.05 m, to: 0.2 m, count: 100}"
        for name, text in {"xy_curve": LONG, "simulate": smooth.replace("steady_state", "simulate, cycles: 1e5"), "regime_map": smooth.replace("steady_state", grid)}.items():
            with self.subTest(name):
                self.write("long.yaml", text)
                process = subprocess.Popen([PROGRAM, "run", "long.yaml"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                wait_until_it_watches(process)
                time.sleep(0.5)
                self.assertIsNone(process.poll(), "it ended before it could be interrupted")
                process.send_signal(signal.SIGINT)
                begin = time.monotonic()
                _, errors = process.communicate(timeout=PATIENCE * 60)
                self.assertLess(time.monotonic() - begin, 10.0)
                self.assertEqual(process.returncode, 130)
                self.assertEqual(errors, b"interrupted\n")
                self.assertEqual(list(tree(self.folder)), ["base.yaml", "long.yaml"])

    def test_an_interrupted_list_of_files_stops_and_keeps_what_is_complete(self):
        self.write("long.yaml", LONG)
        self.write("last.yaml", BASE)
        process = subprocess.Popen([PROGRAM, "run", "base.yaml", "long.yaml", "last.yaml"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        done = self.folder / "results/base/report.html"
        deadline = time.monotonic() + 60.0
        while not done.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE * 60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(list(tree(self.folder / "results")), [f"base/{name}" for name in FILES])


class Others(Case):
    def test_check(self):
        self.assertIn("base.yaml: valid", self.run_program("check", "base.yaml").stdout)
        self.write("bad.yaml", "schema: dualdamp/2\n")
        result = self.run_program("check", "base.yaml", "bad.yaml", status=3)
        self.assertIn("base.yaml: valid", result.stdout)
        self.assertIn("bad.yaml:1:9: error:", result.stderr)
        self.assertEqual(list(tree(self.folder)), ["bad.yaml", "base.yaml"])

    def test_lists(self):
        self.assertIn("coulomb", self.run_program("laws").stdout)
        self.assertRegex(self.run_program("laws", "coulomb").stdout, r"kinetic +N +required")
        names = [line.split()[0] for line in self.run_program("methods").stdout.splitlines()]
        self.assertEqual(names, sorted(names))
        for name in names:
            self.assertRegex(self.run_program("methods", name).stdout, r"assumes +\w")

    def test_schema_is_the_committed_one(self):
        self.assertEqual(self.run_program("schema").stdout, (ROOT / "scenarios/scenario.schema.json").read_text())

    def test_version_and_help(self):
        self.assertRegex(self.run_program("--version").stdout, r"^dualdamp \d+\.\d+\.\d+ \(.+\)\n$")
        self.assertIn("Exit status", self.run_program("--help").stdout)
        self.assertIn("--set", self.run_program("run", "--help").stdout)


class Identify(Case):
    PAIRS = "Y [m],x [m]\n0.1,0.1860780979567862\n0.6,1.4361439607891241\n"
    KNOWN = ["--mass", "1 kg", "--stiffness", "100 N/m", "--frequency", "10 rad/s"]

    def test_pairs(self):
        self.write("data/pairs.csv", self.PAIRS)
        document = self.document("identify", "data/pairs.csv", *self.KNOWN, "--method", "resonance_two_point", "--json")
        (estimate,) = document["result"]["estimates"]
        self.assertAlmostEqual(estimate["F0"], 2.00278357380023, delta=1e-12)
        self.assertTrue(estimate["usable"])
        self.assertEqual(list(tree(self.folder / "results")), ["pairs/assumptions.csv", "pairs/estimates.csv", "pairs/report.html", "pairs/result.json"])

    # Coulomb and viscous friction at resonance, zeta 0.1, x_f 20 mm, rounded to 0.1 mm; one reading is spoilt.
    LEVELS = [(0.1, 0.4745), (0.2, 0.9746), (0.3, 1.4746), (0.4, 1.9746), (0.5, 2.4746), (0.6, 2.9747), (0.7, 3.4747), (0.8, 3.9747)]

    def table(self, spoilt=None):
        rows = [f"{Y},{x * (1.3 if i == spoilt else 1) + (-1) ** i * 2e-3}" for i, (Y, x) in enumerate(self.LEVELS)]
        return "Y [m],x [m]\n" + "\n".join(rows) + "\n"

    def test_an_outlier_is_named_and_bounded_on_request(self):
        self.write("pairs.csv", self.table())
        self.write("spoilt.csv", self.table(spoilt=3))
        given = [*self.KNOWN, "--method", "resonance_least_squares", "--json"]
        sound = self.document("identify", "pairs.csv", *given)["result"]
        self.assertEqual(sound["outliers"], [])
        errors = []
        for options in [], ["--robust"]:
            document = self.document("identify", "spoilt.csv", *given, *options)
            (outlier,) = document["result"]["outliers"]
            self.assertEqual(outlier["reading"], "x of pair 4")
            self.assertGreater(outlier["deviations"], 20)
            (warning,) = [line for line in document["warnings"] if line.startswith("x of pair 4 lies")]
            self.assertIn("it counts" if options else "'robust' bounds", warning)
            errors.append(abs(document["result"]["estimates"][0]["F0"] / sound["estimates"][0]["F0"] - 1))
        self.assertLess(errors[1], 0.2 * errors[0])

    def test_without_an_answer_the_status_tells_it_and_the_result_is_there(self):
        rows = "".join(f"{Y},{x - 0.04 * x * x}\n" for Y, x in self.LEVELS)  # bends as under quadratic drag
        self.write("bent.csv", "Y [m],x [m]\n" + rows)
        document = self.document("identify", "bent.csv", *self.KNOWN, "--json", "--out", "bent", status=4)
        self.assertEqual(document["status"], 4)
        self.assertIsNone(document["result"]["answer"])
        self.assertIn("the data contradict that friction", document["result"]["answer_reason"])
        self.assertIn("there is no answer: the data contradict", document["errors"][0]["message"])
        self.assertTrue(document["result"]["estimates"])
        self.assertIn("bent/estimates.csv", tree(self.folder))

    def test_a_simulated_history_read_back_gives_its_friction(self):
        # Signals without noise. Methods that regress forces or follow the motion exactly leave rounding, 1e-9 at most.
        # Harmonics of x beyond the ninth leave 1e-4 to the energy balance, local fits as much to the extremes of a free
        # decay; a smoothed sign of the velocity 1 % to the Kalman filter.
        exact = dict.fromkeys(
            ["acceleration_velocity_displacement", "friction_force", "recursive_least_squares", "output_error"], 1e-9
        )
        followed = {**exact, "energy_balance": 1e-4, "extended_kalman": 0.01}
        c, friction, mass, stiffness = 11, 3.7, 1.042, 1568
        zeta = c / (2 * (mass * stiffness) ** 0.5)
        drives = {
            "{type: base_harmonic, amplitude: 6 mm, frequency: 38.79 rad/s}": ("t y x v a friction", followed),
            "{type: force_harmonic, amplitude: 9.4 N, frequency: 38.79 rad/s}": ("t x v a friction force", followed),
            "{type: none}": ("t x v a friction", {**exact, "free_decay": 1e-4}),
        }
        for excitation, (columns, tolerances) in drives.items():
            with self.subTest(excitation):
                self.write("run.yaml", f"""schema: dualdamp/1
title: read back
system: {{mass: {mass} kg, stiffness: {stiffness} N/m, damping: {c} N.s/m,
  friction: {{law: coulomb, kinetic: {friction} N}}}}
excitation: {excitation}
initial: {{position: 60 mm}}
analysis: {{type: simulate, duration: 3 s, sample_rate: 500 Hz}}
""")
                self.run_program("run", "run.yaml", "--out", "run", "--quiet")
                lines = (self.folder / "run/history.csv").read_text().splitlines()
                header = next(line for line in lines if not line.startswith("#"))
                self.assertEqual([name.split()[0] for name in header.split(",")], columns.split())
                given = ["--mass", f"{mass} kg", "--stiffness", f"{stiffness} N/m", "--json"]
                given += [part for method in tolerances for part in ("--method", method)]
                document = self.document("identify", "run/history.csv", *given)
                estimates = {estimate["method"]: estimate for estimate in document["result"]["estimates"]}
                for method, tolerance in tolerances.items():
                    self.assertAlmostEqual(estimates[method]["zeta"] / zeta, 1, delta=tolerance, msg=method)
                    self.assertAlmostEqual(estimates[method]["F0"] / friction, 1, delta=tolerance, msg=method)

    def test_data_anywhere(self):
        with tempfile.TemporaryDirectory() as elsewhere:
            path = Path(elsewhere) / "it's data: #1.csv"
            path.write_text(self.PAIRS)
            self.run_program("identify", path, *self.KNOWN, "--out", "out")
            self.assertIn("result.json", tree(self.folder / "out"))

    def test_names_with_control_characters_are_refused_by_their_fault(self):
        for name, fault in (("two\nlines.csv", "several lines"), ("a\ttab.csv", "a tab"), ('quote"\x07.csv', "U+0007")):
            said = self.run_program("identify", name, *self.KNOWN, status=3).stderr
            self.assertIn("DATA:1:", said)
            self.assertIn(fault, said)

    def test_free_decay_needs_no_frequency(self):
        self.write("decay.csv", "t [s],x [mm]\n0,20\n0.3,-15\n0.6,11\n0.9,-8\n1.2,5\n")
        document = self.document("identify", "decay.csv", "--mass", "1", "--stiffness", "100", "--json")
        self.assertIn("free_decay", [e["method"] for e in document["result"]["estimates"]])

    def test_faults_of_the_command_line_are_located(self):
        self.write("pairs.csv", self.PAIRS)
        wrong = ["--mass", "1 N", "--stiffness", "100 N/m", "--frequency", "10"]
        result = self.run_program("identify", "pairs.csv", *wrong, "--method", "guess", status=3)
        for place in ["--mass:1:13:", "--frequency:1:22:", "--method:1:19:"]:
            self.assertIn(place, result.stderr)
        self.assertIn("--frequency", self.run_program("identify", "pairs.csv", "--mass", "1", "--stiffness", "1", status=3).stderr)

    def test_faults_of_the_data_are_located(self):
        self.write("pairs.csv", self.PAIRS + "0.7,nan\n0.8\n")
        result = self.run_program("identify", "pairs.csv", *self.KNOWN, status=3)
        self.assertIn("pairs.csv:4:5: error:", result.stderr)
        self.assertIn("pairs.csv:5:", result.stderr)
        self.run_program("identify", "none.csv", *self.KNOWN, status=3)

    def test_no_estimate_is_a_numerical_failure(self):
        self.write("pairs.csv", "Y [m],x [m]\n0.1,0.186\n")
        document = self.document("identify", "pairs.csv", *self.KNOWN, "--json", status=4)
        self.assertIsNone(document["result"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
