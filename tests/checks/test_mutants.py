"""scripts/mutants changes code, one place at a time, and neither comments nor strings."""

import importlib.machinery
import importlib.util
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "mutants"
LOADER = importlib.machinery.SourceFileLoader("mutants", str(SCRIPT))
mutants = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutants", LOADER))
LOADER.exec_module(mutants)


class Mutants(unittest.TestCase):
    def after(self, text):
        return [change.after for change in mutants.changes_of(text)]

    def test_each_operator_constant_and_statement_is_a_change(self):
        self.assertEqual(self.after("  if (a < b + 2) return true;"),
                         ["  if (a <= b + 2) return true;", "  if (a < b - 2) return true;", "  if (a < b + 2) return false;", "  if (a < b + 3) return true;"])
        self.assertEqual(self.after("  piece_time_ += s;"), ["  piece_time_ -= s;", ""])
        self.assertEqual(self.after("  list.push_back(1.0);"), ["  list.push_back(1.5);", ""])
        self.assertEqual(self.after("  x = 0.0;"), ["  x = 1.0;", ""])

    def test_comments_strings_templates_and_includes_stay(self):
        self.assertEqual(self.after('#include "a - b.hpp"\n// a < b\n/// 1.0\n  std::vector<double> a;\n  say("a < b");  // 1.0'), [""])

    def test_a_change_says_its_line(self):
        self.assertEqual([(change.line, change.before) for change in mutants.changes_of("\n\nint a = b * c;")], [(2, "int a = b * c;")])


if __name__ == "__main__":
    unittest.main()
