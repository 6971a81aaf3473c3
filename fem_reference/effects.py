"""What acts in a scene and what does not, with reasons, as shown to people."""

from contact_scene import Scene, effect
from contact_scene.effect import Effect
from fem_reference.path import Path


def effects(
    scene: Scene, path: Path, acting: tuple[bool, bool, bool], why_coupled: str
) -> tuple[Effect, ...]:
    """Every effect with its reason.

    acting       whether there are friction, a tangential load, and torsion
    why_coupled  why pressure does or does not move the surfaces past each other
    """
    has_friction, loaded, twisted = acting
    return (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene, "1 layer"),
        effect.friction(scene),
        Effect(
            "tangential load",
            has_friction and loaded,
            "a step names a tangential force or shift" if loaded else "no step pushes sideways",
        ),
        Effect(
            "torsion",
            has_friction and twisted,
            "a step names a torque or twist" if twisted else "no step twists the indenter",
        ),
        effect.coupled(scene, path in (Path.PRESSING_WITH_FRICTION, Path.HARMONICS), why_coupled),
        _cross_slip(path),
        effect.load_history(path is not Path.PRESSING and len(scene.loading) > 1),
    )


def _cross_slip(path: Path) -> Effect:
    """Slip across the load, which Poisson's ratio calls for (Munisamy, Hills and Nowell 1994)."""
    name = "slip across the load"
    if path is Path.SHEARING:
        return Effect(
            name, False, "neglected, as by Cattaneo and Mindlin: shear and slip are along the load"
        )
    if path is Path.HARMONICS:
        return Effect(name, True, "Coulomb's law is obeyed as a vector law at every point")
    return Effect(name, False, "nothing pushes sideways")
