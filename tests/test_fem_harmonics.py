"""Tests of the finite-element contact solver on points (r, θ), with artificial compliances."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from fem_scenes import elements, solved
from hankel_responses import Coating
from ring_responses import half_space, rings

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
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import (
    ContactNotResolved,
    GrossSliding,
    NotConverged,
)
from contact_solver import dense_inverse
from fem_reference.compliance.angular_grid import (
    AngularGrid,
    axisymmetric_grid,
    end_grid,
    mid_grid,
    whole_grid,
)
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.compliance.ring_compliance import ring_compliance
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.increment import advance
from fem_reference.contact.increment_report import _contact_area
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.energy import COMPONENTS, dissipation_uncertainty
from fem_reference.loads import TWIST, Loads, NormalTarget, TangentialTarget
from fem_reference.model import ContactModel
from fem_reference.plan import Path
from verification.observed.ring_errors import tractions_at

RINGS = 16  # on the contact radius
HIGHEST = 8
TOLERANCE = 1e-8
SPRINGS_ALONE = Penalty(augmentations=0, overlap=np.inf)


def contact(
    *bodies: Coating,
    mu: float = 0.1,
    per_radius: int = RINGS,
    grid: AngularGrid | None = None,
    springs: float = 0.0,
    reach: float = 1.25,
    power: int = 2,
) -> PointContact:
    """Ball of radius 1 on bodies, the lower one first; the upper one rigid if there is none.

    power  gap r^power / 2; 0: a flat punch
    """
    grid = grid or end_grid(HIGHEST)
    known = rings(per_radius, reach, HIGHEST, *bodies)
    # ∫ r² φ r dr / ∫ φ r dr on rings of equal distance
    radii, h = known.radii, 1 / per_radius
    inner, outer = np.maximum(radii - h, 0.0), np.minimum(radii + h, radii[-1])
    gap = np.array([_mean_gap(*edges, power) for edges in zip(inner, radii, outer, strict=True)])
    known = replace(known, gap=gap)
    if grid.whole:
        motions = known.motions.copy()
        motions[TWIST, 1] = known.stretch
        known = replace(known, path=Path.WHOLE_CIRCLE, motions=motions)
    compliance = PointCompliance(known, grid, springs)
    law = SPRINGS_ALONE if springs else None
    return PointContact(compliance, CoulombFriction(coefficient=mu), law)


def _mean_gap(inner, peak, outer, power):
    x, w = np.polynomial.legendre.leggauss(6)
    total = weight = 0.0
    for left, right, hat in ((inner, peak, (1 + x) / 2), (peak, outer, (1 - x) / 2)):
        r = left + (right - left) * (1 + x) / 2
        share = w * (right - left) * hat * r
        total += np.sum(share * r**power / 2) if power else 0.0
        weight += np.sum(share)
    return total / weight


def hertz_force(nu: float, bodies: int = 1) -> float:
    """Force that makes a contact of radius 1."""
    return 4 / 3 * 2 / (1 - nu) / bodies


def pressed(of: PointContact, force: float, increments: int) -> PointState:
    """Pressed by the force in increments of equal contact radius, and set on the points of `of`."""
    ring = replace(of, compliance=replace(of.compliance, grid=axisymmetric_grid()))
    state = None
    for k in range(1, increments + 1):
        target = NormalTarget(force=force * (k / increments) ** 3)
        state = advance(ring, state, Loads(target), TOLERANCE)
    assert state is not None
    return of.extend_to_points(state)


def along(load: float | None = None, motion: float | None = None) -> TangentialTarget:
    """Force or shift along the load; no shift across, and no twist."""
    return TangentialTarget((load, None, None), (motion, 0.0, 0.0))


def sheared(of: PointContact, state: PointState, *forces: float) -> PointState:
    """Sheared by forces, one increment each, under the normal force of the state."""
    normal = NormalTarget(force=state.normal_force)
    for force in forces:
        state = advance(of, state, Loads(normal, along(load=force)), TOLERANCE)
    return state


def along_load(of: PointContact, state: PointState):
    """q_x and q_y (rings, angles)."""
    return cartesian(of.compliance.grid, of.compliance.vector_on_grid(state.shear))


def cartesian(grid, vector):
    """x and y components of r and θ components (2, rings, angles)."""
    cos, sin = np.cos(grid.angles), np.sin(grid.angles)
    return vector[0] * cos - vector[1] * sin, vector[0] * sin + vector[1] * cos


STEEL = half_space(0.3)
NU_ZERO = half_space(0.0)


GRIDS = (
    axisymmetric_grid(),
    end_grid(2),
    end_grid(7),
    mid_grid(2),
    mid_grid(7),
    whole_grid(2),
    whole_grid(7),
)
MU = 0.1
COATED = Coating(2.0, 0.3, 1.0, 0.3, 1.0)


def grid_name(grid):
    if grid.highest == 0:
        return "rings"
    if grid.whole:
        return f"whole{grid.highest}"
    return f"{'end' if grid.angles[0] == 0 else 'mid'}{grid.highest}"


# transforms and compliance


@pytest.mark.parametrize("grid", GRIDS[1:], ids=grid_name)
def test_harmonics_between_points_pass_through_the_point_values(grid):
    values = np.random.default_rng(1).normal(size=(3, 5, grid.points))
    if not grid.whole:
        values[1, :, ~np.any(grid.sines, axis=0)] = 0.0
    modes = grid.modes(grid.angles)
    found = np.einsum("fcrn,fcnk->crk", grid.amplitudes(values), modes)
    np.testing.assert_allclose(found, values, atol=1e-13)


@pytest.mark.parametrize("springs", [0.0, 0.3])
@pytest.mark.parametrize("grid", GRIDS[1:], ids=grid_name)
def test_displacement_by_harmonics_is_that_of_the_matrix(grid, springs):
    compliance = contact(COATED, grid=grid, springs=springs).compliance
    t = tractions(compliance)
    u_t, u_z = compliance.displacement(t[2], t[:2])
    found, given = (
        np.stack([*compliance.vector_on_grid(v[:2]), compliance.scalar_on_grid(v[2])])[:, 1:]
        for v in (np.stack([*u_t, u_z]), t)
    )
    rings = compliance.rings
    loads = np.stack([*compliance.vector_on_grid(t[:2]), compliance.scalar_on_grid(t[2])])
    weak = np.einsum(
        "naibk,fbkn->fain", rings.harmonics[: grid.highest + 1], grid.amplitudes(loads)
    )
    by_harmonics = np.einsum("fain,fanj->aij", weak, grid.modes(grid.angles))
    by_harmonics = (by_harmonics / rings.areas[:, None])[:, 1:] + springs * given
    np.testing.assert_allclose(found, by_harmonics, atol=1e-12 * np.max(found))


def tractions(compliance):
    """Any that mirror symmetry allows (3, points)."""
    t = np.random.default_rng(2).normal(size=(3, len(compliance.areas)))
    if compliance.grid.whole:
        return t
    t[1, np.concatenate([[True], forbidden(compliance)])] = 0.0
    if compliance.grid.highest == 0:
        t[1] = t[0, 0] = 0.0
    return t


def forbidden(compliance):
    """Points off the axis where symmetry leaves no q_θ."""
    rings, _ = compliance.shape
    return np.tile(~np.any(compliance.grid.sines, axis=0), rings - 1)


@pytest.mark.parametrize("grid", GRIDS[1:], ids=grid_name)
def test_shear_along_has_the_resultant_of_its_profile(grid):
    compliance = contact(STEEL, grid=grid).compliance
    f = np.random.default_rng(3).normal(size=compliance.shape[0])
    q = f[compliance.ring_of_point] * compliance.motions[0]
    resultant = compliance.tangential_loads(q)[0]
    assert resultant == pytest.approx(2 * np.pi * np.sum(compliance.rings.areas * f), rel=1e-13)
    q_x, q_y = cartesian(grid, compliance.vector_on_grid(q))
    np.testing.assert_allclose(q_x, f[:, None] + 0 * q_x, atol=1e-14)
    np.testing.assert_allclose(q_y, 0 * q_y, atol=1e-14)


# closed forms


# coupled contacts


@pytest.fixture(scope="module", params=["rigid on steel", "coated", "dissimilar"])
def coupled(request):
    bodies = {
        "rigid on steel": (STEEL,),
        "coated": (COATED,),
        "dissimilar": (STEEL, Coating(3.0, 0.1, 3.0, 0.1, 1.0)),
    }[request.param]
    of = contact(*bodies, mu=MU)
    return of, pressed(of, hertz_force(0.3, bodies=len(bodies)), 5)


def test_residuals_are_below_the_tolerance(coupled):
    of, state = coupled
    for part in (0.3, 0.6, 0.9):
        state = sheared(of, state, part * MU * state.normal_force)
        assert state.residuals.worst <= TOLERANCE
        assert min(size for size in vars(state.residuals).values() if size is not None) > -1e-15
        assert state.status is ContactStatus.PARTIAL_SLIP


def test_opposite_load_gives_the_mirrored_state(coupled):
    of, start = coupled
    force = 0.5 * MU * start.normal_force
    there, back = sheared(of, start, force), sheared(of, start, -force)
    p_there, p_back = (of.compliance.scalar_on_grid(s.pressure) for s in (there, back))
    q_there, q_back = (of.compliance.vector_on_grid(s.shear)[:, 1:] for s in (there, back))
    np.testing.assert_allclose(p_back[:, ::-1], p_there, atol=1e-7)
    np.testing.assert_allclose(q_back[0, :, ::-1], q_there[0], atol=1e-7)
    np.testing.assert_allclose(-q_back[1, :, ::-1], q_there[1], atol=1e-7)
    assert back.motions[0] == pytest.approx(-there.motions[0], rel=1e-7)


def test_force_and_displacement_lead_to_the_same_state(coupled):
    of, start = coupled
    by_force = advance(
        of,
        start,
        Loads(
            NormalTarget(force=1.1 * start.normal_force), along(load=0.6 * MU * start.normal_force)
        ),
        1e-10,
    )
    by_motion = advance(
        of,
        start,
        Loads(NormalTarget(approach=by_force.approach), along(motion=by_force.motions[0])),
        1e-10,
    )
    np.testing.assert_allclose(by_motion.pressure, by_force.pressure, atol=1e-9)
    np.testing.assert_allclose(by_motion.shear, by_force.shear, atol=1e-9)


def test_coupling_has_the_sign_of_the_closed_form(coupled):
    """Friction resists the surface that pressure pulls inwards: it points outwards on the softer
    body, and less load is needed without it."""
    of, state = coupled
    q_r = of.compliance.vector_on_grid(state.shear)[0, :, 0]
    assert np.min(q_r) > -1e-9
    assert np.max(q_r) > 0.5 * MU


@pytest.mark.parametrize("mu", [1.0, 2.0, 3.0])
def test_strong_coupling_converges(mu):
    """µ|β| = 1 and beyond, where plain turns between pressure and shear do not."""
    of = contact(NU_ZERO, mu=mu)
    state = pressed(of, hertz_force(0.0), 3)
    state = sheared(of, state, *(part * mu * state.normal_force for part in (0.2, 0.5, 0.9)))
    assert state.residuals.worst <= TOLERANCE


# Two ways to lead the first increment, each with a tangential load of part of the friction limit.
FIRST = {
    "by force": lambda mu, part: Loads(
        NormalTarget(force=hertz_force(0.3)),
        along(load=part * mu * hertz_force(0.3)),
    ),
    "by motion": lambda mu, part: Loads(NormalTarget(approach=1.0), along(motion=part * mu)),
}


def few_points(mu, **more):
    return contact(STEEL, mu=mu, per_radius=10, grid=end_grid(4), **more)


def singular(*_, **__):
    raise np.linalg.LinAlgError("singular")


@pytest.mark.parametrize("led", FIRST)
def test_singular_equations_are_an_increment_that_does_not_converge(led, monkeypatch):
    monkeypatch.setattr(dense_inverse, "cho_factor", singular)
    monkeypatch.setattr(dense_inverse, "lu_factor", lambda matrix, **_: (0 * matrix, None))
    with pytest.raises(NotConverged):
        advance(few_points(0.3), None, FIRST[led](0.3, 0.6), TOLERANCE)


def test_approach_that_touches_no_point_is_refused():
    of = few_points(0.3)
    short = NormalTarget(approach=0.5 * np.min(of.gap))
    with pytest.raises(ContactNotResolved):
        advance(of, None, Loads(short, along(motion=0.1)), TOLERANCE)


# at and beyond the friction limit


def test_force_beyond_the_friction_limit_is_refused(coupled):
    of, state = coupled
    with pytest.raises(GrossSliding, match="exceeds the friction limit"):
        sheared(of, state, 1.001 * MU * state.normal_force)


def test_at_the_friction_limit_all_shear_is_along_the_load(coupled):
    of, state = coupled
    state = sheared(of, state, MU * state.normal_force)
    q_x, q_y = along_load(of, state)
    p = of.compliance.scalar_on_grid(state.pressure)
    np.testing.assert_allclose(q_x, MU * p, atol=1e-12)
    assert np.max(np.abs(q_y)) < 1e-12
    assert state.status is ContactStatus.GROSS_SLIDING
    assert state.motions is None
    with pytest.raises(GrossSliding, match="prescribe the shift or twist"):
        sheared(of, state, 0.5 * MU * state.normal_force)


# springs


# ---- The contact solver on points (r, θ) with finite-element bodies, as `solve` calls it.


SUBSTRATE = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
HARD = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.2)
FORCE = 1e3
FRICTION = 0.2
RADIUS = 18e-3
FEW = {"harmonics": 3}


def coated(scale=1.0, stiffness=1.0):
    """A hard layer of about the contact radius on steel."""
    hard, soft = (
        IsotropicMaterial(young_modulus=stiffness * m.young_modulus, poisson_ratio=m.poisson_ratio)
        for m in (HARD, SUBSTRATE)
    )
    return Body(material=soft, layers=(Layer(thickness=0.3e-3 * scale, material=hard),))


def pushed_ball(*steps, scale=1.0, stiffness=1.0, indenter=None):
    """A rigid ball pressed on the coating in three increments and then led along `steps`."""
    unit = stiffness * scale**2
    return Scene(
        indenter=indenter or Paraboloid(radius=RADIUS * scale, material=RIGID),
        body=coated(scale, stiffness),
        friction=CoulombFriction(coefficient=FRICTION),
        loading=(
            LoadStep(normal_force=FORCE * unit, increments=3),
            *(
                LoadStep(
                    tangential_force=(x * FRICTION * FORCE * unit, y * FRICTION * FORCE * unit),
                    increments=2,
                )
                for x, y in steps
            ),
        ),
    )


def along_x():
    return pushed_ball((0.5, 0.0), (-0.2, 0.0))


@pytest.fixture(scope="module")
def result():
    return solved(along_x(), 8, **FEW)


BODIES = {
    "coated": (Paraboloid(radius=1.0, material=RIGID), (Coating(2.0, 0.2, 1.0, 0.3, 0.5),)),
    "dissimilar": (
        Paraboloid(radius=1.0, material=IsotropicMaterial(young_modulus=9.0, poisson_ratio=0.0)),
        (Coating(2.0, 0.2, 1.0, 0.3, 0.5), half_space(0.0)),
    ),
}


@pytest.mark.parametrize("name", BODIES)
def test_compliance_of_rings_is_that_of_hankel_transforms(name):
    """Energies of smooth tractions in every component, n = 0…3; the signs of what mixes shear
    and pressure are those of two bodies pressed together."""
    indenter, known = BODIES[name]
    if len(known) == 2:
        known = (known[0], Coating(4.5, 0.0, 4.5, 0.0, 1.0))
    layer, base = (
        IsotropicMaterial(young_modulus=2 * G * (1 + nu), poisson_ratio=nu)
        for G, nu in ((2.0, 0.2), (1.0, 0.3))
    )
    body = Body(material=base, layers=(Layer(thickness=0.5, material=layer),))
    scene = Scene(indenter=indenter, body=body, loading=(LoadStep(normal_force=1.0),))
    model = ContactModel.of(scene, elements(8), 1.0)
    ours = ring_compliance(model, Path.WHOLE_CIRCLE, 3)
    theirs = rings(8, float(ours.radii[-1]), 3, *known)
    np.testing.assert_allclose(ours.radii, theirs.radii, atol=1e-12)
    np.testing.assert_allclose(ours.areas, theirs.areas, rtol=1e-12)
    r = ours.radii
    inside = np.maximum(1 - r**2, 0.0) ** 2
    for n, (A, exact) in enumerate(zip(ours.harmonics, theirs.harmonics, strict=True)):
        low, high = r ** abs(n - 1) * inside, r ** (n + 1) * inside
        p = r**n * inside
        for t in ((high + low, high - low, 0 * r), (low, -low, p), (0 * r, 0 * r, p)):
            energy, known = (np.einsum("ai,aibk,bk->", t, C, t) for C in (A, exact))
            assert energy == pytest.approx(known, rel=3e-3)


def test_load_in_any_direction_is_the_same_load(result):
    turned = solved(pushed_ball((0.3, 0.4), (-0.12, -0.16)), 8, **FEW)
    assert turned.plan.direction == pytest.approx((0.6, 0.8))
    for a, b in zip(turned.increments, result.increments, strict=True):
        np.testing.assert_allclose(a.pressure, b.pressure, rtol=1e-9)
        assert a.tangential_shift == pytest.approx(
            (0.6 * b.tangential_shift[0], 0.8 * b.tangential_shift[0]), rel=1e-9
        )
        x, y = np.array([0.05e-3, 0.2e-3]), np.array([0.1e-3, -0.05e-3])
        q, p = tractions_at(b, x, y)
        q_turned, p_turned = tractions_at(a, 0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, (0.6, 0.8))
        np.testing.assert_allclose(p_turned, p, rtol=1e-9)
        expected = [0.6 * q[0] - 0.8 * q[1], 0.8 * q[0] + 0.6 * q[1]]
        np.testing.assert_allclose(q_turned, expected, rtol=1e-7, atol=1e-6 * np.max(np.abs(q)))


def test_the_area_within_an_edge_is_the_sum_of_its_sectors():
    quarters = SimpleNamespace(grid=SimpleNamespace(weights=np.full(4, np.pi / 2)))
    area = _contact_area(SimpleNamespace(compliance=quarters), np.array([1.0, 1.0, 2.0, 2.0]))
    assert area == pytest.approx(2.5 * np.pi)


def test_an_error_of_increments_is_the_same_with_angles_and_without():
    radii, points = np.linspace(0.0, 1.0, 11), np.linspace(0.0, np.pi, 5)
    names = [f"{field}_{part}" for field in ("shear", "slip") for part in COMPONENTS]
    found = []
    for angles, whole in ((None, False), (points, False), (whole_grid(3).angles, True)):
        around = 1.0 if angles is None else np.ones(len(angles))
        field = np.multiply.outer(1 - radii**2, around)
        of = {name: field if name.endswith("radial") else None for name in names}
        end = SimpleNamespace(
            step=1, dissipated_energy=1.0, radii=radii, angles=angles, covers_circle=whole, **of
        )
        found.append(dissipation_uncertainty(SimpleNamespace(path_matters=(True,)), None, end))
    assert found[1:] == pytest.approx([found[0], found[0]])
    assert found[0] == pytest.approx(np.pi / 3, rel=0.02)
