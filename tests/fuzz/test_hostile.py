#!/usr/bin/env python3
"""Files made to cost more than they are worth: each is refused quickly (execution.py has the limits), with its place.

usage: test_hostile.py PROGRAM ROOT [TEST...]
"""

import json
import os
import shutil
import struct
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()
sys.path.insert(0, str(Path(__file__).resolve().parent))
from execution import MEGABYTES, SECONDS, Execution
from seeds import ANSWERS, RIG

HEAD = "schema: dualdamp/1\n"
RIG_TEXT = "system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}\n"
DRIVEN = HEAD + RIG_TEXT + "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}\n"
FREE = HEAD + RIG_TEXT + "excitation: {type: none}\ninitial: {position: 0.1 m}\n"
STEADY = "analysis: {type: steady_state}\n"
DATA = HEAD + "system: {mass: 1 kg, stiffness: 100 N/m}\nexcitation: {type: base_harmonic, frequency: 10 rad/s}\nanalysis: {type: identify, data: %s}\n"


def aliases():
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 12)]
    return HEAD + "\n".join(lines) + "\n"


def merges():
    return HEAD + "a0: &a0 {x: 1}\n" + "".join(f"a{i}: &a{i} {{<<: [*a{i - 1}, *a{i - 1}]}}\n" for i in range(1, 60))


# Name: the scenario, made when its turn comes: a child's memory is counted from its parent's.
SCENARIOS = {
    "alias_bomb": lambda: aliases(),
    "merge_bomb": lambda: merges(),
    "deep_flow": lambda: HEAD + "system: " + "[" * 100_000,
    "deep_flow_closed": lambda: HEAD + "system: " + "{a: " * 50_000 + "1" + "}" * 50_000,
    "deep_block": lambda: HEAD + "".join(" " * i + "a:\n" for i in range(1500)),
    "dashes": lambda: HEAD + "- " * 200_000,
    "questions": lambda: HEAD + "? " * 200_000,
    "million_keys": lambda: HEAD + "".join(f"k{i}: 1\n" for i in range(200_000)),
    "million_documents": lambda: "---\n" * 300_000,
    "long_line": lambda: HEAD + "title: " + "x" * 10_000_000,
    "long_number": lambda: DRIVEN.replace("mass: 1 kg", "mass: " + "1" * 1_000_000 + " kg") + STEADY,
    "long_unit": lambda: DRIVEN.replace("1 kg", "1 " + "kg." * 300_000 + "kg") + STEADY,
    "unit_of_powers": lambda: DRIVEN.replace("1 kg", "1 " + "(" * 5000 + "kg" + ")^9" * 5000) + STEADY,
    "sweep_of_1e12": lambda: DRIVEN + STEADY + "sweep: {system.friction.kinetic: {from: 1 N, to: 2 N, count: 1000000000000}}\n",
    "sweep_of_1e15_by_products": lambda: DRIVEN + STEADY + "sweep: {" + ", ".join(
        f"{key}: {{from: 1, to: 2, count: 1000}}" for key in ("system.mass", "system.stiffness", "system.damping", "system.friction.kinetic", "excitation.amplitude")) + "}\n",
    "sweep_of_many_long_curves": lambda: DRIVEN + "analysis: {type: xy_curve, amplitudes: {from: 1 mm, to: 2 mm, count: 510000}}\n"
    "sweep: {system.friction.kinetic: {from: 1 N, to: 2 N, count: 9000}}\n",
    "curve_of_1e12": lambda: DRIVEN + "analysis: {type: xy_curve, amplitudes: {from: 1 m, to: 2 m, count: 1000000000000}}\n",
    "curve_of_1e30": lambda: DRIVEN + "analysis: {type: xy_curve, amplitudes: {from: 1 m, to: 2 m, count: 1e30}}\n",
    "map_of_1e12": lambda: DRIVEN + "analysis: {type: regime_map, amplitudes: {from: 1 m, to: 2 m, count: 1000000}, frequencies: {from: 1 Hz, to: 2 Hz, count: 1000000}}\n",
    "history_of_1e12": lambda: DRIVEN + "analysis: {type: simulate, duration: 1e9 s, sample_rate: 1 kHz}\n",
    "cycles_of_1e12": lambda: DRIVEN + "analysis: {type: simulate, cycles: 1000000000000}\n",
    "peaks_of_1e12": lambda: FREE + "analysis: {type: free_decay, peaks: 1000000000000}\n",
    "noise_of_1e15": lambda: HEAD + RIG_TEXT + "excitation: {type: force_noise, intensity: 1 N^2.s, bandwidth: 1e15 Hz, seed: 1}\nanalysis: {type: simulate, duration: 1 s}\n",
    "elements_of_1e9": lambda: DRIVEN.replace("{law: coulomb, kinetic: 2 N}", "{law: iwan, elements: 1000000000, stiffness: 1 N/m, kinetic: 2 N}") + STEADY,
    "laws_by_the_thousand": lambda: DRIVEN.replace("{law: coulomb, kinetic: 2 N}", "[" + ", ".join(["{law: coulomb, kinetic: 2 N}"] * 20_000) + "]") + STEADY,
    "methods_by_the_thousand": lambda: DRIVEN + "analysis: {type: identify, measurement: {type: xy_curve, amplitudes: [1 m, 2 m]}, methods: [" + ", ".join(["free_decay"] * 50_000) + "]}\n",
    "stress_test_of_1e15": lambda: HEAD + RIG_TEXT + "excitation: {type: base_harmonic, frequency: natural}\nanalysis: {type: stress_test, laws: [stribeck], severities: [1], seeds: 1000000000000000}\n",
    "expectations_by_the_thousand": lambda: DRIVEN + STEADY + "expect: [" + ", ".join(["{value: peak, equals: 1, within: 1}"] * 100_000) + ", x]\n",
    "expectation_far_away": lambda: DRIVEN + STEADY + "expect: [{value: 'points[99999999999999999999].x', equals: 1, within: 1}]\n",
    "data_outside": lambda: DATA % "../../../../../../etc/passwd",
    "data_absolute": lambda: DATA % "/etc/passwd",
    "data_of_a_device": lambda: DATA % "/dev/zero",
    "data_by_a_link": lambda: DATA % "link.csv",
    "data_by_a_linked_folder": lambda: DATA % "folder/hostname",
    "data_is_a_pipe": lambda: DATA % "pipe.csv",
    "data_is_a_folder": lambda: DATA % "empty",
    "data_is_the_scenario": lambda: DATA % "case.yaml",
    "escaped_name": lambda: DATA % '"..\\u002f..\\u002f..\\u002fetc\\u002fpasswd"',
    "nul_in_the_name": lambda: DATA % '"pairs\\0.csv"',
}


