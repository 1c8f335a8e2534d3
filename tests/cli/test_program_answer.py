#!/usr/bin/env python3
"""The program's own answer in a stress test: `answer: true`.

usage: test_program_answer.py PROGRAM ROOT [TEST...]
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from case import PATIENCE
from definitions import table

PROGRAM = str(Path(sys.argv[1]).resolve())
ROOT = Path(sys.argv[2]).resolve()
SCENARIO = ROOT / "scenarios/stress/small.yaml"
SLOW_LAWS = ("bouc_wen", "dahl", "elasto_plastic", "friction_lag", "generalized_maxwell_slip", "iwan", "lugre", "normal_vibration")


class ProgramAnswer(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def call(self, *arguments):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE * 300)
        self.assertIn(result.returncode, (0, 4), result.stderr)  # 4: no answer
        return result

    def identified(self, data, mass, stiffness, *, methods=()):
        """Without the laws whose fits take most of the time: a range over laws answers as well without them."""
        out, scenario = Path(tempfile.mkdtemp(dir=self.folder)), self.folder / "identify.yaml"
        chosen = f"methods: [{', '.join(methods)}]" if methods else ""
        without = "" if methods else f"without: [{', '.join(SLOW_LAWS)}]"
        scenario.write_text(f"""schema: dualdamp/1
system: {{mass: {mass} kg, stiffness: {stiffness} N/m}}
analysis: {{type: identify, data: {data.relative_to(self.folder)}, {chosen or without}}}
""")
        self.call("run", scenario, "--out", out, "--quiet")
        return json.loads((out / "result.json").read_text())["result"]

    def test_it_is_that_of_identify_without_a_range_over_laws(self):
        own = [SCENARIO, "--set", "analysis.answer=true", "--set", "analysis.severities=[0.3]", "--set", "analysis.seeds=1",
               "--set", "expect=[{value: cases.failed, equals: 0}]"]
        export, out = self.folder / "own", self.folder / "scored"
        self.call("stress", "export", *own, "--out", export, "--seed", 7)
        self.call("run", *own, "--set", "analysis.seed=7", "--out", out, "--quiet")
        lines = [json.loads(line) for line in (out / "cases.jsonl").read_text().splitlines()[1:]]
        self.assertIn("answer", [row["method"] for row in table(out / "ranking.csv")])
        answered_by = []
        for place, row in zip(json.loads((export / "key.json").read_text())["numbers"], table(export / "constants.csv")):
            data = export / f"cases/{int(row['case']):06d}.csv"
            constants = row["mass [kg]"], row["stiffness [N/m]"]
            result = self.identified(data, *constants)
            answer = result["answer"]
            if answer is None:  # the misfit of the range over laws may be why
                others = [e["method"] for e in result["estimates"] if e["method"] != "any_law"]
                answer = self.identified(data, *constants, methods=others)["answer"]
            estimate = lines[place]["estimates"][-1]
            answered_by.append(answer["method"] if answer else None)
            stands_by_one = answer is not None and answer["method"] != "any_law"
            self.assertEqual((estimate["method"], estimate.get("usable", False)), ("answer", stands_by_one))
            if stands_by_one:
                self.assertEqual([estimate["zeta"], estimate["F0"], estimate["zeta95"]], [answer["zeta"], answer["F0"], answer["interval95"]["zeta"]])
        self.assertIn("any_law", answered_by)
        self.assertGreater(len(answered_by), 2 * answered_by.count("any_law"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
