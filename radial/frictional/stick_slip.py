"""Pressure and radial shear on a disc under Coulomb's law, for a given contact radius.

The pressure is that of the frictionless contact, which is exact, plus a change Δp on rings by the
shear. The gap is closed at every node and the pressure is zero at the edge. A sticking node keeps
its radial displacement u_r. A slipping node has q = ∓b(p) with the friction limit b. The condition
|q - γ Δu_r| < b determines the sticking nodes, by semismooth Newton (Alart and Curnier 1991).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.solver_errors import NotConverged
from radial.frictional.coupling import (
    Coupling,
    RingResponse,
)
from radial.frictional.rings import Rings
from radial.normal.disc import (
    Disc,
    disc,
)
from radial.normal.surface import pressure

if TYPE_CHECKING:
    from contact_scene.geometry import ShapedBody

Signs = NDArray[np.int64]

MAX_STEPS = 200  # Newton steps; near full stick only one ring changes per step
# A node whose trial shear differs from its friction limit by less than this multiple of the largest
# limit keeps its state (stick or slip).
TIE = 1e-9
EXACT = 1e-12  # bound of the error of the linearised friction limit over the largest limit
# If nodes change only outside this fraction of the contact radius, the slip zone is too narrow for
# the rings, and the error message mentions it.
AT_EDGE = 0.95
# Number of first steps that change all nodes; later steps change only the node with the largest
# error.
ALL_AT_ONCE = 8


@dataclass(frozen=True)
class FrictionalContact:
    """Solution of an axisymmetric contact with friction that has a given contact radius.

    Fields are (n + 1,) at the nodes of the rings unless stated otherwise. Rows are the nodes and
    points outside the contact. u_r and u_z are displacements of the lower body relative to the
    indenter.

    contact              frictionless contact of equal radius
    rings                nodes along the radius of the contact
    pressure_change      Δp, pressure minus that of `contact` [force/length²]
    shear                q, radial shear on the lower body, positive outward [force/length²]
    approach_change      approach minus that of `contact` [length]
    normal_displacement  u_z by Δp and q, at the rows [length]
    radial_displacement  u_r by all tractions, at the rows [length]
    slip_increment       u_r minus the displacement that stick requires: the slip of the increment
                         [length]
    sliding              0 at a sticking node, else the sign of q
    residual             largest error of the closed gap over the approach [1]
    """

    contact: Disc
    rings: Rings
    pressure_change: Array
    shear: Array
    approach_change: float
    normal_displacement: Array
    radial_displacement: Array
    slip_increment: Array
    sliding: Signs
    residual: float

    @property
    def radius(self) -> float:
        """Radius a of the contact area, which is prescribed in this solve [length]."""
        return self.contact.radius

    @property
    def approach(self) -> float:
        """Approach δ of the indenter since first contact, with friction [length].

        The value is the approach without friction plus its change by the shear.
        """
        return self.contact.approach + self.approach_change

    @property
    def load(self) -> float:
        """Normal force W with friction, the integral of the pressure [force]."""
        return self.contact.load + self.integrate_over_contact(self.pressure_change)

    @cached_property
    def pressure(self) -> Array:
        """Pressure p of the contact with friction at the nodes (n + 1,) [force/length²].

        The pressure is infinite at the axis below a tip.
        """
        return pressure(self.contact, self.rings.x) + self.pressure_change

    def integrate_over_contact(self, field: Array) -> float:
        """Integrate a nodal traction (or its product with a displacement) over the contact area.

        field  values at the nodes (n + 1,); zero at the edge, where the field varies as √(1-x²),
               x = r/a
        """
        return float(2 * pi * self.radius**2 * (self.rings.weights @ field))

    def elastic_energy(self, gap: Array) -> float:
        """Compute the elastic energy of both bodies, ½ ∫ (p u_z + q u_r) dA [force length].

        p and q are pressure and radial shear. Within the contact u_z = δ - f, with the approach δ
        and the undeformed gap f.

        gap  f at the nodes (n + 1,) [length]
        """
        by_change = self.integrate_over_contact(self.pressure_change * (self.approach - gap))
        by_shear = self.integrate_over_contact(
            self.shear * self.radial_displacement[: len(self.shear)]
        )
        whole = self.contact.elastic_energy
        return whole + 0.5 * (self.approach_change * self.contact.load + by_change + by_shear)


def frictional_contact(
    coupling: Coupling,
    indenter: ShapedBody,
    radius: float,
    rings: Rings,
    friction: CoulombFriction,
    before: Array,
    guess: Signs,
) -> FrictionalContact:
    """Solve pressure, radial shear and stick zone of a contact with friction and given radius.

    coupling  elastic response of both bodies
    indenter  shape of the indenter
    radius    contact radius [length]
    rings     n + 1 nodes along the radius of the contact
    friction  friction law
    before    radial displacement that stick requires, at the nodes and points outside (rows,)
              [length]
    guess     initial guess of the slip zone: signs of the shear of slipping nodes, 0 for sticking
              nodes (n + 1,)
    raises    NotConverged if the sticking nodes cannot be determined, and errors of `disc`
    """
    contact = disc(coupling.bodies, indenter, radius)
    response = coupling.response(rings, radius)
    frictionless_displacement = coupling.frictionless_displacement(contact, rings)
    smooth = pressure(contact, rings.x)
    found, sliding = _solve_stick_and_slip(
        response,
        rings.count,
        friction,
        smooth[1:-1],
        (before - frictionless_displacement)[1 : rings.count],
        guess[1:-1],
        rings.x[1:-1],
    )
    n = rings.count
    p, q, approach_change = found[:n], found[n:-1], float(found[-1])
    normal_displacement = response.zz @ p + response.zr @ q
    radial_displacement = frictionless_displacement + response.rz @ p + response.rr @ q
    depth = contact.approach + approach_change
    return FrictionalContact(
        contact,
        rings,
        np.append(p, 0.0),
        np.concatenate([[0.0], q, [0.0]]),
        approach_change,
        normal_displacement,
        radial_displacement,
        (radial_displacement - before)[: n + 1],
        np.concatenate([[0], sliding, [sliding[-1]]]),
        float(np.max(np.abs(normal_displacement[: n + 1] - approach_change))) / depth,
    )


def _solve_stick_and_slip(
    response: RingResponse,
    n: int,
    friction: CoulombFriction,
    smooth: Array,
    stick_displacement: Array,
    guess: Signs,
    places: Array,
) -> tuple[Array, Signs]:
    """Solve for pressure change, radial shear and slip zone of a contact of given radius.

    The pressure change Δp is the pressure minus that of the frictionless contact. The method is
    semismooth Newton: each step solves a linear system with fixed sticking and slipping nodes. The
    function returns the vector of Δp, the shear q and the change of the approach, and the signs of
    the shear of slipping nodes.

    response            compliance matrices between rings
    n                   number of elements, the intervals between nodes
    friction            friction law
    smooth              pressure without friction, at the nodes between axis and edge (n - 1,)
                        [force/length²]
    stick_displacement  radial displacement by Δp and q that stick requires, at these nodes (n - 1,)
                        [length]
    guess               initial guess of the signs of the shear, 0 for sticking nodes (n - 1,)
    places              radii of these nodes over the contact radius (n - 1,)
    """
    own = np.abs(np.diag(response.rr[1:n]))
    size = 2 * n
    matrix, right = np.zeros((size, size)), np.zeros(size)
    matrix[: n + 1] = np.column_stack([response.zz[: n + 1], response.zr[: n + 1], -np.ones(n + 1)])
    sticking = np.column_stack([response.rz[1:n], response.rr[1:n], np.zeros(n - 1)])
    sliding, contradicting, first, pressure = guess, 1.0, 0.0, smooth
    for step in range(MAX_STEPS):
        slope = friction.slope(pressure)
        limit = friction.limit(pressure) - slope * pressure + slope * smooth
        rows = sticking.copy()
        right[n + 1 :] = stick_displacement
        at = np.flatnonzero(sliding)
        rows[at] = 0.0
        rows[at, n + at] = own[at]
        rows[at, at + 1] = -own[at] * sliding[at] * slope[at]
        right[n + 1 + at] = own[at] * sliding[at] * limit[at]
        matrix[n + 1 :] = rows
        *_, found, failed = lapack.dgesv(matrix, right)
        if failed:
            break
        most = limit + slope * found[1:n]
        pressure = np.maximum(smooth + found[1:n], 0.0)
        slip = sticking @ found - stick_displacement
        trial_shear = found[n:-1] - slip / own
        # A node at the limit, as under a constant load, keeps its state.
        least = most + np.where(sliding == 0, TIE, -TIE) * np.max(most)
        wrong = np.where(np.abs(trial_shear) < least, 0, np.where(trial_shear > 0, 1, -1)).astype(
            np.int64
        )
        contradicting = float(np.mean(wrong != sliding))
        if contradicting == 0:
            bent = np.abs(friction.limit(pressure) - np.maximum(most, 0.0))
            contradicting = float(np.max(bent) / np.max(most))
            if contradicting <= EXACT:
                return found, sliding
            continue
        first = float(np.min(places[wrong != sliding]))
        if step >= ALL_AT_ONCE:
            by = np.where(wrong != sliding, np.abs(np.abs(trial_shear) - most) / np.abs(most), -1.0)
            one = int(np.argmax(by))
            wrong = np.where(np.arange(n - 1) == one, wrong, sliding)
        sliding = wrong
    problem = "the stick zone (residual: fraction of rings in contradiction with their tractions"
    if first > AT_EDGE:
        problem += (
            f"; with a coefficient of friction of {friction.largest:g} only the last "
            f"{1 - first:.1g} of the radius slips, which the rings do not resolve: use a smaller "
            "coefficient"
        )
    raise NotConverged(f"{problem})", step + 1, contradicting, 0.0)
