#!/usr/bin/env python3
"""Surroundings that must not damage a result or end the program without a message: streams, signals, little memory.

usage: test_surroundings.py PROGRAM [TEST...]
"""

import bisect
import os
import re
import resource
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from case import BASE, PATIENCE, PROGRAM, Case

LONG = BASE.replace("steady_state", "xy_curve, amplitudes: {from: 0 m, to: 0.6 m, count: 1000000}")
# Read at once, and computed for minutes.
SWEEP = BASE.replace("{law: coulomb, kinetic: 2 N}", "{law: lugre, kinetic: 2 N, static: 2.5 N, stribeck_velocity: 1 mm/s, sigma0: 1e6 N/m, sigma1: 300 N.s/m}") + (
    "sweep: {system.mass: {from: 1 kg, to: 1.1 kg, count: 400}}\n")
SANITIZED = "DUALDAMP_SANITIZED" in os.environ


class Surroundings(Case):
    def setUp(self):
        super().setUp()
        for name, text in {"base": BASE, "curve": LONG.replace("1000000", "20000"), "slower": LONG.replace("1000000", "200000"), "sweep": SWEEP, "another": SWEEP}.items():
            self.write(f"{name}.yaml", text)

    def start(self, *arguments, **options):
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, **{**streams, **options})
        self.addCleanup(process.kill)
        return process

    def wait_until(self, holds):
        deadline = time.monotonic() + PATIENCE * 60
        while not holds() and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertTrue(holds())

    def wait_until_it_watches(self, process):
        self.wait_until(lambda: int(re.search(r"SigBlk:\s*(\w+)", Path(f"/proc/{process.pid}/status").read_text()).group(1), 16) >> (signal.SIGTERM - 1) & 1)

    def test_several_files_at_once_are_interrupted(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start("run", "sweep.yaml", "another.yaml", "--jobs", "2", "--overwrite")
            self.wait_until_it_watches(process)
            time.sleep(0.3)
            process.send_signal(number)
            _, errors = process.communicate(timeout=PATIENCE * 60)
            self.assertEqual((process.returncode, errors), (130, b"interrupted\n"))

    def test_several_files_on_fewer_threads_than_asked_for(self):
        """Each thread of a size that only one has room for."""
        def no_threads():
            resource.setrlimit(resource.RLIMIT_STACK, (1 << 42, resource.RLIM_INFINITY))
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))

        self.write("second.yaml", BASE)
        if SANITIZED:
            self.skipTest("a sanitizer reserves terabytes of addresses")
        self.run_program("run", "base.yaml", "second.yaml", "--jobs", "2", preexec_fn=no_threads)
        self.assertTrue((self.folder / "results/second/report.html").exists())

    def test_a_signal_that_is_ignored_stays_ignored(self):
        """As for a command in the background of a script."""
        for isolated in ([], ["--isolate-plugins=600"]):
            with self.subTest(isolated):
                process = self.start(*isolated, "run", "sweep.yaml", "--overwrite", preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
                if not isolated:  # which waits for signals of its child, too
                    self.wait_until_it_watches(process)
                time.sleep(0.5)
                process.send_signal(signal.SIGINT)
                time.sleep(1.0)
                self.assertIsNone(process.poll())
                process.send_signal(signal.SIGTERM)
                _, errors = process.communicate(timeout=PATIENCE * 60)
                self.assertEqual((process.returncode, errors), (130, b"interrupted\n"))

    def test_what_is_printed_to_a_closed_stream_is_not_written_into_a_result(self):
        for number in (1, 2):
            with self.subTest(number):
                process = self.start("run", "slower.yaml", "sweep.yaml", "--jobs", "2", "--out", f"out{number}", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                     preexec_fn=lambda closed=number: os.close(closed))
                points = self.folder / f"out{number}/sweep/points.jsonl"
                self.wait_until(lambda: (points.parent.parent / "slower/report.html").exists() and points.exists())
                time.sleep(0.3)
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(timeout=PATIENCE * 60), 130)
                self.assertEqual([line for line in points.read_bytes().splitlines() if not line.startswith(b"{")], [])
        self.run_program("run", "base.yaml", status=2, preexec_fn=lambda: os.close(1))
        self.run_program("schema", status=2, preexec_fn=lambda: [os.close(number) for number in range(3)])

    def test_a_pipe_that_nobody_reads_ends_the_program_as_any(self):
        for isolated in ([], ["--isolate-plugins=600"]):
            with self.subTest(isolated):
                reading, writing = os.pipe()
                os.close(reading)
                process = self.start(*isolated, "schema", stdout=writing)
                os.close(writing)
                _, errors = process.communicate(timeout=PATIENCE * 60)
                self.assertEqual((process.returncode, errors), (-signal.SIGPIPE, b""))

    @unittest.skipIf(SANITIZED, "a sanitizer reserves terabytes of addresses")
    def test_little_memory(self):
        """From the least with which the program can be loaded, in small steps: as with plenty, or 2 and a message."""
        def run(kilobytes, *arguments):
            return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE * 60,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (kilobytes << 10, kilobytes << 10)))

        def is_loaded(kilobytes):
            result = run(kilobytes, "no command")
            return result.returncode == 2 and "error: " in result.stderr

        self.run_program("run", "curve.yaml", "--out", "curve")
        before = {path.name: path.read_bytes() for path in (self.folder / "curve").iterdir()}
        steps = range(16 << 10, 1 << 20, 256)  # kB
        least = steps[bisect.bisect_left(steps, True, key=is_loaded)]
        for arguments in (["schema"], ["laws", "coulomb", "--check", "--set", "kinetic=2 N"], ["run", "base.yaml", "curve.yaml", "--jobs", "2", "--out", "all"], ["report", "curve"]):
            statuses = []
            for more in [*range(0, 4 << 10, 512), 10 << 10, 1 << 20]:
                with self.subTest(f"{arguments} {more}"):
                    result = run(least + more, *arguments)
                    statuses.append(result.returncode)
                    self.assertIn(result.returncode, (0, 2), result.stderr)
                    self.assertNotRegex(result.stderr, r"bug|terminate|bad_alloc")
                    if result.returncode == 2:
                        self.assertRegex(result.stderr, "memory|Resource temporarily unavailable")
            self.assertEqual((statuses[0], statuses[-1]), (2, 0), arguments)
        self.assertEqual({name: (self.folder / "curve" / name).read_bytes() for name in before}, before)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=1)
