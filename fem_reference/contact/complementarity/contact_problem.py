"""The discrete contact of one path: compliances between tractions at rings and gaps over hats."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import CoulombFriction
from fem_reference.contact.ring_edge import Beyond, beyond_pressure
from fem_reference.elasticity.hats import Hats
from fem_reference.model import ContactModel
from fem_reference.plan import Path

Field = NDArray[np.float64]
Matrix = NDArray[np.float64]

# Of n = 0.
R, Z = 0, 1


@dataclass(frozen=True)
class Sideways:
    """The one component of shear that a path has: radial, circumferential, or along the load.

    friction     between the surfaces
    compliance   displacement over the hats per shear (n, n)
    motion       of the indenter's surface over the hats, per unit of its shift or twist; its
                 product with the shear is the force or torque over 2π. None where symmetry
                 keeps the indenter in place
    by_pressure  displacement over the hats per pressure (n, n); None where pressure moves the
                 surfaces by the same amount. Its transpose is the gap per shear (Betti)
    on_axis      whether there can be any on the axis
    """

    friction: CoulombFriction
    compliance: Matrix
    motion: Field | None
    by_pressure: Matrix | None
    on_axis: bool

    def limited(self, bound: Field) -> Field:
        """A bound of the shear, or the pressure, without the ring on the axis where there can be
        none."""
        return bound if self.on_axis else np.where(np.arange(len(bound)) > 0, bound, 0.0)

    def resultant(self, q: Field) -> float:
        """Of a shear, over 2π; zero where symmetry leaves none."""
        return 0.0 if self.motion is None else float(np.sum(self.motion * q))

    def capacity(self, p: Field) -> float:
        """The largest resultant over 2π that friction carries under a pressure."""
        carried = self.friction.carried(self.resultant(self.limited(p)))
        assert carried is not None  # it is the same everywhere
        return carried


@dataclass(frozen=True)
class ContactProblem:
    """All that the complementarity method needs.

    radii     (n,) of the rings [length]
    weights   ∫ φ r dr (n,); the normal force is 2π Σ weights pressure
    gap       undeformed gap over the hats (n,), ∫ h φ r dr
    normal    gap over the hats per pressure (n, n)
    sideways  None where the path has no shear
    open_end  whether the mesh ends at the last ring but the contact may go on
    edge      how far beyond the last ring pressure ends, see `beyond_pressure`
    """

    radii: Field
    weights: Field
    gap: Field
    normal: Matrix
    sideways: Sideways | None
    open_end: bool
    edge: Beyond


def contact_problem(model: ContactModel, path: Path) -> ContactProblem:
    """The problem of a path other than Path.HARMONICS; condenses only the harmonics it needs."""
    hats, pressing = model.hats, model.compliance(0).matrix
    return ContactProblem(
        radii=hats.radii,
        weights=hats.weights,
        gap=hats.of(model.gap),
        normal=hats.compliance(pressing[Z, :, Z]),
        sideways=_sideways(model, hats, path),
        open_end=not model.ends_at_rim,
        edge=beyond_pressure(model.scene.body, model.scene.indenter),
    )


def _sideways(model: ContactModel, hats: Hats, path: Path) -> Sideways | None:
    friction = model.friction
    if path is Path.PRESSING_WITH_FRICTION:
        pressing = model.compliance(0).matrix
        radial = hats.compliance(pressing[R, :, R])
        return Sideways(friction, radial, None, hats.compliance(pressing[R, :, Z]), on_axis=False)
    if path is Path.TWISTING:
        around = hats.compliance(model.torsion().matrix[0, :, 0])
        return Sideways(friction, around, hats.arms, None, on_axis=False)
    if path is Path.SHEARING:
        return Sideways(
            friction, hats.compliance(model.along_load()), hats.weights, None, on_axis=True
        )
    return None
