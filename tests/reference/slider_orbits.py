#!/usr/bin/env python3
"""Steady states of an oscillator with massless Coulomb sliders behind springs, to 30 digits.

Shares nothing with the program: closed forms of each mode in 45-digit arithmetic (mpmath), events by a fine scan and
then the secant rule, the periodic state by Newton's method on differences. Writes slider_orbits.csv beside itself;
tests/sim/orbits/test_slider_orbits.cpp compares. Needs python3-mpmath; takes some minutes.
"""

import cmath
import csv
import pathlib

from mpmath import mp, mpf, mpc, lu_solve, matrix, nstr

mp.dps = 45


class Element:
    """Spring k and damper ct, slider with kinetic fk and static fs."""

    def __init__(self, k, fk, fs, ct):
        self.k, self.fk, self.fs, self.ct = mpf(k), mpf(fk), mpf(fs), mpf(ct)


class Mode:
    """x(t) of m x'' + C x' + K x = k Y cos(w t) + f, from (x0, v0) at t0."""

    def __init__(self, system, elements, modes, states, t0, x0, v0):
        m, c, k, w, y = system
        stiffness, damping, force = k, c, mpf(0)
        for e, mode, z in zip(elements, modes, states):
            if mode == 0:
                stiffness += e.k
                damping += e.ct
                force += e.k * z
            else:
                force -= mode * e.fk
        self.w, self.t0 = w, t0
        self.drive = k * y / (stiffness - m * w * w + mpc(0, 1) * damping * w)
        self.rest = force / stiffness
        half = damping / (2 * m)
        root = mp.sqrt(mpc(half * half - stiffness / m))
        self.p, self.q = -half + root, -half - root
        turn = mp.exp(mpc(0, 1) * w * t0)
        dx = x0 - self.rest - (self.drive * turn).real
        dv = v0 - (mpc(0, 1) * w * self.drive * turn).real
        self.b = (dv - self.p * dx) / (self.q - self.p)
        self.a = dx - self.b
        self.quick = [complex(z) for z in (self.drive, self.p, self.q, self.a, self.b)]
        self.rate = max(float(w), abs(complex(self.p)), abs(complex(self.q)))

    def at(self, t):
        s = t - self.t0
        turn = self.drive * mp.exp(mpc(0, 1) * self.w * t)
        ea, eb = self.a * mp.exp(self.p * s), self.b * mp.exp(self.q * s)
        return (self.rest + (turn + ea + eb).real,
                (mpc(0, 1) * self.w * turn + self.p * ea + self.q * eb).real)

    def roughly(self, t):
        drive, p, q, a, b = self.quick
        s = t - float(self.t0)
        turn = drive * cmath.exp(1j * float(self.w) * t)
        ea, eb = a * cmath.exp(p * s), b * cmath.exp(q * s)
        return (float(self.rest) + (turn + ea + eb).real, (1j * float(self.w) * turn + p * ea + q * eb).real)


def guards(elements, modes, states, direction, t0):
    """List of (kind, element, g(t, x, v)), each g > 0 while the mode holds."""
    found = [("reversal", None, lambda t, x, v, d=direction: d * v)]
    for i, (e, mode, z) in enumerate(zip(elements, modes, states)):
        if mode == 0:
            for side in (1, -1):
                found.append(("break", (i, side), lambda t, x, v, e=e, z=z, s=side: e.fs - s * (e.k * (x - z) + e.ct * v)))
        elif e.ct > 0:
            def speed(t, x, v, e=e, u0=z, s=mode):
                settled = s * e.fk / e.k
                exp = mp.exp if isinstance(t, mpf) else cmath.exp
                rate = -(e.k / e.ct) * (u0 - settled) * exp(-(e.k / e.ct) * (t - t0))
                return s * (v - (rate if isinstance(t, mpf) else complex(rate).real))
            found.append(("stick", i, speed))
    return found


def refine(mode, g, low, high):
    """The root of g between low (positive) and high (negative): bisection in doubles is done, secant in 45 digits."""
    f = lambda t: g(t, *mode.at(t))
    flow, fhigh = f(low), f(high)
    for _ in range(200):
        t = (low * fhigh - high * flow) / (fhigh - flow)
        if not low < t < high:
            t = (low + high) / 2
        value = f(t)
        if value > 0:
            low, flow = t, value
            fhigh /= 2
        else:
            high, fhigh = t, value
            flow /= 2
        if high - low < mpf(10) ** -42 or value == 0:
            break
    return (low + high) / 2


def pass_event(event, elements, modes, states, x, v, direction):
    """Changes modes and states at an event; the velocity and the direction behind it."""
    kind, which, _ = event
    if kind == "reversal":
        for i, (e, n) in enumerate(zip(elements, modes)):
            if n != 0 and e.ct == 0:
                modes[i], states[i] = 0, x - n * e.fk / e.k
        return mpf(0), -direction
    if kind == "break":
        i, side = which
        modes[i] = side
        states[i] = x - states[i] if elements[i].ct > 0 else mpf(0)
    else:
        modes[which], states[which] = 0, x - states[which]
    return v, direction


