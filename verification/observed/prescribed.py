"""Comparison of computed loads and motions at the ends of the load steps with the prescribed
ones."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_scene import ControlKind, Scene
from contact_scene.rig import prescribed_motions

if TYPE_CHECKING:
    from contact_scene.stepping.load_path import ScalarControl, VectorControl


def missed(scene: Scene, steps: Sequence[Any]) -> Iterator[float]:
    """Yield the relative deviations from the prescribed loads and motions at the ends of all load
    steps.

    Forces are relative to the normal force, and displacements to the approach. Moments and
    rotations use these scales with the contact radius as arm. Without friction, tangential loads
    and torques are skipped, because no solver computes them.

    scene  scene with the prescribed loads
    steps  last increment of every load step, of any solver
    """
    for ramp, end in zip(scene.load_path(), steps, strict=True):
        force, motion, arm = end.normal_force, abs(end.approach), end.contact_radius
        approach, shift = (getattr(end, name) for name in prescribed_motions(scene.rig))
        yield _missed(ramp.normal, end.normal_force, approach, force, motion)
        if ramp.stretch is not None:
            strain = np.subtract((*end.bulk_strain, end.bulk_shear), ramp.stretch[1])
            yield float(np.max(np.abs(strain))) * arm / motion
        moment, tilt = getattr(end, "moment", None), getattr(end, "tilt", None)
        yield _missed(ramp.tilting, moment, tilt, force * arm, motion / arm)
        if scene.friction is None:
            continue
        yield _missed(ramp.tangential, end.tangential_force, shift, force, motion)
        yield _missed(ramp.twisting, end.torque, end.twist, force * arm, motion / arm)


def _missed(
    control: ScalarControl | VectorControl, force: Any, motion: Any, *scales: float
) -> float:
    """Compute the relative deviation of one load or motion from its prescribed end value.

    A value that a solver omits counts as zero.

    control  prescribed force or motion of the load step
    force    computed force or moment
    motion   computed displacement or rotation
    scales   scale of the force, and scale of the motion
    """
    by_force = control.kind is ControlKind.FORCE
    found_end, scale = (force, scales[0]) if by_force else (motion, scales[1])
    return (
        float(np.max(np.abs(np.subtract(0.0 if found_end is None else found_end, control.end))))
        / scale
    )


class Imbalance(float):
    """Difference of energies that should balance in an increment, relative to the largest energy so
    far.

    terms  text with the number of the increment, from 1, and the compared energies
    """

    terms: str

    def __new__(cls, number: int, largest: float, difference: float, **terms: float) -> Imbalance:
        """Create the imbalance of one increment from a difference of energies [force length].

        number      number of the increment, from 1
        largest     largest energy so far, the scale of the imbalance
        difference  energy difference that should vanish
        terms       compared energies, by name
        """
        found = super().__new__(cls, abs(difference) / largest)
        texts = (f"{name.replace('_', ' ')} {energy:.6g} J" for name, energy in terms.items())
        found.terms = f"increment {number}: {', '.join(texts)}; difference {difference:.3g} J"
        return found


def largest_of(found: Iterable[float]) -> float:
    """Return the largest of dimensionless numbers; infinite if one is not finite, 0 for no
    numbers."""
    numbers = list(found)
    return max(numbers, default=0.0) if np.all(np.isfinite(numbers)) else float("inf")
