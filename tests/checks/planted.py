"""What the tests of the checks share: a check passes a sound tree, and names each fault that is planted in it."""

import subprocess
import sys
import tempfile
from pathlib import Path

CHECKS = Path(__file__).resolve().parents[2] / "scripts" / "checks"


class Planted:
    """To be mixed into a TestCase that sets these three.

    ``check``: the name of the check. ``sound``: path and text of each file; None: no such file. ``faults``: by name, a
    path, what stands there instead, and words of the one complaint.
    """

    check = ""
    sound = {}
    faults = {}

    def arguments(self, folder):
        return [folder]

    def run_on(self, tree):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in tree.items():
                if text is None:
                    continue
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return subprocess.run([sys.executable, CHECKS / f"{self.check}.py", *self.arguments(folder)], capture_output=True, text=True, check=False)

    def test_sound_tree_passes(self):
        result = self.run_on(self.sound)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_planted_faults_are_named(self):
        for name, (path, text, words) in self.faults.items():
            with self.subTest(name):
                result = self.run_on({**self.sound, path: text})
                self.assertEqual(result.returncode, 1, result.stderr)
                for word in words:
                    self.assertIn(word, result.stdout)
                self.assertEqual(len(result.stdout.splitlines()), 1, result.stdout)

    def test_needs_a_root(self):
        result = subprocess.run([sys.executable, CHECKS / f"{self.check}.py"], capture_output=True, text=True, check=False)
        self.assertNotEqual(result.returncode, 0)
