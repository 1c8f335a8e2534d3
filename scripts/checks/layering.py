#!/usr/bin/env python3
"""Fails when a folder includes or links what its place in the architecture does not allow.

usage: layering.py ROOT

FOLDERS says which folders may include which, ROOMS the same of the rooms inside a folder; LIBRARIES says where each
foreign library may appear. A header is public when a CMakeLists.txt names it under HEADERS (they are installed),
private otherwise. Two types of one name in one namespace break the rule of one definition: the linker takes one of
them for both, without a word. Messages of the folders below bench/ name no option of a command line: the Python
package and other programs show them too (core/setting.hpp). A name under PAIRS stands for a public header, NAME.hpp,
and a source.
"""

import re
import sys
from pathlib import Path

# What a folder may include from the project, beside itself. tests/ may include anything.
FOLDERS = {
    "core": [],
    "friction_models": ["core"],
    "sim": ["core", "friction_models"],
    "identify": ["core", "friction_models", "sim"],
    "scenarios": ["core", "friction_models", "sim", "identify"],
    "bench": ["core", "friction_models", "sim", "identify", "scenarios"],
    "cli": ["core", "friction_models", "sim", "identify", "scenarios", "bench"],
    "python": ["core", "friction_models", "sim", "identify", "scenarios", "bench", "cli"],  # of cli/ the page of results
}
# What a room may include of its own folder, beside itself. "." is the folder's own top level. Each room stands below
# the rooms that name it, so the includes of rooms go one way; only the top level, with its lists of laws, methods and
# analyses, stands below and above them.
ROOMS = {
    "core": {
        ".": [],
        "crossing": ["."],
    },
    "friction_models": {
        ".": ["laws", "modifiers"],  # the list of laws; the wrapper of plugins
        "formulas": ["."],
        "modifiers": ["."],
        "laws": [".", "formulas", "modifiers"],
    },
    "sim": {
        ".": [],
        "steppers": ["."],
        "engine": [".", "steppers"],
        "analytic": ["."],
        "motion": [".", "engine"],
        "batch": [".", "engine"],
        "orbits": [".", "engine", "motion", "analytic", "batch"],  # a search tries packs first
        "curves": [".", "engine", "motion", "analytic", "batch", "orbits"],
        "law_host": [".", "steppers"],
        "conformance": [".", "steppers", "law_host"],
    },
    "identify": {
        ".": ["methods"],  # the list of methods
        "statistics": ["."],
        "records": [".", "statistics"],
        "readers": [".", "statistics", "records"],
        "models": [".", "statistics"],
        "uncertainty": [".", "statistics", "records", "models"],
        "departures": [".", "records"],
        "methods": [".", "statistics", "records", "models", "uncertainty", "departures"],
        "experiments": [".", "statistics", "records"],
        "fit": [".", "statistics", "records", "experiments"],
        "ledger": [".", "statistics", "records", "models", "uncertainty", "methods"],
        "outliers": [".", "statistics", "ledger"],
        "answer": [".", "statistics", "methods", "ledger"],
        "design": [".", "statistics", "methods"],
    },
    "bench": {
        ".": ["mechanisms", "score"],  # what both analyses run; the scores know the grid and the predictions
        "mechanisms": ["."],
        "score": ["."],
        "contest": [".", "score"],
        "crosscheck": [],
        "speed": [],
        "accuracy": [],
    },
    "scenarios": {
        ".": ["format", "results", "measurements", "analyses", "sweep", "verification"],  # loads and runs
        "format": [],
        "results": ["format"],
        "measurements": ["format"],
        "analyses": [".", "format", "results", "measurements"],
        "sweep": [".", "format", "results", "analyses"],
        "verification": [".", "format", "results"],
    },
}
ANYWHERE = list(FOLDERS)
ABOVE_SIM = ["identify", "scenarios", "bench", "cli", "python"]

# Files that may include a library: sources, private headers too, or all headers too.
SOURCES, PRIVATE, PUBLIC = range(3)

