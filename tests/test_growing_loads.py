"""Tests of normal and tangential loads that grow together without slip, in all solvers."""

from typing import Any

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LIMIT,
    LOAD,
    MU,
    NU,
    PRESS,
    RADIUS,
    A,
    hertz,
    push,
    scene,
    steel,
)

import slipstick
from contact_scene import (
    Cone,
    Ellipsoid,
    FiniteElementDiscretisation,
    HeightMap,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.rig import Rig
from contact_scene.stepping.increment_error import has_increment_error
from semi_analytical import plan

# The discretisation, and its error of the shift over that of gross slip.
SOLVERS: dict[str, tuple[Any, float]] = {
    "semi-analytical": (SurfaceDiscretisation(cells=(64, 64)), 1e-4),
    "radial": (RadialDiscretisation(), 1e-5),
    "fem": (FiniteElementDiscretisation(elements_per_radius=16), 2e-3),
    "fem-complementarity": (FiniteElementDiscretisation(elements_per_radius=16), 1e-3),
}
# Shift over the part T/W of the approach of equal bodies (Mindlin 1949).
SOFTER = (2 - NU) / (2 * (1 - NU))


@pytest.mark.parametrize("solver", SOLVERS)
def test_growth_without_slip_is_followed_by_slip_from_the_edge(solver):
    """After T = k W from nothing a push slips as if to (T - kW)/(µ - k) at the friction µ - k.

    q = µp - (µ - k) p(W*) with W* = (µW - T)/(µ - k) (Jaeger 1998).
    """
    mesh, error = SOLVERS[solver]
    end = slipstick.solve(scene({**PRESS, **push(0.5)}, push(0.8)), solver, mesh).increments[-1]
    inner = hertz((1 - 0.8) / (1 - 0.5) * LOAD)
    shift = SOFTER * (MU * APPROACH - 0.5 * MU * inner.approach)
    # Along one line, the law for ν > 0 is 1e-3 from that of Cattaneo and Mindlin.
    assert end.tangential_shift[0] == pytest.approx(shift, rel=2e-3 + error)
    assert end.stick_radius == pytest.approx(inner.contact_radius, rel=0.03)


@pytest.mark.parametrize("solver", SOLVERS)
def test_loads_that_grow_by_more_than_friction_take_many(solver):
    from_nothing = scene(
        {"approach": APPROACH, "tangential_shift": (1.1 * MU * SOFTER * APPROACH, 0)}
    )
    later = scene(PRESS, {"normal_force": 2 * LOAD, "tangential_force": (1.1 * LIMIT, 0.0)})
    for described in (from_nothing, later):
        assert slipstick.plan(described, solver).increments[-1] > 1
        assert has_increment_error(described)[-1]


BUMPS = np.minimum(
    *(
        (np.add.outer((np.linspace(-2, 2, 65) * A - x) ** 2, np.linspace(-2, 2, 65) ** 2 * A**2))
        / 2
        / RADIUS
        for x in (-0.8 * A, 0.9 * A)
    )
)
GROWING = {
    "cone": ({"indenter": Cone(slope_angle=0.02, material=steel())}, None, True),
    "ellipse, obliquely": (
        {"indenter": Ellipsoid(radii=(RADIUS, RADIUS / 3), material=steel())},
        None,
        True,
    ),
    "springs": ({}, Rig(tangential_stiffness=3e8, normal_stiffness=5e8), True),
    "any shape without Poisson's ratio": (
        {
            "indenter": HeightMap(file=BUMPS, spacing=A / 16, material=steel(0.0)),
            "body": steel(0.0),
        },
        None,
        True,
    ),
    "any shape": (
        {"indenter": HeightMap(file=BUMPS, spacing=A / 16, material=steel())},
        None,
        False,
    ),
}


@pytest.mark.parametrize("name", GROWING)
def test_other_contacts_grow_without_slip(name):
    """One increment and eight agree where one is planned: to the error of the cells."""
    parts, rig, exact = GROWING[name]
    described = scene(
        {**PRESS, **push(0.5, 0.3)}, {"normal_force": 1.5 * LOAD, **push(0.3, 0.6)}, **parts
    )
    described = described.model_copy(update={"rig": rig})
    counts = plan(described).increments
    assert counts == (1, 1) if exact else min(counts) > 8
    one, many = (
        slipstick.solve(
            described.with_increments([n, n]),
            "semi-analytical",
            SurfaceDiscretisation(cells=(32, 32)),
        )
        for n in (1, 8)
    )
    for few, more in zip(one.steps, many.steps, strict=True):
        close = 1e-4 if exact else 2e-2
        assert few.tangential_shift == pytest.approx(more.tangential_shift, rel=close)
        scale = MU * few.peak_pressure
        assert np.mean(np.abs(few.shear - more.shear)) < 5 * close * scale
        assert few.energy_imbalance < 1e-8
