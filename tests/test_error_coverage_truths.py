"""Tests of the known results of random scenes: solvers converge to them under refinement."""

from collections.abc import Iterator

import numpy as np
import pytest

import fem_reference
import semi_analytical
from contact_errors.error_formula import values_of
from verification.problems.drawn.drawing import CELLS, STRESSES, KnownScene
from verification.problems.drawn.families import (
    FAMILIES,
    Posed,
    Similar,
    drawn,
    refined,
    similar,
    stress_maxima,
)

SEED = 2  # of draws that neither tried the rules nor judge them
# Cheap families of all rules but that of finer cells.
CHEAP = "shapes", "tilted", "pushed-shapes", "twisted", "gross-slip", "elements-pushed"
# cells along a side
COARSE = 16
FINE = 48
# elements per contact radius
FEW = 6
MANY = 18
# Smooth errors fall by nine while cells become a third as large, square roots by 1.7. Each depends
# on the cut of the edge, which is off by at most one of some 16 cells per radius; slip at the edge
# by somewhat more.
FALLS = 1.5
CHANCE = 1e-4
LARGEST = 0.1


def errors(known: KnownScene, *, fine: bool) -> Iterator[float]:
    """Relative errors beyond the uncertainty of the answer."""
    asked = known.fineness.asked
    if known.fineness.solver == CELLS:
        cells = FINE if fine else COARSE
        asked = asked.model_copy(update={"cells": (cells, cells + 1)})
        result = semi_analytical.solve_discretised(known.scene, asked)
    else:
        asked = asked.model_copy(update={"elements_per_radius": MANY if fine else FEW})
        result = fem_reference.solve(known.scene, asked, fem_reference.Method.COMPLEMENTARITY)
    steps = values_of(result)
    for truth in known.truths:
        if truth.quantity in STRESSES:
            found = stress_maxima(result, truth.step)[truth.quantity][0]
        else:
            found = truth.read(steps)
        if found is not None:
            beyond = abs(found - truth.value) - truth.uncertainty
            yield max(beyond, 0.0) / abs(truth.value)


@pytest.mark.parametrize(
    "family",
    [*CHEAP, *(pytest.param(name, marks=pytest.mark.slow) for name in ("oblique", "sliding"))],
)
def test_errors_fall_towards_the_answer(family):
    """All are small on fine cells, and their geometric mean falls, chance agreements aside."""
    known = drawn(family, SEED, 0)
    coarse, fine = (np.array([*errors(known, fine=fine)]) for fine in (False, True))
    assert np.max(fine) <= LARGEST
    assert np.mean(np.log(fine + CHANCE)) <= np.mean(np.log(coarse + CHANCE)) - np.log(FALLS)


def similar_under_forces(posed: Posed) -> KnownScene:
    return next(
        known
        for seed in range(9)
        if (known := similar(np.random.default_rng(seed), posed)).scene == posed.scene
    )


def similar_balls() -> Similar:
    scene = drawn("pushed", SEED, 0).scene
    load, friction = scene.loading[0].normal_force, scene.friction
    return Similar(scene, load, friction.uniform)


def test_work_along_a_loop_is_stored_or_dissipated():
    balls = similar_balls()
    top = 0.8 * balls.mu * balls.load
    way = np.concatenate([np.linspace(top, -top, 301), np.linspace(-top, top, 301)[1:]])
    shift, stick, lost, stored = np.transpose([*balls.along(way.tolist())])
    work = np.cumsum((way[1:] + way[:-1]) / 2 * np.diff(shift))
    assert lost[1:] + stored[1:] - lost[0] - stored[0] == pytest.approx(work, abs=1e-4 * work[-1])
    assert (shift[-1], stick[-1], stored[-1]) == pytest.approx((shift[0], stick[0], stored[0]))
    assert lost[-1] == pytest.approx(5 * lost[0])


@pytest.mark.slow
def test_finer_cells_and_more_increments_agree_with_closed_forms():
    """The rule of finer cells, on a scene with ν = 0 that has a closed form."""
    posed = FAMILIES["pushed"].posed(np.random.default_rng(SEED))
    by_forces = similar_under_forces(posed)
    closed, found = (
        {(truth.step, truth.quantity): truth for truth in known.truths}
        for known in (by_forces, refined(np.random.default_rng(SEED), posed))
    )
    both = closed.keys() & found.keys()
    assert len(both) >= 8
    for key in both:
        apart = abs(closed[key].value - found[key].value)
        assert apart <= 3 * found[key].uncertainty + 1e-6 * abs(closed[key].value), key


def test_an_edge_at_the_border_of_coarse_tractions_has_no_stress():
    """On half of its cells the fitted edge of this contact lies at the border of the window."""
    known = drawn("films", 86243, 30)
    result = semi_analytical.solve_discretised(known.scene, known.fineness.asked)
    found = stress_maxima(result, len(known.scene.loading))
    assert min(min(value, error.error) for value, error in found.values()) > 0
