#!/usr/bin/env python3
"""The interval of a parameter whose effect ends reaches to where fits with a stated value leave more than noise.

usage: test_profiles.py PROGRAM [TEST...]
"""

import json
import random
import sys
import unittest

import case

CONSTANTS = ("--mass", "1 kg", "--stiffness", "1000 N/m", "--damping", "1 N.s/m", "--set", "system.friction.limit=2 N")
RATE = 400
SAMPLES = 240
STEPS = 100  # between two samples
NOISE = 8e-6
LIMIT, CONTACT = 2.0, 20000.0


def motion():
    """A release from 30 mm under an elastic contact that then slides, by the midpoint rule: bouc_wen of an infinite exponent."""
    x, v, z, h, most = 0.03, 0.0, 0.0, 1 / (RATE * STEPS), LIMIT / CONTACT
    for _ in range(SAMPLES):
        yield x
        for _ in range(STEPS):
            middle, force = x + 0.5 * h * v, CONTACT * max(-most, min(most, z + 0.5 * h * v))
            speed = v + 0.5 * h * (-1000.0 * middle - v - force)
            x, z = x + h * speed, max(-most, min(most, z + h * speed))
            v += h * (-1000.0 * middle - speed - force)


class Profiles(case.Case):
    def fitted(self, *arguments):
        result = json.loads(self.run_program("fit", "bouc_wen", "record.csv", *CONSTANTS, *arguments, "--json", "--out", "fit").stdout)["result"]
        return result["residual"]["rms"], {each["name"]: each for each in result["parameters"]}

    def test_an_exponent_without_an_upper_end_has_a_lower_one(self):
        noise = random.Random(4)
        self.write("record.csv", "t [s],x [m]\n" + "".join(f"{i / RATE!r},{x + NOISE * noise.gauss(0, 1)!r}\n" for i, x in enumerate(motion())))
        rms, found = self.fitted()
        low, high = found["exponent"]["interval95"]
        self.assertIsNone(high)
        self.assertGreater(low, 1.5)
        self.assertGreater(found["friction.stiffness"]["interval95"][1], CONTACT)
        self.assertLess(found["friction.stiffness"]["interval95"][0], CONTACT)
        # At the end, the sum of squares has grown by 1.96^2 variances of the noise.
        held, _ = self.fitted("--set", f"system.friction.exponent={low}", "--no-profile")
        growth = SAMPLES * ((held / rms) ** 2 - 1.0)
        self.assertGreater(growth, 2.0)
        self.assertLess(growth, 6.0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
