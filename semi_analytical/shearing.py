"""The shear of a model at a given pressure: the box around the contact, nested grids within."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from semi_analytical.admissible_shear import (
    FixedShift,
    ShearSum,
    TangentialLoad,
    Vector,
    VectorField,
)
from semi_analytical.box import box_around
from semi_analytical.model import ContactModel, doubled, halved
from semi_analytical.tangential import TangentialSolution, solve_tangential

Field = NDArray[np.float64]

COARSE_TOLERANCE = 1e-4
COARSEST = 16


@dataclass(frozen=True)
class Shearing:
    """Shear and its displacement on the whole window, the motion of the load, slip zone, and
    iterations."""

    shear: VectorField
    displacement: VectorField
    motion: Vector
    in_slip: NDArray[np.bool_]
    iterations: int


@dataclass(frozen=True)
class Torsion:
    """Exactly one of the two controls: torque M_z [force length] or twist."""

    torque: float | None = None
    twist: float | None = None


@dataclass(frozen=True)
class TangentialTarget:
    """Exactly one of the two controls: force T [force] or shift [length], each (2,); and the
    torsion, None where nothing twists."""

    force: Vector | None = None
    shift: Vector | None = None
    torsion: Torsion | None = None

    def on(self, cell_area: float, rotation: VectorField | None) -> TangentialLoad:
        """The load as the solver sees it on cells of this area.

        rotation  (-y, x) of the cells (2, nx, ny) [length]; None where nothing twists
        """
        total = None if self.force is None else self.force / cell_area
        if self.torsion is not None and self.torsion.torque is not None:
            assert rotation is not None
            from semi_analytical.torsion import ShearMoments

            return ShearMoments(rotation, self.torsion.torque / cell_area, total, self.shift)
        if total is not None:
            return ShearSum(total)
        assert self.shift is not None
        return FixedShift(self.shift)


@dataclass(frozen=True)
class _Problem:
    """The shear problem on a box of cells of one model (see tangential.solve_tangential)."""

    model: ContactModel
    bound: Field
    target: VectorField
    start: VectorField
    motion: Vector
    load: TangentialTarget
    rotation: VectorField | None

    def halved(self) -> "_Problem | None":
        """The same on twice as large cells."""
        nx, ny = self.bound.shape
        if self.model.coarse is None or nx % 2 or ny % 2 or min(nx, ny) <= COARSEST:
            return None
        return _Problem(
            self.model.coarse,
            halved(self.bound),
            halved(self.target),
            halved(self.start),
            self.motion,
            self.load,
            None if self.rotation is None else halved(self.rotation),
        )


def shear(
    model: ContactModel,
    bound: Field,
    target: VectorField,
    load: TangentialTarget,
    start: VectorField,
    motion: Vector,
    tolerance: float,
) -> Shearing:
    """Solve the shear problem of one increment; all fields on the whole window.

    bound          friction limit µp, not zero everywhere
    target         c, from the state before (see tangential.solve_tangential)
    start, motion  of the state before
    raises         NotConverged
    """
    box = box_around(bound > 0, margin=0)
    inside = (..., *box.slices)
    rotation = None if load.torsion is None else model.rotation[inside]
    problem = _Problem(
        model, bound[box.slices], target[inside], start[inside], motion, load, rotation
    )
    solution = _solve(problem, tolerance)
    q = box.embed(solution.shear, model.grid.cells)
    return Shearing(
        shear=q,
        displacement=model.tangential_operator(model.grid.cells)(q),
        motion=solution.motion,
        in_slip=box.embed(solution.in_slip.astype(np.float64), model.grid.cells) > 0,
        iterations=solution.iterations,
    )


def _solve(problem: _Problem, tolerance: float) -> TangentialSolution:
    """Start from the solution on twice as large cells, which starts from the next one."""
    start, motion, spent = problem.start, problem.motion, 0
    coarse = problem.halved()
    if coarse is not None:
        solution = _solve(coarse, COARSE_TOLERANCE)
        share = solution.shear / np.where(coarse.bound > 0, coarse.bound, 1.0)
        start, motion = doubled(share) * problem.bound, solution.motion
        spent = solution.iterations
    operator = problem.model.tangential_operator(problem.bound.shape)
    solution = solve_tangential(
        operator,
        operator.precondition,
        problem.bound,
        problem.target,
        problem.load.on(problem.model.grid.cell_area, problem.rotation),
        start,
        motion,
        problem.model.self_compliance,
        tolerance,
    )
    return replace(solution, iterations=spent + solution.iterations)
