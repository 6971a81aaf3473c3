"""Data of the coupled problem of pressure and shear of one increment."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_solver.conjugate_gradients import Map
from contact_solver.gross_slip import exhausts_friction
from contact_solver.pressure import PressureProblem
from contact_solver.rigid_motion import RigidMotions
from contact_solver.shear import ShearProblem
from contact_solver.zones import Zones


class Preconditioner(Protocol):
    """Interface of an inverse of the derivative of a coupled problem.

    exact  True if `in_zones` is the inverse up to round-off; False for a preconditioner
    """

    @property
    def exact(self) -> bool: ...

    def in_zones(self, zones: Zones) -> Map:
        """Return the approximate inverse in zones of contact, stick and slip.

        It is a map from rows of the linear system to free unknowns, see `Zones`, both (k, size).

        zones  zones of an iterate
        """

    def with_compliance(self, compliance: float) -> "Preconditioner":
        """Return the approximate inverse for surfaces with an additional compliance of each point.

        The proximal-point method adds this compliance.

        compliance  additional displacement of a point by its own unit traction [length^3/force]
        """


@dataclass(frozen=True)
class CoupledProblem:
    """Compliance, loads and friction law of one increment, with pressure and shear unknown.

    p is the pressure (n,), q the shear (2, n), u_z the normal and u_t the tangential surface
    displacement.

    normal, tangential     maps p -> u_z and q -> u_t
    normal_by_shear        map q -> u_z
    shear_by_pressure      map p -> u_t
    inverse_on             see `PressureProblem.inverse_on`
    inverse_in             see `ShearProblem.inverse_in`
    together               map (q_x, q_y, p) -> (u_x, u_y, u_z)
    inverse                approximate inverse of the derivative
    gap                    undeformed gap (n,) [length], infinite outside the indenter
    friction_limit         map from pressure (n,) to the largest shear (n,)
    friction_slope         map from pressure (n,) to the derivative of the largest shear (n,)
    target                 displacement that stick requires: c = u_t - rigid motion of the previous
                           state (2, n) [length]
    closing, shifting      rigid motions that reduce the gap, and tangential rigid motions
    self_compliance        tangential displacement of a point by its own unit shear
                           [length^3/force]
    patch                  compliance of a point over that of a patch of points, see `gamma`
    images                 number of mirror images of a point, 1 without symmetry
    """

    normal: Map
    tangential: Map
    normal_by_shear: Map
    shear_by_pressure: Map
    inverse_on: Callable[[Mask], Map]
    inverse_in: Callable[[Zones], Map]
    together: Map
    inverse: Preconditioner
    gap: Vector
    friction_limit: Callable[[Vector], Vector]
    friction_slope: Callable[[Vector], Vector]
    target: VectorField
    closing: RigidMotions
    shifting: RigidMotions
    self_compliance: float
    patch: float = 1.0
    images: int = 1

    @property
    def gamma(self) -> float:
        """Stiffness γ that multiplies gap and slip in the natural map [force/length^3].

        γ is the stiffness of a patch of points. The solution does not depend on γ > 0. An inexact
        linear solve leaves a smooth gap error of the width of the contact. With the stiffness of a
        single small cell, γ times this error would open many loaded points.
        """
        return 1 / (self.self_compliance * self.patch)

    @cached_property
    def pressing(self) -> PressureProblem:
        """Problem of the pressure without shear."""
        return PressureProblem(self.normal, self.inverse_on, self.gap, self.closing)

    def loaded(self, p: Vector) -> Vector:
        """Return a pressure (n,) near a given one that carries the prescribed normal loads.

        p  pressure (n,), of which values outside the indenter are ignored
        """
        return self.pressing.admissible(np.where(self.pressing.allowed, p, 0.0))

    def pressing_at(self, q: VectorField) -> PressureProblem:
        """Return the problem of the pressure at a given shear.

        q  shear (2, n) [force/length^2]
        """
        return replace(self.pressing, gap=self.gap + self.normal_by_shear(q))

    def shearing_at(self, p: Vector) -> ShearProblem:
        """Return the problem of the shear at a given pressure.

        p  pressure (n,) [force/length^2]
        """
        return ShearProblem(
            self.tangential,
            self.inverse_in,
            self.friction_limit(p),
            self.target - self.shear_by_pressure(p),
            self.shifting,
            self.self_compliance,
        )

    def exhausts_friction(self, bound: Vector) -> bool:
        """Return True if the prescribed tangential forces are at or above the friction limit.

        bound  friction limit (n,)
        """
        return exhausts_friction(self.shifting, bound)

    def with_compliance(self, compliance: float, tractions: Field) -> "CoupledProblem":
        """Return the coupled problem with an additional compliance, for the proximal-point method.

        Displacements become u + compliance * (t - tractions), with the tractions t. Newton's method
        solves the new problem. Of the operators only `together` and its preconditioner are changed.

        compliance  additional displacement per traction [length^3/force]
        tractions   reference tractions (q_x, q_y, p) (3, n)
        """
        q, p = tractions[:2], tractions[2]
        return replace(
            self,
            together=lambda t: self.together(t) + compliance * t,
            inverse=self.inverse.with_compliance(compliance),
            gap=self.gap - compliance * p,
            target=self.target + compliance * q,
            self_compliance=self.self_compliance + compliance,
        )


@dataclass(frozen=True)
class CoupledSolution:
    """Solution for pressure and shear of one increment.

    pressure, shear   p (n,) and q (2, n) [force/length^2]
    closing           rigid motions that close the gap (k,): approach, and tilts
    motion            tangential rigid motions (k,): shifts, and twist
    in_slip           slipping points (n,)
    at_limit          True if the load reaches the friction limit: gross slip, the motion is
                      undefined
    iterations        sum over all linear solves
    outer_iterations  iterations of the alternating iteration or of Newton's method
    algorithm         name of the method that found the solution
    """

    pressure: Vector
    shear: VectorField
    closing: Vector
    motion: Vector
    in_slip: Mask
    at_limit: bool
    iterations: int
    outer_iterations: int
    algorithm: str = "newton"
