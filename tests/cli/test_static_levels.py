#!/usr/bin/env python3
"""Intervals of the level at which a mass at rest breaks away, in records that hardly show it.

usage: test_static_levels.py PROGRAM ROOT [TEST...]
"""

import json
import math
import sys
import unittest

import case
import laboratory_records as laboratory

RIG = {"mass": 1.0, "stiffness": 1000.0, "damping": 1.0, "friction": 0.1, "static": 0.13}
RATE, COUNT = 120, 240


def motion():
    """Under a force that is far above both levels when the record begins: the mass leaves its first rest at once, and never comes to another one."""
    rows = laboratory.forced(lambda t: 5.0 * math.cos(8 * math.pi * t), RATE, COUNT, RIG)
    return [list(column) for column in zip(*rows)]


class StaticLevels(case.Case):
    def fitted(self, *arguments):
        t, x, _, _, force = MOTION
        rows = zip(t, laboratory.rough(x, 0.01, SEED), force)
        record = self.write("driven.csv", "t [s],x [m],force [N]\n" + "".join(f"{a!r},{b!r},{c!r}\n" for a, b, c in rows))
        constants = ("--mass", "1 kg", "--stiffness", "1000 N/m")
        ran = self.run_program("fit", *arguments, record, *constants, "--drive", "force", "--json", "--out", "fit")
        result = json.loads(ran.stdout)["result"]
        return result["residual"]["rms"], {row["name"]: row for row in result["parameters"]}

    def test_a_rest_that_need_not_be_does_not_bound_the_level(self):
        # The noise of the first samples may look like a longer rest, under a level of 3 N. A level of 0.13 N leaves
        # residuals that are larger by less than chance: their squares grow by less than 1.96^2 variances.
        best, parameters = self.fitted("coulomb", "--free", "static")
        self.assertGreater(parameters["static"]["value"], 1.0)
        true = self.fitted("coulomb", "--set", "system.friction.static=0.13 N", "--no-profile")[0]
        self.assertLess(COUNT * (true**2 / best**2 - 1), 1.96**2)
        low = parameters["static"]["interval95"][0]
        self.assertLessEqual(low if low is not None else 0.0, RIG["static"])

    def test_a_level_is_sought_below_the_one_that_is_stated(self):
        # Of no data does a start lie below a level as small as this one.
        for law in ("coulomb", "stribeck"):
            more = ("--set", "system.friction.stribeck_velocity=0.01 m/s") if law == "stribeck" else ()
            kinetic = self.fitted(law, "--set", "system.friction.static=0.13 N", *more, "--no-profile")[1]["kinetic"]
            self.assertLessEqual(kinetic["value"], RIG["static"])
            self.assertAlmostEqual(kinetic["value"], RIG["friction"], delta=4 * kinetic["std"])


MOTION = motion()
SEED = 48

if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
