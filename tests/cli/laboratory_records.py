"""Records of a rig with Coulomb and viscous friction, known in closed form, and the files that laboratories make of them."""

import cmath
import math
import random
import struct

MASS, STIFFNESS, ZETA, FRICTION = 1.042, 1568.0, 0.12, 3.7
OMEGA = math.sqrt(STIFFNESS / MASS)
FREQUENCY = OMEGA / (2 * math.pi)
X_F = FRICTION / STIFFNESS
PERIOD = 2 * math.pi / (OMEGA * math.sqrt(1 - ZETA**2))


def pairs():
    """Y and x in metres at resonance, by Den Hartog's law: (x + G x_f)^2 + H^2 x_f^2 = (Y / 2 zeta)^2."""
    s = math.sqrt(1 - ZETA**2)
    a, b = math.pi * ZETA, math.pi * s
    g = (math.sinh(a) - ZETA / s * math.sin(b)) / (math.cosh(a) + math.cos(b))
    h = math.sin(b) / s / (math.cosh(a) + math.cos(b))
    return [(y, math.sqrt((y / (2 * ZETA)) ** 2 - (h * X_F) ** 2) - g * X_F) for y in (0.0044, 0.0048, 0.0052, 0.0056, 0.006, 0.0064)]


def phases():
    """How far x lags behind y at each of the pairs, in degrees: harmonics of the motion that turns back at t = 0."""
    drag = 2 * ZETA * STIFFNESS
    square = 4 * FRICTION / math.pi
    further = ((h, -1j * square / h / (STIFFNESS * (1 - h * h) + 1j * h * drag)) for h in range(3, 20001, 2))
    turn = -sum(h * harmonic.imag for h, harmonic in further)
    lags = []
    for y, _ in pairs():
        base = STIFFNESS * y * cmath.exp(1j * (math.pi / 2 + math.asin(drag * turn / (STIFFNESS * y))))
        lags.append(math.degrees(cmath.phase(base / ((base / 1j - square) / drag))))
    return lags


# A slow pendulum-like rig for decays, so that coarse clocks resolve it.
SLOW = {"mass": 2.0, "stiffness": 2.0 * (2 * math.pi * 0.5) ** 2, "zeta": 0.02, "friction": 0.05}


def decay(times, rig=SLOW, start=0.1, held=0.0):
    """x of a free vibration released from `start` at the time `held`: half swing after half swing about its shifted middle."""
    omega = math.sqrt(rig["stiffness"] / rig["mass"])
    x_f = rig["friction"] / rig["stiffness"]
    damped = omega * math.sqrt(1 - rig["zeta"] ** 2)
    half = math.pi / damped
    ratio = math.exp(-math.pi * rig["zeta"] / math.sqrt(1 - rig["zeta"] ** 2))
    extremes = [start]
    while abs(extremes[-1]) > x_f:
        middle = math.copysign(x_f, extremes[-1])
        extremes.append(middle - (extremes[-1] - middle) * ratio)
    values = []
    for t in times:
        n, s = divmod(t - held, half)
        if t <= held or n + 1 >= len(extremes):
            values.append(start if t <= held else extremes[-1])
            continue
        middle = math.copysign(x_f, extremes[int(n)])
        tail = math.exp(-rig["zeta"] * omega * s) * (math.cos(damped * s) + rig["zeta"] * omega / damped * math.sin(damped * s))
        values.append(middle + (extremes[int(n)] - middle) * tail)
    return values


