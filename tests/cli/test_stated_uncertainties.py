#!/usr/bin/env python3
"""Stated noise, gains and uncertain constants, through the program: they reach the answer, or are refused or told.

usage: test_stated_uncertainties.py PROGRAM [TEST...]
"""

import json
import math
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from case import PATIENCE

PROGRAM = str(Path(sys.argv[1]).resolve())
CONSTANTS = ["--mass", "1 kg", "--stiffness", "1421.2 N/m", "--frequency", "6 Hz"]
# m 1 kg, k 1421.2 N/m, c 6 N.s/m, F0 2.5 N at 6 Hz, three sweeps of Y; deviations 0.01 mm of Y, 0.03 mm of x.
PAIRS = """Y [mm],x [mm],sweep
3.991981,11.00753,1
4.711802,15.54874,1
5.439932,20.02803,1
6.137331,24.48965,1
6.86463,29.05058,1
7.574156,33.4528,1
8.276132,38.026,1
9.002029,42.41419,1
3.999163,11.01237,2
4.707993,15.52149,2
5.421438,20.04134,2
6.142226,24.49551,2
6.861239,29.02643,2
7.554998,33.48209,2
8.275907,37.9728,2
8.987106,42.46677,2
3.999621,11.03814,3
4.703806,15.52424,3
5.417658,19.98409,3
6.145105,24.47991,3
6.868846,29.02303,3
7.55145,33.49796,3
8.274697,37.97899,3
9.000436,42.4065,3
"""
QUICK = ["--method", "den_hartog_fit", "--method", "resonance_least_squares"]


def extremes(noise):
    """Of a free decay: zeta 0.02, 0.4 mm of friction displacement."""
    source = random.Random(4)
    ratio = math.exp(-math.pi * 0.02 / math.sqrt(1 - 0.02 ** 2))
    size, lines = 40.0, ["x [mm]"]
    for i in range(14):
        lines.append(f"{(-1) ** i * size + source.gauss(0, noise):.5f}")
        size = ratio * size - 0.4 * (1 + ratio)
    return "\n".join(lines) + "\n"


def response():
    """Of the linear oscillator with a little Coulomb friction, by its equivalent damping: amplitudes and phases."""
    source = random.Random(7)
    lines = ["f [Hz],Y [mm],x [mm],phase [deg]"]
    for i in range(20):
        r = 0.85 + 0.3 * i / 19
        drive, zeta = 4.0, 0.06
        size = drive / math.hypot(1 - r * r, 2 * zeta * r)
        phase = math.degrees(math.atan2(2 * zeta * r, 1 - r * r))
        lines.append(f"{6 * r:.5f},{drive + source.gauss(0, 0.004):.5f},{size + source.gauss(0, 0.02):.5f},{phase + source.gauss(0, 0.1):.4f}")
    return "\n".join(lines) + "\n"


