#!/usr/bin/env python3
"""Fails when code and pages do not use the words of docs/glossary.md.

usage: words.py ROOT

The glossary is made of tables with the columns: term, symbol, unit, meaning, in the code, replaced. Three rules:

* A term is found, under that name, in the code and on a page beside the glossary. "static friction" is also found as
  static_friction and StaticFriction, and in the plural.
* Each `name` under "in the code" is a file, a folder or an identifier of the sources.
* No `regular expression` under "replaced" matches a source, comment, message, page, script, shipped scenario or test.
  Letter case does not matter; a space matches any white space, also from one comment line to the next.

CONTRACT names the keys and columns of files that keep their name though the word was replaced.
"""

import re
import sys
from pathlib import Path

HEADER = ["term", "symbol", "unit", "meaning", "in the code", "replaced"]
GLOSSARY = "docs/glossary.md"
CODE = ["core", "friction_models", "sim", "identify", "scenarios", "bench", "cli", "python"]
EVERYWHERE = [*CODE, "tests", "docs", "scripts", "cmake"]
SOURCES = (".hpp", ".cpp", ".h", ".c", ".js", ".py", ".html", ".css", ".in")
TEXTS = (*SOURCES, ".md", ".yaml", ".txt", ".cmake", "")
# What may name a replaced word: the glossary, this check with its test, and what happened.
EXEMPT = {GLOSSARY, "scripts/checks/words.py", "tests/checks/test_words.py", "CHANGELOG.md"}
# Keys and columns of YAML, JSON and CSV files.
CONTRACT = ["cycles", "stops_per_cycle", "average_cycles", "jump_cycle", "knew", "multipliers"]

# Between two words of a phrase: white space, also with the signs of a comment or of a text that goes on.
GAP = r'[\s/#*"]+'
QUOTED = re.compile(r"`([^`]+)`")
# A contract name as one: in quotes or backticks, as a key before a colon, as an argument of Python, as the end of a path, after "takes only one of".
AS_CONTRACT = re.compile(
    r"(?P<quote>[`\"'])(?P<path>[\w.\[\]]*?)\b(?:{0})(?P=quote)|\b(?:{0})(?=\s*:|=\w)|(?<=[\w\]]\.)(?:{0})\b|\bone of duration, (?:{0})\b".format(
        "|".join(CONTRACT)))


class Term:
    def __init__(self, line, cells):
        self.line = line
        self.name, _, _, _, code, replaced = cells
        self.code = QUOTED.findall(code)
        self.replaced = QUOTED.findall(replaced)


def cells_of(line):
    """The cells of a row of a table; a | inside a cell is written \\|."""
    cells = re.split(r"(?<!\\)\|", line.strip().strip("|"))
    return [cell.strip().replace("\\|", "|") for cell in cells]


def terms_of(text):
    """The terms of a glossary, and complaints about rows that cannot be read."""
    terms, faults = [], []
    in_table = False
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith("|"):
            in_table = False
            continue
        cells = cells_of(line)
        if cells == HEADER:
            in_table = True
        elif in_table and not re.fullmatch(r"[|\s:-]+", line):
            if len(cells) == len(HEADER):
                terms.append(Term(number, cells))
            else:
                faults.append(f"{GLOSSARY}:{number}: {len(cells)} cells instead of {len(HEADER)}")
    names = [term.name for term in terms]
    faults += [f"{GLOSSARY}:{term.line}: '{term.name}' is stated twice"
               for i, term in enumerate(terms) if term.name in names[:i]]
    return terms, faults


def files(root, folders, suffixes):
    paths = [p for folder in folders for p in (root / folder).rglob("*")]
    paths += [p for p in root.iterdir() if p.suffix == ".md"]
    return sorted(p for p in paths if p.is_file() and p.suffix in suffixes and "__pycache__" not in p.parts)


def read(root, folders, suffixes):
    """Texts by path relative to the root; files that are no text are left out."""
    texts = {}
    for path in files(root, folders, suffixes):
        try:
            texts[str(path.relative_to(root))] = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
    return texts


def in_words(text):
    """Identifiers taken apart: static_friction and StaticFriction as 'static friction'."""
    text = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", text.replace("_", " "))
    return re.sub(GAP, " ", text).lower()


def term_pattern(name):
    words = re.split(r"[\s-]+", name.lower())
    return re.compile(r"\b" + r"[\s-]?".join(re.escape(word) for word in words) + r"(s|es)?\b")


def place_faults(root, term, identifiers):
    """Names under 'in the code' that do not exist."""
    for name in term.code:
        last = re.split(r"::|\.", name)[-1]
        if not (root / name).exists() and ("/" in name or last not in identifiers):
            yield f"{GLOSSARY}:{term.line}: {term.name}: the code has no '{name}'"


def found_faults(term, code, pages):
    pattern = term_pattern(term.name)
    for where, text in (("code", code), ("docs", pages)):
        if not pattern.search(text):
            yield f"{GLOSSARY}:{term.line}: '{term.name}' is not found in the {where}"


def without_contract(text):
    return AS_CONTRACT.sub(lambda match: re.sub(r"\S", "~", match[0]), text)


def replaced_faults(term, texts):
    for expression in term.replaced:
        pattern = re.compile(expression.replace(" ", GAP), re.IGNORECASE)
        for path, text in texts.items():
            for match in pattern.finditer(text):
                line = text.count("\n", 0, match.start()) + 1
                words = re.sub(GAP, " ", match[0]).strip()
                yield f"{path}:{line}: '{words}': the glossary's word is '{term.name}'"


def faults(root):
    terms, found = terms_of((root / GLOSSARY).read_text(encoding="utf-8"))
    if not terms:
        found.append(f"{GLOSSARY}: no table with the columns {', '.join(HEADER)}")
    code = read(root, CODE, SOURCES)
    pages = {path: text for path, text in read(root, ["docs"], (".md",)).items() if path not in EXEMPT}
    identifiers = set(re.findall(r"\w+", " ".join(code.values())))
    code_words, page_words = in_words(" ".join(code.values())), in_words(" ".join(pages.values()))
    texts = {path: without_contract(text) for path, text in read(root, EVERYWHERE, TEXTS).items() if path not in EXEMPT}
    for term in terms:
        found += place_faults(root, term, identifiers)
        found += found_faults(term, code_words, page_words)
        found += replaced_faults(term, texts)
    return found


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = faults(Path(sys.argv[1]).resolve())
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
