"""Refusal of scenes that no solver of bodies of revolution supports: shapes, friction and tilts."""

from contact_scene.checks.expected_contact import refuse_ring
from contact_scene.reading.scene_text import shape_text
from contact_scene.scene import Scene
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import ControlKind

ELSEWHERE = "solve it with the semi-analytical solver"


def refuse_shape(scene: Scene) -> None:
    """Raise UnsupportedScene if the indenter is no body of revolution that is lowest on the axis.

    scene  contact problem, which contains the shape of the indenter
    """
    indenter = scene.indenter
    if not indenter.is_of_revolution:
        raise UnsupportedScene(
            f"the indenter is not axisymmetric ({shape_text(indenter)}), and this solver requires "
            f"bodies of revolution; {ELSEWHERE}"
        )
    refuse_ring(scene)


def refuse_coefficient_map(scene: Scene) -> None:
    """Raise UnsupportedScene if the coefficient of friction varies over the surface.

    scene  contact problem with its friction
    """
    if scene.friction is not None and scene.friction.coefficient_map is not None:
        raise UnsupportedScene(
            "the coefficient of friction is a map, and this solver requires one number. Give one "
            f"number, or {ELSEWHERE}"
        )


def refuse_tilt(scene: Scene, *, pushed: bool, coupled: bool) -> None:
    """Raise UnsupportedScene if the indenter tilts.

    The indenter tilts by a prescribed moment or tilt. If its tilt is free, the indenter also tilts
    by a tangential load on coupled bodies.

    scene    contact problem with its load history
    pushed   True if a load step has a tangential force or shift
    coupled  True if normal loading causes shear
    """
    ramps = scene.load_path()
    free = any(ramp.tilting.kind is ControlKind.FORCE for ramp in ramps)
    if any(any(ramp.tilting.end) for ramp in ramps) or (free and pushed and coupled):
        raise UnsupportedScene(
            "a step has a moment or a tilt, and this solver does not tilt the indenter. Remove it, "
            f"or {ELSEWHERE}"
        )
