"""Definition of a verification problem, and scenes of the standard ball from the reference paper.

A problem is a scene, its known answer, and the source of the answer. The ball has a radius of 18 mm
and is pressed on a half-space with 1 kN. The paper prints a contact radius of 0.388 mm and a peak
pressure of 3.1684 GPa. These values belong to the compliance of one body with E = 210 GPa, ν = 0.3.
Two identical bodies with E = 420 GPa have the same total compliance and are uncoupled, as the
closed form assumes. Two bodies with ν = 0 and E = 2 E* have this compliance as well; for these
bodies the closed form of the tangential problem is exact.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cache
from typing import Any

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.array_types import Field
from contact_scene.geometry import Indenter
from semi_analytical.frf.stack import stack_of
from semi_analytical.frf.surface import scalars
from semi_analytical.grid import SurfaceGrid
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.coated_indentation import (
    LayeredIndentation,
    LayeredSurface,
    paraboloid_under,
)
from verification.closed_forms.hertz import PointContact, contact_modulus, tangential_modulus

RADIUS = 18e-3
NORMAL_FORCE = 1e3
FRICTION = 0.1
FRICTION_LIMIT = FRICTION * NORMAL_FORCE

STEEL = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)
CONTACT_MODULUS = contact_modulus((420e9, 0.3), (420e9, 0.3))
NU_ZERO = IsotropicMaterial(young_modulus=2 * CONTACT_MODULUS, poisson_ratio=0.0)

HERTZ = PointContact.under_load(NORMAL_FORCE, RADIUS, CONTACT_MODULUS)
WINDOW_PER_RADIUS = 3.0


def square_grid(cells: int, half_width: float) -> SurfaceGrid:
    """Create a square grid of cells × cells on the window |x|, |y| <= `half_width`.

    cells       number of cells per side
    half_width  half of the side of the window [length]
    """
    return SurfaceGrid((cells, cells), (2 * half_width, 2 * half_width))


def hertz_grid(cells: int) -> SurfaceGrid:
    """Create a square grid of cells × cells on a window whose side is 3 Hertz contact radii.

    The radius is that of the standard ball (18 mm, 1 kN).

    cells  number of cells per side
    """
    return square_grid(cells, WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius)


def paraboloid(material: IsotropicMaterial) -> Paraboloid:
    """Create the standard ball (radius 18 mm) as a paraboloid of the given material.

    Hertz theory assumes this shape.
    """
    return Paraboloid(radius=RADIUS, material=material)


def frictional(
    title: str, indenter: Indenter, body: IsotropicMaterial, *loading: LoadStep
) -> Scene:
    """Create the scene of an indenter that is pressed with 1 kN and µ = 0.1, then loaded further.

    The bodies must be uncoupled. The pressure then does not depend on the load history, so that one
    increment is sufficient for the normal force.

    title     title of the scene
    indenter  shape and material of the indenter
    body      material of the half-space
    loading   load steps after the normal loading
    """
    return pressed(title, indenter, body, pressing(1), *loading, friction=FRICTION)


def pressing(increments: int | None = None) -> LoadStep:
    """Create the load step to a normal force of 1 kN.

    increments  number of increments; None: the solver chooses
    """
    return LoadStep(normal_force=NORMAL_FORCE, increments=increments)


def tangential_step(part_of_limit: float, increments: int) -> LoadStep:
    """Create a load step to a tangential force along x.

    part_of_limit  force at the end of the step over the friction limit µW = 100 N
    increments     number of increments
    """
    force = part_of_limit * FRICTION_LIMIT
    return LoadStep(tangential_force=(force, 0.0), increments=increments)


def partial_slip(material: IsotropicMaterial, tangential_force: float) -> PartialSlip:
    """Create the partial slip state of Cattaneo and Mindlin of the standard ball (18 mm, 1 kN, µ =
    0.1).

    material          material of both bodies
    tangential_force  T [force]; magnitudes above the friction limit are reduced to the limit
    """
    constants = (material.young_modulus, material.poisson_ratio)
    modulus = tangential_modulus(constants, constants)
    limited = math.copysign(min(abs(tangential_force), FRICTION_LIMIT), tangential_force)
    return PartialSlip(NORMAL_FORCE, HERTZ.contact_radius, FRICTION, modulus, limited)


SUBSTRATE = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FREDHOLM = "Fredholm equation for the Abel transform of the pressure, to 1e-13"
FREDHOLM_EQUATION = (
    r"\tfrac{\pi}{E^*} g(s) + \tfrac{2}{E^*} \int_0^a K(s, t) g(t) \, dt = \delta - s^2/R,\quad "
    r"K = \int_0^\infty \left(\tfrac{1}{2} k E^* F(k) - 1\right) \cos ks \cos kt \, dk"
)
# Relative error of the semi-closed solution, measured against the rows of the reference table.
SEMI_CLOSED_ERROR = 1e-12


def film(modulus_ratio: float, thickness_over_radius: float) -> Layer:
    """Create a coating layer (ν = 0.3) for the standard substrate (E = 210 GPa, ν = 0.3).

    modulus_ratio          Young's modulus of the coating over that of the substrate
    thickness_over_radius  thickness of the coating over the Hertz contact radius
    """
    material = IsotropicMaterial(
        young_modulus=modulus_ratio * SUBSTRATE.young_modulus, poisson_ratio=0.3
    )
    return Layer(thickness=thickness_over_radius * HERTZ.contact_radius, material=material)


def coated(*layers: Layer) -> Body:
    """Create the standard substrate (E = 210 GPa, ν = 0.3) with coating layers.

    layers  coating layers, outermost first; none: an uncoated half-space
    """
    return Body(material=SUBSTRATE, layers=layers)


def rigid_ball() -> Paraboloid:
    """Create the standard ball (radius 18 mm) as a rigid paraboloid."""
    return Paraboloid(radius=RADIUS, material=RIGID)


def half_space(poisson_ratio: float) -> Body:
    """Create a half-space that has the standard contact modulus E* below a rigid indenter.

    The modulus E* is that of two bodies with E = 420 GPa, ν = 0.3. The contact radius without
    friction is then the same for all Poisson ratios.

    poisson_ratio  ν of the half-space
    """
    modulus = CONTACT_MODULUS * (1 - poisson_ratio**2)
    return Body(material=IsotropicMaterial(young_modulus=modulus, poisson_ratio=poisson_ratio))


def pressed(
    title: str,
    indenter: Indenter,
    body: Body | IsotropicMaterial,
    *loading: LoadStep,
    friction: float | None = None,
) -> Scene:
    """Create the scene of an indenter on a body under given load steps.

    title     title of the scene
    indenter  shape and material of the indenter
    body      lower body, or the material of a half-space
    loading   load steps; default: one step to a normal force of 1 kN
    friction  coefficient of friction µ; None or zero: no friction
    """
    return Scene(
        title=title,
        indenter=indenter,
        body=body if isinstance(body, Body) else Body(material=body),
        friction=CoulombFriction(coefficient=friction) if friction else None,
        loading=loading or (pressing(),),
    )


@cache
def surface_of(*bodies: Body) -> LayeredSurface:
    """Create the normal compliance of the surfaces of one or two bodies, in wavenumber space.

    Used for semi-closed solutions of layered contacts. A rigid body contributes nothing; at least
    one body must be layered.
    """
    stacks = [stack_of(body) for body in bodies if body.deforms]

    def compliance(k: Field) -> Field:
        return np.asarray(sum(scalars(stack, k).c22 for stack in stacks))

    outer = sum((1 - stack.outer.poisson_ratio) / stack.outer.shear_modulus for stack in stacks)
    thickness = min(stack.layers[0].thickness for stack in stacks if stack.layers)
    return LayeredSurface(compliance, 2 / outer, thickness)


@cache
def exact_contact(*bodies: Body) -> LayeredIndentation:
    """Solve the frictionless contact of the standard ball with layered bodies, in semi-closed form.

    The ball has a radius of 18 mm and a normal force of 1 kN.

    bodies  lower body, and material and layers of the ball unless it is rigid
    """
    return paraboloid_under(NORMAL_FORCE, surface_of(*bodies), RADIUS)


# Positions of the contact axis in a cell, in cell sides. Symmetric positions are omitted.
OFFSETS = ((0.0, 0.0), (0.5, 0.5), (0.5, 0.0), (0.25, 0.25), (0.1, 0.35), (0.4, 0.15))
# Two offsets for which the contact edge cuts the cells differently. Their mean errors scatter
# 1/3 as much as those of one grid per size.
UNLIKE = ((0.5, 0.0), (0.25, 0.25))


@dataclass(frozen=True)
class ShiftedGrid(SurfaceGrid):
    """Grid of cells whose centre is not the axis of the contact.

    Used to average errors over the position of the contact edge within the cells.

    offset  position of the grid centre relative to the contact axis, in cell sides along x and y
    """

    offset: tuple[float, float] = (0.0, 0.0)

    @property
    def x(self) -> Field:
        """Coordinates x of the cell centres relative to the contact axis (nx,) [length]."""
        return np.asarray(super().x + self.offset[0] * self.spacing[0])

    @property
    def y(self) -> Field:
        """Coordinates y of the cell centres relative to the contact axis (ny,) [length]."""
        return np.asarray(super().y + self.offset[1] * self.spacing[1])


ROUNDING = 1e-12  # relative uncertainty of a closed form in double precision


class ReferenceKind(StrEnum):
    """Kind of the source of a reference value, from closed forms to results of other programs."""

    CLOSED_FORM = "closed form"
    SEMI_CLOSED = "semi-closed"
    THEORY = "theory"
    EXTERNAL_CODE = "external code"
    OTHER_SOLVER = "other solver"
    OWN_REFINEMENT = "own refinement"  # the same solver on a coarser discretisation
    IDENTITY = "identity"  # holds exactly by a theorem or by the equations themselves


EXACT = (ReferenceKind.IDENTITY, ReferenceKind.THEORY)
NUMERICAL = (ReferenceKind.OTHER_SOLVER, ReferenceKind.OWN_REFINEMENT)


@dataclass(frozen=True)
class Reference:
    """Hold the reference value with which a measured number is compared.

    value        reference value, in the unit of the number
    kind         kind of the source
    source       description of the source
    uncertainty  standard uncertainty u_ref, in the unit of the value
    """

    value: float
    kind: ReferenceKind
    source: str
    uncertainty: float = 0.0


def closed_form(value: float, source: str, scale: float | None = None) -> Reference:
    """Create a reference value from a closed form, whose uncertainty is rounding.

    value   value of the closed form
    source  description of the source
    scale   magnitude to which the rounding error is relative; None: the value
    """
    uncertainty = ROUNDING * abs(value if scale is None else scale)
    return Reference(value, ReferenceKind.CLOSED_FORM, source, uncertainty)


def identity(value: float, source: str) -> Reference:
    """Create a reference value that follows exactly from the equations, without uncertainty.

    value   expected value
    source  law from which the value follows
    """
    return Reference(value, ReferenceKind.IDENTITY, source)


OVER_RADIUS = "the contact radius"
OVER_PEAK = "p_H"


@dataclass(frozen=True)
class Problem:
    """Verification problem: a scene with its known answer.

    scene        bodies and loads
    ends         exact answer at the end of every load step: records with the attribute names of the
                 quantities of a result; fields are functions of the distance from the axis, or of x
                 and y if the contact is not round
    radius       contact radius, or semi-axis of the contact along x [length]
    source       source of the answer
    kind         kind of the source
    uncertainty  standard uncertainty of the numbers, relative to their scale
    scales       error scales by name, in addition to the contact radius
    across       semi-axis of the contact along y; None if the contact is round [length]
    equations    governing equations of the answer, in LaTeX
    """

    scene: Scene
    ends: tuple[Any, ...]
    radius: float
    source: str
    kind: ReferenceKind = ReferenceKind.CLOSED_FORM
    uncertainty: float = ROUNDING
    scales: Mapping[str, float] = field(default_factory=dict)
    across: float | None = None
    equations: tuple[str, ...] = ()

    def scale(self, name: str) -> float:
        """Return the number by which errors with the given name of their scale are divided.

        Raises KeyError for an unknown name.
        """
        return self.radius if name == OVER_RADIUS else self.scales[name]

    def on_surface(self, exact: Callable[..., Field], x: Field, y: Field | float) -> Field:
        """Evaluate an exact field, such as the pressure, at points of the surface.

        exact  function of the distance from the axis, or of x and y if the contact is not round
        x, y   coordinates of the points [length]
        """
        return exact(np.hypot(x, y)) if self.across is None else exact(x, y)

    def reference(self, value: float, scale: float | None = None) -> Reference:
        """Create the reference for a number of the exact answer, with the uncertainty of the
        problem.

        value  exact number
        scale  magnitude to which the uncertainty is relative; None: the value
        """
        uncertainty = self.uncertainty * abs(value if scale is None else scale)
        return Reference(value, self.kind, self.source, uncertainty)


@dataclass(frozen=True, eq=False)
class TabulatedContact:
    """Hold a reference contact from a table: numbers, and tractions at a few radii.

    row  row of the table; its numbers are relative to the Hertz contact of the substrate
    """

    row: Mapping[str, Any]

    @property
    def contact_radius(self) -> float:
        """Contact radius from the reference table [length]."""
        return float(self.row["a_over_aH"]) * HERTZ.contact_radius

    @property
    def approach(self) -> float:
        """Approach of the bodies since first touch, from the reference table [length]."""
        return float(self.row["delta_over_deltaH"]) * HERTZ.approach

    @property
    def friction(self) -> float:
        """Coefficient of friction µ of the tabulated contact."""
        return float(self.row["mu"])

    @property
    def radii(self) -> Field:
        """Distances from the axis at which the tractions are tabulated [length]."""
        return np.array(self.row["r_over_a"]) * self.contact_radius

    def pressure(self, r: Field) -> Field:
        """Interpolate the pressure of the reference table linearly to radii r [force/length²]."""
        return np.interp(r, self.radii, np.array(self.row["p_over_pH"]) * HERTZ.peak_pressure)

    def shear(self, r: Field) -> Field:
        """Interpolate the radial shear of the reference table linearly to radii r [force/length²].

        Positive shear points outwards.
        """
        limit = self.friction * HERTZ.peak_pressure
        return np.interp(r, self.radii, np.array(self.row["q_over_mu_pH"]) * limit)
