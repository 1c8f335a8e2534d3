#!/usr/bin/env python3
"""The standard case and a sweep from Python: dualdamp beside heyoka, SciPy and CVODE (scikit-sundae).

usage: peers.py [BATCHES]; started by scripts/peers

Standard case: the steady amplitude against Den Hartog's closed form, and its processor time; the peers follow the
motion from rest for 50 forcing periods. Sweep: 10^5 steady amplitudes over Y and F0. dualdamp computes all of them; of
the peers SAMPLE are timed, and the time of all is that of these in proportion. Prints a table in Markdown with the
lines that a user writes. Status 69: a peer is missing.
"""

import inspect
import math
import statistics
import sys
import time

import numpy as np

MASS, STIFFNESS, DAMPING, FRICTION, FREQUENCY, BASE = 1.0, 100.0, 4.0, 2.0, 10.0, 0.1  # SI
AMPLITUDE = 0.186078097956786  # Den Hartog's closed form
PERIODS = 50
END = PERIODS * 2.0 * math.pi / FREQUENCY
SWEPT, SAMPLE = 100_000, 20
TOLERANCE = 1e-10


# Each peer: a function that prepares, and returns amplitude(base, friction). The sign of the friction is frozen
# between reversals, so that no solver steps over a jump of the force.


def dualdamp_peer():
    import dualdamp as dd

    return lambda base, friction: dd.steady_state(mass=MASS, stiffness=STIFFNESS, damping=DAMPING, F0=friction, Y=base, omega=FREQUENCY).amplitude


def heyoka_peer():
    import heyoka as hy

    x, v = hy.make_vars("x", "v")
    base, friction = hy.par[0], hy.par[1]  # friction with its sign

    def turn(solver, _direction):
        turns.append(solver.state[0])
        pull = STIFFNESS * (solver.pars[0] * math.cos(FREQUENCY * solver.time) - solver.state[0])
        solver.pars[1] = math.copysign(solver.pars[1], pull)
        return True

    rate = (STIFFNESS * (base * hy.cos(FREQUENCY * hy.time) - x) - DAMPING * v - friction) / MASS
    turns = []
    solver = hy.taylor_adaptive([(x, v), (v, rate)], [0.0, 0.0], tol=TOLERANCE, pars=[0.0, 0.0], t_events=[hy.t_event(v, callback=turn)])

    def amplitude(base, friction):
        turns.clear()
        solver.time, solver.state[:], solver.pars[:] = 0.0, (0.0, 1e-9), (base, friction)
        solver.propagate_until(END)
        return 0.5 * abs(turns[-1] - turns[-2])

    return amplitude


def scipy_peer():
    from scipy.integrate import solve_ivp

    def amplitude(base, friction):
        t, state, sign, turns = 0.0, (0.0, 1e-9), 1.0, []

        def rate(t, y):
            return y[1], (STIFFNESS * (base * math.cos(FREQUENCY * t) - y[0]) - DAMPING * y[1] - sign * friction) / MASS

        def turn(t, y):
            return sign * y[1]

        turn.terminal, turn.direction = True, -1
        while True:
            found = solve_ivp(rate, (t, END), state, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE, events=turn)
            if found.status == 0:
                return 0.5 * abs(turns[-1] - turns[-2])
            t, state = found.t[-1], (found.y[0, -1], 0.0)
            turns.append(state[0])
            sign = math.copysign(1.0, base * math.cos(FREQUENCY * t) - state[0])

    return amplitude


def cvode_peer():
    from sksundae.cvode import CVODE

    def rate(t, y, yp, data):
        base, force = data
        yp[0], yp[1] = y[1], (STIFFNESS * (base * math.cos(FREQUENCY * t) - y[0]) - DAMPING * y[1] - force) / MASS

    def turn(t, y, events, data):
        events[0] = math.copysign(1.0, data[1]) * y[1]

    turn.terminal, turn.direction = [True], [-1]

    def amplitude(base, friction):
        data, t, state, turns = [base, friction], 0.0, np.array([0.0, 1e-9]), []
        while True:
            solver = CVODE(rate, method="Adams", rtol=TOLERANCE, atol=TOLERANCE, eventsfn=turn, num_events=1, userdata=data)
            found = solver.solve(np.array([t, END]), state)
            if found.t[-1] >= END:
                return 0.5 * abs(turns[-1] - turns[-2])
            t, state = found.t[-1], np.array([found.y[-1, 0], 0.0])
            turns.append(state[0])
            data[1] = math.copysign(friction, base * math.cos(FREQUENCY * t) - state[0])

    return amplitude


PEERS = {"dualdamp": dualdamp_peer, "heyoka": heyoka_peer, "SciPy DOP853": scipy_peer, "CVODE Adams (scikit-sundae)": cvode_peer}


def seconds(work):
    begin = time.process_time()
    work()
    return time.process_time() - begin


def lines(peer):
    """What a user writes: lines that are neither empty nor comments."""
    return sum(1 for line in inspect.getsource(peer).splitlines() if line.strip() and not line.strip().startswith("#"))


def main():
    batches = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    bases, frictions = np.linspace(0.1, 0.3, SWEPT), np.linspace(2.0, 0.5, SWEPT)
    chosen = range(0, SWEPT, SWEPT // SAMPLE)
    print("| | amplitude error | one steady state [us] | 10^5 steady states [s] | largest difference | lines |\n|---|---|---|---|---|---|")
    reference = None
    for name, peer in PEERS.items():
        try:
            amplitude = peer()
        except ImportError:
            print(f"{name} is missing", file=sys.stderr)
            sys.exit(69)
        error = abs(amplitude(BASE, FRICTION) / AMPLITUDE - 1.0)  # warms up
        one = statistics.median(seconds(lambda: amplitude(BASE, FRICTION)) for _ in range(batches)) 
        if reference is None:
            swept = [0.0]
            all_of_them = statistics.median(seconds(lambda: swept.__setitem__(0, amplitude(bases, frictions))) for _ in range(batches))
            reference, difference = swept[0], 0.0
        else:
            found = []
            all_of_them = seconds(lambda: found.extend(amplitude(bases[i], frictions[i]) for i in chosen)) * SWEPT / SAMPLE
            difference = max(abs(x / reference[i] - 1.0) for x, i in zip(found, chosen))
        print(f"| {name} | {error:.1e} | {1e6 * one:.3g} | {all_of_them:.3g} | {difference:.1e} | {lines(peer)} |")


if __name__ == "__main__":
    main()
