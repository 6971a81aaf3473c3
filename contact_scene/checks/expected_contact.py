"""How far a contact is likely to reach and what strains it makes, before anything is solved."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from contact_scene.body import Body
from contact_scene.body_pair import contact_modulus
from contact_scene.geometry import Sphere
from contact_scene.material import IsotropicMaterial
from contact_scene.rig import compliances
from contact_scene.scene import Scene
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)

# atanh(x) with x atanh(x) = 1: at an approach of R the contact of a rigid sphere has the radius xR
# and the force atanh(x) E* R^2 (Sneddon 1965).
_AT_EQUATOR = 1.19967864
BISECTIONS = 60  # to round-off


def refuse_equator(scene: Scene) -> None:
    """Raise UnsupportedScene for a sphere that is pressed to its equator, beyond which it has no
    shape: by its approach, or by its force between bodies without layers."""
    indenter = scene.indenter
    if not isinstance(indenter, Sphere):
        return
    R, layered = indenter.radius, scene.body.layers or indenter.layers
    for ramp in scene.load_path():
        end, by_force = ramp.normal.end, ramp.normal.kind is ControlKind.FORCE
        if by_force and layered:
            continue
        if not by_force:
            end = contact_approach(scene, end, contact_modulus(scene))
        most = _AT_EQUATOR * contact_modulus(scene) * R**2 if by_force else R
        if end >= most:
            load, unit = ("normal force", "N") if by_force else ("approach", "m")
            raise UnsupportedScene(
                f"step {ramp.step} presses the sphere to its equator: a {load} of {end:.4g} "
                f"{unit}, and {most:.4g} {unit} press it in by its radius; take less, or a "
                "paraboloid"
            )


def contact_approach(scene: Scene, approach: float, modulus: float) -> float:
    """Approach of the bodies where that of the actuator is given, by half-spaces [length].

    modulus  E* [force/length^2]
    """
    down, indenter = compliances(scene.rig)[0], scene.indenter
    at, under = indenter.contact_at(1.0), indenter.contact_under(1.0, modulus)
    k = indenter.gap_exponent
    if not down or at is None or under is None or k is None:
        return approach
    stiffness = math.prod(at) ** ((k + 1) / (2 * k)) / math.sqrt(math.prod(under))
    low, high = 0.0, approach
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = middle + down * stiffness * middle ** ((k + 1) / k) > approach
        low, high = (low, middle) if beyond else (middle, high)
    return high


@dataclass(frozen=True)
class ExpectedContact:
    """The contact at the end of a step, by Hertz for what lies within it.

    modulus  E* [force/length^2]
    radius   of the contact [length]
    strain   by order of magnitude
    """

    ramp: LoadRamp
    modulus: float
    radius: float
    strain: float

    @property
    def stiffness(self) -> float:
        """Along the normal, and up to 30 % more than along the surface [force/length]."""
        return 2 * self.modulus * self.radius


def expected_contacts(scene: Scene) -> Iterator[ExpectedContact]:
    """That of every step of which it is known."""
    k, outermost = scene.indenter.gap_exponent, contact_modulus(scene)
    if k is None:
        return
    for ramp in scene.load_path():
        by_force, end = ramp.normal.kind is ControlKind.FORCE, ramp.normal.end

        def radius(modulus: float, by_force: bool = by_force, end: float = end) -> float:
            power = (
                scene.indenter.contact_under(end, modulus)
                if by_force
                else scene.indenter.contact_at(contact_approach(scene, end, modulus))
            )
            return math.nan if power is None else math.prod(power) ** (0.5 / (k + by_force))

        modulus = _modulus_within(scene, radius(outermost)) or outermost
        if (a := radius(modulus)) > 0:
            force = end if by_force else modulus * a * contact_approach(scene, end, modulus)
            strain = force / (math.pi * a**2) / modulus
            # Below a cone strains do not depend on the load.
            yield ExpectedContact(ramp, modulus, a, 0.0 if k == 1 else strain)


def _modulus_within(scene: Scene, radius: float) -> float:
    """E* of the substrates under layers thinner than the contact, and of thicker layers; 0 where
    all of that is rigid."""
    compliance = 0.0
    for body in (scene.body, scene.indenter):
        thin = _thickness(body) < radius
        material = body.material if thin or not body.layers else body.layers[0].material
        if isinstance(material, IsotropicMaterial):
            compliance += 1.0 / material.plane_strain_modulus
    return 1.0 / compliance if compliance else 0.0


def _thickness(body: Body) -> float:
    return sum(layer.thickness for layer in body.layers)
