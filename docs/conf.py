"""Sphinx: `./run docs`, or sphinx-build -W -b html docs build/docs. It needs no network."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from made_pages import write_pages  # noqa: E402

from contact_results.directory.machine import program_version  # noqa: E402

project = "slipstick"
author = "slipstick contributors"
copyright = "slipstick contributors, BSD-3-Clause"
release = program_version()

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3
exclude_patterns = ["made/*.md", "__pycache__"]
autodoc_typehints = "description"
autodoc_member_order = "bysource"
nitpicky = False

html_theme = "alabaster"
html_theme_options = {
    "description": "Slip, stick and how accurately they are known",
    "fixed_sidebar": True,
    "page_width": "1080px",
    "sidebar_width": "240px",
    "font_family": "Georgia, 'DejaVu Serif', serif",
}
html_show_sourcelink = False
html_static_path = ["_static"]
html_css_files = ["narrow.css"]


def setup(app) -> None:
    """The pages that are read off the code are written first."""
    app.connect("builder-inited", lambda app: write_pages(HERE))
