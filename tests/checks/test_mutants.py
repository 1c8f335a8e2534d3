"""scripts/mutants puts a switch at each operator, constant and statement, and at neither comments nor strings."""

import importlib.machinery
import importlib.util
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
LOADER = importlib.machinery.SourceFileLoader("mutants", str(SCRIPTS / "mutants"))
mutants = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutants", LOADER))
LOADER.exec_module(mutants)

PROGRAM = """#include <cstdio>
#include <string>
#include <vector>
// 1 + 1
constexpr int fixed = 2 + 3;
static int values(int a, const std::vector<int>& list) {
  int sum = 0;
  sum += a * 2;
  if (a < 5 && list.size() == 2) sum -= 1;
  return sum;
}
int main() {
  const std::string text = std::string("1 + 1") + " 2";
  std::printf("%d %s", values(5, {1, 2}), text.c_str());
  return 0;
}
"""


class Mutants(unittest.TestCase):
    def switched(self, text):
        return mutants.switched(text, 1)[0].rstrip("\n")

    def test_each_operator_constant_and_statement_has_a_switch(self):
        self.assertEqual(self.switched("  if (a < b + c) return true;"),
                         "  if (a < mutant::Op{1} < b + mutant::Op{2} + c) return mutant::flipped(3, true);")
        self.assertEqual(self.switched("  time_ += s;"), "  mutant::on(2) ? void() : void(time_ += mutant::Op{1} += s);")
        self.assertEqual(self.switched("  return a && std::min(b, 1.0);"), "  return a && !mutant::on(1) && mutant::Min{2}(b, mutant::number(3, 1.0));")

    def test_what_is_no_code_or_is_evaluated_by_the_compiler_stays(self):
        for text in ['#include "a - b.hpp"', "/// 1.0 + 2", "constexpr double a = b + 1.0;", "template <int i = 1>", "  case 1:", "  return word;", "  std::array<double, 3> list;",
                     '  return "1 + 1";  // 2 + 2', "  assert(is_open);", "      .real();"]:
            self.assertEqual(mutants.switched(text, 1), (text + "\n", []))

    def test_a_change_says_its_number_and_line_and_lines_can_be_left_out(self):
        self.assertEqual(mutants.switched("\nint a = b * c;", 7)[1], [(7, 2, "int a = b * c;  [* at 10]")])
        self.assertEqual(mutants.switched("\nint a = b * c;", 7, {2})[1], [])

    def test_a_program_with_switches_is_the_program_until_one_is_on(self):
        text, changes = mutants.switched(PROGRAM, 1)
        with tempfile.TemporaryDirectory() as folder:
            source, program, reached = (Path(folder) / name for name in ("a.cpp", "a", "reached"))
            source.write_text(text)
            subprocess.run(["g++", "-std=c++20", "-w", "-include", SCRIPTS / "lib" / "mutant_switches.hpp", source, "-o", program], check=True)

            def printed(**settings):
                return subprocess.run([program], env=settings, capture_output=True, text=True, check=False).stdout

            self.assertEqual(printed(DUALDAMP_MUTANTS_REACHED=str(reached)), "10 1 + 1 2")
            passed = {int(line) for line in reached.read_text().split()}
            ends = {what.split("  ")[1]: printed(DUALDAMP_MUTANT=str(number)).split()[0] for number, line, what in changes if line in (8, 9)}
        self.assertEqual({what: end for what, end in ends.items() if end != "10"},
                         {"[+= at 6]": "-10", "[* at 11]": "2", "[2 at 14]": "15", "[taken away]": "0", "[< at 8]": "9", "[5 at 11]": "9"})
        # Where the first half of a condition is false, nothing comes past the second.
        self.assertEqual([what.split("  ")[1] for number, line, what in changes if line == 9 and number not in passed],
                         ["[&& at 12]", "[== at 27]", "[2 at 31]", "[-= at 37]", "[1 at 41]"])


if __name__ == "__main__":
    unittest.main()
