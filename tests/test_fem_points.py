"""Tests of the finite-element solver on points (r, θ): harmonics, increments and refusals."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from fem_scenes import elements

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.solver_errors import ContactNotResolved, NotConverged
from contact_solver import dense_inverse
from fem_reference.compliance.angular_grid import (
    AngularGrid,
    axisymmetric_grid,
    end_grid,
    grid_at,
    mid_grid,
    whole_grid,
)
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.compliance.ring_compliance import RingCompliance, ring_compliance
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.increment import advance
from fem_reference.contact.point_contact import PointContact
from fem_reference.loads import Loads, NormalTarget, TangentialTarget
from fem_reference.model import ContactModel
from fem_reference.plan import Path

RINGS = 12  # on the contact radius
HIGHEST = 7
TOLERANCE = 1e-8
SPRINGS_ALONE = Penalty(augmentations=0, overlap=np.inf)
STEEL, FILM = (
    IsotropicMaterial(young_modulus=2.6 * shear_modulus, poisson_ratio=0.3)
    for shear_modulus in (1.0, 2.0)
)
COATED = Body(material=STEEL, layers=(Layer(thickness=1.0, material=FILM),))


@cache
def known(path: Path) -> RingCompliance:
    ball = Paraboloid(radius=1.0, material=RIGID)
    scene = Scene(indenter=ball, body=COATED, loading=(LoadStep(normal_force=1.0),))
    return ring_compliance(ContactModel.of(scene, elements(RINGS), 1.0), path, HIGHEST)


def contact(grid: AngularGrid | None = None, springs=0.0) -> PointContact:
    grid = grid or end_grid(HIGHEST)
    rings = known(Path.WHOLE_CIRCLE if grid.whole else Path.HARMONICS)
    law = SPRINGS_ALONE if springs else None
    compliance = PointCompliance(rings, grid, springs)
    return PointContact(compliance, CoulombFriction(coefficient=0.3), law)


def along(load: float | None = None, motion: float | None = None) -> TangentialTarget:
    """Force or shift along the load; no shift across, and no twist."""
    return TangentialTarget((load, None, None), (motion, 0.0, 0.0))


GRIDS = (end_grid(2), end_grid(7), mid_grid(2), mid_grid(7), whole_grid(2), whole_grid(7))


def grid_name(grid):
    kind = "whole" if grid.whole else "end" if grid.angles[0] == 0 else "mid"
    return f"{kind}{grid.highest}"


@pytest.mark.parametrize("grid", GRIDS, ids=grid_name)
def test_harmonics_between_points_pass_through_the_point_values(grid):
    again = grid_at(grid.angles)  # as the stress of a stored result finds it
    np.testing.assert_array_equal((*again.angles, again.highest), (*grid.angles, grid.highest))
    values = np.random.default_rng(1).normal(size=(3, 5, grid.points))
    if not grid.whole:
        values[1, :, ~np.any(grid.sines, axis=0)] = 0.0
    modes = grid.modes(grid.angles)
    found = np.einsum("fcrn,fcnk->crk", grid.amplitudes(values), modes)
    np.testing.assert_allclose(found, values, atol=1e-13)


def test_singular_equations_are_an_increment_that_does_not_converge(monkeypatch):
    def singular(*_, **__):
        raise np.linalg.LinAlgError("singular")

    monkeypatch.setattr(dense_inverse, "cho_factor", singular)
    monkeypatch.setattr(dense_inverse, "lu_factor", lambda matrix, **_: (0 * matrix, None))
    loads = Loads(NormalTarget(force=4.0), along(load=0.7))
    with pytest.raises(NotConverged):
        advance(contact(), None, loads, TOLERANCE)


def test_approach_that_touches_no_point_is_refused():
    of = contact()
    short = NormalTarget(approach=0.5 * np.min(of.gap))
    with pytest.raises(ContactNotResolved):
        advance(of, None, Loads(short, along(motion=0.1)), TOLERANCE)


def test_an_error_of_increments_is_the_same_with_angles_and_without():
    of, forces = contact(), 4 / 3 * 2 / 0.7 * np.array([1.0, 2.0])
    ring = replace(of, compliance=replace(of.compliance, grid=axisymmetric_grid()))
    first, more = (Loads(NormalTarget(force=force)) for force in forces)
    before = advance(ring, None, first, TOLERANCE)
    at_rings = advance(ring, before, more, 1e-10)
    at_points = advance(of, of.extend_to_points(before), more, 1e-10)
    assert at_points.friction_changed == pytest.approx(at_rings.friction_changed, rel=1e-7)
    changed, slipped = at_rings.shear - before.shear, at_rings.slip - before.slip
    by_hand = np.sum(ring.compliance.areas * np.hypot(*changed) * np.hypot(*slipped))
    assert 0 < by_hand == pytest.approx(at_rings.friction_changed)
