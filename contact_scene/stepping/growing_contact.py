"""Contact whose normal load grows while a tangential load grows with it.

The pressure of a contact that grows from A₀ to A₁ is a sum of pressures of flat punches on the
areas between A₀ and A₁. Let k be the ratio ΔT/ΔW of the changes of the loads. On a circle and on an
ellipse the shear k Δp of such a punch moves its area by a uniform shift, so that nothing slips:

    q = q₀ + k Δp,    Δω = k ρ Δδ,    ρ = Δ½∫ p u_t dA / Δ½∫ p u_z dA        (|k| ≤ µ)

with u_t the displacement by the shear p and δ the approach (Jaeger 1998, Ciavarella 1998; Mindlin
and Deresiewicz 1953 for balls). The shear stays below the friction limit: |q₀ + k Δp| ≤ µp₀ + µΔp.
A particle that comes into contact meanwhile sticks where it is at its first contact. Until then it
has moved by the free motion k u_t(Δp) - Δω relative to the indenter.

On layers, and on other shapes, m = k u_t(Δp) - Δω is not zero within the earlier contact A₀, where
the surfaces stick. A smooth change of the shear cancels m there, and moves points ahead of A₀ as it
moves the edge of A₀, up to second order in the increment. The free motion is therefore m minus its
value at the nearest point of A₀. Without this difference it has an error of first order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import hypot
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.body_pair import UNCOUPLED, contact_modulus, dundurs_beta
from contact_scene.friction_limit import reaches_limit
from contact_scene.geometry import Cone, FlatPunch, SmoothTip
from contact_scene.rig import compliances
from contact_scene.scene import Scene
from contact_scene.stepping.load_path import ControlKind, LoadRamp


class Growth(NamedTuple):
    """Shear of a contact that grows without slip in an increment, at n points.

    The tangential load changes in m directions. Vectors at points have c components.

    shear  change of the shear (c, n) [force/length^2]
    moved  tangential displacement of the points by this change (c, n) [length]
    shift  shift of the indenter in each direction (m,) [length]
    free   free motion of each point until its contact (c, n) [length]; 0 at points that were in
           contact before
    """

    shear: Field
    moved: Field
    shift: Vector
    free: Field


@dataclass(frozen=True)
class GrowingContact:
    """Contact that grows in an increment, at n points.

    areas       areas of the points (n,) [length^2], or the area of each
    start, end  pressure at the start and at the end of the increment (n,) [force/length^2]
    apart       points with a gap between the undeformed surfaces at first contact (n,)
    approach    change of the approach [length]
    springs     compliances of the test rig, normal and tangential [length/force]; displacements of
                points contain the springs
    at_nearest  map from a field (c, n) and a mask of points (n,) to a field (c, n) with the values
                at the nearest points of the mask
    """

    areas: Vector | float
    start: Vector
    end: Vector
    apart: Mask
    approach: float
    springs: tuple[float, float]
    at_nearest: Callable[[Field, Mask], Field]

    def without_slip(
        self,
        change: Vector,
        unit: Field,
        tangential: Callable[[Field], Field],
        normal: Callable[[Vector], Vector],
        limit: Callable[[Vector], Vector],
        *,
        by_force: bool,
    ) -> Growth | None:
        """Compute the shear that grows with the pressure so that nothing slips.

        The ratio k is at most that of the growth of the friction limit. None is returned if no
        point comes into contact, or if the tangential load does not change.

        change      change of the tangential force [force] or shift [length] in each direction (m,)
        unit        displacements of the points by unit shifts in these directions (m, c, n)
        tangential  map from a shear to its tangential displacement, both (c, n)
        normal      map from a pressure to its normal displacement, both (n,)
        limit       map from a pressure to the friction limit, both (n,)
        by_force    True for a force
        """
        begins, grown = (self.start == 0) & self.apart, self.end - self.start
        load = float(np.sum(self.areas * grown))
        closes = min(load, self.approach) > 0 and np.any(begins & (self.end > 0))
        if not (closes and np.any(change)):
            return None
        down, spring = self.springs
        moved = np.array([tangential(one * grown) for one in unit])
        along = moved - spring * load * unit
        pressure = self.areas * (self.start + self.end)
        rho = np.einsum("n,icn,jcn->ij", pressure, unit, along)
        rho *= (self.approach - down * load) / (pressure @ (normal(grown) - down * load))
        if by_force:
            k = change / load
        else:
            k = np.linalg.solve(rho + spring * load * np.eye(len(rho)), change)
        most = float(np.sum(self.areas * (limit(self.end) - limit(self.start)))) / load
        k = k * min(1.0, most / float(np.hypot.reduce(k)))
        own = rho @ k
        free = np.tensordot(k, along, 1) - np.tensordot(own, unit, 1)
        if np.any(self.start):
            free = free - self.at_nearest(free, self.start > 0)
        free = np.where(begins, free, 0.0)
        shear = np.tensordot(k, unit, 1) * grown
        return Growth(shear, np.tensordot(k, moved, 1), own + spring * load * k, free)


def at_nearest_ring(radii: Vector, values: Field, known: Mask) -> Field:
    """Return the values of a field at the nearest ring of a mask, along each ray.

    radii   radii of the rings, ascending (rings,) [length]
    values  field (c, rings, angles)
    known   mask of the points whose values are taken (rings, angles); 0 on rays without such points
    """
    found = np.zeros_like(values)
    for angle, on_ray in enumerate(known.T):
        rings = np.flatnonzero(on_ray)
        if len(rings):
            middles = 0.5 * (radii[rings[1:]] + radii[rings[:-1]])
            found[:, :, angle] = values[:, rings[np.searchsorted(middles, radii)], angle]
    return found


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
