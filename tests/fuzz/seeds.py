#!/usr/bin/env python3
"""Good inputs, and the cases of the campaigns: mutated inputs with the command lines that read them.

usage: seeds.py ROOT DIR    writes the seeds of each harness to DIR/NAME
"""

import functools
import json
import random
import struct
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from execution import ENDS
from mutations import Corpus, damaged, hostile_number, mutated_table, neighbour, on_one_line

RIG = ["--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "6.1739 Hz"]
SLOW_RIG = ["--mass", "2 kg", "--stiffness", "19.739 N/m"]
METHODS = {"pairs": ["den_hartog_fit", "resonance_least_squares", "energy_balance"], "history": ["free_decay", "jacobsen_ayre"]}
QUANTITIES = ["1.042 kg", "1568 N/m +- 8 N/m", "6.17 Hz", "4 N.s/m", "90 deg", "3 um", "1e-3", "(1.042 ± 0.005) kg", "2.5 mm/V ± 1 %", "60 rpm", "1 m/s^2",
              "0.5 %", "4 N s m^-1", "1 kg.m^2", "5 N.m/rad", "-0.5 m", "1.0e-05 µm", "12 N/mm", "3 lb", "2 °"]
ANSWERS = "case,zeta,F0,zeta_low,zeta_high,F0_low,F0_high,p_value,usable\n" + "".join(
    f"{i},0.{i},{i}.5,0.{i},0.{i}5,{i},{i + 1},0.{i},{'yes' if i % 2 else 'no'}\n" for i in range(1, 10))

# Small enough to be finished in a second; what it leaves is mutated and gone on with.
SWEEP = """schema: dualdamp/1
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.0987, friction: {law: coulomb, kinetic: 4.39 N}}
excitation: {type: base_harmonic, amplitude: 5 mm, frequency: natural}
analysis: {type: steady_state}
sweep: {system.friction.kinetic: [1 N, 2.5 N, 4 N], excitation.frequency: [5.1 Hz, 6.3 Hz]}
"""


@dataclass
class Step:
    what: str
    arguments: list
    names: list  # one of them stands in the first line of a refusal
    out: str = ""
    ends: set = field(default_factory=lambda: ENDS)


@dataclass
class Case:
    name: str
    files: dict
    steps: list
    budget: int = 4  # s of processor time of one step


# Of the sweep of the harness `resume`: a point that is whole, one that has failed, one that holds something else.
POINTS = ('{"case":0,"values":{"system.friction.kinetic":1.0},"status":0,"result":{"peak":0.1,"sticks":[]}}\n'
          '{"case":1,"values":{"system.friction.kinetic":1.5},"status":4,"result":null,"reason":"none","warnings":["a"]}\n'
          '{"case":2,"result":[1e308,null,{"peak":"x"}],"status":"no"}\n')


@functools.lru_cache
def scenarios(root):
    folders = ("scenarios/examples", "scenarios/paper", "tests/valid")
    return Corpus([path.read_text() for folder in folders for path in sorted(Path(root, folder).glob("*.yaml"))])


@functools.lru_cache
def shipped_data(root):
    return {path.name: path.read_bytes() for folder in ("examples", "paper") for path in sorted(Path(root, "scenarios", folder).glob("*.csv"))}


@functools.lru_cache
def laboratory_files(root):
    """(name, content, options) of files as laboratories write them."""
    sys.path.insert(0, str(Path(root, "tests/cli")))
    import laboratory_formats as formats

    rows = [(name, content if isinstance(content, bytes) else content.encode(), RIG if expected == formats.PAIRS else SLOW_RIG, options, expected)
            for name, content, options, expected in formats.ACCEPTED]
    return [(name, content, [*rig, *options], "pairs" if expected == formats.PAIRS else "history") for name, content, rig, options, expected in rows]


def scenario_case(root, seed, number, _):
    random_ = random.Random(f"scenario {seed} {number}")
    corpus = scenarios(root)
    text = corpus.mutant(random_, random_.choice(corpus.texts))
    files = {**shipped_data(root), "case.yaml": text.encode("utf-8", "surrogatepass")}
    names = list(files)
    return Case(f"scenario-{seed}-{number}", files, [
        Step("check", ["run", "--dry-run", "case.yaml"], names),
        Step("run", ["run", "--quiet", "--jobs", "1", "--out", "out", "case.yaml"], names, "out")])


# Analyses of motions: a second computation of each must agree.
VERIFIED = {"simulate", "steady_state", "xy_curve", "frequency_response", "regime_map", "free_decay"}


def neighbour_case(root, seed, number, _):
    random_ = random.Random(f"neighbour {seed} {number}")
    scenario = neighbour(random_, random_.choice(scenarios(root).texts))
    files = {**shipped_data(root), "case.yaml": on_one_line(scenario).encode()}
    verify = ["--verify"] if scenario["analysis"]["type"] in VERIFIED and "sweep" not in scenario else []
    return Case(f"neighbour-{seed}-{number}", files, [
        Step("run", ["run", *verify, "--quiet", "--jobs", "1", "--out", "out", "case.yaml"], list(files), "out", ENDS - {1})], 60)


def data_case(root, seed, number, _):
    random_ = random.Random(f"data {seed} {number}")
    name, content, options, kind = random_.choice(laboratory_files(root))
    content = (damaged if name.endswith(".mat") else mutated_table)(random_, content)
    if random_.random() < 0.2 and options:
        options = list(options)
        at = random_.randrange(1, len(options), 2)
        options[at] = hostile_number(random_, options[at].split(" ")[0]) + " " + options[at].partition(" ")[2]
    return Case(f"data-{seed}-{number}", {name: content}, [
        Step("identify", ["identify", name, *options, "--quiet", "--out", "out", "--method", random_.choice(METHODS[kind])], [name, "--"], "out", ENDS | {2})])


@functools.lru_cache
def finished(program, root):
    """What runs leave behind: {name: {file: content}} of a sweep, a fit and a curve."""
    found = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "sweep.yaml").write_text(SWEEP)
        for example in ("fit.yaml", "coulomb.yaml", "xy_curve.yaml", "identify_free_decay.yaml"):
            (folder / example).write_bytes(Path(root, "scenarios/examples", example).read_bytes())
        for name, content in shipped_data(root).items():
            (folder / name).write_bytes(content)
        for scenario in ("sweep", "coulomb", "xy_curve", "identify_free_decay"):
            subprocess.run([program, "run", "--quiet", f"{scenario}.yaml", "--out", scenario], cwd=folder, check=True, capture_output=True)
            found[scenario] = {path.name: path.read_bytes() for path in (folder / scenario).iterdir() if path.name != "report.html"}
    return found


