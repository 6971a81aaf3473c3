"""Output rings, prescribed normal loads of the history, and checks of the contact area.

The solvers of load steps of this package use them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import ceil, log10
from typing import Any

import numpy as np

from contact_scene import Scene
from contact_scene.array_types import Array
from contact_scene.checks.axisymmetric import ELSEWHERE
from contact_scene.rig import compliances
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_stepping import ConvergedIncrement, Solver
from radial.fields import Increment
from radial.normal.disc import Disc
from radial.normal.pressing import (
    NormalContact,
    Target,
)

# OUTSIDE: ratio of the numbers of rings inside and outside the largest contact. REACH: outermost
# radius over that of the largest contact.
OUTSIDE = 4
REACH = 2.0
# Negative pressures below this multiple of the largest pressure, and negative gaps below this
# multiple of the approach, are round-off.
NO_DISC = 1e-9


def largest_targets(scene: Scene) -> Iterator[Target]:
    """Yield the largest normal force and the largest approach that the load steps prescribe.

    Values at the ends of the load steps are compared. If no load step prescribes a force (or an
    approach), no value is yielded for it. Used to place rings over the largest contact.

    scene  contact problem with its load history
    """
    ends = list(targets(scene))
    for by_force in (True, False):
        same = [end for end in ends if (end.force is not None) is by_force]
        if same:
            yield max(same, key=lambda end: end.prescribed_value)


def targets(scene: Scene) -> Iterator[Target]:
    """Yield the normal force or approach that each load step of a scene prescribes at its end.

    Load steps that end without contact are skipped.

    scene  contact problem with its load history
    """
    for ramp in scene.load_path():
        if ramp.normal.end:
            yield target(scene, *ramp.normal.prescribed(1.0, (0.0, 0.0)))


def target(scene: Scene, force: float | None, approach: float | None) -> Target:
    """Create the prescribed normal load of a contact: a normal force, or an approach.

    scene     contact problem, whose rig (test machine) can have a normal spring
    force     normal force; None under a prescribed approach [force]
    approach  approach of the actuator, the far end of the normal spring; None under a prescribed
              force [length]
    """
    return Target(force, approach, compliances(scene.rig)[0])


def output_radii(count: int, largest: Sequence[NormalContact], rim: float | None) -> Array:
    """Return the radii of the rings at which fields are output (n,) [length].

    The rings are denser towards the edge of the largest contact and end at twice its radius. Radii
    with infinite pressure (the axis below a tip, a rim) are omitted.

    count    number of rings within the largest contact
    largest  contacts at the largest prescribed force and approach
    rim      radius of the rim of the indenter; None without a rim [length]
    """
    widest = max((found.contact for found in largest), key=lambda contact: contact.radius)
    inside = np.sin(0.5 * np.pi * np.arange(count + 1) / count)
    inside = inside[1 if widest.profile.apex else 0 : None if rim is None else -1]
    outside = np.arange(1, count // OUTSIDE + 1) / (count // OUTSIDE)
    return np.asarray(widest.radius * np.concatenate([inside, 1 + (REACH - 1) * outside**2]))


@dataclass(frozen=True)
class StepsOnRings(Solver[Any, Increment]):
    """Base class of the solvers of load steps of bodies of revolution.

    scene      the contact problem
    stiffness  true if the contact stiffnesses are computed at the end of each load step
    """

    scene: Scene
    stiffness: bool = field(default=False, kw_only=True)

    def add_stiffness(self, increment: Increment, reached: ConvergedIncrement[Any]) -> Increment:
        """Add the contact stiffnesses to the output of the last increment of a load step.

        increment  output of the increment
        reached    its solved state
        """
        if not self.stiffness or increment.index < increment.increments_in_step:
            return increment
        return replace(increment, **self.contact_stiffness(reached))

    def contact_stiffness(self, reached: ConvergedIncrement[Any]) -> dict[str, Any]:
        """Compute the contact stiffnesses at the end of an increment, by the names of the results.

        reached  solved state at the end of the increment
        """
        raise NotImplementedError

    def undeformed_gap(self, last: Increment, tilt: Any) -> Array:
        """Return the gap of the undeformed surfaces at first contact, at output points [length].

        The shape is that of the increment's gap: (rings,) or (rings, angles).

        last  increment whose rings are used
        tilt  not used, because this solver does not tilt the indenter
        """
        gap = np.asarray(self.scene.indenter.initial_gap(last.radii, 0.0))
        return np.array(np.broadcast_to(gap, last.gap.T.shape).T)


def refuse_no_disc(radii: Array, p: Array, gap: Array) -> None:
    """Raise UnsupportedScene if the contact area is not a single disc.

    The solver assumes a contact disc of one radius. A negative pressure shows that the surfaces
    separate within the disc. A negative gap shows that they touch outside the disc.

    radii  radii of the points (n,) [length]
    p      pressure at the points (n,) [force/length²]
    gap    gap at the points over the approach (n,) [1]
    """
    for wrong, what in (
        (p < -NO_DISC * np.max(p), "separate within the contact"),
        (gap < -NO_DISC, "touch again outside the contact"),
    ):
        if np.any(wrong):
            raise UnsupportedScene(
                f"the surfaces {what}, {radii[np.argmax(wrong)]:.4g} m from the axis. This solver "
                f"requires one circular contact area; {ELSEWHERE}"
            )


def refuse_round_off(contact: Disc, tolerance: float) -> None:
    """Raise UnsupportedScene if round-off keeps the error of a contact above the tolerance.

    The error is that of the integral equation of the frictionless contact, over the approach. The
    function `disc` has increased the number of polynomials until this error decreased no further.

    contact    frictionless contact, with its error
    tolerance  upper bound of every residual [1]
    """
    if contact.residual > tolerance:
        enough = 10.0 ** ceil(log10(contact.residual))
        raise UnsupportedScene(
            f"round-off limits the accuracy for these thin layers of different stiffness: the "
            f"error is {contact.residual:.1g} of the approach and the tolerance is "
            f"{tolerance:.1g}. Use [radial] tolerance = {enough:.0e}, or {ELSEWHERE}"
        )
