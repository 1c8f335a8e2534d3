#!/usr/bin/env python3
"""What the machine refuses: full disks, places that cannot be written, little memory, signals at any time.

usage: test_limits.py PROGRAM ROOT [TEST...]; DUALDAMP_TRIES: how often each is tried (default 1)

Whatever happens, no file under its final name is half-written: documents parse, tables end with their last row.
"""

import hashlib
import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()
TRIES = int(os.environ.get("DUALDAMP_TRIES", "1"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
from execution import BUG
from seeds import SWEEP

RIG = """schema: dualdamp/1
system: {mass: 1.042 kg, stiffness: 1568 N/m, damping_ratio: 0.0987, friction: {law: coulomb, kinetic: 4.39 N}}
excitation: {type: base_harmonic, amplitude: 5 mm, frequency: natural}
"""
CURVE = RIG + "analysis: {type: xy_curve, amplitudes: {from: 5 mm, to: 9 mm, count: 400}}\n"
FREE = RIG.replace("excitation: {type: base_harmonic, amplitude: 5 mm, frequency: natural}", "excitation: {type: none}\ninitial: {position: 0.1 m}")
COMMANDS = {
    "xy_curve": CURVE,
    "simulate": RIG + "analysis: {type: simulate, cycles: 200, sample_rate: 500 Hz}\n",
    "sweep": SWEEP.replace("[1 N, 2.5 N, 4 N]", "{from: 1 N, to: 4 N, count: 60}"),
    "identify": RIG.replace("amplitude: 5 mm, ", "") + "analysis: {type: identify, measurement: {type: xy_curve, amplitudes: [4.4 mm, 5 mm, 6 mm, 7 mm]}}\n",
    "fit": (ROOT / "scenarios/examples/fit.yaml").read_text(),
    "stress": (ROOT / "scenarios/stress/small.yaml").read_text(),
}


def wait_until_it_heeds_signals(process):
    """Waits until the program blocks SIGTERM to handle it itself, or has ended; before that the signal ends any process."""
    status, bit = Path(f"/proc/{process.pid}/status"), 1 << (signal.SIGTERM - 1)
    while process.poll() is None and not int(re.search(r"SigBlk:\s*(\w+)", status.read_text()).group(1), 16) & bit:
        time.sleep(0.005)


def with_disk_of(most):
    """A limit on the size of files, which stands for a full disk."""
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        if os.environ.get("DUALDAMP_SANITIZED"):  # its runtime writes a file of its own before the program ignores this signal
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    return limit


class Limits(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.folder.chmod(0o777)
        for name, text in COMMANDS.items():
            (self.folder / f"{name}.yaml").write_text(text)
        for path in (ROOT / "scenarios/examples").glob("*.csv"):
            (self.folder / path.name).write_bytes(path.read_bytes())
        self.random = random.Random(1)

    def run_limited(self, name, limit, out="out"):
        result = subprocess.run([PROGRAM, "run", f"{name}.yaml", "--out", out], cwd=self.folder, capture_output=True, text=True, timeout=300, preexec_fn=limit)
        self.assertIsNone(BUG.search(result.stderr), result.stderr)
        return result

    def check_whole(self, out="out", partial=False):
        """Every file under its final name; `partial`: what a killed program was writing may lie beside them."""
        for path in sorted((self.folder / out).glob("*")) if (self.folder / out).is_dir() else []:
            if path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix == ".csv":
                lines = path.read_text().split("\n")
                self.assertEqual(lines[-1], "", path)
                rows = [line for line in lines[:-1] if not line.startswith("#")]
                if '"' not in path.read_text():
                    self.assertEqual({row.count(",") for row in rows}, {rows[0].count(",")}, path)
            elif path.suffix == ".yaml":
                seal, text = path.read_bytes().split(b"\n", 1)
                self.assertTrue(seal.decode().endswith(hashlib.sha256(text).hexdigest()), path)
            elif path.suffix == ".html":
                self.assertTrue(path.read_text().rstrip().endswith("</html>"), path)
            elif path.suffix != ".jsonl":
                self.assertTrue(partial and path.name.endswith(".partial"), path)

    def test_a_disk_that_is_full_at_any_byte(self):
        """2 and a message, never half a file, and the whole result of the run before."""
        self.run_limited("xy_curve", None, "whole")
        before = {path.name: path.read_bytes() for path in (self.folder / "whole").iterdir()}
        sizes = [len(content) for content in before.values()]
        # A run's name and duration change the size of its files by some bytes.
        for most in [0, 1, 4096, *[size - 200 for size in sizes], *[self.random.randrange(max(sizes)) for _ in range(TRIES)]]:
            with self.subTest(most):
                result = self.run_limited("xy_curve", with_disk_of(most), "whole")
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("cannot write", result.stderr)
                self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "whole").iterdir()}, before)

    def test_a_disk_that_is_full_while_a_campaign_writes_its_cases(self):
        for most in [0, 100, *[self.random.randrange(20_000) for _ in range(TRIES)]]:
            with self.subTest(most):
                result = self.run_limited("sweep", with_disk_of(most), f"out{most}")
                self.assertEqual(result.returncode, 2, result.stderr)
                self.check_whole(f"out{most}")

    def test_places_that_cannot_be_written(self):
        (self.folder / "file").write_text("mine")
        for out in ("/proc/self/out", "/sys/out", "/dev/null/out", "file", "file/out", "x" * 300, "a/" * 3000):
            with self.subTest(out[:20]):
                result = self.run_limited("xy_curve", None, out)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("cannot", result.stderr)
        self.assertEqual((self.folder / "file").read_text(), "mine")

    def test_a_place_that_vanishes(self):
        for _ in range(TRIES):
            process = subprocess.Popen([PROGRAM, "run", "--quiet", "sweep.yaml", "--out", "out"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            time.sleep(self.random.uniform(0.02, 0.3))
            subprocess.run(["rm", "-rf", "out"], cwd=self.folder, check=False)
            _, errors = process.communicate(timeout=120)
            self.assertIn(process.returncode, (0, 2, 3), errors)
            self.assertIsNone(BUG.search(errors.decode()), errors)
            self.check_whole()
            subprocess.run(["rm", "-rf", "out"], cwd=self.folder, check=True)

    def test_few_file_descriptors(self):
        """2 with the reason of the system, never 3 or a word about the content; enough of them: as without the limit."""
        (self.folder / "good.yaml").write_text(RIG + "analysis: {type: steady_state}\n")
        (self.folder / "short.yaml").write_text(RIG + "analysis: {type: steady_state}\nsweep: {system.friction.kinetic: [1 N, 2 N]}\n")
        record = "Y [mm],x [mm]\n5,6.5\n6,9\n7,11.6\n8,14.2\n"
        (self.folder / "pairs.csv").write_text(record)
        # One method: others open no more files, and take time.
        rig = ["--mass", "1.042 kg", "--stiffness", "1568 N/m", "--frequency", "natural", "--method", "den_hartog_fit"]

        def run(most, arguments):
            return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (most, most)))

        run(100, ["run", "short.yaml", "--out", "there"])
        for name, arguments in {"run": ["run", "good.yaml", "--out", "out"], "sweep": ["run", "short.yaml", "--out", "out"], "resume": ["run", "short.yaml", "--out", "there", "--resume"],
                                "again": ["run", "good.yaml", "--out", "again"], "report": ["report", "there"], "compare": ["compare", "there", "there", "--out", "both"],
                                "identify": ["identify", "pairs.csv", *rig, "--out", "out"], "check": ["check", "good.yaml"]}.items():
            subprocess.run(["rm", "-rf", "again"], cwd=self.folder, check=True)
            run(100, ["run", "short.yaml", "--out", "again"])
            endings = []
            for most in (4, 5, 6, 7, 12):
                with self.subTest(f"{name} {most}"):
                    result = run(most, arguments)
                    endings.append(result.returncode)
                    if result.returncode == 127:  # the loader of the system
                        continue
                    self.assertIsNone(BUG.search(result.stderr), result.stderr)
                    if result.returncode != 0:
                        self.assertEqual(result.returncode, 2, result.stderr)
                        self.assertIn("Too many open files", result.stderr)
                    self.assertEqual([path for path in self.folder.glob("*/*~")], [], result.stderr)
            with self.subTest(name):
                self.assertEqual((endings[-1], endings == sorted(endings, reverse=True)), (0, True), endings)
                self.assertIn(2, endings)

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_files_without_permission(self):
        for name in ("good.yaml", "pairs.csv"):
            (self.folder / name).write_text("")
            (self.folder / name).chmod(0)
        for arguments in (["run", "good.yaml"], ["check", "good.yaml"], ["identify", "pairs.csv", "--mass", "1 kg", "--stiffness", "1 N/m"]):
            result = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("Permission denied", result.stderr)

    @unittest.skipIf("DUALDAMP_SANITIZED" in os.environ, "a sanitizer reserves terabytes of addresses")
    def test_little_memory(self):
        """From the least with which the program can be loaded upwards."""

        def run(megabytes, *arguments):
            return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20)))

        least = next(megabytes for megabytes in range(20, 1000, 2) if run(megabytes, "--version").returncode == 0)
        for name in ("xy_curve", "identify"):
            statuses = []
            for more in [*range(0, 30, max(10 // TRIES, 1)), 600]:
                with self.subTest(f"{name} {more}"):
                    result = run(least + more, "run", f"{name}.yaml", "--out", "out")
                    statuses.append(result.returncode)
                    self.assertIn(result.returncode, (0, 2), result.stderr)
                    self.assertIsNone(BUG.search(result.stderr), result.stderr)
                    self.check_whole()
            self.assertEqual((statuses[0], statuses[-1]), (2, 0))

    @unittest.skipIf("DUALDAMP_SANITIZED" in os.environ, "a sanitizer needs more stack")
    def test_small_stack(self):
        """Below 256 kB a message instead of SIGSEGV, from there on the result."""
        for kilobytes, status in ((32, 2), (128, 2), (255, 2), (256, 0)):
            with self.subTest(kilobytes):
                result = self.run_limited("fit", lambda most=kilobytes << 10: resource.setrlimit(resource.RLIMIT_STACK, (most, most)), "out")
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertEqual("stack is limited" in result.stderr, status == 2, result.stderr)
                self.check_whole()

    @unittest.skipIf("DUALDAMP_SANITIZED" in os.environ, "a sanitizer reserves terabytes of addresses")
    def test_no_thread_to_be_had(self):
        """A stack for each thread that is larger than all memory: the loops run on the first thread."""

        def no_threads():
            resource.setrlimit(resource.RLIMIT_STACK, (1 << 42, resource.RLIM_INFINITY))
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))

        for name in ("xy_curve", "fit", "stress"):
            with self.subTest(name):
                tables = []
                for out, limit in ((f"{name}-many", None), (f"{name}-one", no_threads)):
                    result = self.run_limited(name, limit, out)
                    self.assertIn(result.returncode, (0, 5), result.stderr)
                    self.check_whole(out)
                    tables.append(json.loads((self.folder / out / "result.json").read_text())["result"])
                self.assertEqual(*tables)

    def interrupted(self, number, statuses):
        for name in COMMANDS:
            for _ in range(max(TRIES // 3, 1)):
                with self.subTest(name):
                    process = subprocess.Popen([PROGRAM, "run", "--quiet", f"{name}.yaml", "--out", "out"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                               stderr=subprocess.PIPE)
                    wait_until_it_heeds_signals(process)
                    time.sleep(self.random.uniform(0.0, 1.1))
                    process.send_signal(number)
                    _, errors = process.communicate(timeout=120)
                    self.assertIn(process.returncode, statuses, errors)
                    self.check_whole(partial=number == signal.SIGKILL)
                    subprocess.run(["rm", "-rf", "out"], cwd=self.folder, check=True)

    def test_interrupted_at_any_time(self):
        self.interrupted(signal.SIGINT, (0, 130))

    def test_terminated_at_any_time(self):
        self.interrupted(signal.SIGTERM, (0, 130))

    def test_killed_at_any_time(self):
        self.interrupted(signal.SIGKILL, (0, -signal.SIGKILL))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
