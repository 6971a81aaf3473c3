"""Tests of the JSON Schema of scene files: it accepts and refuses the same scenes as the reader."""

import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from jsonschema import Draft202012Validator
from strategies import documents

from contact_scene import (
    scene_schema,
)

SCENES = Path(__file__).resolve().parents[1] / "scenes"
VALIDATOR = Draft202012Validator(scene_schema())


def objects(schema):
    entries = schema.values() if isinstance(schema, dict) else schema
    nested = [o for e in entries if isinstance(e, dict | list) for o in objects(e)]
    return nested + ([schema] if isinstance(schema, dict) and "properties" in schema else [])


@given(documents())
def test_it_admits_every_valid_scene(document):
    assert VALIDATOR.is_valid(document)


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_it_admits_every_scene_shipped(path):
    assert VALIDATOR.is_valid(tomllib.loads(path.read_text()))


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("title", 3),
        ("body", {}),
        ("body", {"material": {"young_modulus": -1, "poisson_ratio": 0.3}}),
        ("indenter", {"shape": "cone", "material": "rigid", "slope_angle": 2}),
        ("indenter", {"material": "rigid", "slope_angle": 0.2}),
        ("indenter", {"shape": "sphere", "material": "rigid", "radius": "mm"}),
        ("loading", []),
        ("loading", [{"normal_force": 1, "increments": 0}]),
        ("loading", [{"normal_force": 1, "tangential_force": [1]}]),
        ("semi_analytical", {"cells": [256, 4]}),
        ("extra", 1),
    ],
)
def test_it_refuses_what_the_reader_refuses(key, value):
    document = tomllib.loads((SCENES / "hertz.toml").read_text())
    assert VALIDATOR.is_valid(document)
    assert not VALIDATOR.is_valid(document | {key: value})


def test_every_key_is_described():
    assert objects(scene_schema())
    for table in objects(scene_schema()):
        for key, entry in table["properties"].items():
            assert key == "shape" or entry.get("description"), key
