"""The JSON Schema of scene files says what the reader does."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from jsonschema import Draft202012Validator
from strategies import Document, documents

from contact_scene import FiniteElementDiscretisation, SceneError, read_scene_file, scene_schema

SCENES = Path(__file__).resolve().parents[1] / "scenes"
VALIDATOR = Draft202012Validator(scene_schema())


def objects(schema: Any) -> list[Any]:
    entries = schema.values() if isinstance(schema, dict) else schema
    nested = [o for e in entries if isinstance(e, dict | list) for o in objects(e)]
    return nested + ([schema] if isinstance(schema, dict) and "properties" in schema else [])


@given(documents())
def test_it_admits_every_valid_scene(document: Document) -> None:
    assert VALIDATOR.is_valid(document)


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_it_admits_every_scene_shipped(path: Path) -> None:
    assert VALIDATOR.is_valid(tomllib.loads(path.read_text()))


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("title", 3),
        ("body", {}),
        ("body", {"material": {"young_modulus": -1, "poisson_ratio": 0.3}}),
        ("body", {"material": {"young_modulus": 1, "poisson_ratio": 0.5001}}),
        ("body", {"material": "rigd"}),
        ("indenter", {"shape": "cone", "material": "rigid", "slope_angle": 2}),
        ("indenter", {"material": "rigid", "slope_angle": 0.2}),
        ("indenter", {"shape": "sphere", "material": "rigid", "radius": "mm"}),
        ("indenter", {"shape": "sphere", "material": "rigid", "radius": 1, "x": 1}),
        ("loading", []),
        ("loading", [{"normal_force": 1, "increments": 0}]),
        ("loading", [{"normal_force": 1, "tangential_force": [1]}]),
        ("semi_analytical", {"cells": [256, 4]}),
        ("semi_analytical", {"tolerance": 1}),
        ("semi_analytical", {"path_accuracy": 0}),
        ("friction", {"coefficient": -1}),
        ("extra", 1),
    ],
)
def test_it_refuses_what_the_reader_refuses(key: str, value: Any) -> None:
    document = tomllib.loads((SCENES / "hertz.toml").read_text())
    assert VALIDATOR.is_valid(document)
    assert not VALIDATOR.is_valid(document | {key: value})


def test_every_key_is_described() -> None:
    assert objects(scene_schema())
    for table in objects(scene_schema()):
        for key, entry in table["properties"].items():
            assert key == "shape" or entry.get("description"), key


# ---- The table [fem_reference] of a scene file.


TABLE = """
[fem_reference]
elements_per_radius = 64
contact_radius = "0.4 mm"
box = 200
mesher = "gmsh"
harmonics = 12
penalty = 30.0
augmentations = 2
tolerance = 1e-9
"""


def file_with(tmp_path, table):
    path = tmp_path / "scene.toml"
    path.write_text((SCENES / "hertz.toml").read_text() + table, encoding="utf-8")
    return path


def test_every_key_is_read(tmp_path):
    assert read_scene_file(file_with(tmp_path, TABLE)).fem_reference == FiniteElementDiscretisation(
        elements_per_radius=64,
        contact_radius=4e-4,
        box=200.0,
        mesher="gmsh",
        harmonics=12,
        penalty=30.0,
        augmentations=2,
        tolerance=1e-9,
    )


def test_absent_means_chosen():
    chosen = read_scene_file(SCENES / "hertz.toml").fem_reference
    assert chosen == FiniteElementDiscretisation()
    assert chosen.box is None
    assert chosen.contact_radius is None


MISTAKES = {
    "elements_per_radius = 3": "a whole number from 4 to 512",
    "elements_per_radius = 32.0": "a whole number from 4 to 512",
    "contact_radius = 0": "a positive length",
    'contact_radius = "1 N"': "a positive length",
    "box = 4": "a number from 5 to 1e6",
    'box = "100 mm"': "a number from 5 to 1e6",
    'mesher = "netgen"': '"tensor" or "gmsh"',
    "harmonics = 1": "a whole number from 2 to 64",
    "penalty = 0": "a number from 0.01 to 1e4",
    "augmentations = -1": "a whole number from 0 to 100",
    "tolerance = 1": "a number from 1e-12 to 0.1",
}


@pytest.mark.parametrize("line", MISTAKES)
def test_a_mistake_is_named_with_its_line_and_key(tmp_path, line):
    path = file_with(tmp_path, "\n[fem_reference]\n" + line)
    with pytest.raises(SceneError) as caught:
        read_scene_file(path)
    (problem,) = caught.value.problems
    assert problem.key == "fem_reference." + line.partition(" ")[0]
    assert problem.line == len(path.read_text().splitlines())
    assert MISTAKES[line] in str(problem)


def test_refined_has_twice_the_elements_and_all_else():
    coarse = FiniteElementDiscretisation(elements_per_radius=16, box=50.0, mesher="gmsh")
    fine = coarse.refined()
    assert fine == coarse.model_copy(update={"elements_per_radius": 32})
    with pytest.raises(ValueError, match="from 4 to 512"):
        FiniteElementDiscretisation(elements_per_radius=257).refined()
