"""Elastic properties of the two bodies: coupling, contact modulus, contrast of materials."""

from contact_scene.body import Body
from contact_scene.material import IsotropicMaterial, Material
from contact_scene.scene import Scene
from contact_scene.solver_errors import UnsupportedScene

# |beta| below this value is round-off of equal materials in different units.
UNCOUPLED = 1e-12


def coupling(scene: Scene) -> tuple[bool, str]:
    """Determine if pressure displaces the two surfaces tangentially relative to each other.

    In this case the normal and the tangential problem are coupled. The criterion for half-spaces is
    Dundurs' constant β ≠ 0 (Dundurs 1969). Layered bodies are coupled unless both bodies are equal.

    scene    bodies with their layers and materials
    returns  True for coupled problems; reason in one sentence
    """
    lower, upper = scene.body, scene.indenter
    if (lower.material, lower.layers) == (upper.material, upper.layers):
        return False, "the two bodies are equal: pressure moves both surfaces by the same amount"
    beta = dundurs_beta(scene)
    if beta is None:
        return True, "a layer moves sideways under pressure, and the other body does not follow"
    text = f"Dundurs' beta is {beta:.2g}"
    if abs(beta) <= UNCOUPLED:
        return False, f"{text}: pressure does not move the surfaces past each other"
    return True, f"{text}: pressure moves the surfaces past each other"


def dundurs_beta(scene: Scene) -> float | None:
    """Compute Dundurs' constant β = ½ [(1-2ν1)/G1 - (1-2ν2)/G2] / [(1-ν1)/G1 + (1-ν2)/G2].

    G is the shear modulus and ν Poisson's ratio, with index 1 for the lower body and 2 for the
    indenter. A rigid body has 1/G = 0. Returns None if a body has a layer of another material than
    its substrate.
    """
    for body in (scene.body, scene.indenter):
        if any(layer.material != body.material for layer in body.layers):
            return None
    return outermost_beta(scene)


def outermost_beta(scene: Scene) -> float:
    """Compute Dundurs' constant β of the outermost materials of the two bodies [1].

    β determines the singularity of the tractions at an edge of the contact. Layers below the
    outermost material are ignored.

    scene  bodies with their layers and materials
    """
    difference = total = 0.0
    for sign, body in ((1, scene.body), (-1, scene.indenter)):
        material = _outermost_material(body)
        if isinstance(material, IsotropicMaterial):
            nu, G = material.poisson_ratio, material.shear_modulus
            difference += sign * (1 - 2 * nu) / G
            total += (1 - nu) / G
    return 0.5 * difference / total


def contact_modulus(scene: Scene) -> float:
    """Compute the contact modulus E* of the outermost materials of the two bodies.

    1/E* is the sum of (1-ν²)/E over the elastic ones of the two materials, with Young's modulus E
    and Poisson's ratio ν. The result is E* [force/length^2].

    scene  bodies with their layers and materials
    """
    outermost = map(_outermost_material, (scene.body, scene.indenter))
    return 1 / sum(
        1 / material.plane_strain_modulus
        for material in outermost
        if isinstance(material, IsotropicMaterial)
    )


def _outermost_material(body: Body) -> Material:
    return body.layers[0].material if body.layers else body.material


def refuse_contrast(scene: Scene, most: float, why: str) -> None:
    """Raise UnsupportedScene if the shear moduli of the materials within one body differ too much.

    A compliant bond counts as a soft material with the stiffness of the bond times the thickness of
    its layer.

    scene  bodies with their layers and materials
    most   largest allowed ratio of the shear moduli
    why    reason of the limit, for the message
    """
    for name, body in (("body", scene.body), ("indenter", scene.indenter)):
        moduli = [material.shear_modulus for material in body.elastic_materials]
        bonds = [
            layer.thickness * stiffness
            for layer in body.layers
            if layer.interface_stiffness is not None
            for stiffness in layer.interface_stiffness.given
        ]
        softest = min([*moduli, *bonds], default=0.0)
        if moduli and max(moduli) > most * softest:
            raise UnsupportedScene(
                f"materials and bonds of the {name} have shear moduli from {softest:.3g} to "
                f"{max(moduli):.3g} Pa{why}; use a rigid base, or leave the soft part out"
            )
