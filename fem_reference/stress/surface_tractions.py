"""Tractions on the surface of a section at any radius, as amplitudes of angular harmonics.

A ring is a circle around the axis on the surface. A ray is the set of surface points at one angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field
from fem_reference.compliance.angular_grid import (
    AngularGrid,
    end_grid,
    grid_at,
    whole_grid,
)
from fem_reference.compliance.gauss_points import POINTS_PER_EDGE
from fem_reference.compliance.ring_edge import (
    BEYOND,
    Beyond,
    Edge,
    GaussEdge,
    HatEdge,
    contact_edge,
    holes,
)
from fem_reference.elasticity.motion import (
    LINE_PRESSING,
    LINE_SHEARING,
    PRESSING,
    SHEARING,
    TORSION,
    Motion,
    motion,
)
from fem_reference.fields import Increment

# The smooth factor near the edge is fitted without the last element with pressure. Hat functions
# that do not end at the edge have oscillating errors, with a factor of -0.3 from ring to ring. A
# line and this oscillation are fitted to FITTED elements before the last.
FITTED = 8
OSCILLATION = -0.3
FEWEST_RINGS = 4
# Indices among r, θ and z of the components whose harmonics q_r, q_theta, the shear along the load
# and the pressure have. Tractions with angles have no shear along the load.
COMPONENTS = [0, 1, 0, 2]
BETWEEN_RAYS = 2  # number of rays for the tractions per ray of the solution


@dataclass(frozen=True, eq=False)
class TractionAmplitude:
    """Amplitudes of the surface tractions in one angular harmonic, at given radii.

    motion  harmonic and its displacement components
    values  amplitudes (c, radii) of the c components among q_r, q_theta and p [force/length^2]
    turned  True for a harmonic turned by a quarter wave: (sin nθ, -cos nθ, sin nθ)
    """

    motion: Motion
    values: Field
    turned: bool = False


@dataclass(frozen=True, eq=False)
class SurfaceTractions:
    """Tractions on the lower body as functions of the radius, for the stress below the surface.

    Pressure and shear are fields of an increment, given on rings. By default the tractions are
    linear between rings. With `rooted`, the pressure is √(1 - r²/a²) times a linear interpolant,
    with the radius a of the contact edge on every ray. The shear is then the pressure times a
    linear interpolant. This form matters for the stress near an edge, which depends on the
    tractions of the last element.

    radii     radii of the rings (rings,) [length]
    pressure  pressure (rings,) or (rings, angles) [force/length^2]
    angles    None for axisymmetric fields (rings,), or angles of the rays (angles,) for fields
              (rings, angles)
    shear_radial, shear_circumferential, shear_along_load
              components of the shear, of the shape of the pressure; None for zero [force/length^2]
    rooted    True if pressure and shear decrease to zero like the root of the distance from the
              edge
    edge      coefficients of the polynomial from the ratio of the last two pressures to the
              distance of the edge from the last ring with pressure, in elements
    plane     True for a line contact, with equal tractions at x and -x
    normal_force
              resultant of the pressure [force], per length of a line contact; None for that of the
              interpolated pressure
    """

    radii: Field
    pressure: Field
    angles: Field | None = None
    shear_radial: Field | None = None
    shear_circumferential: Field | None = None
    shear_along_load: Field | None = None
    rooted: bool = False
    edge: Beyond = BEYOND
    plane: bool = False
    normal_force: float | None = None

    @classmethod
    def of(cls, increment: Increment) -> SurfaceTractions:
        """Create the surface tractions of an increment, for the stress below the surface.

        The tractions are linear between the rings on which the increment states them.

        increment  increment of the result, with pressure and shear
        """
        return cls(
            increment.radii,
            increment.pressure,
            increment.angles,
            increment.shear_radial,
            increment.shear_circumferential,
            increment.shear_along_load,
            plane=increment.is_line,
        )

    @property
    def loaded_radius(self) -> float:
        """Radius of the last ring with pressure [length].

        If only the axis carries pressure, the radius is that of the next ring. Used as unit of
        length of the mesh for the stress unless a contact radius is prescribed.
        """
        loaded = self.pressure.reshape(len(self.radii), -1).max(axis=1) > 0
        last = np.flatnonzero(loaded)[-1]
        return float(self.radii[last] or self.radii[last + 1])

    @property
    def extrapolated_from(self) -> float:
        """Radius beyond which the resultant of the interpolated tractions errs [length].

        At Gauss points, the last element with pressure lies beyond it. At hat functions, three
        rings reduce the oscillation at the edge to 3 %. If the surfaces separate within the
        contact, the resultant errs at every edge, and may exceed the force beyond the last hole.
        The interpolated pressure is zero at rings beyond the edge that is resolved between rings.
        """
        if self._has_holes:
            return 0.0
        edge = float(np.max(self.edges, initial=0.0)) or self.loaded_radius
        inner = self.radii[self.radii <= min(edge, self.loaded_radius)][:-POINTS_PER_EDGE]
        return float(inner[-1]) if inner.size else 0.0

    @property
    def reach(self) -> float:
        """Outer radius of the interpolated pressure: the first ring without pressure [length].

        The pressure is interpolated linearly to zero at this ring. If all rings carry pressure, the
        radius is that of the last ring.
        """
        beyond = self.radii[self.radii > self.loaded_radius]
        return float(beyond[0]) if beyond.size else self.loaded_radius

    @property
    def edges(self) -> Field:
        """Radii of the contact edge at θ = 0 and θ = π [length].

        The angle is counted from the direction of the load. The two radii are equal for an
        axisymmetric pressure. The array is empty if the tractions are not `rooted`, if too few
        rings carry pressure, or if the surfaces separate within the contact, where a root that ends
        at the outer edge does not describe the pressure. Used to refine the mesh for the stress.
        """
        if not self.rooted or self._least_element_count < FEWEST_RINGS:
            return np.empty(0)
        if self._has_holes:
            return np.empty(0)
        if self.angles is None:
            return np.repeat(self._edge_radii, 2)
        amplitudes = self._angular_grid.cosines @ self._edge_radii
        return np.array([np.sum(amplitudes), np.sum(amplitudes[::2]) - np.sum(amplitudes[1::2])])

    def amplitudes(self, radii: Field) -> list[TractionAmplitude]:
        """Compute the amplitudes of the surface tractions in all angular harmonics, at given radii.

        The first amplitude contains the pressure of harmonic 0. Amplitudes of one motion are
        adjacent.

        radii  radii at which the tractions are evaluated [length]
        """
        nothing = np.zeros_like(self.pressure)
        shear = (self.shear_radial, self.shear_circumferential, self.shear_along_load)
        parts = [nothing if part is None else part for part in (*shear, self.pressure)]
        rays = np.stack([part.reshape(len(self.radii), -1) for part in parts])
        values = (
            self._interpolate_with_root(radii, rays)
            if self.edges.size
            else self._interpolate_linearly(radii, rays)
        )
        if self.angles is not None:
            return [
                _amplitude_of(n, family[[0, 1, 3], :, n], turned=turned > 0)
                for n in range(self._angular_grid.highest + 1)
                for turned, family in enumerate(values)
            ]
        outward, around, along, pressure = values[0, ..., 0]
        if self.plane:
            by_shear = TractionAmplitude(LINE_SHEARING, np.stack([along, 0.0 * along]))
            return [TractionAmplitude(LINE_PRESSING, np.stack([outward, pressure])), by_shear]
        found = [TractionAmplitude(PRESSING, np.stack([outward, pressure]))]
        if self.shear_circumferential is not None:
            found.append(TractionAmplitude(TORSION, around[None]))
        if self.shear_along_load is not None:
            found.append(TractionAmplitude(SHEARING, np.stack([along, -along, 0.0 * along])))
        return found

    @property
    def _least_element_count(self) -> float:
        """Least number of elements with pressure on a ray, which must resolve the edge."""
        return float(np.min(np.count_nonzero(self._ray_pressures > 0, axis=0)) / self._per_element)

    @property
    def _has_holes(self) -> bool:
        """True if the surfaces separate within the contact on a ray."""
        return any(holes(ray, self._edge_rule) for ray in self._ray_pressures.T)

    @property
    def _ray_pressures(self) -> Field:
        """Pressure at the rings on every ray (rings, angles); one ray if it is axisymmetric."""
        return self.pressure.reshape(len(self.radii), -1)

    @cached_property
    def _angular_grid(self) -> AngularGrid:
        assert self.angles is not None
        return grid_at(self.angles)

    @property
    def _per_element(self) -> int:
        """Number of rings per element: 1 for hat functions, which have a ring on the axis,
        and POINTS_PER_EDGE for Gauss points, which have none."""
        return 1 if self.radii[0] == 0.0 else POINTS_PER_EDGE

    @property
    def _edge_rule(self) -> Edge:
        """Rule that locates the contact edge between the rings."""
        if self._per_element == 1:
            return HatEdge(self.edge)
        element = float(self.radii[POINTS_PER_EDGE] - self.radii[0])
        # The rings end beyond the edge, and may be every second one.
        return GaussEdge(element, whole_elements=False, power=0 if self.plane else 1)

    @cached_property
    def _edge_radii(self) -> Field:
        """Radius of the contact edge, resolved between rings, on every ray (angles,) [length]."""
        edge = self._edge_rule
        return np.array([contact_edge(self.radii, ray, edge) for ray in self._ray_pressures.T])

    def _interpolate_linearly(self, radii: Field, rays: Field) -> Field:
        """Interpolate q_r, q_theta, shear along the load, and pressure
        (4, rings, angles) between rings, as amplitudes (families, 4, radii, harmonics)."""
        found = [[np.interp(radii, self.radii, ray) for ray in part.T] for part in rays]
        return self._transform_angles(np.swapaxes(found, 1, 2))

    def _interpolate_with_root(self, radii: Field, rays: Field) -> Field:
        """Interpolate surface tractions that decrease like a square root to the contact edge.

        The pressure is √(1 - r²/a²) times a smooth factor, with the radius a of the contact edge.
        The shear is the pressure times a ratio. Factor and ratio are interpolated between the rays
        first, because a differs from ray to ray. The result contains amplitudes of the angular
        harmonics (families, 4, radii, harmonics), or the interpolated tractions (1, 4, radii, 1) if
        they are axisymmetric.

        radii  radii at which the tractions are evaluated [length]
        rays   q_r, q_theta, shear along the load, and pressure on rings and rays (4, rings, angles)
        """
        factors = np.empty((4, len(radii), rays.shape[2]))
        for ray, edge in enumerate(self._edge_radii):
            loaded = rays[3, :, ray] > 0
            at, pressed = self.radii[loaded], rays[3, loaded, ray]
            for part in range(3):
                factors[part, :, ray] = np.interp(radii, at, rays[part, loaded, ray] / pressed)
            factors[3, :, ray] = _smooth_factor(radii, at, pressed, edge, self._per_element)
        edges, fine = self._edge_radii, None
        if self.angles is not None:
            grid = self._angular_grid
            refined = whole_grid if grid.whole else end_grid
            fine = refined(BETWEEN_RAYS * grid.highest)
            modes = grid.modes(fine.angles)
            amplitudes = self._transform_angles(factors)
            factors = np.einsum("fcrn,fcnk->crk", amplitudes, modes[:, COMPONENTS])
            by_family = [transforms[2] @ self._edge_radii for transforms in grid.families]
            edges = np.einsum("fn,fnk->k", by_family, modes[:, 2])
        root = np.sqrt(np.maximum(1.0 - (radii[:, None] / edges) ** 2, 0.0))
        factors[3] *= root
        factors[:3] *= factors[3]
        if fine is None:
            return factors[None]
        return self._transform_angles(factors, fine)[..., : self._angular_grid.highest + 1]

    def _transform_angles(self, values: Field, grid: AngularGrid | None = None) -> Field:
        """Transform values at angles (4, radii, angles) to (families, 4, radii, harmonics);
        axisymmetric ones are unchanged, as one family."""
        if self.angles is None:
            return values[None]
        return (grid or self._angular_grid).amplitudes(values, COMPONENTS)


def _amplitude_of(n: int, tractions: Field, *, turned: bool) -> TractionAmplitude:
    """Create harmonic n of the tractions q_r, q_theta, p (3, radii) [force/length^2].
    `turned` means turned by a quarter wave, which is torsion for n = 0."""
    if turned and n == 0:
        return TractionAmplitude(TORSION, -tractions[1:2])
    of = motion(n)
    return TractionAmplitude(of, tractions[list(of.components)], turned)


def _smooth_factor(radii: Field, at: Field, pressed: Field, edge: float, per_element: int) -> Field:
    """Compute p / √(1 - r²/a²) of the pressure p on one ray, which varies slowly up to the edge a.

    Near the edge the factor is a straight line, which is fitted without the last element.

    radii        radii at which the factor is evaluated [length]
    at, pressed  radii and pressures of the rings with pressure
    edge         a [length]
    per_element  number of rings per element
    """
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