class StatedUncertainties(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)

    def run_on(self, text, *options, constants=CONSTANTS):
        path = self.folder / "record.csv"
        path.write_text(text)
        return subprocess.run([PROGRAM, "identify", str(path), *constants, *options], capture_output=True, text=True,
                              timeout=60 * PATIENCE, cwd=self.folder)

    def joint(self, text, *options, constants=CONSTANTS):
        """Half the width of joint_fit's interval of zeta, and what is warned of."""
        result = self.run_on(text, "--json", *options, constants=constants)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        document = json.loads(result.stdout)
        found = [e for e in document["result"]["estimates"] if e["method"] == "joint_fit"]
        self.assertTrue(found, result.stdout[:2000])
        low, high = found[0]["interval95"]["zeta"]
        return 0.5 * (high - low), " ".join(document["warnings"]) + result.stderr

    def test_the_noise_of_few_phases_is_known_where_that_of_the_amplitudes_is_stated(self):
        """any_law had no degrees of freedom left, and ended as a bug of the program."""
        lines = ["Y [mm],x [mm],phase [deg]"]
        for i, line in enumerate(PAIRS.splitlines()[1:9]):
            lines.append(",".join(line.split(",")[:2]) + ("," if i % 4 else ",89.6"))
        result = self.run_on("\n".join(lines) + "\n", "--sigma-x", "0.03 mm", "--method", "any_law", "--json")
        self.assertIn(result.returncode, (0, 4), result.stderr)
        estimates = json.loads(result.stdout)["result"]["estimates"]
        self.assertTrue(any(e["method"] == "any_law" and e["laws"] for e in estimates))

    def test_stated_noise_of_pairs_is_that_of_the_answer(self):
        own, _ = self.joint(PAIRS, *QUICK)
        wide, said = self.joint(PAIRS, *QUICK, "--sigma-x", "0.3 mm")
        self.assertGreater(wide, 4 * own)
        self.assertIn("the amplitudes scatter 0.2 times as much as the stated deviations say: the stated noise is too large", said)
        by_Y, _ = self.joint(PAIRS, *QUICK, "--sigma-Y", "0.1 mm")
        self.assertGreater(by_Y, 8 * own)
        right, said = self.joint(PAIRS, *QUICK, "--sigma-x", "0.03 mm", "--sigma-Y", "0.01 mm")
        self.assertNotIn("joint_fit", said)
        self.assertNotAlmostEqual(right / own, 1.0, 3)
        self.assertAlmostEqual(right / own, 1.0, delta=0.25)
        double, _ = self.joint(PAIRS, *QUICK, "--sigma-x", "0.06 mm", "--sigma-Y", "0.02 mm")
        self.assertAlmostEqual(double / right, 2.0, 2)

    def test_noise_that_the_pairs_exceed_is_told_and_not_used(self):
        own, _ = self.joint(PAIRS, *QUICK)
        small, said = self.joint(PAIRS, *QUICK, "--sigma-x", "0.003 mm")
        self.assertAlmostEqual(small, own, 12)
        self.assertIn("the amplitudes scatter 20 times as much as the stated deviations say: the stated noise is too small, and joint_fit takes the noise from the readings", said)

    def test_stated_noise_of_extremes_and_of_responses(self):
        for text, constants, methods in ((extremes(0.02), CONSTANTS[:4], ("free_decay", "jacobsen_ayre")),
                                         (response(), CONSTANTS[:4], ("den_hartog_fit", "law_selection"))):
            beside = [word for method in methods for word in ("--method", method)]
            own, _ = self.joint(text, *beside, constants=constants)
            wide, said = self.joint(text, *beside, "--sigma-x", "0.2 mm", constants=constants)
            self.assertGreater(wide, 1.5 * own, methods)  # phases tell zeta as well
            self.assertIn("the stated noise is too large", said)
            _, said = self.joint(text, *beside, "--sigma-x", "0.001 mm", constants=constants)
            self.assertIn("the stated noise is too small", said)

    def test_a_joint_fit_to_histories_uses_the_stated_noise_of_x(self):
        wn = math.sqrt(1421.2)
        rows = "".join(f"{i / 500:.3f},{20 * math.exp(-0.03 * wn * i / 500) * math.cos(wn * i / 500) + 0.01 * math.sin(i * i):.6f}\n" for i in range(750))
        run = lambda *options: self.run_on("t [s],x [mm]\n" + rows, "--method", "free_decay", *options, constants=CONSTANTS[:4]).stderr
        self.assertIn("the samples of x scatter", run("--sigma-x", "0.1 mm"))
        self.assertIn("the stated noise is too small, and joint_fit takes the noise from the readings", run("--sigma-x", "0.0005 mm"))
        self.assertNotIn("the stated noise", run("--sigma-x", "0.007 mm"))  # the rms of the wiggle

    def test_gains_of_pairs_are_those_of_Y_and_x(self):
        by_Y, _ = self.joint(PAIRS, *QUICK, "--gain-uncertainty", "Y=1 %")
        by_y, _ = self.joint(PAIRS, *QUICK, "--gain-uncertainty", "y=1 %")
        self.assertEqual(by_Y, by_y)
        own, _ = self.joint(PAIRS, *QUICK)
        self.assertGreater(by_Y, 2 * own)
        refused = self.run_on(PAIRS, "--gain-uncertainty", "v=1 %")
        self.assertEqual(refused.returncode, 3)
        self.assertIn("signals of the record: Y, x", refused.stderr)
        twice = self.run_on(PAIRS, "--gain-uncertainty", "Y=1 %", "--gain-uncertainty", "y=1 %")
        self.assertEqual(twice.returncode, 3)
        self.assertIn("stated twice", twice.stderr)
        self.assertEqual(self.run_on(PAIRS, "--scale", "Y=1 ± 1 %", "--gain-uncertainty", "Y=1 %").returncode, 3)

    def test_an_uncertainty_as_large_as_its_constant_is_refused(self):
        mass, stiffness, frequency = ["--mass", "1 kg"], ["--stiffness", "1421.2 N/m"], ["--frequency", "6 Hz"]
        for constants, key in ((["--mass", "1 kg ± 300 %", *stiffness, *frequency], "system.mass"),
                               ([*mass, "--stiffness", "1421.2 N/m +- 1500 N/m", *frequency], "system.stiffness"),
                               ([*mass, *stiffness, "--frequency", "6 Hz ± 100 %"], "excitation.frequency")):
            result = self.run_on(PAIRS, constants=constants)
            self.assertEqual(result.returncode, 3, constants)
            self.assertIn(f"the uncertainty of '{key}' is too large", result.stderr)
            self.assertIn("less than 100 % of its value", result.stderr)
        self.assertEqual(self.run_on(PAIRS, "--gain-uncertainty", "x=100 %").returncode, 3)
        self.assertEqual(self.run_on(PAIRS, "--scale", "x=1 ± 100 %").returncode, 3)

    def test_a_large_uncertainty_does_not_cancel_out(self):
        """A mass far off either way moves zeta the same way, or is told by the record and corrected: smaller errors are not."""
        five, _ = self.joint(PAIRS, *QUICK, constants=["--mass", "1 kg ± 5 %", *CONSTANTS[2:]])
        for share in ("20 %", "40 %", "60 %"):
            wide, _ = self.joint(PAIRS, *QUICK, constants=["--mass", f"1 kg ± {share}", *CONSTANTS[2:]])
            self.assertGreater(wide, 0.5 * five, share)

    def test_a_table_that_is_cut_short_names_its_file(self):
        one_sweep = "".join(PAIRS.splitlines(keepends=True)[:9])
        result = self.run_on(one_sweep, "--method", "any_law", "--out", "results")
        shown = next(line for line in result.stdout.splitlines() if line.startswith("  ... "))
        self.assertRegex(shown, r"^  \.\.\. \d+ more rows? in any_law\.csv$")
        self.assertNotIn(" 1 more rows", result.stdout)
        self.assertTrue((self.folder / "results/any_law.csv").exists())


if __name__ == "__main__":
    sys.argv[1:2] = []
    unittest.main()
