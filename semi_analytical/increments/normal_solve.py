"""Solution of the normal problem: nested grids, then a box of cells around the contact."""

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
from contact_solver.pressure import solve_pressure
from contact_solver.residuals import complementarity, penetration
from semi_analytical.increments.initial_pressure import bearing_pressure
from semi_analytical.increments.normal_target import NormalTarget, Pair, plane
from semi_analytical.model import ContactModel, refine_field
from semi_analytical.operator.box import Box, box_around
from semi_analytical.operator.points import fields_of

# Tolerance of solves that yield an initial guess: the discretisation error of their grid is larger.
COARSE_TOLERANCE = 1e-3
MARGIN = 4
MAX_ATTEMPTS = 4


@dataclass(frozen=True)
class NormalState:
    """Solution of the normal problem on the reduced domain.

    pressure         p (nx, ny) [force/length^2]
    displacement     normal surface displacement u_z (nx, ny) [length]
    approach         approach of the bodies [length]
    complementarity  residual Σ p |gap| / (Σp times overlap of the undeformed bodies), dimensionless
    penetration      residual max(-gap) / overlap of the undeformed bodies, dimensionless
    iterations       iterations of all solves
    tilt             tilt of the indenter (φ_x, φ_y); None without tilt
    """

    pressure: Field
    displacement: Field
    approach: float
    complementarity: float
    penetration: float
    iterations: int
    tilt: Pair | None = None

    def closure(self, model: ContactModel) -> float | Field:
        """Compute the reduction of the gap by approach and tilt of the indenter [length].

        The gap is undeformed gap plus displacement minus this reduction. The result is a number, or
        a field (nx, ny) with tilt.
        """
        if self.tilt is None:
            return self.approach
        return np.asarray(self.approach + plane(model, self.tilt))


def press(model: ContactModel, target: NormalTarget, tolerance: float) -> NormalState:
    """Solve the normal problem of a contact model for a prescribed normal load, without shear.

    The solver works in a box of cells around the contact. A convolution over the whole domain
    checks the solution. If the bodies overlap outside the box, the box becomes the whole domain. If
    a residual exceeds the tolerance otherwise, the solve is repeated with a tighter tolerance.

    model      contact model
    target     prescribed force or approach, with moment or tilt
    tolerance  limit of complementarity and penetration residuals, dimensionless
    raises     ContactAtWindowEdge; ContactNotResolved; NotConverged after MAX_ATTEMPTS solves
    """
    refuse_unresolved_contact(model, target)
    start, iterations = nested_initial_guess(model, target)
    gap = target.gap(model)
    box = box_around(start > 0, MARGIN, model.domain)
    whole = Box.whole(gap.shape)
    everywhere = target.problem(model, whole)
    aim, residual = tolerance, np.inf
    for _ in range(MAX_ATTEMPTS):
        problem = target.problem(model, box)
        solution = solve_pressure(problem, start[box.slices].ravel(), 0.5 * aim)
        iterations += solution.iterations
        p = box.embed(solution.pressure.reshape(box.shape), whole.shape)
        u = model.operator(whole.shape).normal(p)
        g = gap + u - fields_of(everywhere.closure(solution.motion), gap.shape)
        overlap = everywhere.overlap(solution.motion)
        measures = (complementarity(p, g, overlap), penetration(g, overlap))
        residual = worst(*measures)
        if residual <= tolerance:
            refuse_contact_at_edge(p, model)
            approach, tilt = target.reached(model, solution.motion)
            return NormalState(p, u, approach, *measures, iterations, tilt)
        overlap_outside = np.min(np.where(box.mask(whole.shape), 0.0, g)) < 0
        box, aim = (whole, aim) if overlap_outside else (box, 0.1 * aim)
        start = np.where(p > 0, p, np.where(g < 0, np.min(p[p > 0]), 0.0))
    raise NotConverged("the pressure", iterations, residual, tolerance)