def mat5_of(rows, columns):
    """A matrix that says it has more numbers than the file has bytes."""
    body = struct.pack("<2I2I2I2i", 6, 8, 6, 0, 5, 8, rows, columns) + struct.pack("<2I8s2I", 1, 1, b"x", 9, 2**31 - 8)
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + struct.pack("<2I", 14, len(body)) + body


def uff(count):
    lines = ["    -1", "    58", "x", "NONE", "NONE", "NONE", "NONE", f"{1:5d}{1:10d}{0:5d}{0:10d} {'NONE':10s}{1:10d}{3:4d} {'NONE':10s}{0:10d}{0:4d}",
             f"{2:10d}{count:10d}{1:10d}{0:13.5E}{0.001:13.5E}{0:13.5E}"]
    return "\n".join([*lines, *["         1    0    0    0 Time                 s"] * 4, "  1.0  2.0", "    -1", ""])


# Name: the content, likewise.
DATA_FILES = {
    "columns_by_the_million.csv": lambda: ",".join(f"c{i}" for i in range(1_000_000)) + "\n" + "1," * 1_000_000 + "\n",
    "x_by_the_million.csv": lambda: ",".join(["x"] * 1_000_000) + "\n" + ",".join(["1"] * 1_000_000) + "\n",
    "empty_columns.csv": lambda: "Y,x" + "," * 5_000_000 + "\n1,2\n",
    "separators.csv": lambda: "," * 10_000_000,
    "blanks.csv": lambda: " " * 10_000_000,
    "quotes.csv": lambda: '"' * 10_000_001,
    "open_quote.csv": lambda: 'Y,x\n"' + "1,2\n" * 2_000_000,
    "newlines.csv": lambda: "\n" * 10_000_000,
    "comments.csv": lambda: "#\n" * 3_000_000,
    "headers.csv": lambda: "Y,x\n" * 1_000_000,
    "ragged.csv": lambda: "Y [m],x [m]\n" + "1\n" * 2_000_000,
    "words.csv": lambda: "Y [m],x [m]\n" + "a,b\n" * 1_000_000,
    "long_number.csv": lambda: "Y [m],x [m]\n1," + "9" * 60_000_000 + "\n",
    "long_unit.csv": lambda: "Y [" + "m." * 3_000_000 + "m],x [m]\n1,2\n",
    "exponents.csv": lambda: "Y [m],x [m]\n" + "1e" + "9" * 1_000_000 + ",1\n",
    "huge.mat": lambda: mat5_of(2**31 - 1, 2**31 - 1),
    "negative.mat": lambda: mat5_of(-1, -1),
    "wide.mat": lambda: mat5_of(1, 2**28),
    "samples_of_1e9.uff": lambda: uff(999_999_999),
    "data_sets.uff": lambda: "    -1\n    58\n" * 300_000,
}


