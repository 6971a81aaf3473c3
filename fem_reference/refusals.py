"""Scenes that are not axisymmetric enough, refused by name before any work."""

from math import hypot

from contact_scene import (
    ControlKind,
    Scene,
)
from contact_scene.scene_text import shape_text
from contact_scene.solver_errors import UnsupportedScene

# The sine of an angle below this is round-off of a load that goes straight.
STRAIGHT = 1e-9


def refuse_shapes(scene: Scene) -> None:
    """Shapes and friction that are not the same all around; raises UnsupportedScene."""
    indenter, friction = scene.indenter, scene.friction
    if not indenter.is_of_revolution:
        raise UnsupportedScene(
            f"the indenter is not the same all around ({shape_text(indenter)}), and this solver "
            "takes bodies of revolution; solve it with the semi-analytical solver"
        )
    if friction is not None and friction.varying is not None:
        raise UnsupportedScene(
            "friction is given as a map, and this solver takes one coefficient; name one number"
        )


def refuse_loads(scene: Scene, loaded: bool, twisted: bool, coupled: bool) -> None:
    """Loads that are not along one line or about one axis; raises UnsupportedScene.

    coupled  whether pressing alone leaves shear
    """
    if any(any(ramp.tilting.end) for ramp in scene.load_path()):
        raise UnsupportedScene(
            "a step names a moment or a tilt, and this solver keeps the indenter upright; leave it "
            "out"
        )
    free = any(ramp.tilting.kind is ControlKind.FORCE for ramp in scene.load_path())
    if free and loaded and coupled:
        raise UnsupportedScene(
            "the indenter may tilt freely under a tangential load, and this solver keeps it "
            "upright; prescribe the tilt"
        )
    if twisted and loaded:
        raise UnsupportedScene(
            "steps name a tangential load and a torsion, and this solver takes one of them; leave "
            "the other out, or solve it with --solver radial"
        )
    if twisted and coupled:
        raise UnsupportedScene(
            "the indenter is twisted where pressing alone leaves radial shear, and this solver "
            "does not combine the two; take bodies that are alike, leave the torsion out, or solve "
            "it with --solver radial"
        )
    ends = [ramp.tangential.end for ramp in scene.load_path()]
    longest = max(ends, key=lambda end: hypot(*end))
    for end in ends:
        if _turns(longest, end):
            raise UnsupportedScene(
                f"the tangential load goes along {longest} and along {end}, and this solver takes "
                "one direction; keep to a straight line, or solve it with --solver radial"
            )


def _turns(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether two loads are not on one line, round-off apart."""
    cross = one[0] * other[1] - one[1] * other[0]
    return abs(cross) > STRAIGHT * hypot(*one) * hypot(*other)
