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
    """Normal load with prescribed moments Σp y and Σp x, and with prescribed Σp or approach.

    The rigid motion is (approach, tilt x, tilt y).

    arms      (y, x) of the cells (2, nx, ny) [length]
    cells     cells of finite gap (nx, ny)
    moments   (Σp y, Σp x) = (M_x, M_y) / cell area, shape (2,)
    total     Σp = W / cell area; None where the approach is prescribed
    approach  approach of the bodies at the origin [length]; None where Σp is prescribed
    """

    arms: Field
    cells: Mask
    moments: Vector
    total: float | None = None
    approach: float | None = None

    @cached_property
    def reach(self) -> float:
        """Largest |x| or |y| of a cell [length]; a tilt times this length compares with the
        approach."""
        return float(np.max(np.abs(self.arms)))

    @cached_property
    def shapes(self) -> Field:
        """Closures of the gap (k, nx, ny) by unit rigid motions whose conjugate forces are
        prescribed.

        The closures are 1 (approach) if the normal force is prescribed, then y and x (tilts) over
        `reach`, the largest |x| or |y| of a cell.
        """
        slopes = self.arms / self.reach
        return slopes if self.total is None else np.stack([np.ones_like(slopes[0]), *slopes])

    @cached_property
    def sums(self) -> Vector:
        """Prescribed sums (k,) over the cells of pressure times each field of `shapes`: force
        and moments."""
        moments = self.moments / self.reach
        return moments if self.total is None else np.array([self.total, *moments])

    def touches(self, gap: Field) -> bool:
        """Return True if some pressure on the cells of finite gap has the prescribed force and
        moments.

        The cells must surround the point of action of the normal force, see `_is_carried_on`.

        gap  undeformed gap (nx, ny) [length]; infinite where contact is impossible
        """
        return self._is_carried_on(self.cells & np.isfinite(gap))

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the depth below which cells carry the load in the initial guess of the pressure
        [length].

        The moments are ignored.

        gaps       undeformed gaps of all cells, in ascending order [length]
        stiffness  Σp over the depth, as a function of the number of these cells [force/length^3]
        """
        if self.total is None:
            return FixedApproach(self.approach or 0.0).bearing_depth(gaps, stiffness)
        return PressureSum(self.total).bearing_depth(gaps, stiffness)

    def motion(self, p: Field, s: Field) -> Motion:
        """Compute approach and tilt of the plane that fits a gap by least squares, weighted by the
        pressure.

        p  pressure (nx, ny)
        s  gap before the rigid motion (nx, ny) [length]
        """
        shapes = self.shapes
        metric = _weighted_products(p * shapes, shapes)
        right = np.array([np.sum(p * shape * (s - (self.approach or 0.0))) for shape in shapes])
        fit = np.linalg.pinv(metric, rcond=1e-14, hermitian=True) @ right
        approach = fit[0] if self.approach is None else self.approach
        return np.array([approach, *(fit[-2:] / self.reach)])

    def closure(self, motion: Motion) -> float | Field:
        """Return the closure of the gap by approach and tilt, a plane (nx, ny) [length]."""
        approach, tilt_x, tilt_y = np.ravel(motion)
        return np.asarray(approach + tilt_x * self.arms[0] + tilt_y * self.arms[1])

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """Return the largest overlap of the undeformed bodies over the allowed cells [length]."""
        return float(np.max(self.closure(motion) - gap, where=allowed, initial=-np.inf))

    def admissible(self, p: Field) -> Field:
        """Return a non-negative pressure near p (nx, ny) with the prescribed sum and moments.

        Negative values are set to zero, and the pressure is corrected by a plane, weighted by the
        pressure. Where this is impossible the correction has equal weight on all cells of finite
        gap.

        raises  NotConverged where no pressure has the prescribed sums
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
        """Return True if some pressure on these cells has the prescribed sum and moments.

        The cells must surround the point where Σp acts; if Σp is free, they must lie on both sides
        of the direction of the moments.

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
        """Return the non-negative pressure with the prescribed sum and moments that is nearest to
        p.

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
        """Return the projection of pressure changes that preserves the prescribed sum and moments.

        The projection restricts a field to the contact and removes the least-squares fit of a
        plane.

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
        """Return the load that remains for the solver if other cells carry given pressures.

        Force and moments of these pressures are subtracted, and these cells are excluded.

        carried  pressures of the other cells (nx, ny)
        """
        return replace(
            self,
            cells=self.cells & (carried == 0),
            moments=self.moments - np.sum(carried * self.arms, axis=(1, 2)),
            total=None if self.total is None else self.total - float(np.sum(carried)),
        )

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the closures of the gap (nx, ny) by unit rigid motions whose conjugate forces
        are prescribed."""
        return tuple(self.shapes)


def _weighted_products(a: Field, b: Field) -> Field:
    """Compute the symmetric matrix (k, k) of sums over the cells of products of two sets of k
    fields.

    a, b  fields (k, nx, ny)
    """
    sums = np.array([[np.sum(one * other) for other in b] for one in a])
    return 0.5 * (sums + sums.T)


class _ShiftedPressure:
    """Projected pressure max(0, p + weight Σ λ shape) for given multipliers λ of force and moments.

    The shapes are the closures of the gap by unit rigid motions. `multipliers.py` solves for the
    multipliers whose pressure has the prescribed force and moments.
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
        """Return True if the pressure has the prescribed force and moments up to rounding errors.

        multiplier  not used
        """
        size = float(np.sum(self.p)) + float(np.max(np.abs(self._sums)))
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * size)

    def newton_step(self) -> Vector:
        """Compute the Newton step of the multipliers of force and moments (k,).

        The shortest step is taken where the multipliers are not unique.
        """
        metric = _weighted_products(self._slack * self._shapes, self._shapes)
        return np.asarray(-np.linalg.pinv(metric, rcond=1e-14, hermitian=True) @ self.defect)
