"""Check of the strains of a result against the limit of linear elasticity."""

from collections.abc import Iterable, Iterator

import numpy as np

from contact_scene.body import Body, Layer
from contact_scene.material import IsotropicMaterial
from contact_scene.quantities.increment import State
from contact_scene.scene import Scene

# The relative error of linear elasticity is of the order of the strain. A Hertzian ball reaches
# this strain at a/R = 0.24, a cone at a slope of 11 degrees (Johnson 1985, eqs. 3.39 and 5.11).
SMALL_STRAIN = 0.1


def beyond_linear_theory(scene: Scene, ends: Iterable[State]) -> tuple[str, ...]:
    """Return a warning about the largest strain if it exceeds linear theory in any load step."""
    found = [
        (strain, where, step)
        for step, end in enumerate(ends, start=1)
        for strain, where in _strains(scene, end)
    ]
    if all(strain <= SMALL_STRAIN for strain, *_ in found):
        return ()
    strain, where, step = found[int(np.argmax([strain for strain, *_ in found]))]
    return (
        f"strains of about {strain:.2g} in {where} at the end of step {step}: the theory is of "
        "small strains, and wrong by about as much",
    )


def _strains(scene: Scene, end: State) -> Iterator[tuple[float, str]]:
    """Estimate strains to an order of magnitude, with their locations; none without contact."""
    if end.contact_area <= 0 or end.normal_force <= 0:
        return
    pressure = end.normal_force / end.contact_area
    bodies = {"the body": scene.body, "the indenter": scene.indenter}
    for name, body in bodies.items():
        for material, where in _strained(body, end.contact_radius):
            yield pressure / material, f"{where} of {name}" if where else name
    if not any(isinstance(body.material, IsotropicMaterial) for body in bodies.values()):
        layers = sum(layer.thickness for body in bodies.values() for layer in body.layers)
        yield end.approach / layers, "the layers"


def _strained(body: Body, contact_radius: float) -> Iterator[tuple[float, str]]:
    """Yield the moduli of layers and substrate down to a depth of one contact radius.

    The modulus is E/(1 - nu^2); for thin layers see `_layer_modulus`.
    """
    depth = 0.0
    for number, layer in enumerate(body.layers, start=1):
        if depth < contact_radius:
            yield _layer_modulus(layer, contact_radius), f"layer {number}"
        depth += layer.thickness
    if depth < contact_radius and isinstance(body.material, IsotropicMaterial):
        yield body.material.plane_strain_modulus, "the substrate" if body.layers else ""


def _layer_modulus(layer: Layer, contact_radius: float) -> float:
    """Compute the ratio of pressure to strain of a layer [force/length^2].

    The bond restrains a layer thinner than the contact radius: it is compressed in uniaxial strain,
    E (1 - nu) / ((1 + nu) (1 - 2 nu)), or squeezed out in shear, G a/h, whichever is softer.
    """
    material, nu = layer.material, layer.material.poisson_ratio
    if layer.thickness >= contact_radius:
        return material.plane_strain_modulus
    squeezed = material.shear_modulus * contact_radius / layer.thickness
    if nu < 0.5:
        uniaxial = material.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
        squeezed = min(uniaxial, squeezed)
    return max(material.plane_strain_modulus, squeezed)
