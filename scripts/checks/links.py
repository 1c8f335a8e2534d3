#!/usr/bin/env python3
"""Fails when a page links or names a file of the tree, or links a heading of a page, that does not exist, or when the site lacks a page.

usage: links.py ROOT

Read are all Markdown files but those of build trees; those of docs/site/ stand among the pages of docs/ on the site. Headings
have the anchors that GitHub and MyST give them. Links to other sites are not followed. A page of docs/ stands in a table of
contents (`toctree`) of docs/site/. Pages of docs/ name files between backticks by their paths from ROOT, with an extension;
NAME and GROUP stand for any name, and results/ is what programs write.
"""

import re
import sys
from pathlib import Path
from urllib.parse import unquote

TOCTREE = re.compile(r"^```\{toctree\}$(.*?)^```$", re.MULTILINE | re.DOTALL)
FENCE = re.compile(r"^(```+|~~~+).*?^\1\s*$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(`+).*?\1", re.DOTALL)
LINK = re.compile(r"\[[^\]]*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$", re.MULTILINE)
NAMED = re.compile(r"`([\w.+-]+(?:/[\w.+-]+)+\.\w+)`")
TEMPLATE = re.compile(r"NAME|GROUP")
WRITTEN = ("results", "build")
ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


def blank(match):
    return re.sub(r"[^\n]", " ", match[0])


def anchors(text):
    found = set()
    for heading in HEADING.findall(FENCE.sub(blank, text)):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        again = 0
        while (name := f"{anchor}-{again}" if again else anchor) in found:
            again += 1
        found.add(name)
    return found


def pages(root):
    for path in sorted(root.rglob("*.md")):
        parts = path.relative_to(root).parts
        if "build" not in parts and not any(part.startswith(".") for part in parts):
            yield path


def link_faults(root, page, text):
    plain = CODE.sub(blank, FENCE.sub(blank, text))
    # Those of docs/site/ find their neighbours there and in docs/.
    folders = [root / "docs", page.parent] if page.parent == root / "docs/site" else [page.parent]
    for match in LINK.finditer(plain):
        target = match[1]
        if ELSEWHERE.match(target):
            continue
        name, _, anchor = unquote(target).partition("#")
        places = [(folder / name).resolve() for folder in folders] if name else [page]
        path = next((place for place in places if place.exists()), places[0])
        where = f"{page.relative_to(root)}:{plain.count(chr(10), 0, match.start()) + 1}"
        if not path.exists():
            yield f"{where}: no file '{target}'"
        elif anchor and path.suffix == ".md" and anchor not in anchors(path.read_text(encoding="utf-8")):
            yield f"{where}: no heading '#{anchor}' in {path.relative_to(root)}"


def name_faults(root, page, text):
    plain = FENCE.sub(blank, text)
    for match in NAMED.finditer(plain):
        first = match[1].split("/")[0]
        if first in WRITTEN or TEMPLATE.search(match[1]) or not (root / first).is_dir() or (root / match[1]).exists():
            continue
        yield f"{page.relative_to(root)}:{plain.count(chr(10), 0, match.start()) + 1}: no file '{match[1]}'"


def site_faults(root):
    site = root / "docs/site"
    listed = {line.strip() for page in site.glob("*.md") for tree in TOCTREE.findall(page.read_text(encoding="utf-8"))
              for line in tree.splitlines()}
    for page in sorted((root / "docs").glob("*.md")):
        if page.stem not in listed:
            yield f"{page.relative_to(root)}: no table of contents of docs/site/ holds this page"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = Path(sys.argv[1]).resolve()
    found = [fault for page in pages(root) for fault in link_faults(root, page, page.read_text(encoding="utf-8"))]
    found += [fault for page in pages(root) if page.relative_to(root).parts[0] == "docs"
              for fault in name_faults(root, page, page.read_text(encoding="utf-8"))]
    found += site_faults(root)
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
