"""The pressure of a model under a load: nested grids, then the box around the contact."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene import HeightMap
from semi_analytical.box import Box, box_around
from semi_analytical.contact_area import covered_cells
from semi_analytical.errors import ContactAtWindowEdge, ContactNotResolved, NotConverged
from semi_analytical.model import ContactModel, doubled
from semi_analytical.normal import FixedApproach, NormalLoad, PressureSum, solve_normal
from semi_analytical.residuals import complementarity, penetration

Field = NDArray[np.float64]

# A coarse solution is only a first guess: half a digit better than the next grid needs.
COARSE_TOLERANCE = 1e-4
MARGIN = 4
MOST_ATTEMPTS = 4


@dataclass(frozen=True)
class Pressing:
    """Pressure and its normal displacement on the whole window, approach, residuals, cost.

    covered_cells  contact area in cells, with sub-cell accuracy
    """

    pressure: Field
    displacement: Field
    approach: float
    complementarity: float
    penetration: float
    covered_cells: float
    iterations: int


@dataclass(frozen=True)
class NormalTarget:
    """Exactly one of the two controls: force W [force] or approach [length]."""

    force: float | None = None
    approach: float | None = None

    def on(self, model: ContactModel) -> NormalLoad:
        """The load as the solver sees it on one grid."""
        if self.force is not None:
            return PressureSum(self.force / model.grid.cell_area)
        assert self.approach is not None
        return FixedApproach(self.approach)


def press(model: ContactModel, target: NormalTarget, tolerance: float) -> Pressing:
    """Solve the pressure problem on the whole window.

    The answer is checked with a fresh convolution over the window: if bodies overlap outside the
    box that was solved, the box grows to the window; if round-off has crept in, the solve is
    repeated more tightly.
    raises  ContactAtWindowEdge, ContactNotResolved, NotConverged
    """
    refuse_unresolved_contact(model, target)
    start, iterations = nested_start(model, target)
    box = box_around(start > 0, MARGIN)
    whole = Box.whole(model.grid.cells)
    allowed = np.isfinite(model.gap)
    aim, residual = tolerance, np.inf
    for _ in range(MOST_ATTEMPTS):
        operator = model.normal_operator(box.shape)
        solution = solve_normal(
            operator,
            operator.precondition,
            model.gap[box.slices],
            target.on(model),
            start[box.slices],
            0.5 * aim,
        )
        iterations += solution.iterations
        p = box.embed(solution.pressure, model.grid.cells)
        u = model.normal_operator(whole.shape)(p)
        g = np.where(allowed, model.gap, np.inf) + u - solution.approach
        measures = (complementarity(p, g, solution.approach), penetration(g, solution.approach))
        residual = max(measures)
        if residual <= tolerance:
            refuse_contact_at_edge(p, model)
            return Pressing(p, u, solution.approach, *measures, covered_cells(p, p > 0), iterations)
        overlap_outside = np.min(np.where(box.mask(model.grid.cells), 0.0, g)) < 0
        box, aim = (whole, aim) if overlap_outside else (box, 0.1 * aim)
        start = np.where(p > 0, p, np.where(g < 0, np.min(p[p > 0]), 0.0))
    raise NotConverged("the pressure", iterations, residual, tolerance)


def nested_start(model: ContactModel, target: NormalTarget) -> tuple[Field, int]:
    """A first pressure: the frictionless solution of the coarser model, found the same way, and
    the iterations spent on all the coarser grids."""
    coarse = model.coarse
    if coarse is None or not _touches(coarse, target):
        return np.where(np.isfinite(model.gap), 1.0, 0.0), 0
    start, iterations = nested_start(coarse, target)
    operator = coarse.normal_operator(coarse.grid.cells)
    solution = solve_normal(
        operator,
        operator.precondition,
        coarse.gap,
        target.on(coarse),
        start,
        COARSE_TOLERANCE,
    )
    finer = np.where(np.isfinite(model.gap), doubled(solution.pressure), 0.0)
    return finer, iterations + solution.iterations


def _touches(model: ContactModel, target: NormalTarget) -> bool:
    """Whether any cell can carry pressure: a force brings the nearest ones into contact, an
    approach only those whose gap is smaller."""
    least = float(np.min(model.gap))
    return np.isfinite(least) if target.approach is None else least < target.approach


def refuse_unresolved_contact(model: ContactModel, target: NormalTarget) -> None:
    """Raise ContactNotResolved if no cell of the window touches."""
    if not _touches(model, target):
        raise ContactNotResolved(
            f"no cell of the window touches: the gap is at least {np.min(model.gap):.4g} m at the "
            f"cell centres; take more cells or a smaller window"
        )


def refuse_contact_at_edge(p: Field, model: ContactModel) -> None:
    """Raise ContactAtWindowEdge if a cell at the border of the window carries pressure."""
    rim = np.concatenate([p[0], p[-1], p[:, 0], p[:, -1]])
    if np.any(rim > 0):
        w = model.grid.window
        advice = "give a larger window, or leave it out to have it chosen"
        if isinstance(model.scene.indenter, HeightMap):
            advice = "the height map and the window must reach beyond the contact"
        raise ContactAtWindowEdge(
            f"the contact reaches the edge of the window of {w[0]:.4g} m by {w[1]:.4g} m; {advice}"
        )