def forced(force, rate, count, rig):
    """t, x, v, a and force of a mass that begins at rest: Runge and Kutta between the rests of rigid friction."""
    mass, stiffness, damping, friction, static = (rig[name] for name in ("mass", "stiffness", "damping", "friction", "static"))
    steps = 40
    h = 1 / rate / steps

    def slope(t, x, v, side):
        return v, (force(t) - stiffness * x - damping * v - side * friction) / mass

    x = v = 0.0
    side = 0  # 0: at rest
    rows = []
    for i in range(count * steps):
        t = i * h
        if side == 0 and abs(force(t) - stiffness * x) > static:
            side = 1 if force(t) > stiffness * x else -1
        if i % steps == 0:
            rows.append((t, x, v, slope(t, x, v, side)[1] if side else 0.0, force(t)))
        if side == 0:
            continue
        k1 = slope(t, x, v, side)
        k2 = slope(t + h / 2, x + h / 2 * k1[0], v + h / 2 * k1[1], side)
        k3 = slope(t + h / 2, x + h / 2 * k2[0], v + h / 2 * k2[1], side)
        k4 = slope(t + h, x + h * k3[0], v + h * k3[1], side)
        x += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        v += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
        if side * v < 0.0:
            rest = abs(force(t + h) - stiffness * x) <= static
            side = 0 if rest else -side
            v = 0.0 if rest else v
    return rows


def rough(values, share=5e-4, seed=11):
    """With noise of this share of the largest value."""
    draws = random.Random(seed)
    size = max(map(abs, values)) * share
    return [value + draws.gauss(0.0, size) for value in values]


def table(head, rows, separator=",", form="{:.6f}", end="\n", comma=False):
    """A CSV text; `comma`: decimal commas."""
    lines = [head] if head else []
    for row in rows:
        fields = [value if isinstance(value, str) else form.format(value) for value in row]
        lines.append(separator.join(field.replace(".", ",") if comma else field for field in fields))
    return end.join(lines) + end


def mat4(name, values, kind=0, rows=None):
    """A matrix of MATLAB 4; `kind`: 0 doubles, 30 16-bit integers."""
    rows = len(values) if rows is None else rows
    head = struct.pack("<5i", kind, rows, len(values) // rows, 0, len(name) + 1)
    return head + name.encode() + b"\0" + struct.pack(f"<{len(values)}{'h' if kind == 30 else 'd'}", *values)


def element5(kind, content):
    return struct.pack("<2I", kind, len(content)) + content + bytes(-len(content) % 8)


def matrix5(name, values, rows=None, kind="d"):
    """A matrix of MATLAB 5: doubles or 16-bit integers."""
    rows = len(values) if rows is None else rows
    array, number = {"d": (6, 9), "h": (10, 3)}[kind]
    return element5(14, element5(6, struct.pack("<2I", array, 0)) + element5(5, struct.pack("<2i", rows, len(values) // rows))
                    + element5(1, name.encode()) + element5(number, struct.pack(f"<{len(values)}{kind}", *values)))


def struct5(name, elements):
    """A struct array of MATLAB 5; each element maps fields to vectors."""
    fields = list(elements[0])
    content = element5(6, struct.pack("<2I", 2, 0)) + element5(5, struct.pack("<2i", 1, len(elements))) + element5(1, name.encode())
    content += struct.pack("<HHI", 5, 4, 32) + element5(1, b"".join(field.encode().ljust(32, b"\0") for field in fields))
    for values in elements:
        content += b"".join(matrix5("", values[field]) for field in fields)
    return element5(14, content)


def mat5(*elements):
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"".join(elements)


def uff58(name, values, step, unit="m", quantity=8, time_unit="s"):
    lines = ["    -1", "    58", name, "NONE", "NONE", "NONE", "NONE"]
    lines.append(f"{1:5d}{1:10d}{0:5d}{0:10d} {name:10s}{1:10d}{3:4d} {'NONE':10s}{0:10d}{0:4d}")
    lines.append(f"{4:10d}{len(values):10d}{1:10d}{0:13.5E}{step:13.5E}{0:13.5E}")
    lines.append(f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':20s} {time_unit:20s}")
    lines.append(f"{quantity:10d}{0:5d}{0:5d}{0:5d} {name:20s} {unit:20s}")
    lines += [f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {'NONE':20s}"] * 2
    lines += ["".join(f"{value:20.12E}" for value in values[i:i + 4]) for i in range(0, len(values), 4)]
    return "\n".join([*lines, "    -1", ""])
