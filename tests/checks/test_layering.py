#!/usr/bin/env python3
"""The layering check passes a sound tree and names each planted fault."""

import sys
import unittest

from planted import CHECKS, Planted

sys.path.insert(0, str(CHECKS))
import layering

SOUND = {
    "core/units.hpp": "#pragma once\n#include <Eigen/Core>\n#include <string>\n",
    "core/units.cpp": '#include "core/units.hpp"\n\n#include <udunits2.h>\n#include <cmath>\n',
    "friction_models/laws/coulomb.hpp": '#pragma once\n#include "core/units.hpp"\n',
    "sim/smooth.hpp": '#pragma once\n#include "friction_models/laws/coulomb.hpp"\n',
    "sim/smooth.cpp": '#include "sim/smooth.hpp"\n#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>\n',
    "sim/engine/state.hpp": '#pragma once\n#include "sim/smooth.hpp"\n',
    "sim/orbits/search.hpp": "#pragma once\n",
    "identify/fit.cpp": '#include <ceres/ceres.h>\n#include "sim/smooth.hpp"\n',
    "identify/readers/isolated.cpp": "#include <poll.h>\n#include <unistd.h>\n",
    "scenarios/reader.cpp": "#include <yaml-cpp/yaml.h>\n#include <nlohmann/json.hpp>\n",
    "bench/speed/main.cpp": "#include <boost/numeric/odeint.hpp>\n",
    "cli/main.cpp": '#include <CLI/CLI.hpp>\n#include <unistd.h>\n#include "core/units.hpp"\n',
    "tests/core/units.cpp": '#include <yaml-cpp/yaml.h>\n#include "cli/main.cpp"\n#include "files.hpp"\n',
    "tests/core/files.hpp": "#pragma once\n",
    "scenarios/json.hpp": "#pragma once\n#include <nlohmann/json.hpp>\n\nnamespace dualdamp::scenarios {\n\nstruct Text {\n  int a;\n};\n\n}  // namespace dualdamp::scenarios\n",
    "core/CMakeLists.txt": "dualdamp_module(core\n  HEADERS units.hpp bad.hpp\n  SOURCES units.cpp)\n",
    "friction_models/CMakeLists.txt": "dualdamp_module(f PAIRS laws/coulomb PUBLIC dualdamp_core)\n",
    "sim/CMakeLists.txt": "# not dualdamp_cli\ndualdamp_module(sim HEADERS smooth.hpp bad.hpp PUBLIC dualdamp_core)\n",
    "scenarios/CMakeLists.txt": "dualdamp_module(scenarios HEADERS bad.hpp SOURCES reader.cpp json.hpp)\n",
}

