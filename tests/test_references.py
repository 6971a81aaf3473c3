"""Tests of stored reference solutions: readable and physically possible, with their origin."""

import json
import pkgutil
import re
from pathlib import Path

import numpy as np
import pytest

from verification.references import load_reference

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "verification" / "references").glob("*.json"))
NAMES = re.compile(r"\b(?:verification|radial|fem_reference|semi_analytical)(?:\.\w+)+")
PATHS = re.compile(r"\b(?:verification|docs)/[\w/]+\.\w+")


def texts_of(content):
    """All texts of a reference file."""
    if isinstance(content, dict):
        content = list(content.values())
    if isinstance(content, list):
        return [text for value in content for text in texts_of(value)]
    return [content] if isinstance(content, str) else []


def test_origins_of_references_exist():
    """Unless the text names an older commit."""
    texts = [t for file in FILES for t in texts_of(json.loads(file.read_text("utf-8")))]
    present = [text for text in texts if "at commit" not in text]
    names = [name for text in present for name in NAMES.findall(text)]
    assert "verification.challenge.cases.scene_of" in names
    for name in names:
        assert pkgutil.resolve_name(name) is not None
    for path in (path for text in present for path in PATHS.findall(text)):
        assert (ROOT / path).exists(), path


def test_missing_reference_is_named_and_the_folder_cannot_be_left():
    with pytest.raises(ValueError, match=r"no reference 'nope'; available: .*coated_fr.*, frf, "):
        load_reference("nope")
    with pytest.raises(ValueError, match="no reference"):
        load_reference("../references/frf")


def load_over_hertz(row):
    """Load from the tabulated profile: 3 (a/a_H)² ∫ p/p_H x dx, by a fit of p/√(1-x²) in x²."""
    x, p = np.array(row["r_over_a"]), np.array(row["p_over_pH"])
    smooth = np.polynomial.Polynomial.fit(x**2, p / np.sqrt(1 - x**2), 6)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    x = np.sin(np.pi / 4 * (nodes + 1))
    integrand = smooth(x**2) * (1 - x**2) * x
    return 3 * row["a_over_aH"] ** 2 * (integrand * weights).sum() * np.pi / 4


# Allowed error of the load: a fit through twelve points, or through the kink at the stick radius.
PROFILES = [
    *((row, 2e-4) for row in load_reference("coated_frictionless_paraboloid")["rows"]),
    *((row, 1e-2) for row in load_reference("frictional_indentation_homogeneous")["rows"]),
    (load_reference("frictional_indentation_coated"), 1e-2),
]


@pytest.mark.parametrize(("row", "allowed"), PROFILES)
def test_profiles_carry_the_load(row, allowed):
    assert load_over_hertz(row) == pytest.approx(1, abs=allowed)
