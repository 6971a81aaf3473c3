"""Scenes solved with a penalty: closed forms, the error that a penalty makes, history, refusals."""

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LIMIT,
    LOAD,
    MU,
    PRESS,
    RADIUS,
    RIGID_BALL,
    YOUNG,
    A,
    hertz,
    push,
    scene,
    steel,
)
from fem_scenes import elements

from contact_results.quantities import shift_along_x
from contact_scene import Body, IsotropicMaterial, Layer, Paraboloid, Scene
from contact_scene.solver_errors import SurfacesOverlap
from contact_scene.summary import ContactStatus
from fem_reference import ContactAtZoneEdge, Increment, Method, Result, solve
from fem_reference.contact.increment import AT_EDGE
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.moduli import tangential_modulus
from verification.closed_forms.tangential_history import TangentialHistory
from verification.closed_forms.torsion import StuckTorsion, TorsionalPartialSlip
from verification.references import load_reference

HERTZ = hertz()
# With Poisson's ratio zero the closed forms of Cattaneo and Mindlin are exact.
LOOSE = steel(0.0)
G = steel().shear_modulus


def penalised(asked: Scene, per_radius: int = 16, **more) -> Result:
    """With a number of augmentations, whatever they leave."""
    if "augmentations" in more:
        more = {"overlap": 1.0, **more}
    return solve(asked, elements(per_radius, **more), method=Method.PENALTY)


def end(asked: Scene, per_radius: int = 16, **more) -> Increment:
    return penalised(asked, per_radius, **more).increments[-1]


def test_error_falls_with_the_penalty() -> None:
    """p0 −0.54/k and approach +0.31/k with k = c N: pure springs under Hertz's ball."""
    asked, per_radius = scene(PRESS, friction=None), 32
    for factor in (5.0, 10.0, 20.0):
        found = end(asked, per_radius, penalty=factor, augmentations=0)
        k = factor * per_radius
        assert (found.peak_pressure / HERTZ.peak_pressure - 1) * k == pytest.approx(-0.54, abs=0.06)
        assert (found.approach / HERTZ.approach - 1) * k == pytest.approx(0.31, abs=0.03)


@pytest.mark.parametrize("factor", [5.0, 10.0, 30.0])
def test_augmentation_removes_the_error_of_the_penalty(factor: float) -> None:
    found = end(scene(PRESS, friction=None), 32, penalty=factor, augmentations=1)
    assert found.peak_pressure == pytest.approx(HERTZ.peak_pressure, rel=1e-4)
    assert found.approach == pytest.approx(HERTZ.approach, rel=6e-5)
    assert found.contact_radius == pytest.approx(A, rel=4e-3)


@pytest.mark.parametrize("factor", [0.1, 1.0])
def test_penalty_does_not_decide_the_answer(factor: float) -> None:
    """Soft springs are corrected until they leave hardly any overlap."""
    asked = scene(PRESS, friction=None)
    found = end(asked, 32, penalty=factor)
    assert found.augmentations > 1
    assert found.overlap < 1e-3 * found.approach
    assert found.approach == pytest.approx(HERTZ.approach, rel=2e-4)
    assert found.peak_pressure == pytest.approx(HERTZ.peak_pressure, rel=5e-4)
    # Springs that overlap by a part of the approach enlarge the contact by about as much.
    assert found.contact_radius == pytest.approx(A, rel=AT_EDGE)


@pytest.mark.parametrize("augmentations", [0, 1])
def test_springs_that_leave_overlap_are_refused(augmentations: int) -> None:
    asked = scene({**PRESS, "increments": 2}, friction=None)
    with pytest.raises(SurfacesOverlap, match=r"larger penalty or more augmentations"):
        solve(asked, elements(penalty=0.1, augmentations=augmentations), method=Method.PENALTY)


def test_overlap_is_reported() -> None:
    """Springs alone overlap by p0/ε; augmentation leaves a small part of it."""
    asked = scene(PRESS, friction=None)
    springs, augmented = (end(asked, augmentations=n) for n in (0, 1))
    modulus = steel().plane_strain_modulus / 2
    stiffness = 10.0 * modulus * 16 / A
    assert springs.overlap == pytest.approx(springs.peak_pressure / stiffness, rel=1e-2)
    assert augmented.overlap < 0.1 * springs.overlap
    assert np.all(springs.gap >= 0)