# One change to the sound tree, and words of the complaint.
FAULTS = {
    "a type defined twice": ("scenarios/bad.cpp", "namespace dualdamp::scenarios {\nstruct Text {\n  double b;\n};\n}  // namespace dualdamp::scenarios\n",
                             ["scenarios/bad.cpp:2 too", "json.hpp:6", "Text"]),
    "upward include": ("core/bad.cpp", '#include "sim/smooth.hpp"\n', ["core/bad.cpp:1", "core/ may include only core"]),
    "sideways include": ("friction_models/bad.hpp", '#pragma once\n#include "scenarios/x.hpp"\n', ["bad.hpp:2"]),
    "angle brackets hide nothing": ("core/bad.cpp", "#include <sim/smooth.hpp>\n", ["core/ may include only core"]),
    "bench from identify": ("identify/bad.cpp", '#include "bench/x.hpp"\n', ["identify/ may include only"]),
    "tests from the library": ("sim/bad.cpp", '#include "tests/support/x.hpp"\n', ["only tests include tests"]),
    "yaml-cpp outside scenarios": ("cli/bad.cpp", "#include <yaml-cpp/yaml.h>\n", ["yaml-cpp may appear only in scenarios/"]),
    "yaml-cpp in a header": ("scenarios/bad.hpp", "#pragma once\n#include <yaml-cpp/yaml.h>\n", ["belongs in .cpp"]),
    "a second odeint file": ("sim/bad.cpp", "#include <boost/numeric/odeint.hpp>\n", ["in one .cpp", "sim/smooth.cpp"]),
    "the system in a second file": ("identify/bad.cpp", "#include <sys/wait.h>\n", ["in one .cpp", "identify/readers/isolated.cpp"]),
    "odeint elsewhere": ("identify/bad.cpp", "#include <boost/numeric/odeint.hpp>\n", ["Boost.Odeint may appear only"]),
    "CLI11 outside cli": ("scenarios/bad.cpp", "#include <CLI/CLI.hpp>\n", ["CLI11 may appear only in cli/"]),
    "udunits2 in a header": ("core/bad.hpp", "#pragma once\n#include <udunits2.h>\n", ["udunits2 belongs in .cpp"]),
    "Ceres outside identify": ("sim/bad.cpp", "#include <ceres/ceres.h>\n", ["Ceres may appear only in identify/"]),
    "json below scenarios": ("sim/bad.cpp", "#include <nlohmann/json.hpp>\n", ["nlohmann-json may appear only in"]),
    "a room from below": ("sim/smooth.cpp", '#include "sim/engine/state.hpp"\n', ["sim/ may include of sim/ only itself"]),
    "packs that search": ("sim/batch/x.cpp", '#include "sim/orbits/search.hpp"\n', ["sim/batch/ may include of sim/ only ., engine"]),
    "a room that is not listed": ("sim/attic/x.cpp", '#include "sim/smooth.hpp"\n', ["sim/attic/ is no room listed"]),
    "a sibling room of bench": ("bench/crosscheck/x.cpp", '#include "bench/speed/main.cpp"\n',
                                ["bench/crosscheck/ may include of bench/ only itself"]),
    "an option in a message": ("scenarios/bad.cpp", 'const char* remedy = "leave out --mass";\n',
                               ["scenarios/bad.cpp:1", "--mass is an option of a command line"]),
    "a private header of another folder": ("cli/bad.cpp", '#include "scenarios/json.hpp"\n', ["private to scenarios/"]),
    "a private header in a public one": ("scenarios/bad.hpp", '#pragma once\n#include "scenarios/json.hpp"\n',
                                         ["may not include a private one"]),
    "heavy Eigen in a header": ("sim/bad.hpp", "#pragma once\n#include <Eigen/Dense>\n", ["beyond Eigen/Core belongs"]),
    "an unknown library": ("core/bad.cpp", "#include <gsl/gsl_math.h>\n", ["not on the list"]),
    "relative include": ("core/bad.cpp", '#include "units.hpp"\n', ["included from the root"]),
    "relative include of nothing": ("tests/core/bad.cpp", '#include "none.hpp"\n', ["included from the root"]),
    "parent include": ("core/bad.cpp", '#include "../sim/smooth.hpp"\n', ["included from the root"]),
    "a file that is not there": ("sim/bad.cpp", '#include "core/none.hpp"\n', ["no such file"]),
    "no pragma once": ("core/bad.hpp", "int f();\n", ["without #pragma once"]),
    "spaced directive": ("core/bad.cpp", '  #  include   "cli/main.cpp"\n', ["core/ may include only core"]),
    "upward link": ("core/CMakeLists.txt", "x\ndualdamp_module(core HEADERS units.hpp PUBLIC dualdamp_sim)\n",
                    ["core/CMakeLists.txt:2", "core/ may not link dualdamp_sim"]),
}


class Layering(Planted, unittest.TestCase):
    check = "layering"
    sound = SOUND
    faults = FAULTS

    def test_rooms_that_include_each_other_are_named(self):
        self.assertEqual(list(layering.order_faults()), [])
        both = {"sim": {".": ["orbits"], "batch": [".", "orbits"], "orbits": [".", "batch"]}}
        (fault,) = layering.order_faults(both)
        self.assertIn("sim/batch/ may include orbits/", fault)


if __name__ == "__main__":
    unittest.main()
