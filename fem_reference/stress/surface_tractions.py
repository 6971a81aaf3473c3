"""What loads the surface of a section, ring by ring or as harmonics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.harmonics.angular_grid import end_grid, mid_grid
from fem_reference.elasticity.motion import PRESSING, SHEARING, TORSION, Motion, motion
from fem_reference.fields import Increment

Field = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SurfaceTractions:
    """What loads the lower body, linear between rings; names and signs as in `Increment`.

    radii   (rings,) [length]
    angles  None, or (angles,) where fields are (rings, angles)
    """

    radii: Field
    pressure: Field
    angles: Field | None = None
    shear_radial: Field | None = None
    shear_circumferential: Field | None = None
    shear_along_load: Field | None = None

    @classmethod
    def of(cls, increment: Increment) -> SurfaceTractions:
        """Those of an increment."""
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
        """Of the last ring with pressure, or of the next one if that is the axis [length]."""
        loaded = self.pressure.reshape(len(self.radii), -1).max(axis=1) > 0
        last = np.flatnonzero(loaded)[-1]
        return float(self.radii[last] or self.radii[last + 1])

    @property
    def reach(self) -> float:
        """Where the pressure has come to zero, or its last ring [length]."""
        beyond = self.radii[self.radii > self.loaded_radius]
        return float(beyond[0]) if beyond.size else self.loaded_radius

    def amplitudes(self) -> list[tuple[Motion, Field]]:
        """Motions with the amplitudes (c, rings) of q_r, q_theta, p that load them."""
        nothing = np.zeros_like(self.radii)
        if self.angles is not None:
            return self._on_harmonics(self.angles)
        outward = nothing if self.shear_radial is None else self.shear_radial
        found = [(PRESSING, np.stack([outward, self.pressure]))]
        if self.shear_circumferential is not None:
            found.append((TORSION, self.shear_circumferential[None]))
        if self.shear_along_load is not None:
            along = self.shear_along_load
            found.append((SHEARING, np.stack([along, -along, nothing])))
        return found

    def _on_harmonics(self, angles: Field) -> list[tuple[Motion, Field]]:
        grid = end_grid(len(angles) - 1) if angles[0] == 0 else mid_grid(len(angles))
        parts = (self.shear_radial, self.shear_circumferential, self.pressure)
        values = [np.zeros_like(self.pressure) if part is None else part for part in parts]
        amplitudes = grid.amplitudes(np.stack(values))
        motions = [motion(n) for n in range(grid.highest + 1)]
        return [(m, amplitudes[list(m.components), :, m.harmonic]) for m in motions]