RESULT = json.dumps({"program": {"name": "dualdamp"}, "provenance": {"source": "old.yaml", "scenario_sha256": "0", "started": "0"}, "scenario": {}, "analysis": "simulate",
                     "status": 0, "warnings": [], "checks": [], "errors": [], "result": "@"})


def in_result(before, piece, count, after=""):
    """A result of this program but for its numbers."""
    head, tail = RESULT.split('"@"')
    return head + before, piece, count, after + tail


# Name: result.json of an earlier run, as what stands before, between and after the repetitions.
EVENT = '{"t": 1.5, "kind": "reversal"},'
RESULTS = {
    "brackets": ("", "[", 8_000_000, ""),
    "brackets_within": in_result("", "[", 8_000_000),
    "braces": in_result("", '{"a":', 2_000_000),
    "lists": in_result("[", "[],", 3_000_000, "1]"),
    "towers": in_result("[", "[" * 50 + "]" * 50 + ",", 80_000, "1]"),
    "numbers": in_result("{", '"":1,' * 10 + '"a":[' + "1," * 1000 + "1],", 4_000, '"":[]'),
    "texts": in_result("{", '"a":[' + '"",' * 1000 + "1],", 3_000, '"":[]'),
    "keys": in_result("{", '"":1,', 2_000_000, '"":1}'),
    "long_text": in_result('"', "x", 60_000_000, '"'),
    "long_number": in_result("", "1", 60_000_000),
    "long_provenance": (RESULT.split("old.yaml")[0], "x", 60_000_000, RESULT.split("old.yaml")[1]),
    "nothing": ("", " ", 60_000_000, ""),
    "cut": in_result('{"events": [', EVENT, 1_000_000),
}


