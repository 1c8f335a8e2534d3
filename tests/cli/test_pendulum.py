#!/usr/bin/env python3
"""The table of docs/rotation.md: what the sine leaves of a pendulum's decays, which are integrated here.

The first argument is the program, the second the root of the sources."""

import json
import math
import subprocess
import sys
import unittest
from pathlib import Path

from case import PATIENCE, PROGRAM, Case

PAGE = Path(sys.argv[2]).resolve() / "docs/rotation.md"
INERTIA, G = 0.3, 2.943  # kg.m^2, N.m
RELEASES = (20, 45, 60, 90)  # deg
GRID = [(zeta, F0, most) for zeta in (0.005, 0.02) for F0 in (0.02, 0.1) for most in (4, 10)]
STEP = 2e-3  # s, of a rule of fourth order: extremes within 1e-10 rad


def step(state, h, damping, torque):
    """Runge-Kutta of fourth order; the torque of friction is constant in a half swing."""
    def slope(x, v):
        return v, -(damping * v + G * math.sin(x) + torque) / INERTIA

    x, v = state
    a = slope(x, v)
    b = slope(x + h / 2 * a[0], v + h / 2 * a[1])
    c = slope(x + h / 2 * b[0], v + h / 2 * b[1])
    d = slope(x + h * c[0], v + h * c[1])
    return x + h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0]), v + h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])


def extremes(zeta, F0, release, most):
    """(t, x) of the release and the extremes after it, until the pendulum sticks."""
    damping = 2 * zeta * math.sqrt(INERTIA * G)
    t, state = 0.0, (math.radians(release), 0.0)
    found = [(t, state[0])]
    while len(found) < most and G * math.sin(abs(state[0])) > F0:
        way = -math.copysign(1.0, state[0])
        while True:
            following = step(state, STEP, damping, way * F0)
            if way * following[1] <= 0.0:
                break
            state, t = following, t + STEP
        low, high = 0.0, STEP
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if way * step(state, middle, damping, way * F0)[1] > 0.0 else (low, middle)
        state, t = (step(state, high, damping, way * F0)[0], 0.0), t + high
        found.append((t, state[0]))
    return found


class Pendulum(Case):
    def errors(self, zeta, F0, decay, *options):
        """Of zeta and F0 [%]."""
        self.write("decay.csv", "t,x [rad]\n" + "".join(f"{t!r},{x!r}\n" for t, x in decay))
        # A decay read with a linear spring may have an estimate and no answer, which is status 4: so both are taken.
        said = subprocess.run([PROGRAM, "identify", "decay.csv", "--mass", f"{INERTIA} kg.m^2", "--stiffness", f"{G} N.m/rad", "--method", "free_decay", "--json", *options], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE * 60)
        estimate = json.loads(said.stdout)["result"]["estimates"][0]
        return 100 * (estimate["zeta"] / zeta - 1), 100 * (estimate["F0"] / F0 - 1)

    def test_a_record_in_degrees_is_of_an_angle_though_no_stated_unit_says_so(self):
        state, rows = (math.radians(60), 0.0), []
        for i in range(300):
            rows.append(f"{i / 100!r},{math.degrees(state[0]) + 0.05 * math.sin(977.0 * i * i)!r}")
            for _ in range(5):
                state = step(state, STEP, 0.04, math.copysign(0.05, state[1] or -1.0))
        record = self.write("swing.csv", "t [s],x [deg]\n" + "\n".join(rows) + "\n")
        found = json.loads(self.run_program("fit", "coulomb", record, "--set", f"system.gravity_stiffness={G} N.m", "--no-profile", "--json").stdout)
        values = {each["name"]: each["value"] for each in found["result"]["parameters"]}
        self.assertAlmostEqual(values["mass"], INERTIA, delta=0.01 * INERTIA)
        other = self.write("line.csv", record.read_text().replace("deg", "mm"))
        self.assertIn("no angle", self.run_program("fit", "coulomb", other, "--set", f"system.gravity_stiffness={G} N.m", status=3).stderr)

    def test_the_table_of_the_page(self):
        page = PAGE.read_text()
        linear = lambda values: " to ".join(f"{v:.1f}" if abs(v) < 10 else f"{v:.0f}" for v in (min(values, key=abs), max(values, key=abs)))
        converted = lambda values: f"{min(values):.2f} to {max(values):.2f}"
        for release in RELEASES:
            decays = [(zeta, F0, extremes(zeta, F0, release, most)) for zeta, F0, most in GRID]
            without = [self.errors(*case) for case in decays]
            with_sine = [self.errors(*case, "--gravity-stiffness", f"{G} N.m") for case in decays]
            cells = [how([one[i] for one in errors]) for errors, how in ((without, linear), (with_sine, converted)) for i in (0, 1)]
            row = f"| {release}° | " + " | ".join(f"{cell} %" for cell in cells) + " |"
            with self.subTest(release=release):
                self.assertIn(row, page)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
