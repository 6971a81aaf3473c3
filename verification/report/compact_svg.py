"""A drawing of matplotlib's without what a page does not need: two thirds of its bytes go."""

from __future__ import annotations

import hashlib
import re

NUMBER = re.compile(r"-?\d+\.\d+")
DIGITS = 6  # of the digest that stands for a figure's name
DECIMALS = 1  # of a point, 1/72 inch
FINE_DECIMALS, SMALL = 2, 10.0  # for the shapes of marks
REFERENCE = re.compile(r'(?:xlink:href="#|url\(#)([^")]*)')


def compact(svg: str, name: str) -> str:
    """The same picture in fewer bytes.

    name  unique in the page: two figures cannot refer to each other's parts
    """
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<!--.*?-->|<style.*?</style>", "", svg, flags=re.DOTALL)
    svg = _with_own_ids(svg, name)
    svg = re.sub(r' style="([^"]*)"', _short_style, svg)
    svg = re.sub(r' transform="rotate\(-?0 [^"]*\)"', "", svg)
    svg = re.sub(r' (d|x|y|width|height|points|transform|viewBox)="([^"]*)"', _short_numbers, svg)
    svg = svg.replace("xlink:href", "href")
    svg = re.sub(r' (?:xmlns(?::xlink)?|version)="[^"]*"', "", svg)
    svg = re.sub(r"\s*\n\s*", " ", svg)
    svg = re.sub(r"> <", "><", svg)
    return _without_empty_groups(svg)


def _with_own_ids(svg: str, name: str) -> str:
    """Ids that something refers to, numbered in order; the others go."""
    wanted = set(REFERENCE.findall(svg))
    kept = [i for i in re.findall(r'\bid="([^"]*)"', svg) if i in wanted]
    short = hashlib.sha256(name.encode()).hexdigest()[:DIGITS]
    new = {old: f"f{short}.{number}" for number, old in enumerate(dict.fromkeys(kept))}
    svg = re.sub(r' id="([^"]*)"', lambda m: f' id="{new[m[1]]}"' if m[1] in new else "", svg)
    svg = re.sub(r'xlink:href="#([^"]*)"', lambda m: f'xlink:href="#{new[m[1]]}"', svg)
    return re.sub(r"url\(#([^)]*)\)", lambda m: f"url(#{new[m[1]]})", svg)


def _short_style(match: re.Match[str]) -> str:
    """The font's family is the page's."""
    parts = [part.strip().replace(": ", ":") for part in match[1].split(";")]
    return f' style="{";".join(p for p in parts if p and not p.startswith("font-family"))}"'


def _short_numbers(match: re.Match[str]) -> str:
    text = NUMBER.sub(lambda number: _short_number(float(number[0])), match[2])
    text = re.sub(r"\s+", " ", text).strip()
    return f' {match[1]}="{re.sub(r" ?([MLQCz]) ?", lambda m: m[1], text)}"'


def _short_number(value: float) -> str:
    decimals = FINE_DECIMALS if abs(value) < SMALL else DECIMALS
    return f"{value:.{decimals}f}".rstrip("0").rstrip(".")


def _without_empty_groups(svg: str) -> str:
    """Groups without attributes say nothing; those that are empty neither."""
    while (shorter := re.sub(r"<(g|defs)></\1>", "", svg)) != svg:
        svg = shorter
    return _unwrapped(svg)


def _unwrapped(svg: str) -> str:
    """`<g>` and its own `</g>` taken away, where it has no attribute."""
    kept: list[bool] = []

    def end(match: re.Match[str]) -> str:
        if match[0] == "</g>":
            return match[0] if kept.pop() else ""
        if match[0].endswith("/>"):
            return match[0]
        kept.append(match[0] != "<g>")
        return match[0] if kept[-1] else ""

    return re.sub(r"<g(?: [^>]*)?>|</g>", end, svg)
