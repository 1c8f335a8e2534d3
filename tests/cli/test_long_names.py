#!/usr/bin/env python3
"""Names without a place to break stay within the window of a page.

usage: test_long_names.py PROGRAM ROOT
"""

import sys
import unittest

from browser import View
from page import ROOT, PageCase


class LongNames(PageCase):
    def test_long_names_break(self):
        """Names of files, columns and titles without a place to break, in warnings, titles and tables; in pages of runs and of a comparison."""
        name = "a_record_with_a_very_long_name_" * 5
        motion = (ROOT / "scenarios/examples/free_run.csv").read_text()
        motion = "\n".join(line + (",0.1" if line[:1].isdigit() else f",{name}") for line in motion.splitlines() if not line.startswith("#"))
        record = self.folder / f"{name}.csv"
        record.write_text(motion + "\n")
        constants = ("--mass", "1 kg", "--stiffness", "1000 N/m")
        pages = []

        def page(*arguments):
            out = self.folder / f"long{len(pages)}"
            self.run_program(*arguments, "--out", out, "--quiet")
            pages.append(out / "report.html")

        page("identify", record, *constants)
        page("fit", "coulomb,stribeck", record, *constants, "--no-profile")
        for example in ("simulate", "sweep", "xy_curve", "regime_map", "predict"):
            page("run", ROOT / f"scenarios/examples/{example}.yaml", "--set", f"title={name}")
        page("run", ROOT / "scenarios/examples/xy_curve.yaml", "--set", f"title={name}2", "--set", "system.friction.kinetic=1 N")
        self.run_program("compare", pages[4].parent, pages[-1].parent, "--out", self.folder / "long")
        pages.append(self.folder / "long/compare.html")
        for path in pages:
            for width in (420, 1100):
                with self.subTest(f"{path.parent.name}, {width}"), View(self.browser, path, (width, 900)) as view:
                    self.assertLessEqual(view.value("document.documentElement.scrollWidth - innerWidth"), 0)
                    spilt = "[...document.querySelectorAll('p, h1, h2, dt, dd, summary, figcaption')].filter((e) => e.checkVisibility() && e.scrollWidth > e.clientWidth + 1)"
                    self.assertEqual(view.value(f"{spilt}.map((e) => e.textContent.slice(0, 50))"), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
