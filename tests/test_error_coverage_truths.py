"""Scenes that judge stated errors: solvers come closer to what is known as they refine."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

import fem_reference
import semi_analytical
from contact_errors.on_cells import stated_errors
from contact_errors.values import values_of
from contact_results.cycles import fretting_cycles
from contact_scene import Body, IsotropicMaterial, Layer
from contact_scene.stated_error import ErrorStatus
from verification.closed_forms.coated_indentation import paraboloid
from verification.problems.drawn.branches import Reached, Twisting, along
from verification.problems.drawn.coated import stored_energy
from verification.problems.drawn.families import CHOOSING, FAMILIES, JUDGING, drawn
from verification.problems.drawn.known_scene import (
    APPROACH,
    CELLS,
    MISES,
    PEAK,
    RADIUS,
    STICK,
    STRESSES,
    TENSION,
    WORK,
    KnownScene,
    Truth,
)
from verification.problems.layered_scene import surface_of
from verification.studies.error_coverage.case import judged
from verification.studies.error_coverage.coverage import Coverage, with_status
from verification.studies.error_coverage.stress_maxima import stress_maxima

# Their largest stresses take seconds to know; what finer cells and increments tell, a minute.
DEAR = {"coated-stress", "coated-pushed"}
UNSTRESSED = [family for family in FAMILIES if family not in DEAR]
# Where a draw takes seconds.
ONCE = [family for family in UNSTRESSED if family.startswith(("sections", "coated", "twisted"))]
DRAWS = [
    *((family, 1 if family in ONCE else 2) for family in UNSTRESSED),
    *(pytest.param(family, 2, marks=pytest.mark.slow) for family in ONCE),
]
COARSE, FINE = 16, 48  # cells along a side
FEW, MANY = 6, 18  # elements per contact radius
# The root mean square error over the draws falls at least by that while cells become a third as
# large: smooth quantities fall by nine on average, the area's radius by four, and each depends on
# where borders cut cells.
FALLS = 1.5
SMALL = 1e-3  # what may be luck on the coarse grid
EDGE_FALLS = 1.3  # tension at the edge of the contact, order one half

ENERGY = "elastic_energy"
SEED = 2  # of draws that neither set the rules nor judge them


@cache
def scene(family: str, number: int) -> KnownScene:
    return drawn(family, SEED, number)


def solved(known: KnownScene, fine: bool) -> Any:
    asked = known.fineness.asked
    if known.fineness.solver != CELLS:
        asked = asked.model_copy(update={"elements_per_radius": MANY if fine else FEW})
        return fem_reference.solve(known.scene, asked, fem_reference.Method.COMPLEMENTARITY)
    cells = FINE if fine else COARSE
    # With edges inside the cells stress there is right to what no number of cells takes away.
    asked = asked.model_copy(update={"cells": (cells, cells + 1), "edge": "off"})
    return semi_analytical.solve_discretised(known.scene, asked)


def errors(known: KnownScene, fine: bool, *, stress: bool) -> Iterator[tuple[Truth, float]]:
    """Relative to the truth, beyond the truth's own uncertainty; not of the input work, a sum over
    increments."""
    result = solved(known, fine)
    steps = values_of(result, fretting_cycles(result))
    maxima = cache(partial(stress_maxima, result))
    for truth in known.truths:
        if (truth.quantity in STRESSES) is stress and truth.quantity != WORK:
            found = maxima(truth.step)[truth.quantity][0] if stress else truth.read(steps)
            if found is None:  # sheared sections tell of no energy stored, and run states no error
                assert truth.quantity == ENERGY
                assert known.fineness.solver != CELLS
                continue
            known_within = truth.reference.uncertainty / abs(truth.reference.value)
            yield truth, max(abs(found / truth.reference.value - 1) - known_within, 0.0)


def mean(family: str, *, fine: bool, stress: bool, draws: int) -> dict[str, float]:
    """Root mean square over the draws of the largest error of every kind."""
    found: dict[str, list[float]] = defaultdict(list)
    for number in range(draws):
        largest: dict[str, float] = defaultdict(float)
        for truth, error in errors(scene(family, number), fine, stress=stress):
            largest[truth.kind] = max(largest[truth.kind], error)
        for kind, error in largest.items():
            found[kind].append(error)
    return {kind: float(np.sqrt(np.mean(np.square(each)))) for kind, each in found.items()}


@pytest.mark.parametrize(("family", "draws"), DRAWS)
def test_errors_fall_towards_the_truth(family: str, draws: int) -> None:
    coarse, fine = (mean(family, fine=fine, stress=False, draws=draws) for fine in (False, True))
    assert {k: e for k, e in fine.items() if e > max(SMALL, coarse[k] / FALLS)} == {}


@pytest.mark.parametrize("family", ["hertz", "cattaneo", "sliding"])
def test_stresses_rise_to_the_truth(family: str) -> None:
    coarse, fine = (mean(family, fine=fine, stress=True, draws=1) for fine in (False, True))
    falls = {TENSION: EDGE_FALLS, MISES: FALLS}
    assert TENSION in fine
    assert {k: e for k, e in fine.items() if e > coarse[k] / falls[k]} == {}


def test_drawn_scenes_are_the_same_at_every_call_and_other_for_training() -> None:
    for family in ("hertz", "cattaneo", "coated"):
        assert drawn(family, SEED, 0) == scene(family, 0)
        assert drawn(family, CHOOSING[0], 0).scene != drawn(family, JUDGING, 0).scene


def spring(force: float) -> Reached:
    """With friction: motion and energy of the first loading are powers of the force."""
    return Reached.first(force, force**2, 1 - force, force**3 / 3)


def test_a_loop_closes_where_it_began() -> None:
    states = list(along(spring, (0.8, 0.1, -0.8, 0.8)))
    assert [state.motion for state in states] == pytest.approx([0.64, 0.395, -0.64, 0.64])
    assert [state.stick_radius for state in states] == pytest.approx([0.2, 0.65, 0.2, 0.2])
    lost = 0.8**3 / 3
    assert [state.energy for state in states] == pytest.approx(
        [lost, lost + 2 * 0.35**3 / 3, 3 * lost, 5 * lost]
    )


def test_what_a_loop_takes_is_stored_or_lost() -> None:
    forces = [*np.linspace(0.8, -0.8, 2001)]
    states = list(along(spring, forces))
    force, motion = np.array(forces), np.array([state.motion for state in states])
    worked = np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(motion))
    kept = np.array([state.stored + state.energy for state in states])
    assert kept[0] == pytest.approx(2 / 3 * 0.8**3)
    assert kept[1:] - kept[0] == pytest.approx(worked, abs=1e-6)
    assert states[-1].stored == pytest.approx(states[0].stored)


def test_energy_of_a_pressed_coating_is_what_its_load_works() -> None:
    """Of a film like its base two fifths of load times approach; of any, dE = W d(approach)."""
    base = IsotropicMaterial(young_modulus=1.0, poisson_ratio=0.2)
    films = (
        Layer(thickness=0.5, material=base.model_copy(update={"young_modulus": modulus}))
        for modulus in (1.0, 5.0)
    )
    alike, stiff = (surface_of(Body(material=base, layers=(film,))) for film in films)
    bare = paraboloid(alike, 10.0, 1.0)
    assert stored_energy(bare) == pytest.approx(0.4 * bare.load * bare.approach, rel=1e-9)
    less, more = (paraboloid(stiff, 10.0, a) for a in (0.999, 1.001))
    worked = (less.load + more.load) / 2 * (more.approach - less.approach)
    assert stored_energy(more) - stored_energy(less) == pytest.approx(worked, rel=1e-4)


def test_energy_of_a_loop_is_its_area() -> None:
    """Of a first loading φ = M²: the loop M to -M takes 4 φM - 8 ∫ φ dM = (4/3) M³."""
    twisting = Twisting.of(lambda c: (1 - c, (1 - c) ** 2), 0.1, 1.0)
    assert 4 * twisting(0.6).energy == pytest.approx(4 / 3 * 0.6**3)


@pytest.mark.slow
@pytest.mark.parametrize("family", ["hertz", "coated", "cattaneo"])
def test_errors_with_edges_inside_the_cells_hold(family: str) -> None:
    """Of what follows from the edges; the scenes that set their rules were drawn from others."""
    rows = []
    for number in range(15):
        known = drawn(family, JUDGING, number)
        result = semi_analytical.solve_discretised(known.scene, known.fineness.asked)
        errors, steps = stated_errors(result).steps, values_of(result, ())
        assert result.plan.edge == "last"
        for truth in known.truths:
            if truth.quantity in (APPROACH, RADIUS, PEAK, STICK):
                found = truth.read(steps)
                assert found is not None
                rows.append(judged(truth, found, errors[truth.step - 1].get(truth.quantity)))
    coverage = Coverage.of(family, with_status(rows, str(ErrorStatus.ESTIMATED)))
    print(f"{family}: covered {coverage.covered.text}, tight {coverage.tight.text}")
    assert coverage.covered.of >= 30
    assert coverage.covered.part >= 0.9
    assert coverage.tight.part >= 0.7
