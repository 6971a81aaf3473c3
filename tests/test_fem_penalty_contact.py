"""Scenes solved with a penalty: closed forms, the error that a penalty makes, history, refusals."""

import numpy as np
import pytest
from contact_scenes import (
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

from contact_scene import Body, Layer, Paraboloid, Scene
from contact_scene.solver_errors import SurfacesOverlap
from fem_reference import Increment, Method, Result, solve
from fem_reference.contact.increment import AT_EDGE
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.moduli import tangential_modulus
from verification.quantities import shift_along_x

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


VIRGIN = PartialSlip(LOAD, hertz(poisson_ratio=0.0).contact_radius, MU,
                     tangential_modulus((YOUNG, 0.0), (YOUNG, 0.0)), 0.0)  # fmt: skip


def alike(*loading) -> Scene:
    return scene(*loading, indenter=Paraboloid(radius=RADIUS, material=LOOSE), body=LOOSE)


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
