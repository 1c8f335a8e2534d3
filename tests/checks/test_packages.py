#!/usr/bin/env python3
"""Missing packages: root gets them installed, everyone else is told the one command, and nothing is installed."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Packages(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.log = self.folder / "called"

    def command(self, name, text):
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def ensure(self, user, missing=("libjs-d3", "cmake"), install=0):
        """What ensure_packages says to a user on a machine that lacks some packages, and which commands it called."""
        self.command("id", f"echo {user}")
        known = " ".join(missing)
        self.command("dpkg-query", f"""shift 2
for name in "$@"; do case " {known} " in *" $name "*) ;; *) echo "installed $name";; esac; done""")
        for tool in ("apt-get", "sudo"):
            self.command(tool, f'echo "{tool} $*" >> "{self.log}"\ncase "$*" in *" install "*) exit {install};; esac')
        result = subprocess.run(
            ["bash", "-c", f'. "{ROOT}/scripts/lib/prepare.sh"; ensure_packages build'], capture_output=True, text=True,
            env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}, timeout=60)
        return result, self.log.read_text() if self.log.exists() else ""

    def test_others_than_root_are_told_the_one_command(self):
        result, called = self.ensure(1000)
        self.assertEqual(result.returncode, 69)
        self.assertEqual(called, "")
        self.assertIn("missing packages: cmake libjs-d3\n", result.stderr)
        self.assertIn("sudo apt-get install --no-install-recommends cmake libjs-d3\n", result.stderr)

    def test_root_gets_what_is_missing(self):
        result, called = self.ensure(0)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(called.splitlines()[-1].endswith("install --no-install-recommends cmake libjs-d3"), called)
        self.assertNotIn("sudo", called)

    def test_a_failed_installation_is_said(self):
        result, _ = self.ensure(0, install=100)
        self.assertEqual(result.returncode, 69)
        self.assertIn("could not install: cmake libjs-d3", result.stderr)

    def test_nothing_missing_calls_nothing(self):
        for user in (0, 1000):
            result, called = self.ensure(user, missing=())
            self.assertEqual((result.returncode, result.stderr, called), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
