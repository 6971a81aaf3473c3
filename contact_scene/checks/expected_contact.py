"""Estimates of contact radius and strain: from Hertz theory before a solve, or from a result.

Used for finite-element meshes and for warnings about strains beyond linear elasticity.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from contact_scene.body import Body, Layer
from contact_scene.body_pair import contact_modulus
from contact_scene.geometry import Sphere
from contact_scene.material import IsotropicMaterial
from contact_scene.quantities.increment import State
from contact_scene.rig import compliances
from contact_scene.scene import Scene
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)

# atanh(x) with x atanh(x) = 1. At the approach R, the contact of a rigid sphere has the radius x R
# and the force atanh(x) E* R^2 (Sneddon 1965).
_AT_EQUATOR = 1.19967864
BISECTIONS = 60  # to round-off

# The relative error of linear elasticity is of the order of the strain. A Hertzian ball reaches
# this strain at a/R = 0.24, a cone at a slope of 11 degrees (Johnson 1985, eqs. 3.39 and 5.11).
SMALL_STRAIN = 0.1


def refuse_equator(scene: Scene) -> None:
    """Raise UnsupportedScene if a load step presses a sphere to its equator, where its shape ends.

    The limit is an approach equal to the radius. Under force control of bodies without layers, the
    limit is the normal force at that approach.

    scene  bodies, indenter shape and load steps
    """
    indenter = scene.indenter
    if not isinstance(indenter, Sphere):
        return
    R, modulus, layered = (
        indenter.radius,
        contact_modulus(scene),
        scene.body.layers + indenter.layers,
    )
    for ramp in scene.load_path():
        if ramp.normal.kind is ControlKind.FORCE:
            load, unit, end = "normal force", "N", ramp.normal.end
            most = math.inf if layered else _AT_EQUATOR * modulus * R**2
        else:
            load, unit, end = "approach", "m", contact_approach(scene, ramp.normal.end, modulus)
            most = R
        if end >= most:
            raise UnsupportedScene(
                f"step {ramp.step} presses the sphere to its equator: its {load} is {end:.4g} "
                f"{unit}, and at {most:.4g} {unit} the approach is the radius; take less, or a "
                "paraboloid"
            )


def refuse_ring(scene: Scene) -> None:
    """Raise UnsupportedScene if first contact is on a ring, for a solver of circular contacts.

    scene  bodies, with the shape of the indenter
    """
    radius = scene.indenter.lowest_radius
    if radius:
        raise UnsupportedScene(
            f"the indenter is lowest on a ring of radius {radius:.4g} m, and this solver requires "
            "first contact on the axis. Make the profile lowest on the axis, or solve it with the "
            "semi-analytical solver"
        )


def contact_approach(scene: Scene, approach: float, modulus: float) -> float:
    """Estimate the approach of the bodies from the approach of the actuator of a test rig [length].

    The normal spring between actuator and indenter takes up the difference. The estimate is by
    Hertz theory and bisection.

    scene     bodies, indenter shape and springs
    approach  approach of the actuator [length]
    modulus   contact modulus E* [force/length^2]
    """
    down, indenter = compliances(scene.rig)[0], scene.indenter
    at, under = indenter.contact_at(1.0), indenter.contact_under(1.0, modulus)
    k, n = indenter.gap_exponent, indenter.load_exponent
    if not down or at is None or under is None or k is None or n is None:
        return approach
    stiffness = math.prod(at) ** (n / (2 * k)) / math.sqrt(math.prod(under))
    low, high = 0.0, approach
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = middle + down * stiffness * middle ** (n / k) > approach
        low, high = (low, middle) if beyond else (middle, high)
    return high


@dataclass(frozen=True)
class ExpectedContact:
    """Estimate of the contact at the end of a load step, from Hertz theory with one modulus.

    ramp     load ramp of the load step
    modulus  contact modulus E* [force/length^2]
    radius   contact radius [length]
    strain   strain in the bodies, to an order of magnitude; 0 for a cone
    """

    ramp: LoadRamp
    modulus: float
    radius: float
    strain: float

    @property
    def stiffness(self) -> float:
        """Normal stiffness of the expected contact [force/length].

        The tangential stiffness is smaller by the factor 2 (1 - ν)/(2 - ν) for equal materials:
        2/3 to 1 for Poisson's ratios ν of 1/2 to 0 (Johnson 1985, section 7.2).
        """
        return 2 * self.modulus * self.radius


def estimate_contacts(scene: Scene) -> Iterator[ExpectedContact]:
    """Yield an estimate of the contact at the end of every load step, from Hertz theory.

    The estimate contains contact radius, modulus and strain. There is none for shapes whose gap is
    not a power of the distance from first contact.

    scene  bodies, indenter shape and load steps
    """
    indenter, outermost = scene.indenter, contact_modulus(scene)
    k, n = indenter.gap_exponent, indenter.load_exponent
    if k is None or n is None:
        return
    for ramp in scene.load_path():
        by_force, end = ramp.normal.kind is ControlKind.FORCE, ramp.normal.end

        def radius(modulus: float, by_force: bool = by_force, end: float = end) -> float:
            """Estimate the contact radius at the end of the load step for one modulus [length].

            The result is NaN if the shape of the indenter has no estimate.

            modulus   contact modulus E* [force/length^2]
            by_force  True under a prescribed normal force, False under a prescribed approach
            end       normal force or approach at the end of the load step
            """
            power = (
                indenter.contact_under(end, modulus)
                if by_force
                else indenter.contact_at(contact_approach(scene, end, modulus))
            )
            degree = n if by_force else k
            return math.nan if power is None else math.prod(power) ** (0.5 / degree)

        modulus = _modulus_within(scene, radius(outermost)) or outermost
        if (a := radius(modulus)) > 0:
            width, area = (1.0, 2.0 * a) if indenter.is_line else (a, math.pi * a**2)
            force = end if by_force else modulus * width * contact_approach(scene, end, modulus)
            strain = force / area / modulus
            # Strains below a cone do not depend on the load.
            yield ExpectedContact(ramp, modulus, a, 0.0 if k == 1 else strain)


def _modulus_within(scene: Scene, radius: float) -> float:
    """Compute E* of the materials to a depth of about one contact radius [force/length^2].

    The materials are the substrate below layers of a total thickness below the radius, or else the
    outermost layer. The result is 0 if they are rigid.
    """
    compliance = 0.0
    for body in (scene.body, scene.indenter):
        thin = sum(layer.thickness for layer in body.layers) < radius
        material = body.material if thin or not body.layers else body.layers[0].material
        if isinstance(material, IsotropicMaterial):
            compliance += 1.0 / material.plane_strain_modulus
    return 1.0 / compliance if compliance else 0.0


def beyond_linear_theory(scene: Scene, ends: Iterable[State]) -> tuple[str, ...]:
    """Return a warning if the strain at the end of any load step is beyond linear elasticity.

    The warning states the largest strain. The result is empty if all strains are at most
    `SMALL_STRAIN`.

    scene  bodies with their layers and materials
    ends   solved states at the ends of the load steps
    """
    found = [
        (strain, where, step)
        for step, end in enumerate(ends, start=1)
        for strain, where in _estimate_strains(scene, end)
    ]
    if all(strain <= SMALL_STRAIN for strain, *_ in found):
        return ()
    strain, where, step = found[int(np.argmax([strain for strain, *_ in found]))]
    return (
        f"strains of about {strain:.2g} in {where} at the end of step {step}: the theory is of "
        "small strains, and wrong by about as much",
    )


def _estimate_strains(scene: Scene, end: State) -> Iterator[tuple[float, str]]:
    """Estimate the strains in both bodies at the end of a load step, to an order of magnitude.

    Used to warn about strains beyond linear elasticity. The strain is the mean pressure over a
    modulus. For layers on rigid substrates there is also the approach over the thickness of the
    layers.

    scene   bodies with their layers
    end     solved state at the end of the load step; without contact there are no strains
    yields  strain and its location in words
    """
    if end.contact_area <= 0 or end.normal_force <= 0:
        return
    pressure = end.normal_force / end.contact_area
    bodies = {"the body": scene.body, "the indenter": scene.indenter}
    for name, body in bodies.items():
        for material, where in _moduli_below_contact(body, end.contact_radius):
            yield pressure / material, f"{where} of {name}" if where else name
    if not any(isinstance(body.material, IsotropicMaterial) for body in bodies.values()):
        layers = sum(layer.thickness for body in bodies.values() for layer in body.layers)
        yield (end.approach or 0.0) / layers, "the layers"


def _moduli_below_contact(body: Body, contact_radius: float) -> Iterator[tuple[float, str]]:
    """Yield moduli to a depth of one contact radius, with names such as "layer 1".

    The modulus is E/(1 - nu^2); that of a layer thinner than the contact radius is larger, because
    its bond restrains its deformation. Strains are estimated as mean pressure over modulus. A body
    without layers yields none.
    """
    depth = 0.0
    for number, layer in enumerate(body.layers, start=1):
        if depth < contact_radius:
            yield _layer_modulus(layer, contact_radius), f"layer {number}"
        depth += layer.thickness
    if depth < contact_radius and isinstance(body.material, IsotropicMaterial):
        yield body.material.plane_strain_modulus, "the substrate" if body.layers else ""


def _layer_modulus(layer: Layer, contact_radius: float) -> float:
    """Compute the ratio of mean pressure to strain for a layer below the contact [force/length^2].

    The bond restrains a layer thinner than the contact radius a. The layer is compressed in
    uniaxial strain, with the modulus E (1 - nu) / ((1 + nu) (1 - 2 nu)), or squeezed out in shear,
    with the modulus G a/h and the thickness h, whichever is softer. The ratio for a thicker layer
    is E/(1 - nu^2).
    """
    material, nu = layer.material, layer.material.poisson_ratio
    if layer.thickness >= contact_radius:
        return material.plane_strain_modulus
    squeezed = material.shear_modulus * contact_radius / layer.thickness
    if nu < 0.5:
        uniaxial = material.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
        squeezed = min(uniaxial, squeezed)
    return max(material.plane_strain_modulus, squeezed)
