"""The commands of the campaign of faults, and what their directories hold before a command and after it."""

import hashlib
import json
import re
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

RIG = """schema: dualdamp/1
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.0987, friction: {law: coulomb, kinetic: 4.39 N}}
excitation: {type: base_harmonic, amplitude: 5 mm, frequency: natural}
"""
FREE = RIG.replace("amplitude: 5 mm, ", "")
PAIRS = "Y [mm],x [mm]\n" + "".join(f"{4 + i / 4},{4 + 0.65 * i}\n" for i in range(2, 12))
SCENARIOS = {
    "simulate": RIG + "analysis: {type: simulate, cycles: 60, sample_rate: 500 Hz}\n",
    "steady_state": RIG + "analysis: {type: steady_state}\n",
    "xy_curve": RIG + "analysis: {type: xy_curve, amplitudes: {from: 5 mm, to: 9 mm, count: 100}}\n",
    "frequency_response": RIG + "analysis: {type: frequency_response, frequencies: {from: 5 Hz, to: 8 Hz, count: 60}}\n",
    "regime_map": FREE.replace("frequency: natural", "").replace(", }", "}") + "analysis: {type: regime_map, frequencies: {from: 2 Hz, to: 8 Hz, count: 30}, amplitudes: {from: 3 mm, to: 9 mm, count: 30}}\n",
    "identify": FREE + "analysis: {type: identify, methods: [den_hartog_fit, resonance_least_squares], measurement: {type: xy_curve, amplitudes: [4.4 mm, 5 mm, 6 mm, 7 mm]}}\n",
    "sweep": RIG + "analysis: {type: steady_state}\nsweep: {system.friction.kinetic: {from: 1 N, to: 4 N, count: 200}}\n",
}
CONSTANTS = ["--mass", "1.042 kg", "--stiffness", "1568 N/m"]


@dataclass
class Command:
    """`earlier`: commands that leave the results which lie there when the fault comes; `places`: what is written."""
    name: str
    arguments: list
    places: list = field(default_factory=list)
    earlier: list = field(default_factory=list)
    status: int = 0
    is_campaign: bool = False  # has cases that outlast an end at any time


def commands():
    def run(name, *options):
        return ["run", f"{name}.yaml", "--out", "out", *options]

    other = ["--set", "system.friction.kinetic=4.2 N"]
    identify = ["identify", "pairs.csv", *CONSTANTS, "--frequency", "natural"]
    fit = ["fit", "coulomb,asymmetric_coulomb", "free_run.csv", "--mass", "1 kg", "--stiffness", "1000 N/m"]
    predict = ["predict", "fitted", "other_run.csv"]
    result = ["run", "xy_curve.yaml", "--out", "first"]
    second = ["run", "xy_curve.yaml", "--out", "second", *other]
    yield from (Command(f"run {name}", run(name), ["out"], [run(name, *other)]) for name in SCENARIOS if name != "sweep")
    yield Command("run --plot", run("xy_curve", "--plot", "chart.svg"), ["out", "chart.svg"], [run("xy_curve", "--plot", "chart.svg", *other)])
    yield Command("run --mat", run("simulate", "--mat", "run.mat"), ["out", "run.mat"], [run("simulate", "--mat", "run.mat", *other)])
    yield Command("run --json", run("simulate", "--json"), ["out"], [run("simulate", *other)])
    yield Command("run --verify", run("xy_curve", "--verify"), ["out"], [run("xy_curve", *other)])
    yield Command("run several", ["run", "simulate.yaml", "xy_curve.yaml", "identify.yaml", "--out", "all", "--jobs", "2"],
                  ["all/simulate", "all/xy_curve", "all/identify"], [["run", "simulate.yaml", "xy_curve.yaml", "--out", "all", *other]])
    yield Command("run isolated", ["--isolate-plugins=60", *run("xy_curve")], ["out"], [run("xy_curve", *other)])
    yield Command("run sweep", run("sweep"), ["out"], is_campaign=True)
    yield Command("run sweep --overwrite", run("sweep", "--overwrite"), ["out"], [run("sweep", *other, "--set", "sweep={excitation.amplitude: [5 mm, 6 mm]}")], is_campaign=True)
    yield Command("run stress", run("small"), ["out"], is_campaign=True)
    yield Command("run fit", run("fit"), ["out"], [run("fit", "--set", "analysis.laws=[coulomb]")])
    yield Command("run predict", run("predict"), ["out"], [run("predict", "--set", "system.mass=1.001 kg")])
    yield Command("identify", [*identify, "--out", "out"], ["out"], [[*identify, "--method", "den_hartog_fit", "--out", "out"]])
    yield Command("fit", [*fit, "--out", "out"], ["out"], [[*fit, "--no-profile", "--out", "out"]])
    yield Command("predict", [*predict, "--out", "out"], ["out"], [[*fit, "--out", "fitted"], [*predict, "--sigma", "x=1 um", "--out", "out"]])
    yield Command("report --plot", ["report", "first", "--plot", "chart.svg", "--show-in", "um"], ["first", "chart.svg"], [result, ["report", "first", "--plot", "chart.svg"]])
    yield Command("compare", ["compare", "first", "second", "--out", "out"], ["out"], [result, second, ["compare", "second", "first", "--out", "out"]])
    yield Command("stress export", ["stress", "export", "small.yaml", "--out", "out", "--seed", "7", "--overwrite"], ["out"], [["stress", "export", "small.yaml", "--out", "out", "--seed", "8"]])
    for words in (["new", "xy_curve"], ["schema"], ["schema", "--markdown"], ["check", "small.yaml"], ["laws"], ["methods"], ["manual"], ["completion", "bash"],
                  ["laws", "coulomb", "--check", "--set", "kinetic=2 N"]):
        yield Command(" ".join(words), words)


