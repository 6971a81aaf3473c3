"""Whether steps end under the loads that a scene prescribes for them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_scene import ControlKind, Scene

if TYPE_CHECKING:
    from contact_scene.load_path import ScalarControl, VectorControl


def missed(scene: Scene, steps: Sequence[Any]) -> Iterator[float]:
    """How far the end of every step is from what is prescribed: forces over the normal force,
    motions over the approach, rotations and moments by the contact radius.

    steps  the last increment of every loading step, of either solver
    """
    for ramp, end in zip(scene.load_path(), steps, strict=True):
        force, motion, arm = end.normal_force, abs(end.approach), end.contact_radius
        yield from _missed(ramp.normal, end.normal_force, end.approach, force, motion)
        yield from _missed(
            ramp.tangential, end.tangential_force, end.tangential_shift, force, motion
        )
        yield from _missed(ramp.twisting, end.torque, end.twist, force * arm, motion / arm)
        moment, tilt = getattr(end, "moment", None), getattr(end, "tilt", None)
        yield from _missed(ramp.tilting, moment, tilt, force * arm, motion / arm)


def _missed(
    control: ScalarControl | VectorControl, force: Any, motion: Any, *scales: float
) -> Iterator[float]:
    """Nothing where a solver does not tell: what is not there in a scene, or is not defined."""
    by_force = control.kind is ControlKind.FORCE
    told, scale = (force, scales[0]) if by_force else (motion, scales[1])
    if told is not None:
        yield float(np.max(np.abs(np.subtract(told, control.end)))) / scale
