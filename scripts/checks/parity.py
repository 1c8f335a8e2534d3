#!/usr/bin/env python3
"""Fails when a law, a method, an analysis, a header, a source or a scenario lacks one of the things that belong to it.

usage: parity.py ROOT PROGRAM

Laws and methods are those the built PROGRAM lists; a page of another name is a fault. Each law has a header,
a source, a test, a page and a scenario that uses it; each method likewise, where one file pair may serve a family:
resonance.{hpp,cpp} serves resonance_two_point; and a shipped stress test names it among its methods. Each analysis has its pair in scenarios/analyses/ or bench/, a test
that names it, a section in docs/analyses.md and a scenario that uses it; a .js file beside the pairs is the view of one (without
one the page draws its tables). Every header of a library is in a CMakeLists.txt (public under
HEADERS, which makes a FILE_SET; private under SOURCES), so is every source; a name under PAIRS stands for header,
source and test. The first line of every shipped scenario points editors to the schema.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import yaml

CODE = ["core", "friction_models", "sim", "identify", "scenarios", "bench", "cli", "python", "tests"]
LIBRARIES = ["core", "friction_models", "sim", "identify", "scenarios"]  # folders whose headers are installed
PAIR_LIST = re.compile(r"\bdualdamp_module\([^)]*?\bPAIRS\b(.*?)(?:\b(?:HEADERS|SOURCES|PUBLIC|PRIVATE)\b|\))", re.DOTALL)
CAMPAIGNS = ["scenarios/stress"]
SHIPPED = ["scenarios/examples", "scenarios/paper", *CAMPAIGNS]
ANALYSES = ["scenarios/analyses", "bench"]  # folders with the pairs of analyses


def listed(program, command):
    """First column of `program command`: the names."""
    result = subprocess.run([program, command], capture_output=True, text=True, check=True)
    return [line.split()[0] for line in result.stdout.splitlines() if line.strip()]


def family(name):
    """resonance_two_point, resonance_two, resonance: the names a file that serves it may have."""
    words = name.split("_")
    return ["_".join(words[:count]) for count in range(len(words), 0, -1)]


def words_of(node, key):
    """Every text under `key` anywhere in a YAML document: {law: coulomb} and methods: [a, b]."""
    if isinstance(node, dict):
        for name, value in node.items():
            if name == key:
                yield from (v for v in (value if isinstance(value, list) else [value]) if isinstance(v, str))
            yield from words_of(value, key)
    elif isinstance(node, list):
        for value in node:
            yield from words_of(value, key)


def scenario_files(root, folders=SHIPPED):
    return sorted(p for folder in folders for p in (root / folder).rglob("*.yaml"))


def used_words(root, key, folders=SHIPPED):
    return {word for path in scenario_files(root, folders) for word in words_of(yaml.safe_load(path.read_text()), key)}


def lacking(root, places):
    """Of places [what, [candidate patterns]], those with no candidate present."""
    for what, candidates in places:
        if not any(path.is_file() for pattern in candidates for path in root.glob(pattern)):
            yield f"no {what} ({candidates[0]})"


def law_faults(root, names):
    used = used_words(root, "law")
    for name in names:
        yield from (f"law {name}: {fault}" for fault in lacking(root, [
            ("header", [f"friction_models/laws/{name}.hpp"]),
            ("source", [f"friction_models/laws/{name}.cpp"]),
            ("test", [f"tests/friction_models/laws/test_{name}.cpp"]),
            ("page", [f"docs/laws/{name}.md"]),
        ]))
        if name not in used:
            yield f"law {name}: no scenario uses it (scenarios/examples/{name}.yaml)"
    for page in sorted((root / "docs/laws").glob("*.md")):
        if page.stem not in names and page.stem not in ("README", "index"):
            yield f"docs/laws/{page.name}: the program lists no such law"


def method_faults(root, names):
    used = used_words(root, "methods")
    tested = used_words(root, "methods", CAMPAIGNS)
    for name in names:
        stems = family(name)
        yield from (f"method {name}: {fault}" for fault in lacking(root, [
            ("header", [f"identify/methods/*/{stem}.hpp" for stem in stems]),
            ("source", [f"identify/methods/*/{stem}.cpp" for stem in stems]),
            ("test", [f"tests/identify/methods/*/test_{stem}.cpp" for stem in stems]),
            ("page", [f"docs/methods/{name}.md"]),
        ]))
        if name not in used:
            yield f"method {name}: no scenario uses it"
        elif name not in tested:
            yield f"method {name}: no stress test names it ({CAMPAIGNS[0]}/)"
    for page in sorted((root / "docs/methods").glob("*.md")):
        if page.stem not in names and page.stem not in ("README", "index", "accuracy"):
            yield f"docs/methods/{page.name}: the program lists no such method"


def analysis_faults(root, names):
    used = {yaml.safe_load(path.read_text()).get("analysis", {}).get("type") for path in scenario_files(root)}
    page = root / "docs/analyses.md"
    sections = re.findall(r"^## `(\w+)`$", page.read_text() if page.is_file() else "", re.MULTILINE)
    tests = "".join(path.read_text() for folder in ("tests/scenarios", "tests/bench")
                    for path in (root / folder).rglob("*.cpp"))
    for name in names:
        yield from (f"analysis {name}: {fault}" for fault in lacking(root, [
            ("header", [f"{folder}/{name}.hpp" for folder in ANALYSES]),
            ("source", [f"{folder}/{name}.cpp" for folder in ANALYSES]),
        ]))
        if not re.search(rf"\b{name}(_analysis)?\b", tests):
            yield f"analysis {name}: no test names it"
        if name not in sections:
            yield f"analysis {name}: no section (docs/analyses.md)"
        if name not in used:
            yield f"analysis {name}: no scenario uses it (scenarios/examples/{name}.yaml)"
    for name in sections:
        if name not in names:
            yield f"docs/analyses.md: the program lists no analysis {name}"
    for path in sorted(p for folder in ANALYSES for p in (root / folder).glob("*.js")):
        if path.stem not in names:
            yield f"{path.relative_to(root)}: the program lists no such analysis"


def order_faults(kind, names):
    if names != sorted(set(names)):
        yield f"{kind}: the program's list is not sorted or names one twice"


def built_files(root):
    """Paths of the sources and headers that the folders' CMakeLists.txt name."""
    found = set()
    for folder in CODE:
        for cmake in (root / folder).rglob("CMakeLists.txt"):
            text = re.sub(r"#.*", "", cmake.read_text())
            for name in re.findall(r"[\w./-]+\.[ch]pp\b", text):
                found.add((cmake.parent / name).resolve())
            for name in (name for part in PAIR_LIST.findall(text) for name in part.split()):
                room, stem = name.rsplit("/", 1)
                found |= {root / folder / f"{name}.{ending}" for ending in ("hpp", "cpp")}
                found.add(root / "tests" / folder / room / f"test_{stem}.cpp")
    return found


