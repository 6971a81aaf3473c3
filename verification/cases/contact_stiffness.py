"""Verification case of contact stiffnesses: a ball is pressed, pushed, pulled back and twisted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from contact_scene import Scene
from verification.judging.case import Case, Level
from verification.judging.declared_case import (
    IDENTITY,
    Allowed,
    Row,
    Within,
    at_stops,
    case,
    judged,
    number,
    on_cells,
    on_radii,
    part_of_side,
    with_edge_at,
)
from verification.problems.cattaneo_mindlin import SLIDING_TORQUE, sheared, torque_step, virgin
from verification.problems.problem import (
    FRICTION_LIMIT,
    HERTZ,
    NU_ZERO,
    STEEL,
    Problem,
    frictional,
    paraboloid,
    partial_slip,
)

# Tangential force over the friction limit, and torque over that at gross slip, by load step.
FORCES = {0: 0.0, 1: 0.5, 2: 0.9, 3: -0.9}
GROSS_SLIP = {4: -1.0}
TORQUES = {0: 0.0, 1: 0.5, 2: 0.9}
OVER_STICK = "the stiffness of full stick"
SOURCE = "Hertz 1882; Mindlin 1949; Mindlin and Deresiewicz 1953; Lubkin 1951"
STAIRCASE = (
    "the derivative is that of fixed contact and stick cells, whose staircase changes the "
    "effective radius by a fraction of a cell; the cap is a quarter, for the third power three "
    "quarters"
)
NODES = (
    "the derivative is that of fixed nodes in contact and in stick: the radius is known to half an "
    "element, its third power to three halves"
)
RINGS = "the stick radius is known to half a ring, of 24 over the contact radius"
NORMAL = number("normal_stiffness", "normal contact stiffness")
TANGENTIAL = number("tangential_stiffness", "tangential contact stiffness{when}", over=OVER_STICK)
TORSIONAL = number("torsional_stiffness", "torsional contact stiffness{when}", over=OVER_STICK)


@dataclass(frozen=True)
class Stiffness:
    """Hold the exact contact stiffnesses at the end of a load step.

    normal_stiffness, tangential_stiffness, torsional_stiffness
        dW/dδ and dT/dδ [force/length], dM/dφ [force length]
    """

    normal_stiffness: float
    tangential_stiffness: float = 0.0
    torsional_stiffness: float = 0.0


def _requested(scene: Scene) -> Scene:
    return scene.model_copy(update={"contact_stiffness": True})


def pushed(parts: Sequence[float]) -> Problem:
    """Create the problem of a ball with ν = 0 under a changing tangential force.

    parts  tangential force at the end of each step, over the friction limit
    """
    known = sheared("Stiffness of a ball", tuple(parts)[1:])
    slopes = [partial_slip(NU_ZERO, part * FRICTION_LIMIT).tangential_stiffness for part in parts]
    ends = tuple(Stiffness(HERTZ.normal_stiffness, slope) for slope in slopes)
    scales = {OVER_STICK: slopes[0]}
    return replace(
        known,
        scene=_requested(known.scene),
        ends=ends,
        source=SOURCE,
        scales=scales,
        equations=(
            r"\frac{dW}{d\delta} = 2 E^* a,\quad \frac{dT}{d\Delta} = 2 G^* a "
            r"\left(1 - \frac{|T|}{\mu W}\right)^{1/3},\quad "
            r"\frac{1}{G^*} = \sum \frac{2 - \nu}{4 G}",
        ),
    )


def twisted() -> Problem:
    """Create the problem of a ball under a torque that grows in two steps."""
    exact = [virgin(part * SLIDING_TORQUE) for part in TORQUES.values()]
    _, *steps = map(torque_step, TORQUES.values())
    scene = frictional("Torsional stiffness of a ball", paraboloid(STEEL), STEEL, *steps)
    slopes = [end.torsional_stiffness for end in exact]
    return Problem(
        _requested(scene),
        tuple(Stiffness(HERTZ.normal_stiffness, 0.0, slope) for slope in slopes),
        HERTZ.contact_radius,
        SOURCE,
        scales={OVER_STICK: slopes[0]},
        equations=(r"\frac{dM}{d\varphi} = \tfrac{16}{3} G c^3",),
    )


def contact_stiffness(level: Level = Level.QUICK) -> Case:
    """Create the verification case of contact stiffnesses on cells, elements and rings.

    Normal, tangential and torsional stiffness are compared with closed forms in full stick, partial
    slip, after a load reversal, and in gross slip.
    """
    cells, elements = (128, 32) if level is Level.QUICK else (256, 64)

    slid = FORCES | GROSS_SLIP
    push, slide, twist = pushed(tuple(FORCES.values())), pushed(tuple(slid.values())), twisted()
    on_meshes = with_edge_at(slide, (elements,)), with_edge_at(twist, (elements,), of="torsion")
    return case(
        "contact_stiffness",
        "Contact stiffness",
        "The paper's ball under 1 kN is pushed by 0.5 and 0.9 µW, pulled by 0.9 µW and by µW, and "
        "twisted by 0.5 and 0.9 of the torque at gross slip. At the end of each step the solver "
        "states the derivatives of normal force, tangential force and torque.",
        judged(on_cells(slide, (cells,)), _of_push(slid, part_of_side(0.25), STAIRCASE)),
        judged(on_cells(twist, (cells,), of="torsion"), _of_twist(part_of_side(0.75), STAIRCASE)),
        judged(on_meshes[0], _of_push(slid, part_of_side(0.5), NODES)),
        judged(on_meshes[1], _of_twist(part_of_side(1.5), NODES)),
        judged(on_radii(push, "rings"), _of_push(FORCES, 0.5 / 24, RINGS)),
        judged(on_radii(twist, "torsion on discs"), _of_twist(1e-9, IDENTITY)),
        no_order="the edges of contact and stick zone have any position in a cell; other cases "
        "judge the orders of the radii, to which the stiffnesses are proportional",
        shows=("contact stiffness",),
    )


def _of_push(parts: Mapping[int, float], allowed: Allowed, because: str) -> Sequence[Row]:
    along = at_stops(parts, "µW", Within(TANGENTIAL, allowed, because))
    return Within(NORMAL, allowed, because), *along


def _of_twist(allowed: Allowed, because: str) -> Sequence[Row]:
    return at_stops(TORQUES, "of the sliding torque", Within(TORSIONAL, allowed, because))
