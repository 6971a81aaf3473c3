"""Contact and friction as one equation, and its generalised derivative.

With γ the inverse self-compliance of a cell, the increment is solved where

    p = max(0, p - γ g)        q = P_b(z),  z = q + γ (ω + c - u_t),  b = µp

with P_b the projection on the disc of radius b (Alart and Curnier 1991). Both maps have kinks; at a
point beside them they have a derivative, that of the zones of contact, stick and slip in which the
point lies (semismooth Newton: Christensen, Klarbring, Pang and Strömberg 1998). It leaves free

    p where there is contact, q where it sticks, s where it slips: q = µp n + s t

n along z and t across it, and asks for as many displacements:

    u_z - δ = -h        u_t - ω = c        t·(u_t - ω - c) + d s = 0,  d = (|z| - b) / (γ b)

µp n is what makes the derivative unsymmetric, by about µ|β|.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.admissible_shear import Vector, VectorField, magnitude
from semi_analytical.coupled_problem import CoupledProblem

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Tractions = NDArray[np.float64]

# Of the self-compliance: a cell that is held back more does not turn.
STIFFEST = 1e6


@dataclass(frozen=True)
class Point:
    """Tractions t and displacements u (3, nx, ny), by how much the indenter closes the gap, and a
    guess of its motion along the surface."""

    tractions: Tractions
    displacements: Field
    closure: float | Field
    motion: Vector


@dataclass(frozen=True)
class Natural:
    """The natural map at a point.

    gap      g (nx, ny)
    bound    friction limit (nx, ny) of the pressure, cut off at zero
    z        q + γ (ω + c - u_t), shape (2, nx, ny), and its length (nx, ny)
    motion   ω, by the exact projection on the shears that carry the load
    contact  where p > γ g
    slip     where |z| exceeds the bound, in contact
    slipped  ω + c - u_t (2, nx, ny): slip, of the indenter relative to the body
    pressed, sheared  how far p and q are from what the map makes of them, in parts of Σp and Σb
    """

    gap: Field
    bound: Field
    z: VectorField
    length: Field
    motion: Vector
    contact: Mask
    slip: Mask
    slipped: VectorField
    pressed: float
    sheared: float

    @classmethod
    def at(cls, point: Point, problem: CoupledProblem) -> "Natural":
        """Evaluate the map; the load must not exhaust the friction."""
        gamma = 1 / problem.self_compliance
        q, p = point.tractions[:2], point.tractions[2]
        gap = problem.gap + point.displacements[2] - point.closure
        pushed = p - gamma * gap
        contact = pushed > 0
        bound = problem.friction_limit(np.maximum(p, 0.0))
        slipped = problem.target - point.displacements[:2]
        load = problem.tangential_load
        projected, motion = load.nearest(q + gamma * slipped, bound, gamma, point.motion)
        slipped += load.rigid(motion)
        z = q + gamma * slipped
        length = magnitude(z)
        missing = np.sum(np.abs(p - np.where(contact, pushed, 0.0)))
        return cls(
            gap=gap,
            bound=bound,
            z=z,
            length=length,
            motion=motion,
            contact=contact,
            slip=contact & (length > bound),
            slipped=slipped,
            pressed=float(missing / np.sum(np.abs(p))),
            sheared=float(np.sum(magnitude(q - projected)) / np.sum(bound)),
        )

    @property
    def merit(self) -> float:
        """Distance from a solution [1]."""
        return self.pressed + self.sheared


@dataclass(frozen=True)
class Zones:
    """Contact, stick and slip, 1 in the zone and 0 elsewhere (nx, ny); across and along slip.

    tangent   t where it slips, zero elsewhere (2, nx, ny)
    pulled    µ n where it slips, zero elsewhere (2, nx, ny)
    turning   d where it slips, zero elsewhere (nx, ny) [length^3/force]
    """

    contact: Field
    stick: Field
    tangent: VectorField
    pulled: VectorField
    turning: Field

    @classmethod
    def of(cls, natural: Natural, problem: CoupledProblem) -> "Zones":
        """The zones in which a point lies."""
        contact, slip = natural.contact.astype(np.float64), natural.slip
        normal = np.where(slip, natural.z / np.where(slip, natural.length, 1.0), 0.0)
        excess = np.where(slip, natural.length - natural.bound, 0.0)
        least = excess / STIFFEST
        turning = excess / np.where(slip, np.maximum(natural.bound, least), 1.0)
        return cls(
            contact=contact,
            stick=contact * ~slip,
            tangent=np.stack([-normal[1], normal[0]]),
            pulled=problem.friction_limit(contact) * normal,
            turning=problem.self_compliance * turning,
        )

    def along(self, v: Field) -> Field:
        """The component t·v of a field (2, nx, ny) or (3, nx, ny)."""
        return np.asarray(v[0] * self.tangent[0] + v[1] * self.tangent[1])

    def free(self, v: Field) -> Field:
        """The free part of a field (3, nx, ny)."""
        part = np.empty_like(v)
        np.multiply(v[:2], self.stick, out=part[:2])
        part[:2] += self.tangent * self.along(v)
        np.multiply(v[2], self.contact, out=part[2])
        return part

    def tractions(self, free: Field) -> Tractions:
        """The tractions of free unknowns: where it slips, friction follows the pressure."""
        t = free.copy()
        t[:2] += self.pulled * free[2]
        return t

    def rows(self, free: Field, displacements: Field) -> Field:
        """What the derivative makes of free unknowns whose tractions cause displacements."""
        rows = self.free(displacements)
        rows[:2] += self.tangent * (self.turning * self.along(free))
        return rows

    def changes(self, other: "Zones | None") -> int:
        """Cells that are in another zone than before; all if there is no before."""
        if other is None:
            return self.contact.size
        stays = (self.contact == other.contact) & (self.stick == other.stick)
        return int(stays.size - np.count_nonzero(stays))
