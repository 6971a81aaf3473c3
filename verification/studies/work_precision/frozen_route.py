"""The usual route under a tangential load: pressed with sampled coefficients, then shifted to and
fro in equal increments, where a cell that slips keeps the direction in which it began.

The shift is prescribed, and everything is judged under the force that comes with it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from contact_scene import Scene
from semi_analytical import SurfaceGrid
from verification.problems.paper_scene import FRICTION
from verification.quantities import shear_of
from verification.studies.sliding.friction_laws import (
    FixedPressure,
    FrictionLaw,
    at_rest,
    shifted,
)
from verification.studies.work_precision.usual_route import Sampling, solve_sampled

Field = NDArray[np.float64]


@dataclass(frozen=True)
class ShiftedState:
    """After one increment.

    shift              of the indenter [length]
    force              tangential, along the shift [force]
    dissipated_energy  lost to friction since the shifting began [force*length]
    shear              (2, nx, ny) [force/length^2]
    turning            whether the shift turns here, or ends
    """

    shift: float
    force: float
    dissipated_energy: float
    shear: Field
    turning: bool


@dataclass(frozen=True)
class FrozenHistory:
    """What comes out.

    bound         friction limit µp (nx, ny) [force/length^2]
    convolutions  of pressing and shifting
    """

    grid: SurfaceGrid
    bound: Field
    states: tuple[ShiftedState, ...]
    convolutions: int

    @property
    def turned(self) -> tuple[ShiftedState, ...]:
        """Where the shift turned, and the end."""
        return tuple(state for state in self.states if state.turning)


def frozen_history(
    pressing: Scene,
    grid: SurfaceGrid,
    tolerance: float,
    how: Sampling,
    turns: Sequence[float],
    increments: int,
) -> FrozenHistory:
    """Press, then shift from one turn to the next.

    pressing    with the coefficient of friction of all contacts of the study
    turns       shifts at which the motion turns, and its end [length]
    increments  to the first turn, and as large all the way
    raises      what `solve` raises, and ArithmeticError where the shear does not converge
    """
    model, result = solve_sampled(pressing, grid, tolerance, how)
    end = result.increments[-1]
    bound = FRICTION * end.pressure
    problem = FixedPressure.of(model.operator(grid.cells).tangential, bound, model.self_compliance)
    held, lost, states = at_rest(problem, shear_of(end)), 0.0, []
    for by, shift, turning in _increments(turns, increments):
        before = held
        held = shifted(problem, FrictionLaw.FROZEN_DIRECTIONS, before, by)
        # Against the slip of the lower surface relative to the indenter.
        way = np.array([by, 0.0])[:, None, None] - (held.displacement - before.displacement)
        lost += float(np.sum(held.shear * way)) * grid.cell_area
        force = float(np.sum(held.shear[0])) * grid.cell_area
        states.append(ShiftedState(shift, force, lost, held.shear, turning))
    return FrozenHistory(grid, bound, tuple(states), int(model.convolutions.count))


def _increments(turns: Sequence[float], count: int) -> Iterator[tuple[float, float, bool]]:
    """Increment, shift at its end, and whether a turn is reached."""
    for start, end in pairwise((0.0, *turns)):
        here = max(1, round(count * abs(end - start) / abs(turns[0])))
        for n in range(1, here + 1):
            yield (end - start) / here, start + (end - start) * n / here, n == here
