"""The shear of a model at a given pressure, solved in the box around the contact."""

from dataclasses import dataclass

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
from semi_analytical.linearised_shear import Point
from semi_analytical.model import ContactModel
from semi_analytical.tangential import solve_tangential

Field = NDArray[np.float64]


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


def shear(
    model: ContactModel,
    bound: Field,
    target: VectorField,
    load: TangentialTarget,
    start: Point,
    motion: Vector,
    tolerance: float,
) -> Shearing:
    """Solve the shear problem of one increment; all fields on the whole window.

    bound          friction limit µp, not zero everywhere
    target         c, from the state before (see tangential.solve_tangential)
    start, motion  first guesses
    raises         NotConverged
    """
    cells = model.grid.cells
    box = box_around(bound > 0, margin=0)
    inside = (..., *box.slices)
    rotation = None if load.torsion is None else model.rotation[inside]
    operator = model.tangential_operator(box.shape)
    solution = solve_tangential(
        operator,
        model.shear_inverse(box.shape),
        bound[box.slices],
        target[inside],
        load.on(model.grid.cell_area, rotation),
        Point(start.shear[inside], start.displacement[inside]),
        motion,
        model.self_compliance,
        tolerance,
    )
    q, u = box.embed(solution.shear, cells), solution.displacement
    return Shearing(
        shear=q,
        displacement=u if box.shape == cells else model.tangential_operator(cells)(q),
        motion=solution.motion,
        in_slip=box.embed(solution.in_slip.astype(np.float64), cells) > 0,
        iterations=solution.iterations,
    )
