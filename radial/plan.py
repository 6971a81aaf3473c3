"""Plan of a solve: physical effects of a scene, numbers of increments, and unsupported scenes.

The checks of unsupported scenes raise UnsupportedScene before the solve. A solve at points on rings
treats a tangential load, or torsion without a closed form. `frictional` is true if friction acts
under a normal load alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import dropwhile

from contact_scene import LoadRamp, Scene, effect
from contact_scene.checks.axisymmetric import (
    ELSEWHERE,
    AxisymmetricLoads,
    refuse_coefficient_map,
)
from contact_scene.effect import Effect
from contact_scene.friction_limit import increments_by_force
from contact_scene.normal_form import normal_form
from contact_scene.quantities.cycles import loop_increments
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.growing_contact import grows_without_slip
from contact_scene.stepping.load_path import first_direction
from radial.angular_grid import RingAngles

# Largest ratio of shear moduli within a body. Larger ratios cause round-off in the results.
MAX_CONTRAST = 1e8
# Number of increments of a path-dependent load step: the error of the shear is then about 1e-4 of
# the friction limit.
PATH_INCREMENTS = 64
# Increments of a load step of a contact with tangential load. PUSHED_INCREMENTS: number if the
# normal load or the twist changes. LARGEST_SHARE: otherwise, largest change of the tangential force
# in an increment over the friction limit.
PUSHED_INCREMENTS = 20
LARGEST_SHARE = 0.05
# RINGS, ANGLES: rings, and angles of a half circle, of a contact at points. ROUND_RINGS: rings of
# an axisymmetric contact at points (torsion).
RINGS = 24
ANGLES = 9
ROUND_RINGS = 64

EDGE = "the contact edge is an unknown of frictional pressing here; use semi-analytical"


@dataclass(frozen=True)
class Plan:
    """Plan of a solve: physical effects that it includes, and its numbers of increments.

    The solver of load steps is chosen by the plan. The effects are pressure, and shear by friction,
    torsion or a tangential load.

    coupled     true if pressure or bulk strain displaces the surfaces relative to each other, so
                that friction acts under a normal load alone
    twists      true with torsion
    pushed      true with a tangential load
    increments  number of increments of each load step
    effects     all effects with reasons, for the output
    direction   unit vector of the first tangential load in x and y; (1, 0) without one
    circle      angles of a contact at points (rings × angles), whose solve treats contact and
                friction together; None if no such solve is necessary
    stiffness   true if the contact stiffnesses are computed at the end of each load step
    fineness    factor on the numbers of polynomials and quadrature points, 1 by default; with
                friction, factor on the numbers of rings, angles and intermediate solves
    """

    coupled: bool
    twists: bool
    pushed: bool
    increments: tuple[int, ...]
    effects: tuple[Effect, ...]
    direction: tuple[float, float] = (1.0, 0.0)
    circle: RingAngles | None = None
    fineness: float = 1.0
    stiffness: bool = False

    @property
    def rings(self) -> int:
        """Number of rings inside the largest contact, without the dense rings at contact edges."""
        return round(self.fineness * (ROUND_RINGS if self.circle is RingAngles.ONE else RINGS))

    @property
    def highest(self) -> int:
        """Highest angular harmonic of pressure and shear in a solve at points on rings."""
        return round(self.fineness * ANGLES)

    @property
    def angles(self) -> int:
        """Number of angles on a ring; 0 without a solve at points on rings."""
        return 0 if self.circle is None else len(self.circle.angles(self.highest))

    @property
    def has_shear(self) -> bool:
        """True if the surfaces carry shear by friction, torsion or a tangential load."""
        return self.coupled or self.twists or self.pushed


def plan(scene: Scene) -> Plan:
    """Determine the physical effects of a scene and the number of increments of each load step.

    Raises UnsupportedScene if the solver does not support the scene.

    scene  contact problem with its load history
    """
    scene = normal_form(scene)
    loads = AxisymmetricLoads.of(scene, MAX_CONTRAST)
    frictional, twists, ramps = loads.frictional, loads.twists, loads.ramps
    pushed = loads.friction and loads.loaded
    circle = _choose_circle(scene, frictional, twists, pushed, loads.curved)
    if frictional or twists or pushed:
        _refuse_friction(scene, frictional, circle)
    is_resolved = "a step pushes sideways" if pushed else "no step pushes sideways"
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene),
        effect.friction(scene),
        Effect("tangential load", pushed, is_resolved),
        Effect("torsion", twists, "a step twists" if twists else "no step twists"),
        effect.strained(scene),
        effect.coupled(scene, loads.couples, loads.why),
        effect.load_history(frictional or twists or pushed),
    )
    loops = loop_increments(ramps) if circle else (1,) * len(ramps)
    increments = tuple(
        ramp.increments or max(of_loop, _path_increments(scene, ramp, circle, frictional))
        for ramp, of_loop in zip(ramps, loops, strict=True)
    )
    moving = EDGE if frictional and circle is None else ""
    return Plan(
        frictional,
        twists,
        pushed,
        increments,
        effects + effect.contact_stiffness(scene, moving),
        first_direction(ramps),
        circle,
        stiffness=bool(scene.contact_stiffness) and not moving,
    )


def _choose_circle(
    scene: Scene, frictional: bool, twists: bool, pushed: bool, curved: bool
) -> RingAngles | None:
    """Choose the angles of a ring; None if no solve at points is necessary.

    A tangential load needs half a circle, or a full one if it is `curved` (not on one line) or acts
    together with torsion. Torsion alone needs one angle, unless its shear has a closed form.
    """
    if pushed:
        return RingAngles.WHOLE if twists or curved else RingAngles.HALF
    if not twists:
        return None
    # The shear of torsion has a closed form if the limit is µp, and the pressure is constant from
    # the first torsion on.
    proportional = scene.friction is not None and scene.friction.uniform is not None
    twisted = dropwhile(lambda ramp: not ramp.twisting.end, scene.load_path())
    changes = any(ramp.normal.start != ramp.normal.end for ramp in twisted)
    return None if proportional and not frictional and not changes else RingAngles.ONE


def _path_increments(
    scene: Scene, ramp: LoadRamp, circle: RingAngles | None, frictional: bool
) -> int:
    """Return the number of increments that the path dependence of friction requires in a load step.

    Without a solve at points, a step is path-dependent if friction acts while the normal load or
    the bulk strain changes. With such a solve, the number is fixed if the normal load or the twist
    changes, or if displacements are prescribed, and otherwise proportional to the change of the
    tangential force over the friction limit.
    """
    presses = ramp.normal.start != ramp.normal.end
    if circle is None:
        return PATH_INCREMENTS if frictional and (presses or ramp.strains) else 1
    if not frictional and grows_without_slip(scene, ramp):
        return 1
    most = PATH_INCREMENTS if circle is RingAngles.ONE else PUSHED_INCREMENTS
    if presses or ramp.twisting.start != ramp.twisting.end:
        return most
    if ramp.tangential.start == ramp.tangential.end:
        return 1
    return increments_by_force(scene.friction, ramp, LARGEST_SHARE, most)


def _refuse_friction(scene: Scene, frictional: bool, circle: RingAngles | None) -> None:
    """Raise UnsupportedScene for µ that varies, except with the radius in a solve at points,
    and for friction below a rim, except for torsion in closed form."""
    assert scene.friction is not None
    refuse_coefficient_map(scene, symmetric=circle is not None)
    if scene.indenter.rim is not None and (frictional or circle):
        raise UnsupportedScene(
            "the scene has friction below an indenter with a rim, where tractions are infinite, "
            f"and this solver requires a smooth edge. Remove [friction], or {ELSEWHERE}"
        )
