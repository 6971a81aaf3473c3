"""Tests of the numbers and stated errors of shipped scenes and gallery: none becomes worse.

They are those that users see; the longest two have fewer cells.
`python tests/test_shipped_scenes.py` saves them anew.
"""

import tempfile
from pathlib import Path

import pytest
from command import slipstick

ROOT = Path(__file__).parents[1]
SCENES = sorted((*ROOT.glob("scenes/*.toml"), *ROOT.glob("docs/gallery/*.toml")))
EXPECTED = Path(__file__).parent / "expected"
FEWER_CELLS = {"fretting_loop": 64, "torsion": 32}


def run(scene: Path, option: str, output: Path) -> int:
    """Run a scene with `--expect` or `--save-expected`; return the exit code."""
    given = ("--figures", "none", option, EXPECTED / f"{scene.stem}.json")
    if cells := FEWER_CELLS.get(scene.stem):
        given += ("--set", f"semi_analytical.cells=[{cells}, {cells}]")
    return slipstick("run", scene, "--output", output, *given)


@pytest.mark.parametrize("scene", SCENES, ids=[scene.stem for scene in SCENES])
def test_no_stated_error_of_a_shipped_scene_grows_by_half(scene, tmp_path):
    """Exit code 7: intervals that exclude each other, a wider error, a new question mark."""
    assert run(scene, "--expect", tmp_path / "out") == 0


def test_every_expectation_is_of_a_shipped_scene():
    assert {file.stem for file in EXPECTED.glob("*.json")} == {scene.stem for scene in SCENES}


if __name__ == "__main__":
    for each in SCENES:
        with tempfile.TemporaryDirectory() as folder:
            run(each, "--save-expected", Path(folder) / "out")
