"""Contact and friction as one equation, and its generalised derivative.

With γ the inverse compliance of a patch of cells, the increment is solved where

    p = max(0, p - γ g)        q = P_b(z),  z = q + γ (ω + c - u_t),  b = b(p)

with P_b the projection on the disc of radius b (Alart and Curnier 1991). Both maps have kinks; at a
point beside them they have a derivative, that of the zones of contact, stick and slip in which the
point lies (semismooth Newton: Christensen, Klarbring, Pang and Strömberg 1998). It leaves free

    p where there is contact, q where it sticks, s where it slips: q = b n + s t

n along z and t across it, and asks for as many displacements:

    u_z - δ = -h        u_t - ω = c        t·(u_t - ω - c) + d s = 0,  d = (|z| - b) / (γ b)

b n, which changes with the pressure by µ n with µ = db/dp, is what makes the derivative
unsymmetric, by about µ|β|.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Indices, Mask, Vector, VectorField
from semi_analytical.coupled.coupled_problem import CoupledProblem
from semi_analytical.tangential.admissible_shear import (
    magnitude,
    natural_shear,
)

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

    pressure p (nx, ny)
    gap      g (nx, ny)
    bound    friction limit (nx, ny) of the pressure, cut off at zero
    z        q + γ (ω + c - u_t), shape (2, nx, ny), and its length (nx, ny)
    motion   ω, by the exact projection on the shears that carry the load
    contact  where p > γ g
    slip     where |z| exceeds the bound, in contact
    slipped  ω + c - u_t (2, nx, ny): slip, of the indenter relative to the body
    pressed, sheared  how far p and q are from what the map makes of them, in parts of Σp and Σb
    """

    pressure: Field
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
        gamma = problem.gamma
        q, p = point.tractions[:2], point.tractions[2]
        gap = problem.gap + point.displacements[2] - point.closure
        pushed = p - gamma * gap
        contact = pushed > 0
        bound = problem.friction_limit(np.maximum(p, 0.0))
        apart = problem.target - point.displacements[:2]
        shear = natural_shear(problem.tangential_load, q, apart, bound, gamma, point.motion)
        length = magnitude(shear.z)
        missing = np.sum(np.abs(p - np.where(contact, pushed, 0.0)))
        return cls(
            pressure=p,
            gap=gap,
            bound=bound,
            z=shear.z,
            length=length,
            motion=shear.motion,
            contact=contact,
            slip=contact & (length > bound),
            slipped=shear.slipped,
            pressed=float(missing / np.sum(np.abs(p))),
            sheared=shear.error,
        )

    @property
    def merit(self) -> float:
        """Distance from a solution [1]."""
        return self.pressed + self.sheared


