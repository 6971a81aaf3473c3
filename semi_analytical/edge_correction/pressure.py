"""The pressure with its edge inside the cells.

Constant on cells, a pressure that falls to zero like a root is wrong by O(h) at its edge. Fitted
there, p^2 passes smoothly through zero and tells what the pressure is within the cells; by that it
moves the surface, and the pressure is solved for again, until it fits what it is fitted to
(deferred correction).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semi_analytical.box import Box, box_around
from semi_analytical.edge.corrected import Corrected
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.peak import peak_of
from semi_analytical.edge.rim import Rim, area_within, rim
from semi_analytical.edge_correction.closing import closed
from semi_analytical.edge_correction.mixing import Mixing
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.model import ContactModel
from semi_analytical.normal_load import Motion, NormalLoad
from semi_analytical.pressing import MARGIN, NormalTarget

Field = NDArray[np.float64]

MOST_ROUNDS = 8
# Root mean square error that edges inside the cells leave in the end, of a pressure on N cells that
# carry it: LEFT_BY_ONE N^-LEFT_FALLS, within a third, of circles and ellipses of 8 to 100 cells per
# radius. The rounds have settled where the next one would change the pressure by about as much.
LEFT_BY_ONE, LEFT_FALLS = 0.006, 0.575
SETTLED = 2.5
# So much more may change once the rounds have learnt from a change: the next leaves less of it.
LEARNT = 2.0
# Part of its residual that the solve of a round leaves.
ENOUGH = 0.1
# To be accepted: the change that the rounds leave, and its part of the first; the part of the edge
# that could not be fitted.
LEAST_SETTLED, LEAST_FALL = 1e-3, 0.1
MOST_UNSAFE = 0.03


def edge_pressure(
    operators: EdgeOperators, target: NormalTarget, pressure: Field
) -> Corrected | None:
    """A solved pressure (nx, ny) with its edge inside the cells; None where that is not safe: the
    contact is too thin, its edge is rough, or the rounds do not settle."""
    part = operators.model.part
    p, mixing, changes = part.of(pressure), Mixing(), list[float]()
    problem = _Problem(operators, target, box_around(p > 0, MARGIN, part))
    film = operators.film(p > 0, part)
    edge = rim(p, p > 0, part=part, film=film, on_cells=True)
    for number in range(MOST_ROUNDS):
        if edge is None or edge.unsafe > MOST_UNSAFE:
            return None
        solved = problem.solve(p, edge)
        change = solved.pressure - p
        changes.append(float(np.sum(np.abs(change)) / np.sum(p)))
        scale = p if number < 2 else LEARNT * p
        settled = has_settled(change, scale, int(part.images * np.count_nonzero(p)))
        # Base solutions are so far off that nothing is to be learnt from the first change.
        p = solved.pressure if number == 0 else problem.load.admissible(mixing.next(p, change))
        if settled and settles(changes):
            break
        edge = rim(p, p > 0, edge, part=part, film=film)
    if edge is None or not settles(changes):
        return None
    return problem.corrected(p, solved, edge, changes[-1])


def has_settled(change: Field, scale: Field, cells: int) -> bool:
    """Whether what a round changes is as little as the error that is left in the end.

    scale  what it is relative to, in root mean square
    cells  that carry it
    """
    left = LEFT_BY_ONE * max(cells, 1) ** -LEFT_FALLS
    return bool(np.linalg.norm(change) <= SETTLED * left * np.linalg.norm(scale))


def settles(changes: list[float]) -> bool:
    """Whether the changes of the rounds have become small, and a small part of the first."""
    return changes[-1] <= min(LEAST_SETTLED, LEAST_FALL * changes[0])


class _Solved(NamedTuple):
    """Of a round: pressure (nx, ny) and motion of the load, and how far what the pressure is within
    the cells moves the surface (nx, ny)."""

    pressure: Field
    motion: Motion
    by_within: Field


@dataclass(frozen=True)
class _Problem:
    """box  around the contact, in the part of the window that tells pressures"""

    operators: EdgeOperators
    target: NormalTarget
    box: Box

    @property
    def model(self) -> ContactModel:
        return self.operators.model

    @cached_property
    def load(self) -> NormalLoad:
        return self._load_in(Box.whole(self.gap.shape))

    def _load_in(self, box: Box) -> NormalLoad:
        return self.target.on(self.model, box, self.model.part)

    @cached_property
    def gap(self) -> Field:
        return self.model.part.of(self.target.gap(self.model))

    def solve(self, p: Field, edge: Rim) -> _Solved:
        """The pressure with the edge where it is.

        Cells that the contact only reaches into carry what the fit says of them, and the load
        that is left to the others is theirs to find.
        """
        box = self.box.slices
        operator = self.model.pressure_operator(self.box.shape)
        reached = np.where(edge.outer, edge.means, 0.0)[box]
        within = Within.of(p, edge.i, edge.j, edge.parts, self.model.part)
        by_within = self.operators.by_pressure(p.shape)(within)[0]
        found = closed(
            operator,
            operator.precondition,
            (self.gap + by_within)[box],
            self._load_in(self.box).less(reached),
            edge.region[box],
            p[box],
            reached,
            ENOUGH,
        )
        return _Solved(self.box.embed(found.pressure, p.shape), found.motion, by_within)

    def corrected(self, p: Field, solved: _Solved, edge: Rim, change: float) -> Corrected:
        """The pressure of the last round, as a state."""
        approach, tilt = self.target.reached(self.model, solved.motion)
        u = solved.by_within + self.model.pressure_operator(p.shape)(solved.pressure)
        gap = np.maximum(self.gap + u - self.load.closure(solved.motion), 0.0)
        gap[edge.region] = 0.0
        area = area_within(p, edge)
        unfolded = self.model.part.unfolded
        p, gap = unfolded(p), unfolded(gap)
        return Corrected(p, peak_of(p), gap, approach, area, change, edge.kept, tilt)
