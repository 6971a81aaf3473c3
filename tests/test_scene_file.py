"""Tests of scene files: units, overrides, tables and files beside them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from strategies import Document, as_toml, documents

from contact_scene import (
    RIGID,
    FiniteElementDiscretisation,
    FrictionMap,
    HeightMap,
    IsotropicMaterial,
    Layer,
    Scene,
    SceneError,
    SurfaceDiscretisation,
    load_scene,
    read_scene_file,
)

SCENES = Path(__file__).resolve().parents[1] / "scenes"
SCENE = Path(__file__).resolve().parents[1] / "scenes" / "coated_fretting.toml"
LONG = 100_000
REFUSED = (
    *("", "=", "a", "=1", ".=1", "a.=1", ".a=1", "a..b=1", "a[1]=1", "loading[0]=1"),
    *("loading[-1]=1", "loading[3]=1", "loading[9999999]=1", "loading[٣]=1", "loading=[]"),
    *("loading={}", "loading[1][1]=2", "loading[1].normal_force[1]=2", "indenter={}", "indenter=1"),
    *("indenter.radius=nan", "indenter.radius=-inf", "indenter.radius=1e999", "indenter.radius=0"),
    *("indenter.radius=1\nbody=2", "indenter.radius=1\0", "indenter.radius=\udcff"),
    *("indenter.radius=\u202e1", "indenter.radius=1;body=2", "indenter.radius=true"),
    *('"indenter".radius=1', "ｉndenter.radius=1", "__class__=1", "indenter.__class__=1"),
    *("body.layers={}", "friction=false", "semi_analytical.cells=[1,2,3]", "accuracy=1%"),
    *("friction.coefficient={map='../x.npy',spacing=1}", "fem_reference.mesh_file='/dev/zero'"),
    *("friction.coefficient={map='/etc/passwd',spacing=1}", "loading[1].increments=1e3"),
    *("title=" + LONG * "a", "title=" + LONG * "[", "title=" + LONG * "{a=", LONG * "a" + "=1"),
    *(LONG * "a." + "a=1", "a" + LONG * "[1]" + "=1", "indenter.radius=" + LONG * "9"),
    *(LONG * "=", LONG * ".", "a" + LONG * ".a", 'title="""' + LONG * "'"),
)


@pytest.mark.parametrize("assignment", REFUSED, ids=lambda given: ascii(given)[:30])
def test_refusal_names_the_option_in_one_line(assignment: str) -> None:
    with pytest.raises(SceneError) as found:
        read_scene_file(SCENE, [assignment])
    named = [str(problem) for problem in found.value.problems if "--set" in str(problem)]
    assert named
    assert all(line.isprintable() and len(line) < 1000 for line in named)


STEEL = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)


@given(documents())
def test_a_scene_is_the_same_from_a_file_and_from_python(
    tmp_path_factory: pytest.TempPathFactory, document: Document
) -> None:
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


def test_a_scene_does_not_depend_on_the_units_it_is_written_in(tmp_path: Path) -> None:
    (tmp_path / "si.toml").write_text(IN_SI, encoding="utf-8")
    (tmp_path / "units.toml").write_text(IN_UNITS, encoding="utf-8")
    assert read_scene_file(tmp_path / "si.toml") == read_scene_file(tmp_path / "units.toml")


def test_a_mark_at_the_start_and_foreign_line_ends_do_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_bytes(b"\xef\xbb\xbf" + IN_SI.replace("\n", "\r\n").encode())
    assert load_scene(path).indenter.material is RIGID


@pytest.mark.parametrize(
    ("override", "attributes", "expected"),
    [
        ("semi_analytical.cells=[128,128]", "semi_analytical.cells", (128, 128)),
        ("semi_analytical.cells[2]=64", "semi_analytical.cells", (256, 64)),
        (" semi_analytical . tolerance = 1e-6 ", "semi_analytical.tolerance", 1e-6),
        ("loading[2].increments=5", "scene.loading.1.increments", 5),
        ("indenter.radius=20 mm", "scene.indenter.radius", 0.02),
        ('indenter.radius="20 mm"', "scene.indenter.radius", 0.02),
        ("body.material=rigid", "scene.body.material", RIGID),
        (
            "body.layers=[{thickness=1, material={young_modulus=420e9, poisson_ratio=0.3}}]",
            "scene.body.layers.0",
            Layer(thickness=1, material=STEEL),
        ),
        ("title=a=b", "scene.title", "a=b"),
    ],
)
def test_an_override_replaces_one_key(override: str, attributes: str, expected: Any) -> None:
    value: Any = read_scene_file(SCENES / "fretting_loop.toml", [override])
    for name in attributes.split("."):
        value = value[int(name)] if name.isdigit() else getattr(value, name)
    assert value == expected


def test_files_named_in_a_scene_lie_beside_it(tmp_path: Path) -> None:
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
    assert scene.friction is not None
    assert isinstance(scene.friction.coefficient, FrictionMap)
    assert np.all(scene.friction.coefficient.map.values == 0.2)
    assert scene.model_dump(mode="json")["indenter"]["file"] == "maps/h.npy"
