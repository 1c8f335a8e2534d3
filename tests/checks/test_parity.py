#!/usr/bin/env python3
"""The parity check passes a complete tree and names whatever is taken away."""

import unittest
from pathlib import Path

from planted import Planted

PROGRAM = """#!/bin/sh
case $1 in
  laws) echo 'coulomb  constant force'; echo 'dahl     bristles';;
  methods) echo 'free_decay           decrements'; echo 'resonance_two_point  two pairs';;
  analyses) echo 'simulate     a motion'; echo 'stress_test  scores';;
esac
"""
FIRST = "# yaml-language-server: $schema=../scenario.schema.json\n"
COMPLETE = {
    "program": PROGRAM,
    "core/CMakeLists.txt": "dualdamp_module(core\n  HEADERS units.hpp\n  SOURCES units.cpp)\n",
    "core/units.hpp": "",
    "core/units.cpp": "",
    "sim/CMakeLists.txt": "dualdamp_module(sim\n  HEADERS analytic/den_hartog.hpp\n  SOURCES analytic/den_hartog.cpp\n  PUBLIC x)\n",
    "sim/analytic/den_hartog.hpp": "",
    "sim/analytic/den_hartog.cpp": "",
    "friction_models/CMakeLists.txt": "dualdamp_module(f PAIRS laws/coulomb laws/dahl PUBLIC x)\n",
    "friction_models/laws/coulomb.hpp": "",
    "friction_models/laws/coulomb.cpp": "",
    "friction_models/laws/dahl.hpp": "",
    "friction_models/laws/dahl.cpp": "",
    "identify/CMakeLists.txt": "dualdamp_module(i\n  HEADERS methods/decays/free_decay.hpp methods/amplitudes/resonance.hpp\n"
    "  SOURCES methods/decays/free_decay.cpp methods/amplitudes/resonance.cpp)\n",
    "identify/methods/decays/free_decay.hpp": "",
    "identify/methods/decays/free_decay.cpp": "",
    "identify/methods/amplitudes/resonance.hpp": "",
    "identify/methods/amplitudes/resonance.cpp": "",
    "tests/friction_models/CMakeLists.txt": "dualdamp_test(f PAIRS SOURCES ../support/law.cpp)\n",
    "tests/support/law.cpp": "",
    "tests/friction_models/laws/test_coulomb.cpp": "",
    "tests/friction_models/laws/test_dahl.cpp": "",
    "tests/identify/CMakeLists.txt": "dualdamp_test(i SOURCES methods/decays/test_free_decay.cpp methods/amplitudes/test_resonance.cpp)\n",
    "tests/identify/methods/decays/test_free_decay.cpp": "",
    "tests/identify/methods/amplitudes/test_resonance.cpp": "",
    "scenarios/CMakeLists.txt": "dualdamp_module(s HEADERS analyses/simulate.hpp SOURCES analyses/simulate.cpp)\n",
    "scenarios/analyses/simulate.hpp": "",
    "scenarios/analyses/simulate.cpp": "",
    "scenarios/analyses/simulate.js": "",
    "bench/CMakeLists.txt": "dualdamp_module(b HEADERS stress_test.hpp SOURCES stress_test.cpp)\n",
    "bench/stress_test.hpp": "",
    "bench/stress_test.cpp": "",
    "tests/scenarios/CMakeLists.txt": "dualdamp_test(s SOURCES test_run.cpp)\n",
    "tests/scenarios/test_run.cpp": "{type: simulate}; stress_test_analysis()\n",
    "docs/analyses.md": "## `simulate`\n\n## `stress_test`\n",
    "docs/laws/coulomb.md": "",
    "docs/laws/dahl.md": "",
    "docs/methods/free_decay.md": "",
    "docs/methods/resonance_two_point.md": "",
    "scenarios/examples/coulomb.yaml": FIRST + "system: {friction: {law: coulomb}}\n",
    "scenarios/examples/parallel.yaml": FIRST + "system: {friction: [{law: coulomb}, {law: dahl}]}\n",
    "scenarios/examples/simulate.yaml": FIRST + "analysis: {type: simulate}\n",
    "scenarios/stress/small.yaml": FIRST + "analysis: {type: stress_test, methods: [free_decay, resonance_two_point]}\n",
    "scenarios/paper/identify.yaml": FIRST + "analysis: {methods: [free_decay]}\n",
}

