#!/usr/bin/env python3
"""Every file of laboratory_formats.py through the program: the right numbers, or one refusal that says what to do.

usage: test_laboratory_formats.py PROGRAM [TEST...]
"""

import json
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from case import PATIENCE
from laboratory_formats import ACCEPTED, PAIRS, PLAIN, REFUSED, SI
from laboratory_records import FREQUENCY, FRICTION, MASS, SLOW, STIFFNESS, ZETA

PROGRAM = str(Path(sys.argv[1]).resolve())
RIG = ["--mass", f"{MASS} kg", "--stiffness", f"{STIFFNESS} N/m", "--frequency", f"{FREQUENCY} Hz"]
SLOW_RIG = ["--mass", f"{SLOW['mass']} kg", "--stiffness", f"{SLOW['stiffness']} N/m"]


class LaboratoryFormats(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def identify(self, name, content, *more):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return subprocess.run([PROGRAM, "identify", name, *more], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE * 60)

    def estimate(self, name, content, options, expected):
        """zeta and F0, and the truth."""
        rig, method, truth = (RIG, "den_hartog_fit", (ZETA, FRICTION)) if expected == PAIRS else (SLOW_RIG, "free_decay", (SLOW["zeta"], SLOW["friction"]))
        result = self.identify(name, content, *rig, "--method", method, "--json", *options)
        self.assertEqual(result.returncode, 0, result.stdout[-2000:] + result.stderr)
        found = json.loads(result.stdout)["result"]["estimates"][0]
        return (found["zeta"], found["F0"]), truth

    def test_there_are_more_than_forty(self):
        self.assertGreaterEqual(len(ACCEPTED) + len(REFUSED), 100)
        self.assertEqual(len({row[0] for row in ACCEPTED + REFUSED}), len(ACCEPTED) + len(REFUSED))

    def test_accepted(self):
        for name, content, options, expected in ACCEPTED:
            with self.subTest(name):
                found, truth = self.estimate(name, content, options, expected)
                # Pairs are printed with six digits or more. Extremes are read between samples, and in noise.
                tolerance = 2e-4 if expected == PAIRS else 0.06 if "tail" in name or "bursts" in name else 0.02
                for value, true in zip(found, truth):
                    self.assertLess(abs(value / true - 1), tolerance, (found, truth))

    def test_refused(self):
        for name, content, options, words in REFUSED:
            with self.subTest(name):
                history = '"t' in name or any(mark in name for mark in ("time", "milliseconds", "torn", "clipped", "constant"))
                rig = SLOW_RIG if history else RIG if "--frequency" not in options else RIG[:4]
                result = self.identify(name, content, *rig, *options)
                self.assertEqual(result.returncode, 3, result.stdout[-500:] + result.stderr)
                self.assertIn(words, result.stderr)
                self.assertEqual(result.stderr.count("error:"), 1, result.stderr)
                self.assertTrue(result.stderr.startswith(name), result.stderr)
                self.assertIn("allowed:", result.stderr)
                self.assertLess(len(result.stderr), 3000)

    def test_assumptions_are_named(self):
        method = ["--method", "den_hartog_fit"]
        result = self.identify("si.csv", SI.replace(" [m]", ""), *RIG, *method)
        self.assertIn("no unit is stated for Y and x: read Y in m and x in m", result.stderr)
        result = self.identify("si.csv", SI, *RIG, *method)
        self.assertNotIn("no unit is stated", result.stderr)

    def test_random_changes_of_good_files(self):
        """Read, or refused with a message; never a crash, never another number without a word."""
        generator = random.Random(41)
        letters = "0123456789.,;-+eE \t\n\"'xYt[]()mk%#\u00b5\0"
        outcomes = {0: 0, 3: 0, 4: 0}
        for _ in range(60):
            text = list(generator.choice((PLAIN, SI)))
            for _ in range(generator.randint(1, 3)):
                place = generator.randrange(len(text))
                change = generator.randrange(3)
                text[place:place + (0 if change == 0 else 1)] = [] if change == 1 else [generator.choice(letters)]
            # What is tried is how a file is read: the methods are those that take no time.
            result = self.identify("changed.csv", "".join(text), *RIG, "--method", "resonance_least_squares", "--method", "den_hartog_fit", "--json")
            self.assertIn(result.returncode, outcomes, result.stderr)
            outcomes[result.returncode] += 1
            if result.returncode == 3:
                self.assertIn("error:", result.stderr)
        self.assertGreater(outcomes[3], 0)
        self.assertGreater(outcomes[0], 0)


if __name__ == "__main__":
    sys.argv[1:2] = []
    unittest.main()
