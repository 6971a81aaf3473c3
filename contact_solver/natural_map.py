"""Natural map of contact and Coulomb friction, and its generalised derivative.

With γ the stiffness of a patch of points, gap g, rigid motion ω, displacement c that stick requires
and tangential displacement u_t, the increment is the root of (Alart and Curnier 1991)

    p = max(0, p - γ g)        q = P_b(z),  z = q + γ (ω + c - u_t),  b = b(p)

P_b is the projection on the disc of radius b, the friction limit. The map is piecewise smooth. Its
generalised derivative is that of the zones of contact, stick and slip at a point (semismooth Newton
method: Christensen, Klarbring, Pang and Strömberg 1998). The free unknowns are

    p in contact,  q in the stick zone,  s in the slip zone: q = b n + s t

with n along z and t normal to z. With the approach δ and the undeformed gap h the equations are

    u_z - δ = -h        u_t - ω = c        t·(u_t - ω - c) + d s = 0,  d = (|z| - b) / (γ b)

The term b n changes with the pressure by µ n, µ = db/dp. This makes the derivative unsymmetric, by
about µ|β|, with β Dundurs' parameter.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_solver.admissible_shear import magnitude, natural_shear
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.zones import Zones, zones_at

Tractions = NDArray[np.float64]


@dataclass(frozen=True)
class NewtonPoint:
    """Iterate of Newton's method for a coupled increment: tractions, displacements, rigid motion.

    tractions      shear and pressure (q_x, q_y, p), shape (3, n) [force/length^2]
    displacements  surface displacements (u_x, u_y, u_z) by these tractions (3, n) [length]
    closure        reduction of the gap by the rigid normal motion of the indenter [length]
    motion         initial guess of the rigid tangential motion: shift, and twist under a torque
    """

    tractions: Tractions
    displacements: Field
    closure: Field
    motion: Vector


@dataclass(frozen=True)
class Natural:
    """Contact and friction conditions at an iterate of Newton's method, written as a natural map.

    Fields are (n,), vectors (2, n). The iterate is a solution if p = max(0, p - γ g) and q
    = P_b(z). P_b is the projection of a vector on the disc of radius b, and γ a stiffness
    [force/length^3].

    pressure        p [force/length^2]
    gap             g [length]
    bound           friction limit b of max(0, p)
    z, length       z = q + γ (ω + c - u_t) and its magnitude, with the shear q, the displacement c
                    that stick requires and the tangential displacement u_t
    motion          rigid tangential motion ω, for which the projected shear carries the load
    contact         points with p > γ g
    slip            points in contact with |z| > b
    slipped         ω + c - u_t: slip of the indenter relative to the body [length]
    pressure_error  Σ|p - max(0, p - γ g)| / Σ|p|
    shear_error     Σ|q - P(z)| / Σb, with P the projection that also has the prescribed forces
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
    pressure_error: float
    shear_error: float

    @classmethod
    def evaluate(cls, point: NewtonPoint, problem: CoupledProblem) -> "Natural":
        """Evaluate the contact and friction conditions at an iterate, written as a natural map.

        The tangential load must be below the friction limit.

        point    tractions, displacements and rigid motion of the iterate
        problem  operators, loads and friction law of the increment
        """
        gamma = problem.gamma
        q, p = point.tractions[:2], point.tractions[2]
        gap = problem.gap + point.displacements[2] - point.closure
        argument = p - gamma * gap
        contact = argument > 0
        bound = problem.friction_limit(np.maximum(p, 0.0))
        apart = problem.target - point.displacements[:2]
        shear = natural_shear(problem.shifting, q, apart, bound, gamma, point.motion)
        length = magnitude(shear.z)
        error = np.sum(np.abs(p - np.where(contact, argument, 0.0)))
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
            pressure_error=float(error / np.sum(np.abs(p))),
            shear_error=shear.error,
        )

    @property
    def merit(self) -> float:
        """Merit of the iterate: sum of the relative errors of pressure and shear [1].

        The errors are those of the contact and friction conditions. The line search of Newton's
        method accepts steps that reduce the merit.
        """
        return self.pressure_error + self.shear_error


def zones_of(natural: Natural, problem: CoupledProblem) -> Zones:
    """Determine the zones of contact, stick and slip of an iterate of Newton's method.

    natural  contact and friction conditions at the iterate (natural map)
    problem  operators, loads and friction law of the increment
    """
    zones = zones_at(
        natural.contact, natural.z, natural.bound, problem.gamma, problem.self_compliance
    )
    slope = problem.friction_slope(np.maximum(natural.pressure, 0.0))
    return replace(zones, friction_slope=slope[zones.slip] * zones.normal)
