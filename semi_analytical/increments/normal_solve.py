"""The pressure of a model under a load: nested grids, then the box around the contact."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field
from contact_scene.quantities.residuals import worst
from contact_scene.solver_errors import (
    ContactAtWindowEdge,
    ContactNotResolved,
    NotConverged,
    NothingTouches,
)
from semi_analytical.model import ContactModel, doubled
from semi_analytical.normal.contact_area import covered_cells
from semi_analytical.normal.initial_pressure import bearing_pressure
from semi_analytical.normal.normal_load import (
    FixedApproach,
    Motion,
    NormalLoad,
    PressureSum,
)
from semi_analytical.normal.normal_problem import solve_normal
from semi_analytical.operator.box import (
    Box,
    box_around,
)
from semi_analytical.residuals import complementarity, penetration

Pair = tuple[float, float]

# A coarse solution is only a first guess: the next grid changes it by more.
COARSE_TOLERANCE = 1e-3
MARGIN = 4
MAX_ATTEMPTS = 4


@dataclass(frozen=True)
class NormalState:
    """Pressure and its normal displacement on the domain, approach, residuals, cost.

    covered_cells  contact area in cells, with sub-cell accuracy
    tilt           of the indenter (x, y); None where nothing tilts
    """

    pressure: Field
    displacement: Field
    approach: float
    complementarity: float
    penetration: float
    covered_cells: float
    iterations: int
    tilt: Pair | None = None

    def closure(self, model: ContactModel) -> float | Field:
        """By how much the indenter closes the gap [length]."""
        if self.tilt is None:
            return self.approach
        return np.asarray(self.approach + plane(model, self.tilt))


@dataclass(frozen=True)
class Tilting:
    """Exactly one of the two controls: moment (M_x, M_y) [force length] or tilt (x, y)."""

    moment: Pair | None = None
    tilt: Pair | None = None


@dataclass(frozen=True)
class NormalTarget:
    """Exactly one of the two controls: force W [force] or approach [length]; and the tilt, None
    where nothing tilts."""

    force: float | None = None
    approach: float | None = None
    tilting: Tilting | None = None

    def gap(self, model: ContactModel) -> Field:
        """The undeformed gap; where the tilt is given, that of the tilted indenter at first
        touch."""
        if self.tilting is None or self.tilting.tilt is None:
            return model.gap
        return model.gap - plane(model, self.tilting.tilt) - self._first_touch(model)

    def _first_touch(self, model: ContactModel) -> float:
        """Approach at which a cell of the tilted indenter first touches [length]."""
        if self.tilting is None or self.tilting.tilt is None:
            return 0.0
        return float(np.min(model.gap - plane(model, self.tilting.tilt)))

    def on(self, model: ContactModel, box: Box) -> NormalLoad:
        """The load on that gap, as the solver sees it in a box of cells."""
        total = None if self.force is None else self.force / model.grid.cell_area
        if self.tilting is not None and self.tilting.moment is not None:
            from semi_analytical.normal.tilting import PressureMoments

            moments = np.array(self.tilting.moment) / model.grid.cell_area
            arms = model.arms[(..., *box.slices)]
            cells = np.isfinite(model.gap[box.slices])
            return PressureMoments(arms, cells, moments, total, self.approach)
        if total is not None:
            return PressureSum(total)
        assert self.approach is not None
        return FixedApproach(self.approach - self._first_touch(model))

    def reached(self, model: ContactModel, motion: Motion) -> tuple[float, Pair | None]:
        """Approach and tilt that a motion of the load stands for."""
        if self.tilting is None:
            return float(motion), None
        if self.tilting.tilt is not None:
            return float(motion) + self._first_touch(model), self.tilting.tilt
        approach, tilt_x, tilt_y = map(float, np.ravel(motion))
        return approach, (tilt_x, tilt_y)


def plane(model: ContactModel, tilt: Pair) -> Field:
    """By how much a tilt closes the gap (nx, ny) [length]."""
    return np.asarray(tilt[0] * model.arms[0] + tilt[1] * model.arms[1])


def press(model: ContactModel, target: NormalTarget, tolerance: float) -> NormalState:
    """Solve the pressure problem.

    The answer is checked with a fresh convolution over the domain: if bodies overlap outside the
    box that was solved, the box grows to the domain; if round-off has crept in, the solve is
    repeated more tightly.
    raises  ContactAtWindowEdge, ContactNotResolved, NotConverged
    """
    refuse_unresolved_contact(model, target)
    start, iterations = nested_start(model, target)
    gap = target.gap(model)
    box = box_around(start > 0, MARGIN, model.domain)
    whole = Box.whole(gap.shape)
    allowed = np.isfinite(gap)
    load = target.on(model, whole)
    aim, residual = tolerance, np.inf
    for _ in range(MAX_ATTEMPTS):
        operator = model.operator(box.shape)
        solution = solve_normal(
            operator.normal,
            operator.precondition,
            gap[box.slices],
            target.on(model, box),
            start[box.slices],
            0.5 * aim,
        )
        iterations += solution.iterations
        p = box.embed(solution.pressure, whole.shape)
        u = model.operator(whole.shape).normal(p)
        g = np.where(allowed, gap, np.inf) + u - load.closure(solution.motion)
        overlap = load.overlap(solution.motion, gap, allowed)
        measures = (complementarity(p, g, overlap), penetration(g, overlap))
        residual = worst(*measures)
        if residual <= tolerance:
            covered = covered_cells(p, p > 0, model.domain)
            refuse_contact_at_edge(p, model)
            approach, tilt = target.reached(model, solution.motion)
            return NormalState(p, u, approach, *measures, covered, iterations, tilt)
        overlap_outside = np.min(np.where(box.mask(whole.shape), 0.0, g)) < 0
        box, aim = (whole, aim) if overlap_outside else (box, 0.1 * aim)
        start = np.where(p > 0, p, np.where(g < 0, np.min(p[p > 0]), 0.0))
    raise NotConverged("the pressure", iterations, residual, tolerance)


def nested_start(model: ContactModel, target: NormalTarget) -> tuple[Field, int]:
    """Initial guess of the pressure: the frictionless solution of the coarser model, found the same
    way, or by Hertz's law where there is none; and all the iterations that took."""
    coarse = model.coarse
    if coarse is None or not _touches(coarse, target):
        gap = target.gap(model)
        load = target.on(model, Box.whole(gap.shape))
        return bearing_pressure(gap, load, model.bearing_modulus, model.grid.cell_area), 0
    pressure, iterations = _rough(coarse, target)
    return np.where(np.isfinite(model.gap), _on_half_cells(pressure), 0.0), iterations


