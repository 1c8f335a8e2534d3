"""What tests of the program share: it runs in a folder of its own. The first argument of the test is the program."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).resolve())
PATIENCE = float(os.environ.get("DUALDAMP_PATIENCE", "1"))  # factor on all limits of time: sanitizers make programs slow

# A scenario that runs at once.
BASE = """schema: dualdamp/1
title: base
system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}
excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}
analysis: {type: steady_state}
"""


class Case(unittest.TestCase):
    timeout = 300  # s, of a call

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def run_program(self, *arguments, status=0, timeout=None, **options):
        """Names of files may be bytes that are no text."""
        command = [PROGRAM, *(a if isinstance(a, bytes) else str(a) for a in arguments)]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, errors="replace", timeout=PATIENCE * (timeout or self.timeout), **options)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result

    def fit_of_coulomb(self, *arguments):
        """Result and warnings of a fit of `coulomb` without profiles, which stands in the folder `fit`."""
        answer = json.loads(self.run_program("fit", "coulomb", *arguments, "--no-profile", "--json", "--out", "fit").stdout)
        return answer["result"], answer["warnings"]