# A file replaced (None: removed), and words of the one complaint.
FAULTS = {
    "law without header": ("friction_models/laws/dahl.hpp", None, ["law dahl: no header"]),
    "law without source": ("friction_models/laws/dahl.cpp", None, ["law dahl: no source"]),
    "law without test": ("tests/friction_models/laws/test_dahl.cpp", None, ["law dahl: no test"]),
    "law without page": ("docs/laws/dahl.md", None, ["law dahl: no page"]),
    "law without scenario": ("scenarios/examples/parallel.yaml", None, ["law dahl: no scenario"]),
    "page without law": ("docs/laws/lugre.md", "", ["lugre.md: the program lists no such law"]),
    "method without header": ("identify/methods/decays/free_decay.hpp", None, ["method free_decay: no header"]),
    "family without source": ("identify/methods/amplitudes/resonance.cpp", None, ["method resonance_two_point: no source"]),
    "method without test": ("tests/identify/methods/decays/test_free_decay.cpp", None, ["method free_decay: no test"]),
    "a family page is not enough": ("docs/methods/resonance_two_point.md", None, ["resonance_two_point: no page"]),
    "method without scenario": ("scenarios/stress/small.yaml", FIRST + "analysis: {type: stress_test, methods: [free_decay]}\n",
                                ["method resonance_two_point: no scenario"]),
    "method without stress test": ("scenarios/stress/small.yaml", FIRST + "analysis: {type: stress_test, methods: [resonance_two_point]}\n",
                                   ["method free_decay: no stress test names it"]),
    "analysis without header": ("bench/stress_test.hpp", None, ["analysis stress_test: no header"]),
    "analysis without source": ("scenarios/analyses/simulate.cpp", None, ["analysis simulate: no source"]),
    "analysis without test": ("tests/scenarios/test_run.cpp", "stress_test_analysis()", ["analysis simulate: no test"]),
    "analysis without section": ("docs/analyses.md", "## `simulate`\n", ["analysis stress_test: no section"]),
    "analysis without scenario": ("scenarios/stress/small.yaml", FIRST + "analysis: {type: simulate, methods: [free_decay, resonance_two_point]}\n",
                                  ["analysis stress_test: no scenario"]),
    "section without analysis": ("docs/analyses.md", "## `simulate`\n\n## `stress_test`\n\n## `run`\n", ["no analysis run"]),
    "view without analysis": ("bench/scores.js", "", ["bench/scores.js: the program lists no such analysis"]),
    "header in no CMakeLists.txt": ("sim/analytic/other.hpp", "", ["sim/analytic/other.hpp: not in a CMakeLists.txt"]),
    "source in no CMakeLists.txt": ("core/other.cpp", "", ["core/other.cpp: not in a CMakeLists.txt"]),
    "source in a comment": ("core/CMakeLists.txt", "dualdamp_module(core HEADERS units.hpp SOURCES)  # units.cpp\n",
                            ["core/units.cpp: not in"]),
    "test in no CMakeLists.txt": ("tests/identify/test_more.cpp", "", ["tests/identify/test_more.cpp: not in"]),
    "scenario without schema line": ("scenarios/paper/other.yaml", "schema: dualdamp/1\n", ["other.yaml:1: the first line"]),
    "unsorted list": ("program", PROGRAM.replace("coulomb  constant", "zzz").replace("echo 'zzz force'", "true")
                      .replace("'dahl     bristles'", "'dahl x'; echo 'coulomb x'"), ["laws: the program's list is not sorted"]),
}


class Parity(Planted, unittest.TestCase):
    check = "parity"
    sound = COMPLETE
    faults = FAULTS

    def arguments(self, folder):
        program = Path(folder) / "program"
        program.chmod(0o755)
        return [folder, program]

    def test_program_that_fails_is_no_pass(self):
        self.assertNotEqual(self.run_on({**COMPLETE, "program": "#!/bin/sh\nexit 2\n"}).returncode, 0)


if __name__ == "__main__":
    unittest.main()
