#!/usr/bin/env python3
"""The check of links passes a tree whose links lead somewhere and names each planted fault."""

import unittest

from planted import Planted

SOUND = {
    "README.md": "# Tool\n\n[guide](docs/guide.md), [part](docs/guide.md#add-a-law-lugre), [here](#tool), [far](https://example.org/none)\n"
                 "`[no](link)`\n\n```sh\n[none](either)\n# no heading\n```\n",
    "docs/guide.md": "# Guide\n\n## Add a law: `lugre`\n\n## Twice\n\n## Twice\n\n![picture](images/a.svg) [second](#twice-1) [folder](../docs)\n"
                     "`docs/site/index.md` `docs/laws/NAME.md` `cases/000001.csv` `results/a/report.html`\n\n```sh\n`docs/none.md`\n```\n",
    "docs/site/index.md": "[guide](guide.md)\n\n```{toctree}\n:hidden:\n\nguide\n```\n",
    "docs/images/a.svg": "",
    "build/ci/a.md": "[none](none.md)\n",
}

# One change to the sound tree, and words of the one complaint.
FAULTS = {
    "file that is gone": ("docs/laws/a.md", "\n[b](b.md)\n", ["docs/laws/a.md:2", "no file 'b.md'"]),
    "picture that is gone": ("docs/guide.md", SOUND["docs/guide.md"].replace("a.svg", "b.svg"), ["docs/guide.md:9", "no file 'images/b.svg'"]),
    "heading that is gone": ("docs/laws/a.md", "[b](../guide.md#add-a-method)\n", ["docs/laws/a.md:1", "no heading '#add-a-method' in docs/guide.md"]),
    "heading in a block of code": ("docs/laws/a.md", "[b](../../README.md#no-heading)\n", ["no heading '#no-heading'"]),
    "name of a file that is gone": ("docs/laws/a.md", "\n\n`docs/images/b.svg`\n", ["docs/laws/a.md:3", "no file 'docs/images/b.svg'"]),
    "page that the site lacks": ("docs/a.md", "# A\n", ["docs/a.md: no table of contents"]),
    "heading of the page itself": ("README.md", "# Other\n" + SOUND["README.md"].removeprefix("# Tool\n"), ["README.md:3", "no heading '#tool'"]),
}


class Links(Planted, unittest.TestCase):
    check = "links"
    sound = SOUND
    faults = FAULTS


if __name__ == "__main__":
    unittest.main()