def period(system, elements, start, watch=None):
    """Carries (x, v, modes, states) over one forcing period."""
    m, c, k, w, y = system
    x, v, modes, states = start[0], start[1], list(start[2]), list(start[3])
    end, t = 2 * mp.pi / w, mpf(0)
    direction = 1 if v > 0 else -1
    while True:
        mode = Mode(system, elements, modes, states, t, x, v)
        candidates = guards(elements, modes, states, direction, t)
        decay = max([float(e.k / e.ct) for e, n in zip(elements, modes) if e.ct > 0 and n != 0] or [0.0])
        step = min(float(end) / 600, 0.12 / mode.rate)
        low, event = float(t), None
        first = True
        while low < float(end):
            # Behind an event, and while a damped contact settles, the scan begins with short steps.
            width = min(step, max(1e-9 * float(end), 0.02 * (low - float(t)) + (0.02 / decay if decay else 0.0))) if decay or first else step
            if first:
                width = min(width, 1e-7 * float(end))
            high = min(low + width, float(end))
            xa = mode.roughly(high)
            crossed = [item for item in candidates if item[2](high, *xa) < -1e-13 * (1 + abs(xa[1]))]
            if crossed:
                a, b = mpf(low), mpf(high)
                for item in crossed:
                    g = item[2]
                    if g(b, *mode.at(b)) < 0:
                        if g(a, *mode.at(a)) <= 0:
                            a2 = a - (b - a)
                            a2 = max(a2, t)
                            root = refine(mode, g, a2, b) if g(a2, *mode.at(a2)) > 0 else a
                        else:
                            root = refine(mode, g, a, b)
                        if event is None or root < event[0]:
                            event = (root, item)
                if event:
                    break
            low, first = high, False
        finish = event[0] if event else end
        before, x_before = t, x
        x, v = mode.at(finish)
        for i, (e, n) in enumerate(zip(elements, modes)):
            if n != 0 and e.ct > 0:
                settled = n * e.fk / e.k
                states[i] = settled + (states[i] - settled) * mp.exp(-(e.k / e.ct) * (finish - before))
        t = finish
        if watch is not None:
            watch.append(x)
        if event is None:
            return x, v, modes, states
        v, direction = pass_event(event[1], elements, modes, states, x, v, direction)


def orbit(system, elements):
    """(peak, trough) of the periodic motion approached from rest with unstretched springs."""
    state = (mpf(0), mpf(0), [0] * len(elements), [mpf(0)] * len(elements))
    for _ in range(6):
        state = period(system, elements, state)

    def free(state):
        return [i for i in range(len(elements)) if state[2][i] == 0 or elements[i].ct > 0]

    def pack(state):
        return matrix([state[0], state[1]] + [state[3][i] for i in free(state)])

    for _ in range(25):
        end = period(system, elements, state)
        gap = pack(end) - pack(state) if end[2] == state[2] else None
        if gap is None:
            state = end
            continue
        size = max(abs(z) for z in gap)
        if size < mpf(10) ** -36:
            break
        base = pack(state)
        n = len(base)
        derivative = matrix(n, n)
        h = max(size / 100, mpf(10) ** -30)
        sound = size < mpf(10) ** -3
        for j in range(n if sound else 0):
            moved = base.copy()
            moved[j] += h
            states = list(state[3])
            for place, i in enumerate(free(state)):
                states[i] = moved[2 + place]
            there = period(system, elements, (moved[0], moved[1], state[2], states))
            if there[2] != end[2]:
                sound = False
                break
            for row, value in enumerate(pack(there) - pack(end)):
                derivative[row, j] = value / h
        if not sound:
            state = end
            continue
        change = lu_solve(mp.eye(n) - derivative, gap)
        states = list(state[3])
        for place, i in enumerate(free(state)):
            states[i] += change[2 + place]
        state = (state[0] + change[0], state[1] + change[1], state[2], states)
    else:
        raise RuntimeError("no periodic state")
    turning = [state[0]]
    period(system, elements, state, turning)
    return max(turning), min(turning)


def cases():
    standard = ("1", "4", "100", "10", "0.1")
    below = ("1", "1", "100", "7", "0.1")
    for kt in ("1e2", "1e3", "1e4", "1e5", "1e6", "1e7"):
        for static in ("2", "3"):
            for ct in ("0", "5"):
                yield "contact", standard, [(kt, "2", static, ct)]
        yield "contact", below, [(kt, "2", "2", "0")]
    for count in (3, 8):
        n = mpf(count)
        yield "iwan", standard, [(nstr(2000 / n, 40), nstr(2 * 3 * (i + mpf(1) / 2) / n**2, 40), None, "0") for i in range(count)]


def main():
    rows = []
    for name, system, parts in cases():
        elements = [Element(k, fk, fs or fk, ct) for k, fk, fs, ct in parts]
        peak, trough = orbit(tuple(mpf(z) for z in system), elements)
        first = parts[0]
        fields = [len(parts)] + ([first[0], first[1], first[2], first[3]] if name == "contact" else ["2000", "3", "", "0"])
        rows.append([name, *system, *fields, nstr(peak, 30), nstr(trough, 30)])
        print(*rows[-1], flush=True)
    with open(pathlib.Path(__file__).with_suffix(".csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow("law mass damping stiffness frequency amplitude count k kinetic static contact_damping peak trough".split())
        writer.writerows(rows)


if __name__ == "__main__":
    main()