def nested_initial_guess(model: ContactModel, target: NormalTarget) -> tuple[Field, int]:
    """Return an initial guess of the contact pressure (nx, ny), and the iterations spent on it.

    The guess is the solution on a grid with half the cells per side, whose initial guess is found
    in the same manner. On the coarsest grid the guess follows from Hertz theory
    (`initial_pressure`). Hertz theory is also used if no cell of the coarser grid comes into
    contact.
    """
    coarse = model.coarse
    if coarse is None or not target.touches(coarse, target.gap(coarse)):
        return bearing_pressure(model, target), 0
    pressure, iterations = rough_initial_guess(coarse, target)
    return np.where(np.isfinite(model.gap), refine_field(pressure), 0.0), iterations


def rough_initial_guess(model: ContactModel, target: NormalTarget) -> tuple[Field, int]:
    """Solve the frictionless normal problem with the loose tolerance COARSE_TOLERANCE.

    Return the pressure (nx, ny) and the number of iterations. The pressure is the initial guess on
    the next finer grid, and that of the coupled problem.
    """
    start, iterations = nested_initial_guess(model, target)
    problem = target.problem(model, Box.whole(start.shape))
    solution = solve_pressure(problem, start.ravel(), COARSE_TOLERANCE)
    return solution.pressure.reshape(start.shape), iterations + solution.iterations


def refuse_unresolved_contact(model: ContactModel, target: NormalTarget) -> None:
    """Raise an error if the grid cannot represent the contact under a normal load.

    ContactNotResolved is raised if no cell of the window comes into contact (NothingTouches under a
    prescribed approach). ContactAtWindowEdge is raised if the window is too small, or if its border
    comes into contact first.

    model   contact model
    target  prescribed normal load
    """
    undeformed = target.gap(model)
    if target.touches(model, undeformed):
        if target.moment is None and np.min(model.domain.rim(undeformed)) <= np.min(undeformed):
            raise ContactAtWindowEdge(
                "the lowest point of the indenter lies at the border of the window, so that the "
                f"contact begins there. {_remedy_at_border(model)}"
            )
        return
    if target.moment is None:
        gap = float(np.min(model.gap))
        least = f"the gap is at least {gap:.4g} m at" if gap < np.inf else "the indenter covers no"
        kind = ContactNotResolved if target.approach is None else NothingTouches
        raise kind(
            f"no cell of the window comes into contact: {least} cell centre. Use more cells or a "
            f"smaller window"
        )
    if np.isfinite(model.domain.rim(model.gap)).any():
        raise ContactAtWindowEdge(
            f"the moment places the normal force outside the window. {_remedy_for_window(model)}"
        )
    raise ContactNotResolved(
        "the moment places the normal force beyond the outermost cells of the indenter, which tips "
        "over. Use a smaller moment, or prescribe tilt instead"
    )


def _remedy_at_border(model: ContactModel) -> str:
    """Return a sentence for an error message: the remedy if contact begins at the window border."""
    if model.scene.indenter.extent is None:
        return _remedy_for_window(model)
    return (
        "Change indenter.flip if the map is inverted (heights are positive away from the body, "
        "with flip = true towards it), and remove the slope of a measured map"
    )


def _remedy_for_window(model: ContactModel) -> str:
    """Return a sentence for an error message: the remedy if the window is too small."""
    if model.scene.indenter.extent is not None:
        return "Use a height map and a window that are larger than the contact"
    if model.scene.friction is not None and model.scene.friction.extent is not None:
        return "Use a friction map and a window that are larger than the contact"
    return "Use a larger window, or omit the window to have it chosen"


def refuse_contact_at_edge(p: Field, model: ContactModel) -> None:
    """Raise ContactAtWindowEdge if a cell at the border of the window carries pressure.

    p  pressure (nx, ny) on the reduced domain
    """
    if np.any(model.domain.rim(p) > 0):
        w = model.window.window
        raise ContactAtWindowEdge(
            f"the contact reaches the edge of the window of {w[0]:.4g} m by {w[1]:.4g} m. "
            f"{_remedy_for_window(model)}"
        )
