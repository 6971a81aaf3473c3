"""Pressure and radial shear on a disc under Coulomb's law, at a given radius of the contact.

To the pressure of the contact without friction, which is exact, comes what shear changes: Δp on
rings, with the gap closed at every node and the pressure zero at the edge. A node sticks, u_r as
it was, or slips, q = ∓b(p) with the friction limit b; which of them is found by Newton's method for
|q - γ Δu_r| < b (Alart and Curnier 1991).
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
    Response,
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

MAX_STEPS = 200  # a few per ring: what all but sticks changes one ring at a time
TIE = 1e-9  # of the largest limit
EXACT = 1e-12  # of the largest limit: by so much a limit linear in Δp may miss that of the law
AT_EDGE = 0.95  # of the radius: where rings are all that slips beyond, there is next to no slip
ALL_AT_ONCE = 8  # steps of Newton's method; then the node that is most in the wrong changes alone


@dataclass(frozen=True)
class Rubbed:
    """A contact with friction. Fields are (n + 1,) at the nodes of the rings but where it says so.

    contact   the one of the same radius without friction
    changed   Δp [force/length²]
    shear     q, outward on the lower body [force/length²]
    deeper    approach less that of `contact` [length]
    raised    u_z by Δp and q, at the rows [length]
    moved     u_r, at the rows [length]
    slipped   Δu_r since the state before [length]
    sliding   0 where a node sticks, else the sign of q
    missed    of the equations of the gap, over the approach [1]
    """

    contact: Disc
    rings: Rings
    changed: Array
    shear: Array
    deeper: float
    raised: Array
    moved: Array
    slipped: Array
    sliding: Signs
    missed: float

    @property
    def radius(self) -> float:
        """a [length]."""
        return self.contact.radius

    @property
    def approach(self) -> float:
        """δ since first touch [length]."""
        return self.contact.approach + self.deeper

    @property
    def load(self) -> float:
        """W [force]."""
        return self.contact.load + self.over(self.changed)

    @cached_property
    def pressure(self) -> Array:
        """p; infinite on an apex [force/length²]."""
        return pressure(self.contact, self.rings.x) + self.changed

    def over(self, field: Array) -> float:
        """∫ f dA of a field that is linear between the nodes."""
        return float(2 * pi * self.radius**2 * (self.rings.weights @ field))

    def elastic_energy(self, gap: Array) -> float:
        """½ ∫ (p u_z + q u_r) dA, with u_z = δ - f within the contact [force length].

        gap  f at the nodes [length]
        """
        by_change = self.over(self.changed * (self.approach - gap))
        by_shear = self.over(self.shear * self.moved[: len(self.shear)])
        whole = self.contact.elastic_energy
        return whole + 0.5 * (self.deeper * self.contact.load + by_change + by_shear)


def rubbed(
    coupling: Coupling,
    indenter: ShapedBody,
    radius: float,
    rings: Rings,
    friction: CoulombFriction,
    before: Array,
    guess: Signs,
    fineness: int = 1,
) -> Rubbed:
    """The contact of this radius [length].

    before    u_r of the state before, at the rows [length]
    guess     of `limit_load`
    raises    NotConverged where no set of sticking nodes is found, and what `disc` raises
    """
    contact = disc(coupling.bodies, indenter, radius, fineness=fineness)
    answer = coupling.response(rings, radius, fineness)
    drawn = coupling.drawn(contact, rings, fineness)
    smooth = pressure(contact, rings.x)
    found, sliding = _newton(
        answer, rings.count, friction, smooth[1:-1], (before - drawn)[1 : rings.count],
        guess[1:-1], rings.x[1:-1],
    )  # fmt: skip
    n = rings.count
    p, q, deeper = found[:n], found[n:-1], float(found[-1])
    raised = answer.zz @ p + answer.zr @ q
    moved = drawn + answer.rz @ p + answer.rr @ q
    depth = contact.approach + deeper
    return Rubbed(
        contact,
        rings,
        np.append(p, 0.0),
        np.concatenate([[0.0], q, [0.0]]),
        deeper,
        raised,
        moved,
        (moved - before)[: n + 1],
        np.concatenate([[0], sliding, [sliding[-1]]]),
        float(np.max(np.abs(raised[: n + 1] - deeper))) / depth,
    )


def _newton(
    answer: Response, n: int, friction: CoulombFriction, smooth: Array, stuck: Array, guess: Signs,
    places: Array,
) -> tuple[Array, Signs]:  # fmt: skip
    """Δp, q and what the approach changes by, and which nodes slide.

    smooth  the pressure without friction, at the nodes between axis and edge
    stuck   u_r by Δp and q of what sticks, there
    """
    own = np.abs(np.diag(answer.rr[1:n]))
    size = 2 * n
    matrix, right = np.zeros((size, size)), np.zeros(size)
    matrix[: n + 1] = np.column_stack([answer.zz[: n + 1], answer.zr[: n + 1], -np.ones(n + 1)])
    sticking = np.column_stack([answer.rz[1:n], answer.rr[1:n], np.zeros(n - 1)])
    sliding, contradicting, first, pressure = guess, 1.0, 0.0, smooth
    for step in range(MAX_STEPS):
        slope = friction.slope(pressure)
        limit = friction.limit(pressure) - slope * pressure + slope * smooth
        rows = sticking.copy()
        right[n + 1 :] = stuck
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
        slip = sticking @ found - stuck
        tried = found[n:-1] - slip / own
        # Who rests at the limit, as under a held load, stays what it is.
        least = most + np.where(sliding == 0, TIE, -TIE) * np.max(most)
        wrong = np.where(np.abs(tried) < least, 0, np.where(tried > 0, 1, -1)).astype(np.int64)
        contradicting = float(np.mean(wrong != sliding))
        if contradicting == 0:
            bent = np.abs(friction.limit(pressure) - np.maximum(most, 0.0))
            contradicting = float(np.max(bent) / np.max(most))
            if contradicting <= EXACT:
                return found, sliding
            continue
        first = float(np.min(places[wrong != sliding]))
        if step >= ALL_AT_ONCE:
            by = np.where(wrong != sliding, np.abs(np.abs(tried) - most) / np.abs(most), -1.0)
            one = int(np.argmax(by))
            wrong = np.where(np.arange(n - 1) == one, wrong, sliding)
        sliding = wrong
    problem = "which rings stick (residual: share of them that contradict their tractions)"
    if first > AT_EDGE:
        problem += (
            f", of which a coefficient of friction of {friction.largest:g} lets none slip but in "
            f"the last {1 - first:.1g} of the radius, narrower than they tell: give a smaller "
            "coefficient,"
        )
    raise NotConverged(problem, step + 1, contradicting, 0.0)
