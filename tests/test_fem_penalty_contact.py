"""Scenes solved with a penalty: closed forms, the error that a penalty makes, history, refusals."""

import numpy as np
import pytest
from contact_scenes import LOAD, PRESS, A, hertz, push, scene, steel
from fem_scenes import elements

from contact_scene import Scene
from contact_scene.solver_errors import SurfacesOverlap
from fem_reference import Increment, Method, Result, solve
from fem_reference.contact.increment import AT_EDGE

HERTZ = hertz()


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


@pytest.mark.parametrize("share", [0.5, 0.1, 0.01])
def test_residual_shear_is_unloaded_with_the_contact(share: float) -> None:
    """The displacement of residual shear is too small a scale for the strain of springs."""
    unload = {"normal_force": share * LOAD, "increments": 16}
    asked = scene(PRESS, push(0.4, increments=4), push(0.0, increments=4), unload)
    found = penalised(asked)
    exact = solve(asked, elements(), method=Method.COMPLEMENTARITY).steps[-1]
    last, hertz_approach = found.steps[-1], HERTZ.approach * share ** (2 / 3)
    assert last.approach == pytest.approx(hertz_approach, abs=1e-3 * HERTZ.approach)
    assert last.dissipated_energy == pytest.approx(exact.dissipated_energy, rel=0.08)
    largest = max(abs(step.tangential_shift[0]) for step in found.steps)
    assert last.tangential_shift == pytest.approx(exact.tangential_shift, abs=5e-3 * largest)


def test_overlap_is_reported() -> None:
    """Springs alone overlap by p0/ε; augmentation leaves a small part of it."""
    asked = scene(PRESS, friction=None)
    springs, augmented = (end(asked, augmentations=n) for n in (0, 1))
    modulus = steel().plane_strain_modulus / 2
    stiffness = 10.0 * modulus * 16 / A
    assert springs.overlap == pytest.approx(springs.peak_pressure / stiffness, rel=1e-2)
    assert augmented.overlap < 0.1 * springs.overlap
    assert np.all(springs.gap >= 0)
