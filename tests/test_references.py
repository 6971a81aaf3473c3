"""Tests of the stored reference solutions: named, with origins that exist."""

import json
import pkgutil
import re
from pathlib import Path

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
