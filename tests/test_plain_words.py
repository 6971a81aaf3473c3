"""Tests of the English of each package: the share of texts with an unclear habit stays below a
limit, and short private functions have short docstrings."""

from pathlib import Path

import pytest
from plain_words import habits, long_docstrings, texts_of

ROOT = Path(__file__).resolve().parents[1]
# Per cent of the texts. A limit may fall and never rises.
LIMITS = {
    "contact_scene": 3,
    "contact_solver": 3,
    "semi_analytical": 10,
    "fem_reference": 1,
    "radial": 1,
    "contact_errors": 3,
    "contact_results": 4,
    "slipstick": 4,
    "verification": 25,
    "docs": 20,
}


@pytest.mark.parametrize("package", LIMITS)
def test_few_texts_have_a_habit(package):
    found = [
        (f"{path.relative_to(ROOT)}:{line}", habits(text, kind))
        for kind_of in ("*.py", "*.md")
        for path in sorted((ROOT / package).rglob(kind_of))
        if "made" not in path.parts
        for line, kind, text in texts_of(path)
    ]
    marked = [f"{place}: {', '.join(words)}" for place, words in found if words]
    assert len(found) > 50
    assert 100 * len(marked) <= LIMITS[package] * len(found), "\n".join(marked)


@pytest.mark.parametrize("package", sorted(LIMITS.keys() - {"verification", "docs"}))
def test_short_private_functions_have_short_docstrings(package):
    found = [
        f"{path.relative_to(ROOT)}:{line} {name}"
        for path in sorted((ROOT / package).rglob("*.py"))
        for line, name in long_docstrings(path)
    ]
    assert not found, "\n".join(found)
