#!/usr/bin/env python3
"""A method outside: the straight line x = a + b Y through each case, by which Den Hartog's resonance law gives zeta and F0.

usage: answers.py EXPORT ANSWERS.csv
"""
import csv, math, sys
from pathlib import Path

with open(Path(sys.argv[1]) / "constants.csv") as constants, open(sys.argv[2], "w", newline="") as out:
    answers = csv.writer(out)
    answers.writerow(["case", "zeta", "F0", "zeta_low", "zeta_high", "F0_low", "F0_high"])
    for known in csv.DictReader(constants):
        with open(Path(sys.argv[1]) / "cases" / f"{int(known['case']):06d}.csv") as file:
            pairs = [(float(row["Y [m]"]), float(row["x [m]"])) for row in csv.DictReader(file)]
        if len(pairs) < 3:
            continue  # too little could be measured: no answer
        Y, x = zip(*pairs)
        n, mean_Y, mean_x = len(Y), sum(Y) / len(Y), sum(x) / len(x)
        S = sum((v - mean_Y) ** 2 for v in Y)
        b = sum((v - mean_Y) * (w - mean_x) for v, w in zip(Y, x)) / S
        a = mean_x - b * mean_Y
        deviation = math.sqrt(sum((w - a - b * v) ** 2 for v, w in zip(Y, x)) / (n - 2))
        zeta = 1 / (2 * b)  # at resonance x = (Y - (4/pi) F0/k)/(2 zeta), to first order in zeta
        F0 = -a / b * math.pi / 4 * float(known["stiffness [N/m]"])
        spread_zeta, spread_F0 = 2 * deviation / math.sqrt(S) / b * zeta, 2 * deviation * math.sqrt(1 / n + mean_Y**2 / S) / -a * F0
        answers.writerow([known["case"], zeta, F0, zeta - abs(spread_zeta), zeta + abs(spread_zeta), F0 - abs(spread_F0), F0 + abs(spread_F0)])