@pytest.mark.parametrize(("augmentations", "apart"), [(0, 1e-8), (1, 1e-4)])
def test_approach_and_force_lead_to_the_same_state(augmentations: int, apart: float) -> None:
    """With augmentation but for what it leaves: the first pass meets one of the two alone."""
    same = {"contact_radius": A, "augmentations": augmentations}
    by_force = end(scene(PRESS, friction=None), **same)
    by_approach = end(scene({"approach": by_force.approach}, friction=None), **same)
    assert by_approach.normal_force == pytest.approx(LOAD, rel=apart)
    inside = by_force.radii < 0.9 * A
    error = np.abs(by_approach.pressure - by_force.pressure)[inside]
    assert np.max(error) < 10 * apart * HERTZ.peak_pressure


COATINGS = {0.5: 1.3, 2.0: 0.9, 4.0: 0.8}  # modulus over the substrate's: expected radius


def test_pressed_with_friction() -> None:
    """The integral equation of self-similar indentation (Spence 1975), at the default penalty."""
    row = load_reference("frictional_indentation_homogeneous")["rows"][0]
    body = IsotropicMaterial(young_modulus=0.5 * YOUNG, poisson_ratio=row["nu"])
    asked = scene({**PRESS, "increments": 20}, indenter=RIGID_BALL, body=body, friction=row["mu"])
    a = row["a_over_aH"] * A
    found = end(asked, 32)
    assert found.approach == pytest.approx(row["delta_over_deltaH"] * HERTZ.approach, rel=1e-4)
    assert found.contact_radius == pytest.approx(a, rel=4e-3)
    assert found.stick_radius == pytest.approx(row["c_over_a"] * a, abs=0.01 * a)
    r = np.array(row["r_over_a"])
    judged = (r > 0.09) & (r < 0.96)
    p = np.interp(r * a, found.radii, found.pressure) / HERTZ.peak_pressure
    q = np.interp(r * a, found.radii, found.shear_radial) / (row["mu"] * HERTZ.peak_pressure)
    assert np.max(np.abs(p - row["p_over_pH"])[judged]) < 3e-3
    assert np.max(np.abs(q - row["q_over_mu_pH"])[judged]) < 1e-2


VIRGIN = PartialSlip(LOAD, hertz(poisson_ratio=0.0).contact_radius, MU,
                     tangential_modulus((YOUNG, 0.0), (YOUNG, 0.0)), 0.0)  # fmt: skip


def alike(*loading) -> Scene:
    return scene(*loading, indenter=Paraboloid(radius=RADIUS, material=LOOSE), body=LOOSE)


@pytest.mark.parametrize("parts", [(0.9,), (0.9, -0.9, 0.9), (0.8, 0.2, 0.6, -0.3)])
def test_slip_is_remembered_through_reversals(parts: tuple[float, ...]) -> None:
    result = penalised(alike(PRESS, *map(push, parts)), 32)
    history, scale = TangentialHistory(VIRGIN), TangentialHistory(VIRGIN).loaded_to(0.9 * LIMIT)
    loop = scale.loaded_to(-0.9 * LIMIT).dissipated_energy
    element, edges = A / 32, []
    for part, step in zip(parts, result.steps[1:], strict=True):
        history = history.loaded_to(part * LIMIT)
        assert shift_along_x(step) == pytest.approx(history.shift, abs=2e-4 * scale.shift)
        assert step.dissipated_energy == pytest.approx(history.dissipated_energy, abs=2e-3 * loop)
        # Across the edge of an older stick zone no fit can tell where the new one ends.
        clear = all(abs(edge - history.stick_radius) > 5 * element for edge in edges)
        allowed = (0.2 if clear else 0.6) * element
        assert step.stick_radius == pytest.approx(history.stick_radius, abs=allowed)
        edges.append(history.stick_radius)
        error = np.abs(step.shear_along_load - history.shear(step.radii))
        inside = (step.radii < 0.9 * A) & (np.abs(step.radii - history.stick_radius) > 0.1 * A)
        # Kinks are left at the edges of older stick zones, too.
        assert np.mean(error[inside]) < 2e-3 * MU * HERTZ.peak_pressure
        assert np.max(error[inside]) < 3e-2 * MU * HERTZ.peak_pressure


