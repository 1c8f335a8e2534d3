#!/usr/bin/env python3
"""The standard case by scipy.integrate.solve_ivp (DOP853 with a terminal event), timing itself.

usage: scipy_contender.py BATCHES PERIODS MASS STIFFNESS DAMPING FRICTION FREQUENCY BASE X0 V0 TOLERANCE...

Prints a line for each tolerance: amplitude [m], reversals, then the processor seconds of each batch, which is one
start integrated over PERIODS forcing periods. Started by dualdamp-speed. Status 69: SciPy is missing.
"""

import math
import sys
import time

try:
    from scipy.integrate import solve_ivp
except ImportError:
    sys.exit(69)


def integrate(periods, tolerance, mass, stiffness, damping, friction, frequency, base, x, v):
    """Amplitude and number of reversals; sgn v is frozen within an interval, as for the other solvers."""
    end = periods * 2.0 * math.pi / frequency
    drive, spring, viscous, level = (q / mass for q in (stiffness * base, stiffness, damping, friction))
    t, turning, amplitude, reversals = 0.0, 0.0, 0.0, 0
    direction = math.copysign(1.0, v)
    while True:
        held = level * direction

        def rate(t, state):
            return state[1], drive * math.cos(frequency * t) - spring * state[0] - viscous * state[1] - held

        def reversal(t, state):
            return direction * state[1]

        reversal.terminal = True
        reversal.direction = -1
        interval = solve_ivp(rate, (t, end), (x, v), method="DOP853", rtol=tolerance, atol=tolerance, events=reversal)
        if interval.status == 0:
            return amplitude, reversals
        if interval.status != 1:
            raise RuntimeError(interval.message)
        t, x, v = interval.t_events[0][0], interval.y_events[0][0][0], 0.0
        pull = drive * math.cos(frequency * t) - spring * x
        if abs(pull) <= level:
            raise RuntimeError("the standard case does not stick")
        direction = math.copysign(1.0, pull)
        amplitude, turning = 0.5 * abs(x - turning), x
        reversals += 1


def main():
    batches, periods = int(sys.argv[1]), int(sys.argv[2])
    case = [float(value) for value in sys.argv[3:11]]
    tolerances = [float(value) for value in sys.argv[11:]]
    seconds = {tolerance: [] for tolerance in tolerances}
    found = {tolerance: integrate(periods, tolerance, *case) for tolerance in tolerances}  # warms up
    for _ in range(batches):
        for tolerance in tolerances:
            begin = time.process_time()
            integrate(periods, tolerance, *case)
            seconds[tolerance].append(time.process_time() - begin)
    for tolerance in tolerances:
        print(*(repr(number) for number in (*map(float, found[tolerance]), *seconds[tolerance])))


if __name__ == "__main__":
    main()
