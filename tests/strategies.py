"""Hypothesis strategies for contact scenes, as nested dictionaries and as TOML text."""

import json
from typing import Any

import numpy as np
from hypothesis import strategies as st

from contact_scene.geometry import SHAPES

Document = dict[str, Any]

LENGTHS = st.floats(1e-6, 1e3) | st.integers(1, 900).map(lambda n: f"{n} mm")
FORCES = st.floats(1e-3, 1e6) | st.integers(1, 900).map(lambda n: f"{n} kN")
ELASTIC = st.fixed_dictionaries(
    {
        "young_modulus": st.floats(1e3, 1e12) | st.integers(1, 900).map(lambda n: f"{n} GPa"),
        "poisson_ratio": st.floats(-0.99, 0.5),
    }
)
LAYERS = st.lists(st.fixed_dictionaries({"thickness": LENGTHS, "material": ELASTIC}), max_size=3)


def rounded_tip(seed):
    """A table of radii and heights, with a curvature that differs by 10 %."""
    rng = np.random.default_rng(seed)
    radii = np.concatenate([[0.0], np.cumsum(rng.uniform(0.5, 1.0, 8))])
    return np.stack([radii, radii**2 * rng.uniform(0.45, 0.55, 9)], axis=1)


def mirrored(table):
    """A table of radii and heights with its mirror image."""
    return np.concatenate([table[:0:-1] * [-1.0, 1.0], table])


_SIZES = {
    "sphere": {"radius": LENGTHS},
    "paraboloid": {"radius": LENGTHS},
    "ellipsoid": {"radii": st.tuples(LENGTHS, LENGTHS).map(list)},
    "cone": {"slope_angle": st.floats(1e-3, 1.0) | st.integers(1, 59).map(lambda n: f"{n} deg")},
    "flat_punch": {"radius": LENGTHS},
    "height_map": {
        "file": st.integers(0, 99).map(lambda seed: np.random.default_rng(seed).random((9, 8))),
        "spacing": LENGTHS,
    },
    "revolved_profile": {
        "file": st.integers(0, 99).map(rounded_tip),
        "radius_unit": LENGTHS,
        "height_unit": LENGTHS,
    },
}
_SLOPE = _SIZES["cone"]["slope_angle"]
_LINE_SIZES = {
    "cylinder": {"radius": LENGTHS},
    "strip": {"half_width": LENGTHS, "edge_radius": st.just(0.0) | LENGTHS},
    "wedge": {"slope_angle": _SLOPE},
    "line_profile": {
        "file": st.integers(0, 99).map(lambda seed: mirrored(rounded_tip(seed))),
        "x_unit": LENGTHS,
        "height_unit": LENGTHS,
    },
}
# A text names the file of a height map or profile, which is not there.
INDENTERS = st.sampled_from(sorted(_SIZES.keys() - {"height_map", "revolved_profile"})).flatmap(
    lambda shape: st.fixed_dictionaries(
        {"shape": st.just(shape), "material": ELASTIC | st.just("rigid"), **_SIZES[shape]},
        optional={"layers": LAYERS},
    )
)
# A shape that is added to SHAPES needs its sizes here: laws over all shapes then hold for it.
SHAPED = st.sampled_from(sorted(SHAPES)).flatmap(
    lambda shape: st.fixed_dictionaries({"material": ELASTIC, **(_SIZES | _LINE_SIZES)[shape]}).map(
        SHAPES[shape].model_validate
    )
)
BODIES = st.fixed_dictionaries({"material": ELASTIC}, optional={"layers": LAYERS})
_NORMAL = st.fixed_dictionaries({"normal_force": FORCES}) | st.fixed_dictionaries(
    {"approach": LENGTHS}
)
# Shift control only: whatever the forces are, it never exceeds the friction limit.
_TANGENTIAL = st.fixed_dictionaries({"tangential_shift": st.tuples(LENGTHS, LENGTHS).map(list)})
_ANGLES = st.floats(1e-9, 1.0) | st.integers(-60, 60).map(lambda n: f"{n} deg")
_TILTING = st.fixed_dictionaries({"tilt": st.tuples(_ANGLES, _ANGLES).map(list)})
_TORSION = st.fixed_dictionaries({"twist": _ANGLES})
_INCREMENTS = st.fixed_dictionaries({}, optional={"increments": st.integers(1, 100)})


def _merged(*tables: Document) -> Document:
    return {key: value for table in tables for key, value in table.items()}


@st.composite
def documents(draw: st.DrawFn) -> Document:
    """Valid contents of a scene file."""
    friction = draw(st.none() | st.fixed_dictionaries({"coefficient": st.floats(0.0, 2.0)}))
    kinds = _NORMAL | _TILTING
    if friction is not None:
        kinds = kinds | _TANGENTIAL | _TORSION
    later = st.lists(st.builds(_merged, kinds, _INCREMENTS), max_size=4)
    document = {
        "indenter": draw(INDENTERS),
        "body": draw(BODIES),
        "loading": [draw(st.builds(_merged, _NORMAL, _INCREMENTS)), *draw(later)],
    }
    if friction is not None:
        document["friction"] = friction
    if draw(st.booleans()):
        document["title"] = draw(st.text(st.characters(codec="utf-8"), max_size=20))
    if draw(st.booleans()):
        document["semi_analytical"] = draw(
            st.fixed_dictionaries(
                {"cells": st.tuples(st.integers(8, 99), st.integers(8, 99)).map(list)},
                optional={
                    "tolerance": st.floats(1e-12, 0.1),
                    "path_accuracy": st.floats(1e-4, 1.0),
                },
            )
        )
    if draw(st.booleans()):
        document["fem_reference"] = draw(
            st.fixed_dictionaries(
                {"elements_per_radius": st.integers(4, 512)},
                optional={
                    "box": st.floats(5.0, 1e6),
                    "mesher": st.sampled_from(["tensor", "gmsh"]),
                    "harmonics": st.integers(2, 64),
                    "tolerance": st.floats(1e-12, 0.1),
                },
            )
        )
    return document


def as_toml(document: Document) -> str:
    """TOML text of a document, everything below the top level inline."""
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in document.items())


def _key(key: str) -> str:
    return json.dumps(key, ensure_ascii=True)


def _value(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value).replace("\x7f", "\\u007f") if value.isascii() else _basic(value)
    return repr(value)


def _basic(text: str) -> str:
    return '"' + "".join(f"\\U{ord(character):08x}" for character in text) + '"'
