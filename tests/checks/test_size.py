#!/usr/bin/env python3
"""The check of sizes passes a tree at its limits and names each planted fault."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[2] / "scripts" / "checks" / "size.py"


def body(lines, indent="  "):
    return f"{indent}x = 1;\n" * lines


# Path, text, and words of the complaint; none where all is well.
CASES = {
    "a function at the limit": ("a.cpp", "int f(int x) {\n" + body(58) + "}\n", None),
    "a function over it": ("a.cpp", "int f(int x) {\n" + body(59) + "}\n", "a.cpp:1: f has 61 lines"),
    "a member function": ("a.hpp", "struct S {\n  void f() const noexcept override {\n" + body(60) + "  }\n};\n", "a.hpp:2: f has 62 lines"),
    "a constructor with initialisers": ("a.cpp", "S::S(int a) : a_(a), b_{a}, c_{} {\n" + body(60) + "}\n", "S::S has 62"),
    "a function that returns a class": ("a.cpp", "struct Values f(int x) {\n" + body(60) + "}\n", "f has 62"),
    "a template": ("a.hpp", "template <class T>\nauto f(const T& x) -> T {\n" + body(60) + "}\n", "f has 62"),
    "a test case": ("a.cpp", 'TEST_CASE("long; {") {\n' + body(60) + "}\n", "TEST_CASE has 62"),
    "a lambda of a constant": ("a.cpp", "const auto f = [](int x) {\n" + body(60) + "};\n", "has 62"),
    "a namespace is none": ("a.cpp", "namespace a {\n" + body(100, "int ") + "}\n", None),
    "a class is none": ("a.hpp", "class A : public B<int()> {\n" + "  int x;\n" * 100 + "};\n", None),
    "a table is none": ("a.cpp", "const std::array<int, 100> table = {\n" + "  1,\n" * 100 + "};\n", None),
    "braces in texts and comments": ("a.cpp", 'int f() { return g("{", \'{\', R"~({)~"); }  // {\nint x[] = {\n' + "  1'000,\n" * 100 + "};\n", None),
    "an arrow function": ("a.js", "const f = (x) => {\n" + body(60) + "};\n", "has 62"),
    "a function of the page": ("a.js", "function f({ a, b }, [c]) {\n" + body(60) + "}\n", "f has 62"),
    "a brace in a pattern": ("a.js", "const p = s.match(/[{]x{/);\nfunction f() { return 1; }\n" + "f();\n" * 100, None),
    "Python": ("a.py", "def f():\n" + "    x = 1\n" * 60, "a.py:1: f has 61 lines"),
    "a method in Python": ("a.py", "class A:\n    def f(self):\n" + "        x = 1\n" * 60, "a.py:2: f has 61 lines"),
    "a file at the limit": ("a.cpp", "int x;\n" * 450, None),
    "a file over it": ("a.cpp", "int x;\n" * 451, "a.cpp: 451 lines"),
}


class Size(unittest.TestCase):
    def check(self, files):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["git", "init", "-q", folder], check=True)
            for name, text in files.items():
                path = Path(folder) / name
                path.parent.mkdir(exist_ok=True)
                path.write_text(text)
            result = subprocess.run([sys.executable, str(CHECK), folder], capture_output=True, text=True)
        self.assertEqual(result.stderr, "")
        self.assertEqual(result.returncode, 1 if result.stdout else 0)
        # Exceptions are for the tree of the project, and planted ones have no need of them.
        return "".join(line for line in result.stdout.splitlines(keepends=True) if not line.endswith("that nothing needs\n"))

    def test_functions_and_files(self):
        said = self.check({f"{i}/{path}": text for i, (path, text, _) in enumerate(CASES.values())}).splitlines()
        for i, (name, (_, _, complaint)) in enumerate(CASES.items()):
            with self.subTest(name):
                here = [line for line in said if line.startswith(f"{i}/")]
                self.assertEqual(len(here), 0 if complaint is None else 1, here)
                if complaint is not None:
                    self.assertIn(complaint, here[0])

    def test_folders(self):
        many = {f"a/f{i}.{suffix}": "" for i in range(20) for suffix in ("cpp", "hpp")}
        self.assertEqual(self.check(many | {"a/CMakeLists.txt": "", "b/f.cpp": ""}), "")
        self.assertIn("a/: 41 source files", self.check(many | {"a/one_more.py": ""}))


if __name__ == "__main__":
    unittest.main()