def result_case(root, seed, number, program):
    """Damaged results of earlier runs: `report`, and `run --resume`."""
    random_ = random.Random(f"result {seed} {number}")
    name = random_.choice(sorted(finished(program, root)))
    files = {f"results/{file}": content for file, content in finished(program, root)[name].items()}
    resumes = name == "sweep" and random_.random() < 0.7
    chosen = "results/points.jsonl" if resumes else random_.choice(sorted(files))
    files[chosen] = mutated_table(random_, files[chosen])
    if resumes:
        files["sweep.yaml"] = SWEEP.encode()
        return Case(f"result-{seed}-{number}", files, [
            Step("resume", ["run", "--resume", "--quiet", "--out", "results", "sweep.yaml"], ["results/"], "results")])
    return Case(f"result-{seed}-{number}", files, [Step("report", ["report", "results"], ["results"])])


KINDS = {"scenario": scenario_case, "neighbour": neighbour_case, "data": data_case, "result": result_case}


def case(kind, root, seed, number, program):
    return KINDS[kind](root, seed, number, program)


def sent_columns():
    """What the process that has read a MATLAB file sends: one test of two columns, labels of rows, a warning, a unit."""
    def number(value):
        return struct.pack("<Q", value)

    def text(value):
        return number(len(value)) + value.encode()

    def column(index, values):
        return number(index) + number(len(values)) + struct.pack(f"<{len(values)}d", *values)

    test = text("1") + number(2) + column(0, [0.0, 0.1, 0.2]) + column(2, [1.0, -0.5, 0.25])
    labels = number(1) + number(2) + text("a") + number(0) + text("b") + number(2)
    units = number(1) + text("x") + number(1) + text("t") + text("ms")
    return number(1) + number(1) + test + labels + number(1) + text("a warning") + units


def write_seeds(root, folder):
    def write(harness, name, content):
        path = Path(folder, harness, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())

    for i, text in enumerate(QUANTITIES):
        write("numbers", f"{i}", text)
        write("units", f"{i}", bytes([i]) + text.encode())
    for i, text in enumerate(scenarios(root).texts):
        write("scenario", f"{i}.yaml", text)
    for i, (name, content, _, _) in enumerate(laboratory_files(root)):
        if name.endswith(".mat"):
            write("mat", name, b"\0" + content)
        else:
            write("records", name, bytes([64 * (i % 5 == 0)]) + content[:4000])
    write("mat", "sent", b"\1" + sent_columns())
    write("mat", "empty", b"\1" + struct.pack("<6Q", 1, 1, 0, 1, 0, 0))  # a column without values
    write("mat", "problem", b"\1" + struct.pack("<3Q", 2, 1, 4) + b"file" + struct.pack("<Q", 5) + b"wrong" + bytes(32))
    write("resume", "points", POINTS)
    write("resume", "parts", POINTS[:POINTS.index("\n") + 1] + "\0" + POINTS)
    random_ = random.Random("seeds")
    for i in range(60):
        write("engines", f"{i}", random_.randbytes(160))
        write("plugin", f"{i}", bytes(min(random_.randrange(256), 199 if i % 2 else 255) for _ in range(120)))
    write("plugin", "sound", bytes(120))
    write("answers", "answers.csv", ANSWERS)
    write("answers", "large", ANSWERS + "\0" + json.dumps({"scenario": "0" * 64, "seed": 7, "numbers": [1, 1e126]}))
    write("answers", "key", ANSWERS + "\0" + json.dumps({"scenario": "0" * 64, "seed": 7, "numbers": list(range(8, -1, -1))}))


def write_scenario_mutants(root, folder, seed, count):
    """Mutants by structure, for the harness of scenarios, whose own mutations are of bytes."""
    for number in range(count):
        case_ = scenario_case(root, seed, number, "")
        Path(folder, "scenario", f"mutant{number}.yaml").write_bytes(case_.files["case.yaml"])


if __name__ == "__main__":
    write_seeds(sys.argv[1], sys.argv[2])