# Library: (its includes, the folders that may use it, the files that may). The first match counts.
LIBRARIES = {
    "Eigen's plain matrices": (r"Eigen/Core", ANYWHERE, PUBLIC),
    "Eigen beyond Eigen/Core": (r"(unsupported/)?Eigen/", ANYWHERE, PRIVATE),
    "udunits2": (r"udunits2?\.h", ["core"], SOURCES),
    "Random123": (r"Random123/", ["core"], SOURCES),
    "OpenSSL": (r"openssl/", ["core"], SOURCES),
    "the processor's own functions": (r"immintrin\.h", ["sim"], SOURCES),
    "SLEEF": (r"sleef\.h", ["sim"], SOURCES),
    "the thread sanitizer": (r"sanitizer/", ["sim"], SOURCES),
    "oneTBB": (r"(tbb|oneapi)/", ["sim"], SOURCES),
    "Boost.Odeint": (r"boost/numeric/odeint", ["sim", "bench"], SOURCES),
    "SUNDIALS": (r"(cvode|nvector|sundials|sunlinsol|sunmatrix|sunnonlinsol)/", ["bench"], SOURCES),
    "Boost": (r"boost/", ["core", "sim", *ABOVE_SIM], SOURCES),
    "Ceres": (r"(ceres|glog)/", ["identify"], SOURCES),
    "yaml-cpp": (r"yaml-cpp/", ["scenarios"], SOURCES),
    "matio": (r"matio\.h", ["identify", "scenarios"], SOURCES),
    "HDF5": (r"hdf5\.h", ["identify"], SOURCES),
    "iconv of the C library": (r"iconv\.h", ["identify"], SOURCES),
    "nlohmann-json": (r"nlohmann/", ["scenarios", "bench", "cli"], PUBLIC),
    "pybind11": (r"pybind11/", ["python"], PRIVATE),
    "fmt": (r"fmt/", ABOVE_SIM, SOURCES),
    "CLI11": (r"CLI/", ["cli"], PUBLIC),
    "MPI": (r"mpi\.h", ["bench"], SOURCES),
    "the dynamic loader": (r"dlfcn\.h", ["friction_models"], SOURCES),
    "the operating system": (r"(sys/\w+|unistd|fcntl|pthread|poll|signal|termios)\.h", ["identify", "scenarios", "bench", "cli", "python"], SOURCES),
}
STANDARD = re.compile(r"[a-z_0-9]+$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
HEADER_LIST = re.compile(r"\bHEADERS\b(.*?)(?:\bSOURCES\b|\))", re.DOTALL)
PAIR_LIST = re.compile(r"\bPAIRS\b(.*?)(?:\b(?:HEADERS|SOURCES|PUBLIC|PRIVATE)\b|\))", re.DOTALL)
LINKED = re.compile(r"\b(?:dualdamp_|dualdamp::)(%s)\b" % "|".join(FOLDERS))
TYPE = re.compile(r"(?:struct|class|enum class|union) (?:\[\[\w+\]\] )?(\w+)(?: final)?\s*(?::[^:;]|\{|$)")
# Folders whose messages name no option, and what an option looks like; in a text, "dualdamp COMMAND" may have some.
WITHOUT_OPTIONS = ["core", "friction_models", "sim", "identify", "scenarios"]
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]+")
# Folders that keep a library in a single file.
ONE_FILE = {"Boost.Odeint": "sim", "the operating system": "identify"}


def source_files(root, folder):
    return sorted(p for p in (root / folder).rglob("*") if p.suffix in (".hpp", ".cpp", ".h", ".ipp"))