def write_repeated(path, before, piece, count, after):
    """In small pieces: a child's memory is counted from its parent's."""
    some = max(100_000 // len(piece), 1)
    with open(path, "w") as file:
        file.write(before)
        for _ in range(count // some):
            file.write(piece * some)
        file.write(piece * (count % some) + after)


class Hostile(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "link.csv").symlink_to("/etc/hostname")
        (self.folder / "folder").symlink_to("/etc")
        (self.folder / "empty").mkdir()
        os.mkfifo(self.folder / "pipe.csv")

    def refused(self, arguments, name, statuses=(3,), words=None):
        execution = Execution(PROGRAM, arguments, self.folder, 20, 2 << 30)
        said = f"{str(arguments)[:300]}: status {execution.status}, {execution.processor:.2f} s, {execution.megabytes:.0f} MB: {execution.stderr[:300]}"
        self.assertIn(execution.status, statuses, said)
        self.assertIn(words or name, execution.stderr.splitlines()[0], said)
        self.assertLess(execution.processor, SECONDS, said)
        self.assertLess(execution.megabytes, MEGABYTES, said)
        self.assertLess(len(execution.stderr), 100_000, said)
        self.assertFalse((self.folder / "out").exists(), said)

    def test_scenarios(self):
        for name, content in SCENARIOS.items():
            with self.subTest(name):
                (self.folder / "case.yaml").write_text(content())
                self.refused(["run", "case.yaml", "--out", "out"], "case.yaml")

    def test_data_files(self):
        for name, make in DATA_FILES.items():
            with self.subTest(name):
                content = make()
                (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
                del content
                self.refused(["identify", name, *RIG, "--out", "out"], name)

    def test_gigabyte_lines(self):
        """A hole of a gigabyte and a byte takes no place on the disk."""
        with open(self.folder / "big", "wb") as file:
            file.truncate((1 << 30) + 1)
        (self.folder / "key.json").write_text(json.dumps({"scenario": "0" * 64, "seed": 7, "numbers": [0]}))
        small = str(ROOT / "scenarios/stress/small.yaml")
        for arguments in (["run", "big"], ["check", "big"], ["identify", "big", *RIG], ["next", "big", *RIG], ["fit", "coulomb", "big"],
                          ["predict", "big", "big"], ["stress", "score", small, "--key", "big", "--answers", "a=big"]):
            with self.subTest(arguments[0]):
                self.refused([*arguments, *([] if arguments[0] == "check" else ["--out", "out"])], "big")

    def test_keys_and_answers(self):
        small = str(ROOT / "scenarios/stress/small.yaml")
        key = json.dumps({"scenario": "0" * 64, "seed": 7, "numbers": [0]})
        for name, keys, answers in (("deep key", "[" * 2_000_000, ANSWERS), ("deep objects", '{"a":' * 500_000, ANSWERS),
                                    ("numbers", '{"scenario": "", "seed": 1e300, "numbers": [-1, 1e300]}', ANSWERS),
                                    ("columns", key, "case," * 1_000_000 + "\n")):
            with self.subTest(name):
                (self.folder / "key.json").write_text(keys)
                (self.folder / "answers.csv").write_text(answers)
                self.refused(["stress", "score", small, "--key", "key.json", "--answers", "a=answers.csv", "--out", "out"], "key.json")

    def test_results(self):
        (self.folder / "old").mkdir()
        for name, content in RESULTS.items():
            with self.subTest(name):
                write_repeated(self.folder / "old/result.json", *content)
                self.refused(["report", "old"], "old/result.json")

    def test_a_run_beside_a_large_result(self):
        """Of an earlier result, only its name is read."""
        (self.folder / "good.yaml").write_text(DRIVEN + STEADY)
        for name, content in {**RESULTS, "whole": in_result('{"events": [', EVENT, 2_000_000, "{}]}")}.items():
            with self.subTest(name):
                shutil.rmtree(self.folder / "old", ignore_errors=True)
                (self.folder / "old").mkdir()
                write_repeated(self.folder / "old/result.json", *content)
                execution = Execution(PROGRAM, ["run", "good.yaml", "--out", "old"], self.folder, 20, 2 << 30)
                said = f"status {execution.status}, {execution.processor:.2f} s, {execution.megabytes:.0f} MB: {execution.stderr[:300]}"
                self.assertEqual(execution.status, 0, said)
                self.assertLess(execution.processor, SECONDS / 3, said)
                self.assertLess(execution.megabytes, MEGABYTES, said)
                if name == "whole":
                    self.assertIn("old held the result of old.yaml, which is replaced", execution.stderr)

    def test_points_of_an_earlier_sweep(self):
        (self.folder / "sweep.yaml").write_text(DRIVEN + STEADY + "sweep: {system.friction.kinetic: [1 N, 2 N]}\n")
        Execution(PROGRAM, ["run", "sweep.yaml", "--out", "old"], self.folder, 20)
        head, *lines = (self.folder / "old/points.jsonl").read_text().splitlines()
        for name, content in (("brackets", ("", "[", 60_000_000, "\n")), ("no lines", ("", "x", 60_000_000, "")), ("lines", ("", "\n", 4_000_000, "")),
                              ("levels", ('{"case":0,"result":', "[", 8_000_000, "\n"))):
            with self.subTest(name):
                write_repeated(self.folder / "old/points.jsonl", head + "\n" + content[0], *content[1:])
                execution = Execution(PROGRAM, ["run", "sweep.yaml", "--out", "old", "--resume"], self.folder, 20, 2 << 30)
                said = f"status {execution.status}, {execution.processor:.2f} s, {execution.megabytes:.0f} MB: {execution.stderr[:300]}"
                self.assertEqual(execution.status, 0, said)
                self.assertLess(execution.processor, SECONDS, said)
                self.assertLess(execution.megabytes, MEGABYTES, said)
                self.assertEqual((self.folder / "old/points.jsonl").read_text().splitlines(), [head, *lines])

    def test_command_lines(self):
        (self.folder / "good.yaml").write_text(DRIVEN + STEADY)
        for setting in ("a" * 100_000 + "=1", "system.mass=" + "[" * 50_000, "system[" + "9" * 50 + "]=1", "system.friction[99999999999999999999].kinetic=1 N",
                        ".".join(["a"] * 30_000) + "=1", "=1", "system=[*a]", "system.mass=&a [*a]"):
            with self.subTest(setting[:30]):
                self.refused(["run", "good.yaml", "--out", "out", "--set", setting], "", (2, 3), "error")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