def test_stuck_springs_yield_no_more_than_friction_over_stiffness() -> None:
    """Without augmentation a sticking point gives way by q/ε: elastic micro-slip, never lost."""
    asked = alike(PRESS, push(0.5), push(0.0), push(0.5))
    first, back, again = penalised(asked, augmentations=0).steps[1:]
    assert np.all(first.slip_along_load[first.in_stick] == 0)
    exact = VIRGIN.__class__(
        LOAD, VIRGIN.contact_radius, MU, VIRGIN.tangential_modulus, 0.5 * LIMIT
    )
    stiffness = 10.0 * YOUNG / 2 * 16 / VIRGIN.contact_radius
    given = shift_along_x(first) - exact.shift
    assert 0 < given < MU * HERTZ.peak_pressure / stiffness
    assert first.dissipated_energy <= back.dissipated_energy <= again.dissipated_energy
    assert shift_along_x(again) == pytest.approx(shift_along_x(first), rel=1e-9)


def test_slip_opposes_the_shear() -> None:
    """And is what the surfaces moved past each other, where they slip and always touched."""
    forth, back = penalised(alike(PRESS, push(0.8), push(-0.8))).steps[1:]
    slipped = forth.in_contact & ~forth.in_stick
    assert np.all(forth.shear_along_load[slipped] > 0)
    assert np.all(forth.slip_along_load[slipped] < 0)
    assert np.all(forth.slip_along_load[~slipped] == 0)
    returned = back.slip_along_load - forth.slip_along_load
    assert np.all(returned[back.in_contact & ~back.in_stick] > 0)
    # Cattaneo's rigid shift at the edge, less what the loaded surface follows there.
    deepest = np.min(forth.slip_along_load)
    assert -shift_along_x(forth) < deepest < -0.2 * shift_along_x(forth)


@pytest.mark.parametrize(("augmentations", "apart"), [(0, 1e-7), (1, 1e-4)])
def test_force_and_shift_lead_to_the_same_state(augmentations: int, apart: float) -> None:
    by_force = end(alike(PRESS, push(0.7)), augmentations=augmentations)
    asked = alike(PRESS, {"tangential_shift": by_force.tangential_shift})
    by_shift = end(asked, augmentations=augmentations)
    assert by_shift.tangential_force == pytest.approx((0.7 * LIMIT, 0.0), rel=apart)
    inside = by_force.radii < 0.5 * VIRGIN.contact_radius
    error = np.abs(by_shift.shear_along_load - by_force.shear_along_load)[inside]
    assert np.max(error) < 10 * apart * MU * HERTZ.peak_pressure


def test_less_pressure_slips_inwards() -> None:
    result = penalised(scene(PRESS, push(0.5), {"normal_force": 0.6 * LOAD, "increments": 10}))
    radii = [step.stick_radius for step in result.increments[1:]]
    assert np.all(np.diff(radii) < 0)
    energy = [step.dissipated_energy for step in result.increments]
    assert np.all(np.diff(energy) >= 0)


def test_sliding_contact_carries_all_that_friction_can() -> None:
    sliding = end(scene(PRESS, {"tangential_shift": (3 * VIRGIN.sliding_shift, 0.0)}))
    assert sliding.status is ContactStatus.GROSS_SLIDING
    assert sliding.tangential_force[0] == pytest.approx(LIMIT, rel=1e-7)
    assert sliding.stick_radius == 0
    at_limit = end(scene(PRESS, push(1.0)))
    assert at_limit.status is ContactStatus.GROSS_SLIDING
    assert at_limit.tangential_shift is None
    assert at_limit.dissipated_energy is None
    assert at_limit.shear_along_load == pytest.approx(
        sliding.shear_along_load, abs=1e-6 * MU * HERTZ.peak_pressure
    )


