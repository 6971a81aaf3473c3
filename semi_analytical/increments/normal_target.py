"""Prescribed normal load of an increment, as rigid motions of the indenter that close the gap."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_solver.pressure import PressureProblem
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import Box
from semi_analytical.operator.points import map_of_points, points_of

Pair = tuple[float, float]


@dataclass(frozen=True)
class NormalTarget:
    """Prescribed normal load of an increment: force or approach, and moment or tilt.

    force, approach  normal force [force] or approach [length]: exactly one is given
    moment, tilt     moment (M_x, M_y) [force length] or tilt (φ_x, φ_y): one is given; both None
                     without tilt
    """

    force: float | None = None
    approach: float | None = None
    moment: Pair | None = None
    tilt: Pair | None = None

    def gap(self, model: ContactModel) -> Field:
        """Return the undeformed gap of the bodies at first contact (nx, ny) [length].

        For a prescribed tilt, the gap is that of the tilted indenter at its first contact.
        """
        if self.tilt is None:
            return model.gap
        tilted = model.gap - plane(model, self.tilt)
        return tilted - np.min(tilted)

    def _first_touch(self, model: ContactModel) -> float:
        """Return the approach at first touch with the tilt, from first contact without [length]."""
        return 0.0 if self.tilt is None else float(np.min(model.gap - plane(model, self.tilt)))

    def motions(self, model: ContactModel, box: Box) -> RigidMotions:
        """Return the rigid motions that close the gap: approach, and tilts under moments.

        The approach counts from first touch of the tilted indenter, as `gap` does. Tilts are
        multiplied by `ContactModel.reach`.

        model  contact model
        box    box of cells in which the normal problem is solved
        """
        area, everywhere = model.grid.cell_area, np.ones((1, 1))
        if self.force is not None:
            motions = [RigidMotion(everywhere, self.force / area)]
        else:
            assert self.approach is not None
            motions = [RigidMotion(everywhere, value=self.approach - self._first_touch(model))]
        if self.moment is not None:
            arms = points_of(model.arms[(..., *box.slices)]) / model.reach
            motions += [
                RigidMotion(arm[None], moment / (area * model.reach))
                for arm, moment in zip(arms, self.moment, strict=True)
            ]
        return RigidMotions(1, tuple(motions))

    def problem(self, model: ContactModel, box: Box) -> PressureProblem:
        """Return the problem of the pressure without shear in a box of cells.

        model  contact model
        box    box of cells in which the normal problem is solved
        """
        operator = model.operator(box.shape)
        precondition = map_of_points(operator.precondition, box.shape)
        return PressureProblem(
            map_of_points(operator.normal, box.shape),
            lambda contact: precondition,
            points_of(self.gap(model)[box.slices]),
            self.motions(model, box),
        )

    def reached(self, model: ContactModel, motion: Vector) -> tuple[float, Pair | None]:
        """Convert the rigid motions found by the solver to approach [length] and tilt.

        motion  rigid motions in the order and scaling of `motions`
        """
        approach, *tilts = map(float, motion)
        if not tilts:
            return approach + self._first_touch(model), self.tilt
        tilt_x, tilt_y = tilts
        return approach, (tilt_x / model.reach, tilt_y / model.reach)

    def touches(self, model: ContactModel, gap: Field) -> bool:
        """Return True if cells of finite gap can carry the prescribed normal load.

        Otherwise the grid is too coarse, the bodies do not touch at the prescribed approach, or the
        moment places the force beyond the cells.

        model  contact model
        gap    undeformed gap (nx, ny) [length]; infinite where contact is impossible
        """
        if self.moment is not None:
            return _is_carried_on(np.isfinite(gap), model.arms, self.moment, self.force)
        if self.force is not None:
            return bool(np.isfinite(np.min(gap)))
        assert self.approach is not None
        return float(np.min(gap)) < self.approach - self._first_touch(model)

    def bearing_depth(self, model: ContactModel, gaps: Vector, stiffness: Vector) -> float:
        """Return the bearing depth of the load by Hertz theory, without moments [length].

        In the initial guess of the pressure, cells whose undeformed gap is below this depth are in
        contact.

        model      contact model
        gaps       distinct finite undeformed gaps of the cells, ascending (k,) [length]
        stiffness  normal force over bearing depth, if all cells up to each of these gaps are in
                   contact (k,) [force/length]
        """
        if self.force is None:
            assert self.approach is not None
            return 0.5 * (self.approach - self._first_touch(model))
        bearing = int(np.searchsorted(stiffness * gaps, self.force))
        return float(self.force / stiffness[max(bearing - 1, 0)])


def _is_carried_on(cells: Mask, arms: Field, moment: Pair, force: float | None) -> bool:
    """Return True if some pressure on given cells has the prescribed force and moments.

    The cells must surround the point where the normal force acts; strips must lie on both sides of
    it. If the normal force is free, the cells must lie on both sides of the direction of the
    moments.

    cells   cells that may carry pressure (nx, ny)
    arms    (y, x) of the cells (2, nx, ny) [length]
    moment  (M_x, M_y) [force length]
    force   normal force [force]; None where the approach is prescribed
    """
    (y, x), (M_x, M_y) = arms[:, cells], moment
    if not np.any(y) and force is not None:
        return bool(x.size and np.min(x) < M_y / force < np.max(x))
    if force is not None:
        angles = np.sort(np.arctan2(y - M_x / force, x - M_y / force))
        gaps = np.diff(angles, append=angles[:1] + 2 * np.pi)
        return bool(gaps.size and np.max(gaps) < np.pi)
    if M_x == 0 and M_y == 0:
        return True
    aside = np.angle(np.exp(1j * (np.arctan2(y, x) - np.arctan2(M_x, M_y))))
    left = np.min(aside, where=aside >= 0, initial=np.inf)
    right = np.max(aside, where=aside <= 0, initial=-np.inf)
    return bool(left - right < np.pi)


def plane(model: ContactModel, tilt: Pair) -> Field:
    """Compute the reduction of the gap by a tilt of the indenter (nx, ny) [length].

    tilt  (φ_x, φ_y): slopes along y and x
    """
    return np.asarray(tilt[0] * model.arms[0] + tilt[1] * model.arms[1])
