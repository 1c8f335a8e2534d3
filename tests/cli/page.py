"""What tests of pages share: a browser, and the results of shipped scenarios, which are computed once for all tests of a
class. The arguments of the test are the program and the root of the sources."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from browser import BROWSER, Browser, View
from case import PATIENCE, PROGRAM

ROOT = Path(sys.argv[2]).resolve()


@unittest.skipIf(BROWSER is None, "there is no Chromium on this machine")
class PageCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.browser = Browser(cls.folder / "browser")
        cls.addClassCleanup(cls.browser.close)

    def run_program(self, *arguments, status=0):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE * 120)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result

    def result_of(self, name, folder="examples"):
        """The directory of a shipped scenario's results, which are computed once for all tests."""
        out = self.folder / name
        if not out.exists():
            self.run_program("run", ROOT / "scenarios" / folder / f"{name}.yaml", "--out", out, "--quiet")
        return out

    def ask(self, name, *expressions, size=(1000, 800)):
        """The values of JavaScript expressions in the page of an example, of one alone its own."""
        with View(self.browser, self.result_of(name) / "report.html", size) as view:
            values = [view.value(expression) for expression in expressions]
            self.assertEqual(view.console(), [])
        return values[0] if len(values) == 1 else values