@pytest.mark.parametrize("part", [0.4, 0.9])
def test_twisted_ball_slips_from_its_edge(part: float) -> None:
    virgin = TorsionalPartialSlip(A, HERTZ.peak_pressure, MU, G / 2, A)
    torque = part * virgin.sliding_moment
    exact = TorsionalPartialSlip.under_moment(torque, A, HERTZ.peak_pressure, MU, G / 2)
    found = end(scene(PRESS, {"torque": torque}), 32)
    assert found.twist == pytest.approx(exact.twist, rel=2e-3)
    assert found.stick_radius == pytest.approx(exact.stick_radius, abs=0.3 / 32 * A)
    inside = (np.abs(found.radii - exact.stick_radius) > 0.1 * A) & (found.radii < 0.85 * A)
    error = np.abs(found.shear_circumferential - exact.shear(found.radii))
    assert np.max(error[inside]) < 0.01 * MU * HERTZ.peak_pressure
    by_twist = end(scene(PRESS, {"twist": found.twist}), 32)
    assert by_twist.torque == pytest.approx(torque, rel=1e-4)


def test_stuck_disc_twists_as_reissner_and_sagoci() -> None:
    punch, torque = INDENTERS["flat punch"], 1e-3
    found = end(scene(PRESS, {"torque": torque}, indenter=punch, friction=10.0), 32)
    assert found.twist == pytest.approx(StuckTorsion(A, G / 2, torque).twist, rel=1e-2)
    assert found.status is ContactStatus.FULL_STICK
    assert found.contact_radius == pytest.approx(A)
    assert found.stick_radius == found.contact_radius


def test_contact_beyond_the_fine_elements_is_refused() -> None:
    with pytest.raises(ContactAtZoneEdge, match="larger contact_radius"):
        penalised(scene(PRESS, friction=None), contact_radius=0.6 * A)


@pytest.mark.parametrize(("length", "modulus"), [(1e-6, 1e3), (1e3, 1e-6)])
def test_result_is_unit_neutral(length: float, modulus: float) -> None:
    """Lengths and moduli in other units: the same numbers, scaled."""
    force = modulus * length**2

    def problem(length: float, modulus: float) -> Scene:
        ball = Paraboloid(radius=RADIUS * length, material=steel(young_modulus=YOUNG * modulus))
        body = steel(0.2, 0.5 * YOUNG * modulus)
        press = {"normal_force": LOAD * modulus * length**2, "increments": 4}
        return scene(press, indenter=ball, body=body, friction=0.3)

    one, other = end(problem(1.0, 1.0)), end(problem(length, modulus))
    assert other.approach == pytest.approx(one.approach * length, rel=1e-10)
    assert other.normal_force == pytest.approx(one.normal_force * force, rel=1e-12)
    scale = 1e-10 * one.peak_pressure
    assert other.pressure / modulus == pytest.approx(one.pressure, abs=scale)
    assert other.shear_radial / modulus == pytest.approx(one.shear_radial, abs=scale)
    assert other.slip_radial / length == pytest.approx(one.slip_radial, abs=1e-10 * one.approach)
    assert other.dissipated_energy == pytest.approx(one.dissipated_energy * force * length)


def test_harmonics_take_springs() -> None:
    """A pushed ball on a coating: springs in series with the exact law err by 1/c."""
    film = Layer(thickness=A, material=steel())
    asked = Scene(
        indenter=RIGID_BALL,
        body=Body(material=steel(young_modulus=0.5 * YOUNG), layers=(film,)),
        friction={"coefficient": MU},
        loading=[{**PRESS, "increments": 3}, {**push(0.5), "increments": 2}],
    )
    mesh = {"per_radius": 8, "harmonics": 4, "contact_radius": 0.9 * A}
    exact = solve(asked, elements(**mesh)).increments[-1]
    soft, stiff = (end(asked, **mesh, penalty=c, augmentations=0) for c in (30.0, 300.0))
    error = [found.approach / exact.approach - 1 for found in (soft, stiff)]
    assert error[0] == pytest.approx(10 * error[1], rel=0.1)
    assert 0 < error[1] < 3e-4
    assert shift_along_x(stiff) == pytest.approx(shift_along_x(exact), rel=5e-4)


def test_same_input_gives_the_same_bits() -> None:
    asked = scene({**PRESS, "increments": 3}, indenter=RIGID_BALL)
    one, other = end(asked), end(asked)
    assert np.array_equal(one.pressure, other.pressure)
    assert np.array_equal(one.shear_radial, other.shear_radial)
    assert one.approach == other.approach
