"""Whether pressure moves the two surfaces past each other."""

from contact_scene import Body, IsotropicMaterial, Scene
from contact_scene.material import Material

# |beta| below this is round-off of equal materials given in different units.
UNCOUPLED = 1e-12


def coupling(scene: Scene) -> tuple[bool, str]:
    """Whether pressure moves the surfaces past each other, and why.

    For half-spaces Dundurs' beta decides (Dundurs 1969); a layer couples by itself unless the
    other body is its mirror image.
    """
    lower, upper = scene.body, scene.indenter
    if (lower.material, lower.layers) == (upper.material, upper.layers):
        return False, "the two bodies are alike: pressure moves both surfaces by the same amount"
    if not (_is_uniform(lower) and _is_uniform(upper)):
        return True, "a coating moves sideways under pressure, and the other body does not follow"
    beta = _dundurs_beta(lower.material, upper.material)
    text = f"Dundurs' beta is {beta:.2g}"
    if abs(beta) <= UNCOUPLED:
        return False, f"{text}: pressure does not move the surfaces past each other"
    return True, f"{text}: pressure moves the surfaces past each other"


def _is_uniform(body: Body) -> bool:
    return all(layer.material == body.material for layer in body.layers)


def _dundurs_beta(lower: Material, upper: Material) -> float:
    """½ [(1-2ν1)/G1 - (1-2ν2)/G2] / [(1-ν1)/G1 + (1-ν2)/G2]; a rigid body has 1/G = 0."""
    difference = total = 0.0
    for sign, material in ((1, lower), (-1, upper)):
        if isinstance(material, IsotropicMaterial):
            nu, G = material.poisson_ratio, material.shear_modulus
            difference += sign * (1 - 2 * nu) / G
            total += (1 - nu) / G
    return 0.5 * difference / total
