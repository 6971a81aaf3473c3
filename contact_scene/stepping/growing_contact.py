"""Contact whose normal load grows while a tangential load grows with it.

The pressure of a contact that grows from A₀ to A₁ is a sum of pressures of flat punches on the
areas between A₀ and A₁. Let k be the ratio ΔT/ΔW of the changes of the loads. On a circle and on an
ellipse the shear k Δp of such a punch moves its area by a uniform shift, so that nothing slips:

    q = q₀ + k Δp,    Δω = k ρ Δδ,    ρ = Δ½∫ p u_t dA / Δ½∫ p u_z dA        (|k| ≤ µ)

with u_t the displacement by the shear p and δ the approach (Jaeger 1998, Ciavarella 1998; Mindlin
and Deresiewicz 1953 for balls). The shear stays below the friction limit: |q₀ + k Δp| ≤ µp₀ + µΔp.
A particle that comes into contact meanwhile sticks where it is at its first contact. Until then it
has moved by the free motion k u_t(Δp) - Δω relative to the indenter.
"""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Vector
from contact_scene.body_pair import UNCOUPLED, contact_modulus, dundurs_beta
from contact_scene.friction_limit import reaches_limit
from contact_scene.geometry import Cone, FlatPunch, SmoothTip
from contact_scene.rig import compliances
from contact_scene.scene import Scene
from contact_scene.stepping.load_path import ControlKind, LoadRamp


class GrowingContact(NamedTuple):
    """Growth of a contact in an increment, from which the growth of its shear follows.

    Sums run over n points. A rigid motion is one direction of the tangential shift.

    pressure  p₀ + p₁ times the area of each point, p at the start and the end (n,) [force]
    normal    normal displacement of the bodies by the change Δp of the pressure (n,) [length]
    along     tangential displacements of the bodies by the shears Δp in the m directions
              (m, c, n), with c components [length]
    unit      displacements by unit shifts in these directions (m, c, n)
    approach  change of the approach, without springs of a test rig [length]
    load      change of the normal force [force]
    limit     change of the friction limit of the whole contact [force]
    spring    tangential compliance of the test rig [length/force]
    """

    pressure: Vector
    normal: Vector
    along: Field
    unit: Field
    approach: float
    load: float
    limit: float
    spring: float = 0.0

    def ratio(self, change: Vector, *, by_force: bool) -> tuple[Vector, Vector]:
        """Compute the ratio k of the growth of shear and pressure, and the shift of the bodies.

        The ratio is at most that of the growth of the friction limit. The results have the shape
        (m,).

        change    change of the tangential force [force] or, with the spring of a test rig, of the
                  tangential shift [length]
        by_force  True for a force
        """
        moved = np.einsum("n,icn,jcn->ij", self.pressure, self.unit, self.along)
        moved *= self.approach / (self.pressure @ self.normal)
        if by_force:
            k = change / self.load
        else:
            k = np.linalg.solve(moved + self.spring * self.load * np.eye(len(moved)), change)
        most = self.limit / self.load
        size = float(np.hypot.reduce(k))
        k = k * min(1.0, most / size) if size > 0 else k
        return k, moved @ k


def grows_without_slip(scene: Scene, ramp: LoadRamp) -> bool:
    """Determine if the normal load grows in a load step so that nothing slips: proved cases.

    The bodies are uncoupled and have no layers. k is constant and below µ: both loads are
    prescribed as forces or, without springs of a test rig, both as displacements. The contact is a
    circle, an ellipse or a strip, or Poisson's ratio is 0. One increment is then exact.

    scene  bodies and friction
    ramp   load ramp of the load step
    """
    normal, tangential, friction = ramp.normal, ramp.tangential, scene.friction
    beta = dundurs_beta(scene)
    if friction is None or beta is None or abs(beta) > UNCOUPLED or ramp.strains:
        return False
    if normal.start is None or tangential.start is None or normal.start >= normal.end:
        return False
    if ramp.twisting.start != ramp.twisting.end or ramp.tilting.start != ramp.tilting.end:
        return False
    # A tilt moves the contact off the axis of the indenter.
    known = scene.indenter.is_line or isinstance(scene.indenter, SmoothTip | Cone | FlatPunch)
    simple = known and not any(ramp.tilting.end)
    materials = [*scene.body.elastic_materials, *scene.indenter.elastic_materials]
    if not simple and any(one.poisson_ratio for one in materials):
        return False
    growth = hypot(*np.subtract(tangential.end, tangential.start)) / (normal.end - normal.start)
    if normal.kind is tangential.kind is ControlKind.DISPLACEMENT:
        if any(compliances(scene.rig)):
            return False
        if scene.indenter.is_of_revolution:
            rho = sum((2 - one.poisson_ratio) / one.shear_modulus for one in materials)
            growth /= contact_modulus(scene) * rho / 4
        # On an ellipse ρ is between 1 and 1/(1-ν) of the bodies: k is not larger than Δω/Δδ.
    elif normal.kind is not tangential.kind:
        return False
    return not reaches_limit(growth, friction.smallest)
