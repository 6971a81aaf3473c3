"""Scenes with coated bodies below a rigid ball, and their semi-closed frictionless solution."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

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
from contact_scene.geometry import Indenter
from semi_analytical.frf.stack import stack_of
from semi_analytical.frf.surface import scalars
from verification.closed_forms.coated_indentation import (
    LayeredIndentation,
    LayeredSurface,
    paraboloid_under,
)
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ, pressing

SUBSTRATE = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FREDHOLM = "Fredholm equation for the Abel transform of the pressure, to 1e-13"
FREDHOLM_EQUATION = (
    r"\tfrac{\pi}{E^*} g(s) + \tfrac{2}{E^*} \int_0^a K(s, t) g(t) \, dt = \delta - s^2/R,\quad "
    r"K = \int_0^\infty \left(\tfrac{1}{2} k E^* F(k) - 1\right) \cos ks \cos kt \, dk"
)
# Relative error of the semi-closed solution, measured against the rows of the reference table.
SEMI_CLOSED_ERROR = 1e-12


def film(modulus_ratio: float, thickness_over_radius: float) -> Layer:
    """Create a coating layer for the standard substrate (E = 210 GPa, ν = 0.3).

    modulus_ratio          Young's modulus of the coating over that of the substrate
    thickness_over_radius  thickness of the coating over the Hertz contact radius
    """
    material = IsotropicMaterial(
        young_modulus=modulus_ratio * SUBSTRATE.young_modulus, poisson_ratio=0.3
    )
    return Layer(thickness=thickness_over_radius * HERTZ.contact_radius, material=material)


def coated(*layers: Layer) -> Body:
    """Create the standard substrate (E = 210 GPa, ν = 0.3) with coating layers, outermost layer
    first."""
    return Body(material=SUBSTRATE, layers=layers)


def rigid_ball() -> Paraboloid:
    """Create the standard ball (radius 18 mm) as a rigid paraboloid."""
    return Paraboloid(radius=paper.RADIUS, material=RIGID)


def half_space(poisson_ratio: float) -> Body:
    """Create a half-space that has the standard contact modulus E* below a rigid indenter.

    The modulus E* is that of two bodies with E = 420 GPa, ν = 0.3.
    """
    modulus = paper.CONTACT_MODULUS * (1 - poisson_ratio**2)
    return Body(material=IsotropicMaterial(young_modulus=modulus, poisson_ratio=poisson_ratio))


def pressed(
    title: str, indenter: Indenter, body: Body, *loading: LoadStep, friction: float | None = None
) -> Scene:
    """Create the scene of an indenter on a body under given load steps.

    loading   load steps; default: one step to a normal force of 1 kN
    friction  coefficient of friction µ; None or zero: no friction
    """
    return Scene(
        title=title,
        indenter=indenter,
        body=body,
        friction=CoulombFriction(coefficient=friction) if friction else None,
        loading=loading or (pressing(),),
    )


def pressed_and_pushed(title: str, body: Body) -> Scene:
    """Create the scene of a rigid ball that is pressed on a body with friction and then sheared.

    The normal force grows in 15 increments, then the tangential force grows to 0.95 µW in 20
    (figures 3 and 4 of the reference paper).

    body  body below the ball
    """
    push = LoadStep(tangential_force=(0.95 * paper.FRICTION_LIMIT, 0.0), increments=20)
    return pressed(title, rigid_ball(), body, pressing(15), push, friction=paper.FRICTION)


@cache
def surface_of(*bodies: Body) -> LayeredSurface:
    """Create the normal compliance of the surfaces of two layered bodies, in wavenumber space.

    A rigid body contributes nothing.
    """
    stacks = [stack_of(body) for body in bodies if body.deforms]

    def compliance(k: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(sum(scalars(stack, k).c22 for stack in stacks))

    outer = sum((1 - stack.outer.poisson_ratio) / stack.outer.shear_modulus for stack in stacks)
    thickness = min(stack.layers[0].thickness for stack in stacks if stack.layers)
    return LayeredSurface(compliance, 2 / outer, thickness)


@cache
def exact_contact(*bodies: Body) -> LayeredIndentation:
    """Solve the frictionless contact of the standard ball with layered bodies, in semi-closed form.

    The ball has a radius of 18 mm and a normal force of 1 kN.
    """
    return paraboloid_under(paper.NORMAL_FORCE, surface_of(*bodies), paper.RADIUS)
