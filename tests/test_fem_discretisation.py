"""The table [fem_reference] of a scene file."""

import tomllib
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from contact_scene import (
    FiniteElementDiscretisation,
    SceneError,
    read_scene_file,
    scene_schema,
)

SCENES = Path(__file__).resolve().parents[1] / "scenes"
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


# A schema knows neither units nor that 32.0 is not the way to write a whole number.
@pytest.mark.parametrize("line", [x for x in MISTAKES if "32.0" not in x and "1 N" not in x])
def test_the_schema_refuses_what_the_reader_refuses(line):
    validator = Draft202012Validator(scene_schema())
    text = (SCENES / "hertz.toml").read_text()
    assert validator.is_valid(tomllib.loads(text + TABLE))
    assert not validator.is_valid(tomllib.loads(text + "\n[fem_reference]\n" + line))


def test_refined_has_twice_the_elements_and_all_else():
    coarse = FiniteElementDiscretisation(elements_per_radius=16, box=50.0, mesher="gmsh")
    fine = coarse.refined()
    assert fine == coarse.model_copy(update={"elements_per_radius": 32})
    with pytest.raises(ValueError, match="from 4 to 512"):
        FiniteElementDiscretisation(elements_per_radius=257).refined()
