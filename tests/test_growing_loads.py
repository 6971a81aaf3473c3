"""Tests of normal and tangential loads that grow together without slip, in all solvers."""

import pytest
from contact_scenes import (
    APPROACH,
    LOAD,
    MU,
    NU,
    PRESS,
    YOUNG,
    A,
    hertz,
    push,
    scene,
    steel,
)

import slipstick
from contact_scene import (
    FiniteElementDiscretisation,
    Layer,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.stepping.growing_contact import grows_without_slip

# The discretisation, and its error of the shift over that of gross slip.
SOLVERS = {
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
def test_one_increment_of_a_coated_contact_that_grows_is_near_four(solver):
    """Below a coating k Δp does not move the contact uniformly; the free motion is relative to its
    edge. Relative to the indenter, the shift of one increment was 2 % from that of four."""
    film = Layer(thickness=A, material=steel(young_modulus=20 * YOUNG))
    shifts = []
    for increments in (1, 4):
        grow = {**PRESS, **push(0.5), "increments": increments}
        bare = scene({"normal_force": 0.2 * LOAD}, grow)
        bodies = {
            name: getattr(bare, name).model_copy(update={"layers": (film,)})
            for name in ("body", "indenter")
        }
        result = slipstick.solve(bare.model_copy(update=bodies), solver, SOLVERS[solver][0])
        shifts.append(result.increments[-1].tangential_shift[0])
    assert shifts[0] == pytest.approx(shifts[1], rel=0.01)


@pytest.mark.parametrize("part", [0.99, 1.01])
def test_displacements_grow_without_slip_below_the_friction_of_their_forces(part):
    """One increment is exact there: below the shift of the force µW at the same approach."""
    shift = part * SOFTER * MU * APPROACH
    grown = scene({"approach": APPROACH, "tangential_shift": (shift, 0.0)})
    (ramp,) = grown.load_path()
    assert grows_without_slip(grown, ramp) is (part < 1)
