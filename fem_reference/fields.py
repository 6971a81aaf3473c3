"""What a solve returns: fields over the radius, with the names and signs of CONVENTIONS."""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.residuals import Residuals
from contact_scene.summary import ContactStatus
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.plan import Plan

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Vector = tuple[float, float]


@dataclass(frozen=True)
class Increment:
    """The converged state at the end of one increment of the load history.

    Fields are (rings,), or (rings, angles) where `angles` is given. Pressure and shear are values
    at the rings, linear in between; gap and slip are means weighted with the ring's hat function,
    so that they vanish exactly where surfaces touch or stick. Outside the contact slip has no
    meaning and is zero.

    step, index               loading step and increment within it, both counted from 1
    increments_in_step        how many increments the step has
    radii                     of the rings [length]
    angles                    from the direction of the tangential load [radian]; None where one
                              function of the radius says all
    pressure                  p [force/length^2]
    gap                       [length]; infinite where the surfaces can never touch
    shear_radial              traction on the lower body, outward [force/length^2]
    shear_circumferential     anticlockwise seen along z
    shear_along_load          along the tangential load, the same on a whole ring
    slip_...                  since the start of the history, of the lower body's particles relative
                              to the indenter's [length]
    in_stick                  rings in contact that did not slip in this increment
    tangential_force, _shift  of the indenter, (x, y); the shift is None where undefined: without
                              friction, and at the friction limit under force control
    torque, twist             about z; None where the path has no torsion or, for the twist, at the
                              friction limit under a torque
    dissipated_energy         by slip since the start of the history [force length]
    iterations                linear systems of the contact solver
    factorizations            sparse factorisations of the finite-element model
    sweeps                    alternations between pressure and shear
    halvings                  how often the increment was cut in two to converge
    path                      which way of solving was taken, where a method has several
    overlap                   largest overlap of the surfaces that a penalty leaves [length]; None
                              without a penalty
    """

    step: int
    index: int
    increments_in_step: int
    radii: Field
    pressure: Field
    gap: Field
    normal_force: float
    approach: float
    contact_radius: float
    peak_pressure: float
    residuals: Residuals
    iterations: int
    factorizations: int = 0
    sweeps: int = 1
    halvings: int = 0
    status: ContactStatus = ContactStatus.FRICTIONLESS
    angles: Field | None = None
    shear_radial: Field | None = None
    shear_circumferential: Field | None = None
    shear_along_load: Field | None = None
    slip_radial: Field | None = None
    slip_circumferential: Field | None = None
    slip_along_load: Field | None = None
    in_stick: Mask | None = None
    stick_radius: float | None = None
    tangential_force: Vector | None = None
    tangential_shift: Vector | None = None
    torque: float | None = None
    twist: float | None = None
    dissipated_energy: float | None = None
    path: str | None = None
    overlap: float | None = None

    @property
    def in_contact(self) -> Mask:
        """Rings that carry pressure."""
        return np.asarray(self.pressure > 0)

    @property
    def contact_area(self) -> float:
        """Area of the contact circle [length^2]."""
        return pi * self.contact_radius**2

    @property
    def stick_area(self) -> float | None:
        """Area of the circle of the stick radius [length^2]; None without friction."""
        return None if self.stick_radius is None else pi * self.stick_radius**2


def radius_of(area: float) -> float:
    """Radius of the circle of an area [length]."""
    return sqrt(area / pi)


@dataclass(frozen=True)
class Result:
    """All increments of a load history on one mesh, with what was asked for and decided.

    sections  meshes of lower body and indenter; None where rigid
    """

    scene: Scene
    discretisation: FiniteElementDiscretisation
    sections: tuple[SectionMesh | None, SectionMesh | None]
    plan: Plan
    increments: tuple[Increment, ...]

    @property
    def steps(self) -> tuple[Increment, ...]:
        """The last increment of every loading step."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)