def rough_start(model: ContactModel, target: NormalTarget) -> tuple[Field, int]:
    """The same, but where there is no coarser model the pressure roughly solved on this one."""
    return _rough(model, target) if model.coarse is None else nested_start(model, target)


def _rough(model: ContactModel, target: NormalTarget) -> tuple[Field, int]:
    """The pressure to the accuracy of an initial guess."""
    start, iterations = nested_start(model, target)
    gap = target.gap(model)
    operator = model.operator(gap.shape)
    solution = solve_normal(
        operator.normal,
        operator.precondition,
        gap,
        target.on(model, Box.whole(gap.shape)),
        start,
        COARSE_TOLERANCE,
    )
    return solution.pressure, iterations + solution.iterations


def _on_half_cells(pressure: Field) -> Field:
    """A pressure (nx, ny) on cells half as long (2 nx, 2 ny), from parabolas through its square:
    that falls to zero at the edge with a slope, the pressure like a root. Zero where it was."""
    squared = _halves(_halves(pressure**2).T).T
    return np.where(doubled(pressure) > 0, np.sqrt(np.maximum(squared, 0.0)), 0.0)


def _halves(values: Field) -> Field:
    """Values (n, …) at the middles of both halves of the cells along the first axis, (2 n, …)."""
    continued = np.concatenate([values[:1], values, values[-1:]])
    before, after = continued[:-2], continued[2:]
    bend, slope = (before + after - 2 * values) / 32, (after - before) / 8
    middles = np.empty((2 * len(values), *values.shape[1:]))
    middles[::2], middles[1::2] = values + bend - slope, values + bend + slope
    return middles


def _touches(model: ContactModel, target: NormalTarget) -> bool:
    """Whether the cells can carry the load: a force brings the nearest ones into contact, an
    approach only those whose gap is smaller."""
    gap = target.gap(model)
    load = target.on(model, Box.whole(gap.shape))
    return load.touches(gap)


def refuse_unresolved_contact(model: ContactModel, target: NormalTarget) -> None:
    """Raise ContactNotResolved if no cell of the window touches, or none where it would have to;
    ContactAtWindowEdge if that is for want of window, or if the border of the window touches first.
    """
    if _touches(model, target):
        undeformed = target.gap(model)
        tilts = target.tilting is not None and target.tilting.moment is not None
        if not tilts and np.min(model.domain.rim(undeformed)) <= np.min(undeformed):
            raise ContactAtWindowEdge(
                "the lowest point of the indenter lies at the border of the window, where the "
                f"contact begins; {_lower(model)}"
            )
        return
    if target.tilting is None or target.tilting.moment is None:
        gap = float(np.min(model.gap))
        least = f"the gap is at least {gap:.4g} m" if gap < np.inf else "nothing of the indenter is"
        kind = ContactNotResolved if target.approach is None else NothingTouches
        raise kind(
            f"no cell of the window touches: {least} at the cell centres; take more cells or a "
            f"smaller window"
        )
    if np.isfinite(model.domain.rim(model.gap)).any():
        raise ContactAtWindowEdge(
            f"under its moment the normal force acts outside the window; {_wider(model)}"
        )
    raise ContactNotResolved(
        "under its moment the normal force acts beyond the outermost cells of the indenter: it "
        "tips over; take a smaller moment, or prescribe tilt instead"
    )


def _lower(model: ContactModel) -> str:
    """What helps where the border of the window touches first."""
    if model.scene.indenter.extent is None:
        return _wider(model)
    return (
        "heights count away from the body, with flip = true towards it: change indenter.flip if "
        "the map is inverted, and remove the slope of a measured map"
    )


def _wider(model: ContactModel) -> str:
    """What helps where the window is too small."""
    if model.scene.indenter.extent is not None:
        return "the height map and the window must reach beyond the contact"
    if model.scene.friction is not None and model.scene.friction.extent is not None:
        return "the friction map and the window must reach beyond the contact"
    return "give a larger window, or leave it out to have it chosen"


def refuse_contact_at_edge(p: Field, model: ContactModel) -> None:
    """Raise ContactAtWindowEdge if a cell at the border of the window carries pressure."""
    if np.any(model.domain.rim(p) > 0):
        w = model.window.window
        raise ContactAtWindowEdge(
            f"the contact reaches the edge of the window of {w[0]:.4g} m by {w[1]:.4g} m; "
            f"{_wider(model)}"
        )