def build_faults(root):
    built = built_files(root)
    for folder in CODE:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            if (root / "tests/package") in path.parents or (path.suffix == ".hpp" and folder not in LIBRARIES):
                continue
            if path not in built:
                where = "CMakeLists.txt (under HEADERS, or SOURCES when private)" if path.suffix == ".hpp" else "CMakeLists.txt"
                yield f"{path.relative_to(root)}: not in a {where}"


def scenario_faults(root):
    schema = root / "scenarios/scenario.schema.json"
    for path in scenario_files(root):
        first = path.read_text().split("\n", 1)[0]
        expected = "# yaml-language-server: $schema=" + os.path.relpath(schema, path.parent)
        if first != expected:
            yield f"{path.relative_to(root)}:1: the first line must be: {expected}"


def faults(root, program):
    laws, methods, analyses = (listed(program, kind) for kind in ("laws", "methods", "analyses"))
    if not laws or not methods or not analyses:
        yield "the program lists no laws, no methods or no analyses"
    yield from order_faults("laws", laws)
    yield from order_faults("methods", methods)
    yield from law_faults(root, laws)
    yield from method_faults(root, methods)
    yield from analysis_faults(root, analyses)
    yield from build_faults(root)
    yield from scenario_faults(root)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    found = list(faults(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()))
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
