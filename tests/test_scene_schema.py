"""Tests of the JSON Schema of scene files: it accepts and refuses the same scenes as the reader."""

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from jsonschema import Draft202012Validator
from strategies import Document, as_toml, documents

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    FrictionMap,
    HeightMap,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
    SceneError,
    Sphere,
    SurfaceDiscretisation,
    load_scene,
    read_scene_file,
    scene_schema,
)
from contact_scene.reading.scene_error import Path as KeyPath
from contact_scene.reading.toml_file import (
    MAX_DEPTH,
    NestedTooDeep,
    locate_keys,
)

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


# ---- Lines of keys: right for every valid document, harmless for every other.


EXAMPLE = '''\
# a comment with a = 1
title = "x"   # [no.table]

[indenter]
shape = "sphere"
material = { young_modulus = "1 Pa", inner = { a = [1,
  2], "b.c" = 2 } }
"quoted \\u00e9\\"key" = 1
'literal.key' = 2
a . "b" . c = """
[fake]
fake = 1
\\""" still inside """
[body]
text = \'\'\'
[[fake]]
fake = 2\'\'\'
after = 1979-05-27 07:32:00
[[loading]]
normal_force = 1
[[loading]]
window = [
  "1 mm", # first
  [ 2, { x = 1 } ],
]
[[loading.inner]]
k = 1
[[loading.inner]]
k = 2
[deep.er]
z = 1
[deep]
y = 2
'''

LINES: dict[KeyPath, int] = {
    ("title",): 2,
    ("indenter",): 4,
    ("indenter", "shape"): 5,
    ("indenter", "material", "young_modulus"): 6,
    ("indenter", "material", "inner", "a", 0): 6,
    ("indenter", "material", "inner", "a", 1): 7,
    ("indenter", "material", "inner", "b.c"): 7,
    ("indenter", 'quoted é"key'): 8,
    ("indenter", "literal.key"): 9,
    ("indenter", "a", "b", "c"): 10,
    ("body", "text"): 15,
    ("body", "after"): 18,
    ("loading",): 19,
    ("loading", 0): 19,
    ("loading", 0, "normal_force"): 20,
    ("loading", 1): 21,
    ("loading", 1, "window", 0): 23,
    ("loading", 1, "window", 1, 1, "x"): 24,
    ("loading", 1, "inner", 0, "k"): 27,
    ("loading", 1, "inner", 1): 28,
    ("deep", "er"): 30,
    ("deep",): 32,
    ("deep", "y"): 33,
}


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_every_form_of_key_is_found(newline: str) -> None:
    document = EXAMPLE.replace("\n", newline)
    located = locate_keys(document)
    assert {path: located.get(path) for path in LINES} == LINES
    assert set(located) == paths_in(tomllib.loads(document))


def paths_in(value: Any, path: KeyPath = ()) -> set[KeyPath]:
    """Every key and array entry of a parsed document."""
    entries: Any = ()
    if isinstance(value, dict):
        entries = value.items()
    elif isinstance(value, list):
        entries = enumerate(value)
    found = {path} if path else set()
    return found.union(*(paths_in(entry, (*path, key)) for key, entry in entries))


@pytest.mark.parametrize(
    "text",
    ["a = " + "[" * 5000, "a = " + "{a=" * 5000, "a." * 5000 + "a = 1", "[" + "a." * 5000 + "a]"],
    ids=["arrays", "tables", "keys", "headers"],
)
def test_nesting_beyond_all_use_is_refused_with_its_line(text: str) -> None:
    with pytest.raises(NestedTooDeep, match="line 3"):
        locate_keys("\n\n" + text)
    at_most = "a = " + "[" * (MAX_DEPTH - 1) + "]" * (MAX_DEPTH - 1)
    assert locate_keys(at_most)[("a",)] == 1


# ---- `--set` with anything after it: a scene, or one refusal that names the option.


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


# ---- Scene files: what they mean, whatever the units and wherever the keys come from.


STEEL = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)


def test_the_example_scene_is_read_as_it_says() -> None:
    file = read_scene_file(SCENES / "fretting_loop.toml")
    assert file.scene == Scene(
        title="Steel ball on steel, fretting loop (paper, figures 1 and 2)",
        indenter=Sphere(radius=0.018, material=STEEL),
        body=Body(material=STEEL),
        friction=CoulombFriction(coefficient=0.1),
        loading=(
            LoadStep(normal_force=1000.0),
            LoadStep(tangential_force=(90.0, 0.0), increments=18),
            LoadStep(tangential_force=(-90.0, 0.0), increments=36),
            LoadStep(tangential_force=(90.0, 0.0), increments=36),
        ),
    )
    assert file.semi_analytical == SurfaceDiscretisation(
        cells=(256, 256), window=(0.0012, 0.0012), tolerance=1e-8
    )
    assert hash(file) == hash(read_scene_file(SCENES / "fretting_loop.toml"))


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_every_scene_shipped_is_valid(path: Path) -> None:
    assert load_scene(path).title


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


def test_overrides_make_missing_tables_and_the_last_one_holds() -> None:
    overrides = ["friction.coefficient=0.3", "friction.coefficient=0.2"]
    scene = read_scene_file(SCENES / "hertz.toml", overrides).scene
    assert scene.friction == CoulombFriction(coefficient=0.2)


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


def test_a_scene_made_in_python_is_checked_for_consistency_too() -> None:
    with pytest.raises(SceneError, match="gross sliding"):
        Scene(
            indenter=Sphere(radius=1.0, material=STEEL),
            body=Body(material=STEEL),
            friction=CoulombFriction(coefficient=0.1),
            loading=(LoadStep(normal_force=1.0, tangential_force=(0.2, 0.0)),),
        )
