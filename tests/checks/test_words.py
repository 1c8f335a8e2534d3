#!/usr/bin/env python3
"""The check of words passes a tree that keeps to its glossary and names each planted fault."""

import unittest

from planted import Planted

GLOSSARY = r"""# Glossary

| term | symbol | unit | meaning | in the code | replaced |
|---|---|---|---|---|---|
| static friction | $F_s$ | N | holds the mass | `sim/model.hpp`, `Coulomb::static_level` | |
| forcing period | $T$ | s | | `Drive::period` | `\bcycles?\b` |
| diagnostics | | | | `diagnostics` | `doubt(s\|ed)?\b` |
| interval | | s | | `Interval` | `(begin\|end) of the phase` |

Another table is not read:

| term | meaning |
|---|---|
| nowhere | nothing |
"""

SOUND = {
    "docs/glossary.md": GLOSSARY,
    "docs/guide.md": "Static friction holds. The key `cycles` counts forcing periods; `analysis.cycles` too. Intervals; diagnostics.\n"
                     "The phase of the drive at the beginning of the interval.\n",
    "CHANGELOG.md": "* Renamed cycle to forcing period.\n",
    "sim/model.hpp": "/// A forcing period after the other.\nstruct StaticFriction { double static_level; };\nclass Interval;\n"
                     "struct Drive { double period; int diagnostics; int stops_per_cycle; };\n"
                     'const char* key = "cycles"; const char* all = "takes only one of duration, cycles";\n',
    "scenarios/examples/simulate.yaml": "title: Ten periods\nanalysis: {type: simulate, cycles: 10}\n",
    "tests/sim/test_model.cpp": 'section.contains("cycles"); // the phase of the drive, at the end\n',
    "core/picture.png": "",
}

# One change to the sound tree, and words of the one complaint.
FAULTS = {
    "identifier that is gone": ("sim/model.hpp", SOUND["sim/model.hpp"].replace("static_level", "level"),
                                ["glossary.md:5", "no 'Coulomb::static_level'"]),
    "file that is gone": ("docs/glossary.md", GLOSSARY.replace("sim/model.hpp", "sim/none.hpp"), ["no 'sim/none.hpp'"]),
    "term that no page has": ("docs/guide.md", SOUND["docs/guide.md"].replace("Intervals", "").replace("the interval", "it"),
                              ["glossary.md:8", "'interval' is not found in the docs"]),
    "term that no source has": ("sim/model.hpp", SOUND["sim/model.hpp"].replace("StaticFriction", "Friction"),
                                ["'static friction' is not found in the code"]),
    "replaced word in a comment": ("sim/a.cpp", "int i;  // one cycle later\n", ["sim/a.cpp:1: 'cycle'", "'forcing period'"]),
    "replaced word in a message": ("cli/a.cpp", '\nfail("no whole cycle");\n', ["cli/a.cpp:2: 'cycle'"]),
    "replaced word on a page": ("docs/a.md", "The method doubted.\n", ["docs/a.md:1: 'doubted'", "'diagnostics'"]),
    "replaced word in the README": ("README.md", "Stops a cycle.\n", ["README.md:1: 'cycle'"]),
    "replaced word in a title": ("scenarios/paper/a.yaml", "title: Last cycle\n", ["scenarios/paper/a.yaml:1"]),
    "replaced word in a test": ("tests/sim/test_a.cpp", "\n\nint cycle = 0;\n", ["tests/sim/test_a.cpp:3"]),
    "replaced word in a script": ("scripts/figures", "set label 'a cycle'\n", ["scripts/figures:1"]),
    "replaced word in another case": ("docs/a.md", "# Cycles\n", ["'Cycles'"]),
    "phrase over two comment lines": ("sim/a.hpp", "  /// at the begin\n  /// of the phase\n", ["sim/a.hpp:1: 'begin of the phase'"]),
    "phrase over two string literals": ("sim/a.cpp", 'f("the end "\n  "of the phase");\n', ["sim/a.cpp:1: 'end of the phase'"]),
    "key used as a word": ("docs/a.md", "After two cycles it stops.\n", ["docs/a.md:1: 'cycles'"]),
    "term stated twice": ("docs/glossary.md", GLOSSARY.replace("| interval |", "| diagnostics | | | | | |\n| interval |"),
                          ["glossary.md:8: 'diagnostics' is stated twice"]),
    "row with too few cells": ("docs/glossary.md", GLOSSARY.replace("| interval |", "| slip | | |\n| interval |"), ["glossary.md:8: 3 cells"]),
}


class Words(Planted, unittest.TestCase):
    check = "words"
    sound = SOUND
    faults = FAULTS

    def test_glossary_without_its_table_is_no_pass(self):
        result = self.run_on({**SOUND, "docs/glossary.md": "# Glossary\n"})
        self.assertEqual(result.returncode, 1)
        self.assertIn("no table with the columns", result.stdout)


if __name__ == "__main__":
    unittest.main()
