"""Sphinx configuration. Build by `./run docs`, or sphinx-build -W -b html docs build/docs."""

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
NAMED = re.compile(r"^(\w+) {2,}(?=\S)")
sys.path[:0] = [str(HERE), str(HERE.parent)]

from docutils import nodes  # noqa: E402
from docutils.utils.math import latex2mathml  # noqa: E402
from made_pages import write_pages  # noqa: E402
from made_reference import parameters  # noqa: E402
from pydantic import BaseModel  # noqa: E402

from contact_results.directory.machine import program_version  # noqa: E402

project = "slipstick"
author = "slipstick contributors"
copyright = "slipstick contributors, BSD-3-Clause"
release = program_version()

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
smartquotes_action = "qe"  # the two hyphens of an option are no dash
exclude_patterns = ["made/*.md", "__pycache__"]
autodoc_typehints = "description"
autodoc_member_order = "bysource"
nitpicky = False

html_math_renderer = "mathml"  # by docutils: the pages need no network either
html_theme = "alabaster"
html_theme_options = {
    "description": "Frictional contact of coated bodies, with the error of each number",
    "fixed_sidebar": True,
    "page_width": "1240px",
    "body_max_width": "none",
    "sidebar_width": "240px",
    "font_family": "Georgia, 'DejaVu Serif', serif",
}
html_show_sourcelink = False
html_static_path = ["_static"]  # the theme itself links custom.css
html_sidebars = {"**": ["menu.html", "searchfield.html", "navigation.html"]}
templates_path = ["_templates"]


def setup(app) -> None:
    """Register the hooks of this build: generated pages, parameter lists and formulas."""
    app.connect("builder-inited", lambda app: write_pages(HERE))
    app.connect("autodoc-process-docstring", list_parameters)
    app.add_html_math_renderer("mathml", (formula, None), (formula, None))


def list_parameters(app, _kind, name, thing, _options, lines) -> None:
    """Convert a docstring to a parameter list for Sphinx.

    Lines that begin with a name and two spaces become parameters. For objects of a scene, the
    descriptions of its keys are appended and type annotations are removed.
    """
    lines[:] = [NAMED.sub(r":param \1: ", line) for line in lines]
    if isinstance(thing, type) and issubclass(thing, BaseModel):
        app.env.current_document.autodoc_annotations.pop(name, None)
        lines += ["", *(f":param {key}: {text}" for key, text in parameters(thing)), ""]


def formula(page, node) -> None:
    """Write a formula as MathML."""
    text, block = node.astext().replace("\\tfrac", "\\frac"), node.tagname == "math_block"
    page.body.append(latex2mathml.tex2mathml(text, as_block=block))
    raise nodes.SkipNode
