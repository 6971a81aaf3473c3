"""Styles that the figures of a page have in common, written once in its head."""

from __future__ import annotations

import re
from collections import Counter

FIGURE = re.compile(r"<svg[ >].*?</svg>", re.DOTALL)
# Within a tag alone: text cannot hold an opening bracket.
STYLED = re.compile(r'(<\w[^<>]*?) style="([^"<>{}]*)"')
HEAD = "</style>\n</head>"
NAME = "s"


def with_shared_styles(page: str) -> str:
    """The same page, where every style that several parts of its figures have is a class.

    Numbered in the order of their first use, so that equal pages stay equal.
    """
    counts = Counter(
        style for figure in FIGURE.findall(page) for _, style in STYLED.findall(figure)
    )
    shared = [style for style, count in counts.items() if count > 1]
    names = {style: f"{NAME}{number}" for number, style in enumerate(shared)}
    page = FIGURE.sub(lambda figure: STYLED.sub(lambda tag: _classed(tag, names), figure[0]), page)
    rules = "".join(f"svg .{name} {{ {style} }}\n" for style, name in names.items())
    return page.replace(HEAD, rules + HEAD, 1)


def _classed(tag: re.Match[str], names: dict[str, str]) -> str:
    name = names.get(tag[2])
    return tag[0] if name is None else f'{tag[1]} class="{name}"'