def write_inputs(folder, root):
    for name, text in SCENARIOS.items():
        (folder / f"{name}.yaml").write_text(text)
    (folder / "small.yaml").write_text((root / "scenarios/stress/small.yaml").read_text().replace("seeds: 4", "seeds: 2").replace("equals: 40", "equals: 20"))
    for name in ("fit.yaml", "predict.yaml", "free_run.csv"):
        (folder / name).write_bytes((root / "scenarios/examples" / name).read_bytes())
    (folder / "pairs.csv").write_text(PAIRS)
    _, head, *rows = (folder / "free_run.csv").read_text().splitlines()
    later = [f"{row.split(',')[0]},{1.001 * float(row.split(',')[1])!r}" for row in rows]
    (folder / "other_run.csv").write_text("\n".join([head, *later]) + "\n")


# What differs from run to run: when and how long. The rest of a result is the same to the bit.
VARYING = re.compile(rb'^# (started|duration|source|plugin).*$|"(started|duration|source)": *("[^"]*"|[-+.e\d]+)|"sha256": *"[0-9a-f]*"', re.MULTILINE)


def plain(name, content):
    """The content without what differs from run to run."""
    if name.endswith(".json"):
        document = json.loads(content)
        document.pop("provenance", None)
        document.pop("tables", None)
        return json.dumps(document).encode()
    if name.endswith(".html"):
        return b"whole" if content.rstrip().endswith(b"</html>") else content
    return VARYING.sub(b"", content)


def files_below(folder):
    """Every file by its path; a pipe, a link or an empty folder by what it is."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            found[name] = b"link"
        elif path.is_dir():
            if not any(path.iterdir()):
                found[name + "/"] = b""
        elif path.is_file():
            found[name] = path.read_bytes()
        else:
            found[name] = b"special"
    return found


def of_place(files, place):
    """The files of one result. The cases of a campaign are no part of it: they grow while it runs. An empty folder is none either."""
    return {name: content for name, content in files.items() if (name == place or name.startswith(place + "/")) and not name.endswith((".jsonl", "/")) and "/.dualdamp.partial" not in "/" + name}


def is_same(some, others):
    if some.keys() != others.keys():
        return False
    return all(some[name] == others[name] or plain(name, some[name]) == plain(name, others[name]) for name in some)


def is_whole_line(line):
    end = line.rfind(b',"check":"')
    return line.startswith(b'{"campaign":') or (end >= 0 and line[end + 10:-2] == hashlib.sha256(line[:end]).hexdigest()[:16].encode())


class Prepared:
    """A command with its inputs, its earlier results, and the results of a run that nothing disturbed."""

    def __init__(self, program, root, command, folder):
        self.command = command
        self.before_folder = folder / "before"
        self.before_folder.mkdir(parents=True)
        write_inputs(self.before_folder, root)
        for arguments in command.earlier:
            self.call(program, arguments, self.before_folder)
        self.before = files_below(self.before_folder)
        after_folder = folder / "after"
        subprocess.run(["cp", "-r", str(self.before_folder), str(after_folder)], check=True)
        self.stdout, self.seconds = self.call(program, command.arguments, after_folder)
        self.after = files_below(after_folder)

    @staticmethod
    def call(program, arguments, folder):
        started = time.monotonic()
        result = subprocess.run([program, *arguments], cwd=folder, capture_output=True, check=False)
        seconds = time.monotonic() - started
        if result.returncode not in (0, 1, 4):  # a wrong prediction, no answer
            raise RuntimeError(f"{arguments}: {result.returncode} {result.stderr.decode()}")
        return result.stdout, seconds

    def states(self, files):
        """Of each place: whether it is as 'before', as 'after', or both; the empty set where it is neither."""
        states = []
        for place in self.command.places:
            now, before, after = (of_place(some, place) for some in (files, self.before, self.after))
            states.append({state for state, is_so in (("before", now == before), ("after", is_same(now, after))) if is_so})
        return states

    def strays(self, files):
        """Files that belong neither to the earlier nor to the new results."""
        return sorted(name for name in files if name not in self.before and name not in self.after)

    def damaged_cases(self, files):
        """Lines of cases that are not whole, but for the last one."""
        return [f"{name}:{i + 1}" for name, content in files.items() if name.endswith(".jsonl")
                for i, line in enumerate(content.split(b"\n")[:-1]) if not is_whole_line(line)]
