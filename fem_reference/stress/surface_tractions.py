"""Tractions on the surface of a section, at any radius, as harmonics."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field
from fem_reference.compliance.angular_grid import (
    AngularGrid,
    end_grid,
    mid_grid,
)
from fem_reference.compliance.gauss_points import POINTS_PER_EDGE
from fem_reference.compliance.ring_edge import (
    BEYOND,
    Beyond,
    Edge,
    GaussEdge,
    HatEdge,
    contact_edge,
)
from fem_reference.elasticity.motion import PRESSING, SHEARING, TORSION, Motion, motion
from fem_reference.fields import Increment

# The last element with pressure does not determine the smooth factor. Hats that do not end at the
# edge have oscillating errors before it, with a factor of -0.3 from ring to ring: a line and this
# oscillation are fitted to this number of elements before the last.
FITTED, OSCILLATION = 8, -0.3
FEWEST_RINGS = 4
BETWEEN_RAYS = 2  # rays of the tractions per computed ray


@dataclass(frozen=True, eq=False)
class SurfaceTractions:
    """Tractions on the lower body; names and signs as in `Increment`.

    They are linear between rings. If the contact ends in a root, the pressure is a linear
    interpolant times √(1 - r²/a²), with the edge a of every ray, and the shear is the pressure
    times a linear interpolant: the stress near an edge depends on the tractions of the last
    element.

    radii   (rings,) [length]
    angles  None, or (angles,) for fields (rings, angles)
    rooted  true if pressure and shear end in a root of the distance from the edge
    edge    distance of the edge from the last ring with pressure, see `beyond_pressure`
    """

    radii: Field
    pressure: Field
    angles: Field | None = None
    shear_radial: Field | None = None
    shear_circumferential: Field | None = None
    shear_along_load: Field | None = None
    rooted: bool = False
    edge: Beyond = BEYOND

    @classmethod
    def of(cls, increment: Increment) -> SurfaceTractions:
        """Return the tractions of an increment, linear between rings."""
        return cls(
            increment.radii,
            increment.pressure,
            increment.angles,
            increment.shear_radial,
            increment.shear_circumferential,
            increment.shear_along_load,
        )

    @property
    def loaded_radius(self) -> float:
        """Radius of the last ring with pressure, or of the next one if it is the axis [length]."""
        loaded = self.pressure.reshape(len(self.radii), -1).max(axis=1) > 0
        last = np.flatnonzero(loaded)[-1]
        return float(self.radii[last] or self.radii[last + 1])

    @property
    def reach(self) -> float:
        """Radius at which the pressure reaches zero, or of the last ring [length]."""
        beyond = self.radii[self.radii > self.loaded_radius]
        return float(beyond[0]) if beyond.size else self.loaded_radius

    @property
    def edges(self) -> Field:
        """Radii of the edges in front of and behind the load [length].

        They are equal for an axisymmetric pressure. Empty if the tractions are not rooted or have
        too few rings.
        """
        if not self.rooted or self._fewest < FEWEST_RINGS:
            return np.empty(0)
        if self.angles is None:
            return np.repeat(self._edges, 2)
        amplitudes = self._grid.cosines @ self._edges
        return np.array([np.sum(amplitudes), np.sum(amplitudes[::2]) - np.sum(amplitudes[1::2])])

    def amplitudes(self, radii: Field) -> list[tuple[Motion, Field]]:
        """Motions with the amplitudes (c, radii) at any radii of q_r, q_theta, p that load them."""
        nothing = np.zeros_like(self.pressure)
        shear = (self.shear_radial, self.shear_circumferential, self.shear_along_load)
        parts = [nothing if part is None else part for part in (*shear, self.pressure)]
        rays = np.stack([part.reshape(len(self.radii), -1) for part in parts])
        values = self._rooted(radii, rays) if self.edges.size else self._linear(radii, rays)
        if self.angles is not None:
            motions = [motion(n) for n in range(self._grid.highest + 1)]
            return [(m, values[[0, 1, 3]][list(m.components), :, m.harmonic]) for m in motions]
        outward, around, along, pressure = values[..., 0]
        found = [(PRESSING, np.stack([outward, pressure]))]
        if self.shear_circumferential is not None:
            found.append((TORSION, around[None]))
        if self.shear_along_load is not None:
            found.append((SHEARING, np.stack([along, -along, 0.0 * along])))
        return found

    @property
    def _fewest(self) -> float:
        """Elements with pressure, on the ray with the fewest."""
        return float(np.min(np.count_nonzero(self._rays > 0, axis=0)) / self._per_element)

    @property
    def _rays(self) -> Field:
        """The pressure (rings, angles), of one angle where it is the same all round."""
        return self.pressure.reshape(len(self.radii), -1)

    @cached_property
    def _grid(self) -> AngularGrid:
        assert self.angles is not None
        count = len(self.angles)
        return end_grid(count - 1) if self.angles[0] == 0 else mid_grid(count)

    @property
    def _per_element(self) -> int:
        """Points of an element: its ring, or Gauss points, of which none is on the axis."""
        return 1 if self.radii[0] == 0.0 else POINTS_PER_EDGE

    @cached_property
    def _edges(self) -> Field:
        """Radius of the edge on every ray [length]: between rings from the axis on, or between
        Gauss points."""
        edge: Edge = HatEdge(self.edge)
        if self._per_element > 1:
            edge = GaussEdge(float(self.radii[POINTS_PER_EDGE] - self.radii[0]))
        return np.array([contact_edge(self.radii, ray, edge) for ray in self._rays.T])

    def _linear(self, radii: Field, rays: Field) -> Field:
        """Return harmonics (4, radii, harmonics) of tractions that are linear between rings."""
        found = [[np.interp(radii, self.radii, ray) for ray in part.T] for part in rays]
        return self._harmonics(np.swapaxes(found, 1, 2))

    def _rooted(self, radii: Field, rays: Field) -> Field:
        """Interpolate tractions that fall to zero like a square root at the contact edge.

        Returns the amplitudes of their harmonics, shape (4, radii, harmonics).

        Shear over pressure and the smooth factor of the pressure are interpolated between rays
        first, because the radius of the root differs from ray to ray.
        """
        factors = np.empty((4, len(radii), rays.shape[2]))
        for ray, edge in enumerate(self._edges):
            loaded = rays[3, :, ray] > 0
            at, pressed = self.radii[loaded], rays[3, loaded, ray]
            for part in range(3):
                factors[part, :, ray] = np.interp(radii, at, rays[part, loaded, ray] / pressed)
            factors[3, :, ray] = _smooth_factor(radii, at, pressed, edge, self._per_element)
        edges, fine = self._edges, None
        if self.angles is not None:
            fine = end_grid(BETWEEN_RAYS * self._grid.highest)
            cosines, sines = self._grid.modes(fine.angles)
            modes = (cosines, sines, cosines, cosines)
            amplitudes = self._harmonics(factors)
            factors = np.stack([f @ m for f, m in zip(amplitudes, modes, strict=True)])
            edges = (self._grid.cosines @ self._edges) @ cosines
        root = np.sqrt(np.maximum(1.0 - (radii[:, None] / edges) ** 2, 0.0))
        factors[3] *= root
        factors[:3] *= factors[3]
        if fine is None:
            return factors
        return self._harmonics(factors, fine)[..., : self._grid.highest + 1]

    def _harmonics(self, values: Field, grid: AngularGrid | None = None) -> Field:
        """Return harmonics (4, radii, harmonics) of values (4, radii, angles), or of axisymmetric
        values."""
        if self.angles is None:
            return values
        on = grid or self._grid
        transforms = (on.cosines, on.sines, on.cosines, on.cosines)
        return np.stack([f @ d.T for f, d in zip(values, transforms, strict=True)])


def _smooth_factor(radii: Field, at: Field, pressed: Field, edge: float, per_element: int) -> Field:
    """Return the smooth factor of the pressure on a ray, p / √(1 - r²/a²), at any radii."""
    inner = at[at < edge][:-per_element]
    smooth = pressed[: len(inner)] / np.sqrt(1.0 - (inner / edge) ** 2)
    count = min(FITTED * per_element, len(inner))
    beside = inner[-count:] / edge - 1.0
    oscillation = OSCILLATION ** np.arange(count)[::-1] if per_element == 1 else np.zeros(count)
    law = np.stack([np.ones(count), beside, oscillation], axis=1)
    value, slope, amplitude = np.linalg.lstsq(law, smooth[-count:], rcond=None)[0]
    smooth[-count:] -= amplitude * oscillation
    line = value + slope * (radii / edge - 1.0)
    return np.where(radii < inner[-1], np.interp(radii, inner, smooth), line)
