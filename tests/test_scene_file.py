"""Tests of scene files: units, overrides, tables and files beside them."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from strategies import as_toml, documents

from contact_scene import (
    RIGID,
    FiniteElementDiscretisation,
    FrictionMap,
    HeightMap,
    Scene,
    SceneError,
    SurfaceDiscretisation,
    load_scene,
    read_scene_file,
)

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "coated_fretting.toml"
LONG = 100_000
# Characters that a terminal does not show, and texts of 100 000 and more of them.
REFUSED = (
    *("indenter.radius=1e999", "indenter.radius=1\nbody=2", "indenter.radius=1\0"),
    *("indenter.radius=\udcff", "indenter.radius=\u202e1"),
    *("title=" + LONG * "a", "title=" + LONG * "[", "title=" + LONG * "{a=", LONG * "a" + "=1"),
    *(LONG * "a." + "a=1", "a" + LONG * "[1]" + "=1", "indenter.radius=" + LONG * "9"),
    *(LONG * "=", LONG * ".", "a" + LONG * ".a", 'title="""' + LONG * "'"),
)


@pytest.mark.parametrize("assignment", REFUSED, ids=lambda given: ascii(given)[:30])
def test_refusal_names_the_option_in_one_line(assignment):
    with pytest.raises(SceneError) as found:
        read_scene_file(SCENE, [assignment])
    named = [str(problem) for problem in found.value.problems if "--set" in str(problem)]
    assert named
    assert all(line.isprintable() and len(line) < 1000 for line in named)


@given(documents())
def test_a_scene_is_the_same_from_a_file_and_from_python(tmp_path_factory, document):
    path = tmp_path_factory.mktemp("scene") / "scene.toml"
    path.write_text(as_toml(document), encoding="utf-8")
    discretisation = document.pop("semi_analytical", {})
    elements = document.pop("fem_reference", {})
    file = read_scene_file(path)
    assert file.scene == Scene.model_validate(document)
    assert file.semi_analytical == SurfaceDiscretisation.model_validate(discretisation)
    assert file.fem_reference == FiniteElementDiscretisation.model_validate(elements)


IN_SI = """
indenter = { shape = "sphere", radius = 0.018, material = "rigid" }
body.material = { young_modulus = 420e9, poisson_ratio = 0.3 }
body.layers = [ { thickness = 0.000388, material = { young_modulus = 1e9, poisson_ratio = 0 } } ]
friction.coefficient = 0.1
loading = [ { normal_force = 1000 }, { tangential_shift = [8e-7, 0] } ]
semi_analytical.window = [0.0012, 0.0012]
"""
IN_UNITS = """
indenter = { shape = "sphere", radius = "18 mm", material = "rigid" }
body.material = { young_modulus = "420000 N/mm^2", poisson_ratio = 0.3 }
body.layers = [ { thickness = "388 µm", material = { young_modulus = "1 GPa", poisson_ratio=0 } } ]
friction.coefficient = 0.1
loading = [ { normal_force = "1 kN" }, { tangential_shift = ["800 nm", "0 in"] } ]
semi_analytical.window = ["1.2 mm", "0.12 cm"]
"""


def test_a_scene_does_not_depend_on_the_units_it_is_written_in(tmp_path):
    (tmp_path / "si.toml").write_text(IN_SI, encoding="utf-8")
    (tmp_path / "units.toml").write_text(IN_UNITS, encoding="utf-8")
    assert read_scene_file(tmp_path / "si.toml") == read_scene_file(tmp_path / "units.toml")


def test_a_mark_at_the_start_and_foreign_line_ends_do_no_harm(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes(b"\xef\xbb\xbf" + IN_SI.replace("\n", "\r\n").encode())
    assert load_scene(path).indenter.material is RIGID


def test_files_named_in_a_scene_lie_beside_it(tmp_path):
    (tmp_path / "maps").mkdir()
    np.save(tmp_path / "maps" / "h.npy", np.arange(20.0, dtype=np.float32).reshape(4, 5))
    np.save(tmp_path / "mu.npy", np.full((8, 9), 0.2))
    text = f"""
        indenter = {{ shape = "height_map", file = "maps/h.npy", spacing = 1e-6, material="rigid" }}
        body.material = {{ young_modulus = 1e9, poisson_ratio = 0.3 }}
        friction.coefficient = {{ map = "mu.npy", spacing = "1 um" }}
        loading = [ {{ approach = "1 nm" }}, {{ tangential_force = [1, 0] }} ]
        semi_analytical.cells = [8, 9]
        semi_analytical.window = [{4e-6!r}, {5e-6!r}]
    """
    (tmp_path / "scene.toml").write_text(text)
    scene = load_scene(tmp_path / "scene.toml")
    assert isinstance(scene.indenter, HeightMap)
    assert scene.indenter.spacing == (1e-6, 1e-6)
    assert scene.indenter.file.shape == (4, 5)
    assert isinstance(scene.friction.coefficient, FrictionMap)
    assert np.all(scene.friction.coefficient.map.values == 0.2)
    assert scene.model_dump(mode="json")["indenter"]["file"] == "maps/h.npy"
