"""Scenes of the paper's coated bodies, and their semi-closed solution."""

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
# Of the semi-closed solution: measured against the shipped reference rows.
SEMI_CLOSED_ERROR = 1e-12


def film(modulus_ratio: float, thickness_over_radius: float) -> Layer:
    """Return a coating.

    The modulus is relative to that of the substrate, the thickness to the Hertz radius.
    """
    material = IsotropicMaterial(
        young_modulus=modulus_ratio * SUBSTRATE.young_modulus, poisson_ratio=0.3
    )
    return Layer(thickness=thickness_over_radius * HERTZ.contact_radius, material=material)


def coated(*layers: Layer) -> Body:
    """Return the substrate with layers, outermost first."""
    return Body(material=SUBSTRATE, layers=layers)


def rigid_ball() -> Paraboloid:
    """Return the paper's ball as a rigid paraboloid."""
    return Paraboloid(radius=paper.RADIUS, material=RIGID)


def half_space(poisson_ratio: float) -> Body:
    """Return a half-space that has the paper's E* under a rigid indenter."""
    modulus = paper.CONTACT_MODULUS * (1 - poisson_ratio**2)
    return Body(material=IsotropicMaterial(young_modulus=modulus, poisson_ratio=poisson_ratio))


def pressed(
    title: str, indenter: Indenter, body: Body, *loading: LoadStep, friction: float | None = None
) -> Scene:
    """Return the scene of an indenter on a body under the given loads, or the paper's force.

    friction  µ; None or zero: no friction
    """
    return Scene(
        title=title,
        indenter=indenter,
        body=body,
        friction=CoulombFriction(coefficient=friction) if friction else None,
        loading=loading or (pressing(),),
    )


def pressed_and_pushed(title: str, body: Body) -> Scene:
    """Return the scene of the paper's figures 3 and 4.

    The rigid ball is pressed with friction in 15 increments, then loaded tangentially to 0.95 µW in
    20.
    """
    push = LoadStep(tangential_force=(0.95 * paper.FRICTION_LIMIT, 0.0), increments=20)
    return pressed(title, rigid_ball(), body, pressing(15), push, friction=paper.FRICTION)


@cache
def surface_of(*bodies: Body) -> LayeredSurface:
    """Return the normal response of two bodies, or of one body under a rigid indenter."""
    stacks = [stack_of(body) for body in bodies if body.deforms]

    def compliance(k: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(sum(scalars(stack, k).c22 for stack in stacks))

    outer = sum((1 - stack.outer.poisson_ratio) / stack.outer.shear_modulus for stack in stacks)
    thickness = min(stack.layers[0].thickness for stack in stacks if stack.layers)
    return LayeredSurface(compliance, 2 / outer, thickness)


@cache
def exact_contact(*bodies: Body) -> LayeredIndentation:
    """Solve the paper's ball on these bodies under the paper's force, semi-closed."""
    return paraboloid_under(paper.NORMAL_FORCE, surface_of(*bodies), paper.RADIUS)
