#!/usr/bin/env python3
"""Fits of free vibrations under Stribeck friction that end in rest, without a stated value of the law.

The records are integrated here, so that nothing of the program takes part in them. A fit that ends at the best
parameters leaves no more than the noise that was added.

usage: test_sticking_decays.py PROGRAM [TEST...]
"""

import json
import math
import random
import sys
import unittest

import case

MASS, STIFFNESS, AMPLITUDE, RATE = 1.0, 1000.0, 0.01, 300.0


def acceleration(x, v, way, rig):
    """Of a mass that slides in direction `way`."""
    level = rig["kinetic"] + (rig["static"] - rig["kinetic"]) * math.exp(-((v / rig["stribeck_velocity"]) ** 2))
    return -(rig["damping"] * v + STIFFNESS * x + way * level) / MASS


def after(x, v, way, rig, h):
    """One step of the classical method of Runge and Kutta."""
    a1 = acceleration(x, v, way, rig)
    a2 = acceleration(x + h / 2 * v, v + h / 2 * a1, way, rig)
    a3 = acceleration(x + h / 2 * (v + h / 2 * a1), v + h / 2 * a2, way, rig)
    a4 = acceleration(x + h * (v + h / 2 * a2), v + h * a3, way, rig)
    return x + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def motion(rig, duration):
    """Positions at the rate of the samples after a release from rest; steps end at each reversal."""
    steps = 10
    x, v, way = AMPLITUDE, 0.0, -1.0
    positions = [x]
    for _ in range(round(duration * RATE)):
        for _ in range(steps):
            left = 1.0 / (RATE * steps)
            while left > 0.0 and way != 0.0:
                x_next, v_next = after(x, v, way, rig, left)
                if way * v_next >= 0.0:
                    x, v, left = x_next, v_next, 0.0
                    continue
                early, late = 0.0, left
                for _ in range(50):
                    middle = 0.5 * (early + late)
                    if way * after(x, v, way, rig, middle)[1] >= 0.0:
                        early = middle
                    else:
                        late = middle
                x, v, left = after(x, v, way, rig, late)[0], 0.0, left - late
                way = 0.0 if STIFFNESS * abs(x) <= rig["static"] else -math.copysign(1.0, x)
        positions.append(x)
    return positions


class StickingDecays(case.Case):
    def check(self, rig, seed):
        """Fits a record of this rig with noise of 0.5 % of the amplitude."""
        draws = random.Random(seed)
        noise = [0.005 * AMPLITUDE * draws.gauss(0.0, 1.0) for _ in range(round(rig["duration"] * RATE) + 1)]
        lines = [f"{i / RATE!r},{x + e!r}" for i, (x, e) in enumerate(zip(motion(rig, rig["duration"]), noise))]
        self.write("decay.csv", "\n".join(["t [s],x [m]", *lines]) + "\n")
        fit = self.run_program("fit", "stribeck", "decay.csv", "--mass", f"{MASS} kg", "--stiffness", f"{STIFFNESS} N/m", "--no-profile", "--out", "fit")
        drawn = math.sqrt(sum(e * e for e in noise) / len(noise))
        result = json.loads((self.folder / "fit/result.json").read_text())["result"]
        found = {each["name"]: each for each in result["parameters"]}
        self.assertLessEqual(result["signals"][0]["rms"], drawn, fit.stdout)
        for name in ("damping", "kinetic"):
            self.assertAlmostEqual(found[name]["value"], rig[name], delta=4.0 * found[name]["std"])
        return found

    def test_with_a_level_at_rest_that_the_first_swings_do_not_show(self):
        # Had ended with a speed of 418 m/s, beyond which nothing is left of the curve, at 1.02 times the noise.
        found = self.check({"damping": 2.27, "kinetic": 0.55, "static": 0.75, "stribeck_velocity": 0.0135, "duration": 0.75}, 1)
        self.assertAlmostEqual(found["static"]["value"], 0.75, delta=4.0 * found["static"]["std"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=1)
