"""The standard case of the benchmark by code that shares nothing with the program: an integrator, Den Hartog's law, fits."""

import math

MASS, STIFFNESS, ZETA, F0 = 1.042, 1568.0, 0.0987, 4.39  # of scenarios/stress/small.yaml


def amplitude(Y, omega, damper=None, bristle=None, forward=0.0, cubic=0.0, third=0.0, rider=None):
    """Amplitude of a motion that reverses without rest: Runge and Kutta from reversal to reversal until they repeat.

    damper: force over velocity; bristle: stiffness of Dahl's law in place of Coulomb friction; forward: what friction and damping
    are more by in this direction, relative; cubic: k3; third: third harmonic of the base; rider: share of the mass that rides on a
    spring of its own, with the frequency and the damping ratio that it has where the rest is held.
    """
    c = 2 * ZETA * math.sqrt(MASS * STIFFNESS)
    damper = damper or (lambda v: c * v)

    share, own, ratio = rider or (0.0, 0.0, 0.0)

    def slope(t, state, direction):
        x, v, z, stretched, stretching = state
        stretch = Y * math.cos(omega * t) + third * math.cos(3 * omega * t) - x
        friction = F0 * (z if bristle else direction) + damper(v)
        force = STIFFNESS * stretch + cubic * stretch**3 - friction * (1 + forward * direction)
        pulled = own**2 * stretched + 2 * ratio * own * stretching  # acceleration of the rider
        a = (force / MASS - share * pulled) / (1 - share)
        return v, a, bristle / F0 * v * (1 - direction * z) if bristle else 0.0, stretching, a - pulled

    def step(t, state, h, direction):
        k1 = slope(t, state, direction)
        k2 = slope(t + h / 2, [s + h / 2 * k for s, k in zip(state, k1)], direction)
        k3 = slope(t + h / 2, [s + h / 2 * k for s, k in zip(state, k2)], direction)
        k4 = slope(t + h, [s + h * k for s, k in zip(state, k3)], direction)
        return [s + h / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4)]

    period, h = 2 * math.pi / omega, 2 * math.pi / omega / (400 if rider else 100)
    t, state, direction, turns = 0.0, [0.0, omega * Y, 0.0, 0.0, 0.0], 1, [0.0, 0.0, 0.0]
    while t < 10 * period or abs(turns[-1] - turns[-3]) > 1e-8 * abs(turns[-1]):
        assert t < 60 * period
        new = step(t, state, h, direction)
        if new[1] * direction > 0:
            t, state = t + h, new
            continue
        part = h * state[1] / (state[1] - new[1])
        for _ in range(4):  # Newton's method for the time of the reversal
            at = step(t, state, part, direction)
            part -= at[1] / slope(t + part, at, direction)[1]
        t, state, direction = t + part, step(t, state, part, direction), -direction
        state[1] = 0.0
        turns.append(state[0])
    return abs(turns[-1] - turns[-2]) / 2


def line(levels, amplitudes, mass, stiffness):
    """zeta and F0 by the straight line through pairs, with the paper's G at resonance."""
    n = len(levels)
    mean_Y, mean_x = sum(levels) / n, sum(amplitudes) / n
    b = sum((Y - mean_Y) * (x - mean_x) for Y, x in zip(levels, amplitudes)) / sum((Y - mean_Y) ** 2 for Y in levels)
    a = mean_x - b * mean_Y
    zeta = 1 / (2 * b)
    s = math.sqrt(1 - zeta**2)
    G = (math.sinh(math.pi * zeta) - zeta / s * math.sin(math.pi * s)) / (math.cosh(math.pi * zeta) + math.cos(math.pi * s))
    return zeta, -a / G * stiffness


def steady_state(zeta, friction, Y, omega):
    """Amplitude and phase lag of the fundamental, from Den Hartog's half period between two turning points."""
    wn = math.sqrt(STIFFNESS / MASS)
    r = omega / wn
    s, beta = math.sqrt(1 - zeta**2), wn / omega
    a, b = math.pi * zeta * beta, math.pi * s * beta
    G = (math.sinh(a) - zeta / s * math.sin(b)) / (math.cosh(a) + math.cos(b))
    H = beta / s * math.sin(b) / (math.cosh(a) + math.cos(b))
    forced = Y / math.sqrt((1 - r**2) ** 2 + (2 * zeta * r) ** 2)
    x_f = friction / STIFFNESS
    x = math.sqrt(forced**2 - (H * x_f) ** 2) - G * x_f
    best = None
    for sign in (1, -1):  # the one that reaches the other turning point
        angle = math.atan2(sign * H * x_f, x + G * x_f)
        A = x - x_f - forced * math.cos(angle)
        B = (zeta * wn * A + omega * forced * math.sin(angle)) / (s * wn)

        def position(t, A=A, B=B, angle=angle):
            return x_f + forced * math.cos(omega * t + angle) + math.exp(-zeta * wn * t) * (A * math.cos(s * wn * t) + B * math.sin(s * wn * t))

        miss = abs(position(math.pi / omega) + x)
        if best is None or miss < best[0]:
            best = miss, angle, position
    miss, angle, position = best
    assert miss < 1e-9 * x, miss
    n = 400  # Simpson's rule over the half period
    cosine = sine = 0.0
    for i in range(n + 1):
        weight = (1 if i in (0, n) else 4 if i % 2 else 2) / (3 * n) * 2
        value = position(i / n * math.pi / omega)
        cosine += weight * value * math.cos(math.pi * i / n)
        sine += weight * value * math.sin(math.pi * i / n)
    drive = angle + math.atan2(2 * zeta * r, 1 - r**2)
    return x, (drive + math.atan2(sine, cosine)) % (2 * math.pi)


def nearest(data, deviations, levels, omega):
    """Distance and the (zeta, F0) of the least-squares Coulomb + viscous motion, over the truth less 1."""

    def residuals(p):
        readings = [value for Y in levels for value in steady_state(ZETA * math.exp(p[0]), F0 * math.exp(p[1]), Y, omega)]
        return [(d - f) / s for d, f, s in zip(data, readings, deviations)]

    p = [0.0, 0.0]
    for _ in range(30):
        here, h = residuals(p), 1e-6
        J = [[(t - r) / h for t, r in zip(residuals([p[0] + h * (j == 0), p[1] + h * (j == 1)]), here)] for j in (0, 1)]
        (aa, ab), bb = [sum(u * v for u, v in zip(J[0], J[k])) for k in (0, 1)], sum(v * v for v in J[1])
        ga, gb = (-sum(u * r for u, r in zip(J[k], here)) for k in (0, 1))
        determinant = aa * bb - ab * ab
        p = [p[0] + (bb * ga - ab * gb) / determinant, p[1] + (aa * gb - ab * ga) / determinant]
    return math.sqrt(sum(r * r for r in residuals(p))), math.exp(p[0]) - 1, math.exp(p[1]) - 1
