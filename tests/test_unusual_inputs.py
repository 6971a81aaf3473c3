"""Tests of unusual but valid inputs: effects of size zero, and points that were not measured."""

import numpy as np
import pytest

import slipstick
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    Ellipsoid,
    FiniteElementDiscretisation,
    HeightMap,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.checks.plausibility import implausible_input

R = 10e-3
ALUMINIUM = IsotropicMaterial(young_modulus=70e9, poisson_ratio=0.3)
STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.25)
COARSE = {
    "semi-analytical": SurfaceDiscretisation(cells=(32, 32)),
    "radial": None,
    "fem": FiniteElementDiscretisation(elements_per_radius=8),
    "fem-complementarity": FiniteElementDiscretisation(elements_per_radius=8),
}


def scene(*loading, **parts):
    ball = Paraboloid(material=RIGID, radius=R)
    usual = {"indenter": ball, "body": Body(material=ALUMINIUM)}
    return Scene(**(usual | parts), loading=tuple(LoadStep(**step) for step in loading))


# A degenerate value is the absence of its effect: the same plan, the same bits.


def uniform(value: float) -> CoulombFriction:
    values = np.full((20, 20), value)
    return CoulombFriction.model_validate({"coefficient": {"map": values, "spacing": 1e-4}})


def coated(*layers: tuple[float, IsotropicMaterial]) -> Body:
    return Body(material=ALUMINIUM, layers=tuple(Layer(thickness=t, material=m) for t, m in layers))


PRESS = {"normal_force": 100.0}
MU = CoulombFriction(coefficient=0.3)
PUSH = {"normal_force": 100.0, "tangential_force": (10.0, 0.0)}
NOTHING = {"tangential_shift": (0.0, 0.0), "torque": 0.0, "moment": (0.0, 0.0)}
BARE = scene(PRESS)
DEGENERATE = {
    "coefficient zero": (scene(PRESS, friction=CoulombFriction(coefficient=0.0)), BARE),
    "map of zeros": (scene(PRESS, friction=uniform(0.0)), BARE),
    "constant map, coupled": (scene(PRESS, friction=uniform(0.3)), scene(PRESS, friction=MU)),
    "constant map, pushed": (
        scene(PUSH, friction=uniform(0.3), indenter=Paraboloid(material=ALUMINIUM, radius=R)),
        scene(PUSH, friction=MU, indenter=Paraboloid(material=ALUMINIUM, radius=R)),
    ),
    "layer of the base": (scene(PRESS, body=coated((1e-5, ALUMINIUM))), BARE),
    "layers alike": (
        scene(PRESS, body=coated((5e-6, STEEL), (5e-6, STEEL), (1e-5, ALUMINIUM))),
        scene(PRESS, body=coated((1e-5, STEEL))),
    ),
    "round ellipsoid": (scene(PRESS, indenter=Ellipsoid(material=RIGID, radii=(R, R))), BARE),
    "loads of zero": (scene(PRESS | {"tangential_force": (0.0, 0.0), "twist": 0.0}), BARE),
    "free motions": (scene(PRESS | NOTHING, friction=MU), scene(PRESS, friction=MU)),
    "fixed motions": (
        scene(PUSH | {"twist": 0.0, "tilt": (0.0, 0.0)}, friction=MU),
        scene(PUSH, friction=MU),
    ),
}


@pytest.mark.parametrize("solver", COARSE)
@pytest.mark.parametrize("name", DEGENERATE)
def test_a_degenerate_value_plans_as_the_absence_of_its_effect(name, solver):
    degenerate, absent = DEGENERATE[name]
    assert slipstick.plan(degenerate, solver) == slipstick.plan(absent, solver)


@pytest.mark.parametrize("solver", ["semi-analytical", "radial", "fem-complementarity"])
@pytest.mark.parametrize("name", ["coefficient zero", "layers alike", "round ellipsoid"])
def test_a_degenerate_value_gives_the_bits_of_its_absence(name, solver):
    ends = [slipstick.solve(asked, solver, COARSE[solver]).steps[-1] for asked in DEGENERATE[name]]
    for quantity in ("approach", "contact_radius", "peak_pressure", "pressure"):
        np.testing.assert_array_equal(*(getattr(end, quantity) for end in ends))


# A measured map means the same in every form that instruments write.

PLACES = np.meshgrid(*(np.linspace(-1, 1, n) for n in (9, 7)), indexing="ij")
TOLD = (
    3.0 + PLACES[0] ** 2 + 0.3 * PLACES[1] + 0.2 * PLACES[0] * PLACES[1]
)  # um, even about nothing


def read_map(folder, name, text, **more):
    (folder / name).write_text(text, encoding="utf-8")
    given = {"shape": "height_map", "material": "rigid", "file": name, "spacing": 1e-5, **more}
    return HeightMap.model_validate(given, context={"folder": folder})


@pytest.mark.parametrize("word", ["", "NaN", "bad", "***", "#N/A", '"-nan"'])
def test_points_that_were_not_measured_are_never_lowest(word, tmp_path):
    """Laplace's equation has TOLD - PLACES[0]² as a solution and its extremes are measured."""
    harmonic = TOLD - PLACES[0] ** 2
    gaps = harmonic.copy()
    gaps[[0, 4, 4, 5, 8], [0, 3, 4, 3, 6]] = np.nan
    rows = ([word if np.isnan(v) else repr(float(v)) for v in row] for row in gaps.T[::-1])
    found = read_map(tmp_path, "gaps.csv", "\n".join(map(",".join, rows)))
    inside = np.s_[1:-1, 1:-1]
    np.testing.assert_allclose(
        found.heights[inside], harmonic[inside], atol=1e-2 * np.ptp(harmonic)
    )
    assert np.nanmin(gaps) <= np.min(found.heights)
    assert np.max(found.heights) <= np.nanmax(gaps)
    known = np.isfinite(gaps)
    np.testing.assert_array_equal(found.heights[known], gaps[known])
    remarks = implausible_input(scene(PRESS, indenter=found))
    assert any("0.079 of the points were not measured" in remark for remark in remarks)
