"""Tests of hard contacts of the stability map: the solvers converge, or refuse them by name."""

from dataclasses import replace

import numpy as np
import pytest

from contact_scene.solver_errors import NotConverged
from contact_solver.coupled_problem import CoupledSolution
from contact_solver.globalisation import _first_converged
from verification.studies.stability.contacts import (
    TOLERANCE,
    LoadingPath,
    Solver,
    StabilityCell,
    Surface,
    Verdict,
    judge_contact,
)

BOTH = [solver for solver in Solver if solver.by_elements]
ORDINARY = StabilityCell(cells=16)
HALF_SPACE = replace(ORDINARY, modulus_ratio=1.0)
SOFT_FILM = replace(ORDINARY, modulus_ratio=1e-3, thickness=0.01, poisson_ratio=0.5)
STIFF_FILM = replace(ORDINARY, modulus_ratio=1e3, thickness=0.1, poisson_ratio=0.0)
SECTION = StabilityCell(solver=Solver.COMPLEMENTARITY)
ALIKE = replace(SECTION, surface=Surface.ALIKE_BALL)
BARE_SECTION = replace(SECTION, modulus_ratio=1.0, poisson_ratio=0.0, base_ratio=0.0)
SOFT_SECTION = replace(SECTION, friction=5.0, modulus_ratio=1e-3, thickness=0.1, poisson_ratio=0.5)
ON_CELLS = [
    ORDINARY,
    *(replace(ORDINARY, path=path, push=0.8) for path in LoadingPath),
    *(replace(ORDINARY, surface=surface, push=0.99) for surface in Surface),
    replace(ORDINARY, push=0.99999, poisson_ratio=0.0, base_ratio=0.0, modulus_ratio=1.0),
    replace(ORDINARY, push=1.0),
    replace(ORDINARY, length=1e-9),
    replace(ORDINARY, load=1e-5),
    replace(ORDINARY, friction=1e-6),
    # The friction limit is less than the round-off of the displacement by the pressure, times γ.
    replace(STIFF_FILM, friction=1e-6, push=0.5, poisson_ratio=0.3, cells=48),
    replace(ORDINARY, modulus_ratio=1e3, thickness=0.01, poisson_ratio=0.5),
    replace(ORDINARY, modulus_ratio=1e-3, thickness=10.0),
    # Accepting Newton steps uphill for their residual went round in circles here,
    replace(HALF_SPACE, path=LoadingPath.APPROACH, friction=1.0, push=0.8, cells=32),
    # here cells let go one after the other below a film that lifts them,
    replace(ORDINARY, modulus_ratio=1e6, thickness=0.1, path=LoadingPath.PRESS, cells=32),
    # here admissible tractions have 1e5 times the merit of the iterate near them,
    replace(ORDINARY, modulus_ratio=1e6, thickness=0.03, friction=1.0, push=0.95, cells=48),
    # here the shear's preconditioner was not positive,
    pytest.param(
        replace(ORDINARY, modulus_ratio=1e3, thickness=0.003, poisson_ratio=0.5, cells=48),
        marks=pytest.mark.slow,
    ),
    # and friction that is strong leaves no way here but on springs: neither parts of Newton's
    # steps nor turns of pressure and shear come near, of whole increments.
    replace(SOFT_FILM, friction=5.0, push=0.5, cells=48),
    replace(STIFF_FILM, friction=5.0, push=0.9, cells=32),
    replace(STIFF_FILM, friction=5.0, push=0.99, thickness=1.0, cells=24),
]
ON_ELEMENTS = [
    replace(SECTION, push=0.99),
    replace(SECTION, push=1.0),
    *(replace(ALIKE, path=path, push=0.8) for path in (LoadingPath.FALLING, LoadingPath.SLIDE)),
    replace(SECTION, path=LoadingPath.SHEARED_RELOAD, push=0.8),
    replace(SECTION, surface=Surface.FLAT_PUNCH, push=0.9),
    # The contact extends 1.6 times as far as a circle of its area.
    pytest.param(
        replace(
            BARE_SECTION,
            friction=5.0,
            push=0.999,
            modulus_ratio=1e3,
            thickness=10.0,
            base_ratio=0.3,
            cells=48,
        ),
        marks=pytest.mark.slow,
    ),
    # The contact slips while it grows, and the shear k Δp does not move it uniformly.
    replace(ALIKE, path=LoadingPath.SHEARED_RELOAD, push=0.8, modulus_ratio=20.0, cells=48),
    # A Newton step of the multiplier exceeds the correction 1e9 times.
    replace(ALIKE, push=0.9999, cells=48),
    # The first increment loads the axis alone, which carries no shear.
    replace(SECTION, friction=1.0, push=0.95, modulus_ratio=1e6, thickness=0.1, cells=24),
    # Pressures that jump to and fro between the turns unless they are damped.
    replace(BARE_SECTION, friction=5.0, push=0.9),
    # Several states obey all laws, and pairs of them vanish on the way to one.
    pytest.param(replace(SOFT_SECTION, push=0.5), marks=pytest.mark.slow),
    # So little friction that slip is no more than the rounding of what pressing moves.
    replace(BARE_SECTION, friction=1e-6, push=0.0, cells=48),
    # So little friction that the slip by an update of the pressure would exceed the displacement.
    replace(BARE_SECTION, friction=1e-6, push=0.5),
]


@pytest.mark.parametrize("cell", ON_CELLS, ids=lambda cell: cell.name)
def test_hard_cell_converges(cell):
    record = judge_contact(cell)
    assert record.verdict is Verdict.CONVERGED, record.reason
    assert record.residual <= record.tolerance <= 1e-7
    assert record.halvings == 0


@pytest.mark.parametrize("solver", BOTH)
@pytest.mark.parametrize("cell", ON_ELEMENTS, ids=lambda cell: cell.name)
def test_hard_section_converges(cell, solver):
    record = judge_contact(replace(cell, solver=solver))
    assert record.verdict is Verdict.CONVERGED, record.reason
    assert record.residual <= record.tolerance == TOLERANCE
    assert record.halvings == 0
    assert record.work == record.iterations > 0


def test_iterations_of_methods_that_fail_are_counted():
    nothing = np.zeros(2)
    solution = CoupledSolution(nothing, nothing, nothing, nothing, nothing, False, 3, 2)

    def stall(*given):
        raise NotConverged("the coupled increment", 4, 1.0, TOLERANCE)

    methods = (stall, stall, lambda *given: solution)
    found = _first_converged(methods, nothing, nothing, nothing, nothing, TOLERANCE, (1, 1))
    assert (found.iterations, found.outer_iterations) == (12, 3)
