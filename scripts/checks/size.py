#!/usr/bin/env python3
"""Fails when a folder, a file or a function has grown too large to read.

usage: size.py ROOT

Sources are .cpp, .hpp, .h, .js and .py files under version control or not ignored. Functions are found by `ast` in Python, and in C++
and JavaScript by their braces: a block whose head has an argument list and is no control statement, class or namespace. Nested
functions count as part of the outer one; a docstring in Python does not count.
"""

import ast
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

FOLDER, FILE, FUNCTION = 40, 450, 60

# What may be larger, and why: a folder, a file, or FILE:FUNCTION.
EXCEPTIONS = {
    "friction_models/laws": "one header and one source for each law, a flat list sorted by name",
}

SUFFIXES = (".cpp", ".hpp", ".h", ".js", ".py")
# Comments, texts and characters of C++ and JavaScript; a quote between digits separates them.
QUIET = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(?P<mark>[^()\s\\]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])*'""", re.DOTALL)
REGEX_LITERAL = re.compile(r"""(?<=[(,=:])\s*/(?![/*])(?:\\.|\[(?:\\.|[^\]\n])*\]|[^/\\\n])+/\w*""")
CONTROL = re.compile(r"\b(if|for|while|switch|catch|do|else|try|return)\b")
CONTAINER = re.compile(r"^(\[\[[^\]]*\]\]\s*)?(export\s+)?(template\s*<.*>\s*)?(typedef\s+)?(inline\s+)?(namespace|class|struct|union|enum|extern)\b", re.DOTALL)


def sources(root):
    found = subprocess.run(["git", "-C", str(root), "-c", f"safe.directory={root}", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                           capture_output=True, check=True, text=True).stdout
    return sorted(path for name in found.split("\0") if name.endswith(SUFFIXES) and (path := Path(name)) and (root / path).is_file())


def blank(match):
    """As many lines, and nothing that looks like code."""
    return "\n" * match.group(0).count("\n")


def head_of(text, brace):
    """What stands before a brace, back to the end of the statement or block before; semicolons in brackets do not count."""
    depth, at = 0, brace - 1
    while at >= 0:
        c = text[at]
        if c in ")]":
            depth += 1
        elif c in "([":
            if depth == 0:
                break
            depth -= 1
        elif c in ";{}" and depth == 0:
            break
        at -= 1
    return text[at + 1 : brace].strip()


def is_function(head):
    """Whether a block with this head is the body of a function; initialisers, control statements and classes are none."""
    if CONTAINER.match(head) and not re.match(r"(class|struct|enum|union)\s+[\w:<>]+[&*\s]+[\w:~]+\s*\(", head):
        return False
    if head.endswith("=>"):
        return True
    if "(" not in head or head.endswith(("=", ",", "(", "return")):
        return False
    return not CONTROL.match(head.removeprefix("}").strip())


def name_of(head):
    names = re.findall(r"([\w:~]+|operator\S+)\s*\(", head)
    return names[0] if names else "(lambda)"


def brace_functions(text):
    """(name, first line, last line) of the outermost functions."""
    text = REGEX_LITERAL.sub(blank, QUIET.sub(blank, text))
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.MULTILINE)
    open_blocks, inside, line = [], 0, 1
    before = None  # the function whose block closed last
    for at, c in enumerate(text):
        if c == "\n":
            line += 1
        elif c == "{":
            head = head_of(text, at) if inside == 0 else ""
            # A constructor's members may have braces of their own, before those of its body.
            continues = inside == 0 and before is not None and re.fullmatch(r"(,\s*\w+)?", head)
            function = inside == 0 and (bool(continues) or is_function(head))
            open_blocks.append((function, *(before if continues else (name_of(head), line))))
            inside += function
        elif c == "}" and open_blocks:
            function, name, first = open_blocks.pop()
            inside -= function
            if inside == 0:
                before = (name, first) if function else None
            if function:
                yield name, first, line


def python_functions(text):
    def visit(node):
        for child in ast.iter_child_nodes(node):
            if isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef)):
                documented = ast.get_docstring(child) is not None
                yield child.name, child.body[0].end_lineno if documented else child.lineno, child.end_lineno
            else:
                yield from visit(child)

    yield from visit(ast.parse(text))


def faults(root, used):
    def too_large(what, size, most, words):
        if size > most:
            used.add(what)
            if what not in EXCEPTIONS:
                yield words

    files = sources(root)
    for folder, count in sorted(Counter(path.parent for path in files).items()):
        yield from too_large(str(folder), count, FOLDER, f"{folder}/: {count} source files, more than {FOLDER}")
    for path in files:
        text = (root / path).read_text()
        lines = text.count("\n")
        yield from too_large(str(path), lines, FILE, f"{path}: {lines} lines, more than {FILE}")
        for name, first, last in (python_functions if path.suffix == ".py" else brace_functions)(text):
            length = last - first + 1
            yield from too_large(f"{path}:{name}", length, FUNCTION, f"{path}:{first}: {name} has {length} lines, more than {FUNCTION}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    used = set()
    found = list(faults(Path(sys.argv[1]).resolve(), used))
    found += [f"{what}: an exception in scripts/checks/size.py that nothing needs" for what in sorted(set(EXCEPTIONS) - used)]
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