@dataclass(frozen=True)
class Zones:
    """Contact, stick and slip. Free unknowns, and what the derivative makes of them, are vectors:
    q_x, then q_y where it sticks, s where it slips, p where there is contact.

    contact, stick  (nx, ny)
    slip     where it slips, flat indices (cells,)
    tangent  t there (2, cells)
    pulled   µ n there (2, cells)
    turning  d there (cells,) [length^3/force]
    """

    contact: Mask
    stick: Mask
    slip: Indices
    tangent: Field
    pulled: Field
    turning: Vector

    @classmethod
    def of(cls, natural: Natural, problem: CoupledProblem) -> "Zones":
        """The zones in which a point lies."""
        slip = np.flatnonzero(natural.slip)
        length, bound = natural.length.ravel()[slip], natural.bound.ravel()[slip]
        normal = natural.z.reshape(2, -1)[:, slip] / length
        excess = length - bound
        slope = problem.friction_slope(np.maximum(natural.pressure, 0.0))
        stiffest = STIFFEST * problem.self_compliance
        return cls(
            contact=natural.contact,
            stick=natural.contact & ~natural.slip,
            slip=slip,
            tangent=np.stack([-normal[1], normal[0]]),
            pulled=slope.ravel()[slip] * normal,
            turning=excess / np.maximum(problem.gamma * bound, excess / stiffest),
        )

    @cached_property
    def _stuck(self) -> Indices:
        return np.flatnonzero(self.stick)

    @cached_property
    def _pressed(self) -> Indices:
        return np.flatnonzero(self.contact)

    @cached_property
    def _apart(self) -> Indices:
        return np.flatnonzero(~self.contact)

    @property
    def size(self) -> int:
        """Number of free unknowns."""
        return 2 * len(self._stuck) + len(self.slip) + len(self._pressed)

    def parts(self, vector: Vector) -> tuple[Vector, Vector, Vector]:
        """Of a vector: (2, cells) where it sticks, (cells,) where it slips, (cells,) in contact."""
        stuck, slip = 2 * len(self._stuck), len(self.slip)
        return vector[:stuck].reshape(2, -1), vector[stuck : stuck + slip], vector[stuck + slip :]

    def free(self, v: NDArray[Any]) -> Vector:
        """The free part of a field (3, nx, ny)."""
        # Component by component: indices behind a slice are many times slower.
        x, y, z = v.reshape(3, -1)
        free = np.empty(self.size)
        (stuck_x, stuck_y), along, pressed = self.parts(free)
        stuck_x[:], stuck_y[:], pressed[:] = x[self._stuck], y[self._stuck], z[self._pressed]
        along[:] = self.tangent[0] * x[self.slip] + self.tangent[1] * y[self.slip]
        return free

    def field(self, vector: Vector) -> Field:
        """The field (3, nx, ny) that has this free part, and nothing else."""
        v = np.zeros((3, self.contact.size))
        stuck, along, pressed = self.parts(vector)
        for one, sticks, tangent in zip(v[:2], stuck, self.tangent, strict=True):
            one[self._stuck], one[self.slip] = sticks, tangent * along
        v[2][self._pressed] = pressed
        return v.reshape(3, *self.contact.shape)

    def rest(self, v: Field) -> Vector:
        """What is not free of a field (3, nx, ny): where it slips along n, and all without
        contact."""
        v = v.reshape(3, -1)
        across = self.tangent[1] * v[0][self.slip] - self.tangent[0] * v[1][self.slip]
        return np.concatenate([across, *(one[self._apart] for one in v)])

    def whole(self, free: Vector, rest: Vector) -> Field:
        """The field (3, nx, ny) of these two parts."""
        v = self.field(free).reshape(3, -1)
        across, apart = rest[: len(self.slip)], rest[len(self.slip) :]
        v[0][self.slip] += self.tangent[1] * across
        v[1][self.slip] -= self.tangent[0] * across
        for one, left in zip(v, apart.reshape(3, -1), strict=True):
            one[self._apart] = left
        return v.reshape(3, *self.contact.shape)

    def tractions(self, free: Vector) -> Tractions:
        """The tractions of changes of free unknowns: where it slips, friction follows the
        pressure."""
        t = self.field(free).reshape(3, -1)
        pressure = t[2][self.slip]
        for one, pulled in zip(t[:2], self.pulled, strict=True):
            one[self.slip] += pulled * pressure
        return t.reshape(3, *self.contact.shape)

    def nearest(self, tractions: Tractions, bound: Field) -> Tractions:
        """The tractions of these zones near given ones: where it slips, the shear along n is the
        friction limit."""
        t = self.field(self.free(tractions)).reshape(3, -1)
        most = bound.ravel()[self.slip]
        t[0][self.slip] += self.tangent[1] * most
        t[1][self.slip] -= self.tangent[0] * most
        return t.reshape(3, *self.contact.shape)

    def held(self, free: Vector) -> Vector:
        """d s where it slips, nothing elsewhere: what the derivative adds to displacements."""
        rows = np.zeros_like(free)
        self.parts(rows)[1][:] = self.turning * self.parts(free)[1]
        return rows

    def changes(self, other: "Zones | None") -> int:
        """Cells that are in another zone than before; all if there is no before."""
        if other is None:
            return self.contact.size
        stays = (self.contact == other.contact) & (self.stick == other.stick)
        return int(stays.size - np.count_nonzero(stays))