def public_headers(root):
    """Paths relative to the root of the headers that a CMakeLists.txt names under HEADERS."""
    found = set()
    for folder in FOLDERS:
        for cmake in (root / folder).rglob("CMakeLists.txt"):
            text = re.sub(r"#.*", "", cmake.read_text())
            names = [name for part in HEADER_LIST.findall(text) for name in part.split()]
            names += [name + ".hpp" for part in PAIR_LIST.findall(text) for name in part.split()]
            paths = (cmake.parent / name for name in names)
            found |= {str(path.relative_to(root)) for path in paths if path.suffix in (".hpp", ".h") and path.exists()}
    return found


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def room_of(path):
    """The room of a file: "engine" of sim/engine/state.hpp, "." of sim/model.hpp."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else "."


def room_fault(path, target):
    """Why a file may not include another one of its folder, or None."""
    folder, room, owner = path.split("/")[0], room_of(path), room_of(target)
    if folder not in ROOMS or room == owner:
        return None
    if room not in ROOMS[folder]:
        return f"{folder}/{room}/ is no room listed in scripts/checks/layering.py"
    if owner in ROOMS[folder][room]:
        return None
    where = f"{folder}/" if room == "." else f"{folder}/{room}/"
    return f"{where} may include of {folder}/ only {', '.join(ROOMS[folder][room]) or 'itself'}"


def project_fault(root, path, target, public):
    """Why file `path` may not include project file `target`, or None."""
    folder, owner = path.split("/")[0], target.split("/")[0]
    if folder == "tests":
        return None if (root / target).exists() else "no such file"
    if owner == "tests":
        return "only tests include tests"
    if owner != folder and owner not in FOLDERS[folder]:
        allowed = ", ".join([folder, *FOLDERS[folder]])
        return f"{folder}/ may include only {allowed}"
    if not (root / target).exists():
        return "no such file"
    if owner == folder and (fault := room_fault(path, target)):
        return fault
    if owner != folder and target not in public:
        return f"this header is private to {owner}/"
    if path in public and target not in public:
        return "a public header may not include a private one"
    return None


def library_fault(path, target, public):
    """Why file `path` may not include foreign header `target`, or None."""
    folder = path.split("/")[0]
    if folder == "tests" or STANDARD.match(target):
        return None
    rank = SOURCES if path.endswith(".cpp") else PUBLIC if path in public else PRIVATE
    for name, (pattern, folders, files) in LIBRARIES.items():
        if not re.match(pattern, target):
            continue
        if folder not in folders:
            return f"{name} may appear only in {', '.join(f + '/' for f in folders)}"
        if rank > files:
            return f"{name} belongs in {('.cpp files', '.cpp files and private headers')[files]}"
        return None
    return "this library is not on the list in scripts/checks/layering.py"


def include_faults(root, path, public):
    text = (root / path).read_text()
    if not path.endswith(".cpp") and not re.search(r"^#pragma once$", text, re.MULTILINE):
        yield f"{path}:1: a header without #pragma once"
    for match in INCLUDE.finditer(text):
        target = match[2]
        owner = target.split("/")[0] if "/" in target else ""
        if owner in FOLDERS or owner == "tests":
            fault = project_fault(root, path, target, public)
        elif match[1] == '"' and path.startswith("tests/") and (root / path).with_name(target).exists():
            fault = None
        elif match[1] == '"':
            fault = "project files are included from the root: #include \"folder/file.hpp\""
        else:
            fault = library_fault(path, target, public)
        if fault:
            yield f"{path}:{line_of(text, match.start())}: {match[0].strip()}: {fault}"


def link_faults(root, folder):
    """The libraries of the project that the folder's CMakeLists.txt names."""
    for path in sorted((root / folder).rglob("CMakeLists.txt")):
        text = re.sub(r"#.*", "", path.read_text())
        for match in LINKED.finditer(text):
            if match[1] != folder and match[1] not in FOLDERS[folder]:
                yield f"{path.relative_to(root)}:{line_of(text, match.start())}: {folder}/ may not link {match[0]}"


def one_file_faults(root):
    for library, folder in ONE_FILE.items():
        used = re.compile(rf"^\s*#\s*include\s*<{LIBRARIES[library][0]}", re.MULTILINE)
        users = [p for p in source_files(root, folder) if used.search(p.read_text())]
        if len(users) > 1:
            names = ", ".join(str(p.relative_to(root)) for p in users)
            yield f"{folder}/: {library} belongs in one .cpp, it is in {names}"


def option_faults(root):
    """Options of a command line in the messages of folders that do not know how they are called."""
    for folder in WITHOUT_OPTIONS:
        for path in source_files(root, folder):
            for number, line in enumerate(path.read_text().splitlines(), 1):
                for text in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
                    if (match := OPTION.search(text)) and "dualdamp " not in text:
                        yield f"{path.relative_to(root)}:{number}: {match[0]} is an option of a command line"


def types_of(path):
    """Types that a file defines in a named namespace, with their lines."""
    namespaces = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if match := re.match(r"namespace ?([\w:]*) ?\{", line):
            namespaces.append(match[1])
        elif line.startswith("}  // namespace") and namespaces:
            namespaces.pop()
        elif (match := TYPE.match(line)) and namespaces and "" not in namespaces:
            yield "::".join([*namespaces, match[1]]), number


def type_faults(root):
    first = {}
    for folder in FOLDERS:
        for path in source_files(root, folder):
            for name, line in types_of(path):
                place = f"{path.relative_to(root)}:{line}"
                if name in first:
                    yield f"{place}: {name} is defined in {first[name]} too: the linker takes one of them for both"
                first.setdefault(name, place)


def order_faults(rooms_of=ROOMS):
    """Rooms listed before one that they may include: then two of them could include each other."""
    for folder, rooms in rooms_of.items():
        listed = set()
        for room, allowed in rooms.items():
            listed.add(room)
            for below in allowed:
                if room != "." and below not in listed:
                    yield f"scripts/checks/layering.py: {folder}/{room}/ may include {below}/, which must be listed before it"


def faults(root):
    yield from order_faults()
    public = public_headers(root)
    for folder in [*FOLDERS, "tests"]:
        for path in source_files(root, folder):
            yield from include_faults(root, str(path.relative_to(root)), public)
        if folder in FOLDERS:
            yield from link_faults(root, folder)
    yield from one_file_faults(root)
    yield from option_faults(root)
    yield from type_faults(root)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(faults(Path(sys.argv[1]).resolve()))
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
