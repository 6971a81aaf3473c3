"""What a load cycle does to the surface, from a result on a section.

The definitions are those of `semi_analytical.fretting`: at every place the slip amplitude is half
the range of slip, and Ruiz's first parameter the largest shear times that (Ruiz, Boddington and
Chen 1984).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from contact_scene.cycles import LoadCycle, load_cycles
from fem_reference import Increment, Result

Field = NDArray[np.float64]


@dataclass(frozen=True)
class SectionCycle:
    """One closed cycle of loads; largest values over the surface.

    dissipated_energy  in the cycle [force length]
    slip_amplitude     [length]
    ruiz_f1            [force/length]
    """

    cycle: LoadCycle
    dissipated_energy: float
    slip_amplitude: float
    ruiz_f1: float


def section_cycles(result: Result) -> tuple[SectionCycle, ...]:
    """All cycles with shear and with defined slip, in the order in which they end."""
    found = []
    for cycle in load_cycles(result.scene.load_path()):
        path = [
            i
            for i in result.increments
            if cycle.start < i.step <= cycle.end
            or (i.step == cycle.start and i.index == i.increments_in_step)
        ]
        start, end = path[0].dissipated_energy, path[-1].dissipated_energy
        if start is None or end is None:
            continue
        amplitude = _half_range([slip_vector(i) for i in path])
        shears = np.broadcast_arrays(*(np.linalg.norm(shear_vector(i), axis=0) for i in path))
        f1 = float(np.max(amplitude * np.max(shears, axis=0)))
        found.append(SectionCycle(cycle, end - start, float(np.max(amplitude)), f1))
    return tuple(found)


def shear_vector(increment: Increment) -> Field:
    """Components (3, rings, angles or 1) outward, circumferential and along the load; the last
    excludes the first two [force/length^2]."""
    return _vector(
        increment,
        (increment.shear_radial, increment.shear_circumferential, increment.shear_along_load),
    )


def slip_vector(increment: Increment) -> Field:
    """Slip since the start of the history, components alike [length]."""
    return _vector(
        increment,
        (increment.slip_radial, increment.slip_circumferential, increment.slip_along_load),
    )


def _vector(increment: Increment, parts: Sequence[Field | None]) -> Field:
    rings = len(increment.radii)
    vector = np.zeros((3, rings, increment.pressure.size // rings))
    for component, part in zip(vector, parts, strict=True):
        if part is not None:
            component[:] = part.reshape(rings, -1)
    return vector


def _half_range(vectors: Sequence[Field]) -> Field:
    """Half the largest distance between any two."""
    places = np.broadcast_arrays(*vectors)
    return 0.5 * np.max(
        [np.linalg.norm(one - other, axis=0) for one, other in combinations(places, 2)], axis=0
    )
