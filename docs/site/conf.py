"""The site of docs/ by Sphinx; scripts/site calls it with the pages, the files that they link and the package at hand."""

import re
from pathlib import Path

import yaml
from latex2mathml.converter import convert
from sphinx.util import logging

root = Path(__file__).resolve().parents[2]
project = "dualdamp"
copyright = "dualdamp contributors"
version = re.search(r"project\(dualdamp VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)
release = version

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
myst_dmath_double_inline = True
exclude_patterns = ["site"]
root_doc = "index"
autodoc_member_order = "bysource"
html_theme = "furo"
html_title = f"dualdamp {version}"
html_static_path = ["static"]
html_extra_path = [str(root / "build/site/extra")]  # cpp/: the C++ reference by Doxygen
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
pygments_style = "friendly"
pygments_dark_style = "monokai"
copybutton_prompt_text = r">>> |\.\.\. "
copybutton_prompt_is_regexp = True

logger = logging.getLogger(__name__)


def mathml(node, text, display):
    """Formulas as MathML, which browsers draw without a script and without a network."""
    try:
        return convert(text, display=display)
    except Exception as error:  # of a converter that knows no such command
        logger.warning("formula %r: %s", text, error, location=node)
        return text


def inline_math(translator, node):
    from docutils.nodes import SkipNode

    translator.body.append(mathml(node, node.astext(), "inline"))
    raise SkipNode


def display_math(translator, node):
    from docutils.nodes import SkipNode

    translator.body.append(f'<div class="formula">{mathml(node, node.astext(), "block")}</div>')
    raise SkipNode


def write_gallery(app):
    """A page that lists the shipped scenarios: what links to one of their folders leads there."""
    rows = []
    for folder in ("examples", "paper", "stress"):
        rows += [f"\n## {folder}\n", "| file | question |", "|---|---|"]
        for path in sorted((root / "scenarios" / folder).rglob("*.yaml")):
            title = yaml.safe_load(path.read_text()).get("title", "")
            rows.append(f"| [{path.stem}](../{path.relative_to(root)}) | {title} |")
    text = "# Shipped scenarios\n\nEach checks itself: `dualdamp run FILE` compares its results with those it expects.\n"
    (Path(app.srcdir) / "gallery.md").write_text(text + "\n".join(rows) + "\n")


def lead_to_gallery(app, name, source):
    source[0] = re.sub(r"\]\((\.\./)+scenarios/(examples|paper)/\)", "](/gallery.md)", source[0])


def setup(app):
    from pygments.lexers.special import TextLexer

    app.add_lexer("csv", TextLexer)
    app.connect("builder-inited", write_gallery)
    app.connect("source-read", lead_to_gallery)
    app.add_html_math_renderer("mathml", (inline_math, None), (display_math, None))


html_math_renderer = "mathml"
