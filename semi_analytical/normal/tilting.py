"""Tilt of the indenter under prescribed moments; this module is not imported without tilt.

A prescribed tilt only changes the gap. A prescribed moment Σ p (y, x) Δ is a constraint like the
normal force: the tilt is its multiplier, as the approach is that of Σp (CONVENTIONS, "generalised
coordinates").
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.solver_errors import NotConverged
from semi_analytical.multipliers import MAX_SWEEPS, find_multiplier
from semi_analytical.normal.normal_load import (
    FixedApproach,
    Motion,
    NormalLoad,
    PressureSum,
    Projection,
)

# Rounding error of a sum of pressures and of its moments, relative to the sum.
ROUND_OFF = 1e-14


@dataclass(frozen=True)
class PressureMoments:
    """Normal load of a tilting indenter: prescribed moments Σp y and Σp x, and Σp or the approach.

    The pressure p has these sums over all cells. The rigid motion of the indenter is (approach,
    tilt x, tilt y).

    arms      (y, x) of the cells (2, nx, ny) [length]
    cells     cells of finite gap (nx, ny)
    moments   (Σp y, Σp x) = (M_x, M_y) / cell area, shape (2,)
    total     Σp = W / cell area with the normal force W; None where the approach is prescribed
    approach  approach of the bodies at the origin [length]; None where Σp is prescribed
    """

    arms: Field
    cells: Mask
    moments: Vector
    total: float | None = None
    approach: float | None = None

    @cached_property
    def reach(self) -> float:
        """Length that makes tilts comparable with the approach [length].

        It is the largest |x| or |y| of a cell.
        """
        return float(np.max(np.abs(self.arms)))

    @cached_property
    def shapes(self) -> Field:
        """Closures of the gap (k, nx, ny) by the unit rigid motions of the indenter that are free.

        A motion is free if its conjugate force or moment is prescribed. The closures are 1
        (approach) if the normal force is prescribed, then y and x (tilts), divided by the largest
        |x| or |y| of a cell.
        """
        slopes = self.arms / self.reach
        return slopes if self.total is None else np.stack([np.ones_like(slopes[0]), *slopes])

    @cached_property
    def sums(self) -> Vector:
        """Prescribed normal force and moments in the scaling of `shapes` (k,), over the cell area.

        Each entry is the sum over all cells of pressure times one field of `shapes`. The force is
        absent where the approach is prescribed.
        """
        moments = self.moments / self.reach
        return moments if self.total is None else np.array([self.total, *moments])

    def touches(self, gap: Field) -> bool:
        """Return True if cells of finite gap can carry the prescribed force and moments.

        The cells must surround the point of action of the normal force, see `_is_carried_on`.

        gap  undeformed gap (nx, ny) [length]; infinite where contact is impossible
        """
        return self._is_carried_on(self.cells & np.isfinite(gap))

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the bearing depth of Hertz theory without the moments of the load [length].

        In the initial guess of the pressure, cells whose undeformed gap is below this depth are in
        contact.

        gaps       distinct finite undeformed gaps of the cells, ascending (k,) [length]
        stiffness  Σp divided by the bearing depth, if all cells up to each of these gaps are in
                   contact (k,) [force/length^3]
        """
        if self.total is None:
            return FixedApproach(self.approach or 0.0).bearing_depth(gaps, stiffness)
        return PressureSum(self.total).bearing_depth(gaps, stiffness)

    def motion(self, p: Field, s: Field) -> Motion:
        """Compute the approach and the tilt of the indenter that close the gap under a pressure.

        They are the plane that fits the gap by least squares, weighted by the pressure. Return the
        vector (approach, tilt x, tilt y). A prescribed approach is returned unchanged.

        p  pressure (nx, ny)
        s  gap before the rigid motion (nx, ny) [length]: undeformed gap plus displacement
        """
        shapes = self.shapes
        metric = _weighted_products(p * shapes, shapes)
        right = np.array([np.sum(p * shape * (s - (self.approach or 0.0))) for shape in shapes])
        fit = np.linalg.pinv(metric, rcond=1e-14, hermitian=True) @ right
        approach = fit[0] if self.approach is None else self.approach
        return np.array([approach, *(fit[-2:] / self.reach)])

    def closure(self, motion: Motion) -> float | Field:
        """Compute the reduction of the gap by approach and tilt, a plane (nx, ny) [length].

        motion  vector (approach, tilt x, tilt y)
        """
        approach, tilt_x, tilt_y = np.ravel(motion)
        return np.asarray(approach + tilt_x * self.arms[0] + tilt_y * self.arms[1])

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """Compute the largest overlap of the undeformed bodies at an approach and tilt [length].

        Residual gaps are divided by this overlap.

        motion   vector (approach, tilt x, tilt y)
        gap      undeformed gap (nx, ny) [length]
        allowed  cells of finite gap (nx, ny)
        """
        return float(np.max(self.closure(motion) - gap, where=allowed, initial=-np.inf))

    def admissible(self, p: Field) -> Field:
        """Return a non-negative pressure near a given one with the prescribed force and moments.

        Negative values are set to zero. A plane, weighted by the pressure, is then added so that
        force and moments are correct. If the loaded cells cannot carry the moments, the plane is
        added with equal weight on all cells of finite gap.

        p       given pressure (nx, ny)
        raises  NotConverged where no pressure has the prescribed force and moments
        """
        p = np.maximum(p, 0.0)
        if self.total is not None:
            p = p * (self.total / np.sum(p))
        carrying = self._nearest_carrying_pressure(p, p)
        if carrying is None:
            carrying = self._nearest_carrying_pressure(p, self.cells * np.mean(p))
        if carrying is None:
            raise NotConverged("the pressure under its moments", MAX_SWEEPS, np.inf, ROUND_OFF)
        return carrying

    def _is_carried_on(self, cells: Mask) -> bool:
        """Return True if some pressure on given cells has the prescribed force and moments.

        The cells must surround the point where the normal force acts. If the normal force is free,
        they must lie on both sides of the direction of the moments.

        cells  cells that may carry pressure (nx, ny)
        """
        y, x = self.arms[:, cells]
        M_x, M_y = self.moments
        if self.total is not None:
            angles = np.sort(np.arctan2(y - M_x / self.total, x - M_y / self.total))
            gaps = np.diff(angles, append=angles[:1] + 2 * np.pi)
            return bool(gaps.size and np.max(gaps) < np.pi)
        if M_x == 0 and M_y == 0:
            return True
        aside = np.angle(np.exp(1j * (np.arctan2(y, x) - np.arctan2(M_x, M_y))))
        left = np.min(aside, where=aside >= 0, initial=np.inf)
        right = np.max(aside, where=aside <= 0, initial=-np.inf)
        return bool(left - right < np.pi)

    def _nearest_carrying_pressure(self, p: Field, weight: Field) -> Field | None:
        """Return the non-negative pressure nearest to p that has the prescribed force and moments.

        None is returned if no such pressure exists.

        p       pressure (nx, ny)
        weight  inverse metric of the projection (nx, ny); zero where the pressure is not corrected
        """
        if not self._is_carried_on(weight > 0):
            return None
        shapes, sums = self.shapes, self.sums
        shifted, multiplier = find_multiplier(
            lambda m: _ShiftedPressure(m, p, weight, shapes, sums), np.zeros(len(sums))
        )
        return shifted.p if shifted.has_prescribed_forces(multiplier) else None

    def projection(self, inside: Field) -> Projection:
        """Return a linear projection of pressure changes that keeps force and moments constant.

        The projection restricts a change to the contact and subtracts the plane that fits it by
        least squares. Conjugate gradients on a contact set use it.

        inside  1 in contact, 0 elsewhere (nx, ny)
        """
        units = inside * self.shapes
        inverse = np.linalg.pinv(_weighted_products(units, units), rcond=1e-14, hermitian=True)

        def projected(field: Field) -> Field:
            shares = inverse @ np.array([np.sum(unit * field) for unit in units])
            motion = sum(share * unit for share, unit in zip(shares, units, strict=True))
            return np.asarray(field * inside - motion)

        return projected

    def less(self, carried: Field) -> NormalLoad:
        """Return the normal load reduced by the force and the moments of given cell pressures.

        The edge correction fixes the pressure of edge cells and solves for the other cells, which
        carry the reduced load. The edge cells are excluded from the cells that can carry it.

        carried  fixed pressure of the edge cells, zero in other cells (nx, ny)
        """
        return replace(
            self,
            cells=self.cells & (carried == 0),
            moments=self.moments - np.sum(carried * self.arms, axis=(1, 2)),
            total=None if self.total is None else self.total - float(np.sum(carried)),
        )

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the closures of the gap by the unit approach and tilts that the load leaves free.

        A closure is a field (nx, ny). The tilts are free, because moments are prescribed. The
        approach is free if the normal force is prescribed.

        shape  number of cells (nx, ny)
        """
        return tuple(self.shapes)


def _weighted_products(a: Field, b: Field) -> Field:
    """Compute the symmetric matrix (k, k) of the scalar products of two sets of k fields.

    A scalar product is the sum over all cells. Used to fit approach and tilts by least squares, and
    in Newton's method for their multipliers.

    a, b  fields (k, nx, ny): closures of the gap by unit approach and tilts, times a weight per
          cell
    """
    sums = np.array([[np.sum(one * other) for other in b] for one in a])
    return 0.5 * (sums + sums.T)


class _ShiftedPressure:
    """Projected pressure max(0, p + weight Σ λ shape) for given multipliers λ of force and moments.

    The shapes are the closures of the gap by unit rigid motions. `multipliers.py` solves for the
    multipliers whose pressure has the prescribed force and moments.

    multiplier  multipliers λ (k,)
    p           given pressure (nx, ny)
    weight      weight of the correction in each cell (nx, ny)
    shapes      closures of the gap by unit approach and tilts (k, nx, ny)
    sums        prescribed force and moments (k,)
    """

    def __init__(
        self, multiplier: Vector, p: Field, weight: Field, shapes: Field, sums: Vector
    ) -> None:
        plane = sum(m * shape for m, shape in zip(multiplier, shapes, strict=True))
        shifted = p + weight * plane
        pressed = (shifted > 0) & (weight > 0)
        self.p, self._slack = np.where(pressed, shifted, 0.0), np.where(pressed, weight, 0.0)
        self._shapes, self._sums = shapes, sums
        self.defect = np.array([np.sum(self.p * shape) for shape in shapes]) - sums

    def has_prescribed_forces(self, multiplier: Vector) -> bool:
        """Return True if the pressure has the prescribed force and moments up to round-off.

        The Newton iteration for the Lagrange multipliers of force and moments stops then.

        multiplier  not used
        """
        size = float(np.sum(self.p)) + float(np.max(np.abs(self._sums)))
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * size)

    def newton_step(self) -> Vector:
        """Compute the Newton step of the Lagrange multipliers (k,) of force and moments.

        The multipliers are the coefficients of a plane that is added to the pressure, so that it
        has the prescribed force and moments. The shortest step is taken where they are not unique.
        """
        metric = _weighted_products(self._slack * self._shapes, self._shapes)
        return np.asarray(-np.linalg.pinv(metric, rcond=1e-14, hermitian=True) @ self.defect)
