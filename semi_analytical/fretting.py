"""What a load cycle does to the surface: slip amplitude, dissipated energy, and Ruiz's parameters.

Ruiz, Boddington and Chen (1984, Exp. Mech. 24, 208-217) rank places of a fretting contact by the
work of friction, F1 = τ δ, and by its product with the tension along the surface, F2 = σ_T τ δ.
Here, at every place, δ is half the range of slip over one cycle, τ the largest shear and σ_T the
largest tension within it. Authors who take the whole range for δ get twice these numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body, Scene
from contact_scene.cycles import LoadCycle, load_cycles
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Vector = NDArray[np.float64]
Value = TypeVar("Value", float, Field)

# Changes of the tangential force below this part of Σ|q| Δ are round-off and have no direction.
ROUND_OFF = 1e-9
CELLS_AT_ONCE = 4096


@dataclass(frozen=True)
class FrettingCycle:
    """One closed cycle of loads; fields are (nx, ny).

    cycle              steps between which it lies
    input_work         of the loads in the cycle, the area of their loops over the motions
                       [force length]
    dissipated_energy  by friction in the cycle [force length]
    dissipation        the same per area [force/length]
    slip_amplitude     δ, half the largest distance between two slips in the cycle [length]
    largest_shear      τ, largest |q| in the cycle [force/length^2]
    surface_tension    σ_T, largest stress of the surface along the direction in which the
                       tangential force changes, at the ends of the steps in the cycle; tension
                       positive [force/length^2]. None if not asked for, or if the force is constant
    """

    cycle: LoadCycle
    input_work: float
    dissipated_energy: float
    dissipation: Field
    slip_amplitude: Field
    largest_shear: Field
    surface_tension: Field | None = None

    @property
    def ruiz_f1(self) -> Field:
        """F1 = τ δ [force/length]."""
        return self.largest_shear * self.slip_amplitude

    @property
    def ruiz_f2(self) -> Field | None:
        """F2 = σ_T τ δ [force^2/length^3], zero under compression; None without σ_T."""
        if self.surface_tension is None:
            return None
        return np.maximum(self.surface_tension, 0.0) * self.ruiz_f1


def fretting_cycles(result: Result, *, surface_stress: bool = False) -> tuple[FrettingCycle, ...]:
    """All cycles that the loading steps close, in the order in which they end.

    A cycle in which the friction limit is reached under force control has no defined slip and is
    left out; so are all where nothing is sheared.

    surface_stress  also compute the stress at the surface, which σ_T and F2 need: of the lower
                    body, or of the indenter where that one is rigid
    """
    return tuple(_each_cycle(result, surface_stress))


def _each_cycle(result: Result, surface_stress: bool) -> Iterator[FrettingCycle]:
    stresses: dict[int, Field] = {}
    for cycle in load_cycles(result.scene.load_path()):
        path = _path(result.increments, cycle)
        if any(increment.dissipation is None for increment in path):
            continue
        tension = None
        direction = _direction(path, result.grid.cell_area) if surface_stress else None
        if direction is not None:
            stresses = {step: s for step, s in stresses.items() if step >= cycle.start}
            ends = [i for i in path if i.index == i.increments_in_step]
            for end in ends:
                if end.step not in stresses:
                    stresses[end.step] = _in_plane_stress(result.scene, result.grid, end)
            along = [_along(direction, stresses[end.step]) for end in ends]
            tension = np.max(along, axis=0)
        yield _fretting_cycle(cycle, path, tension)


def _path(increments: Sequence[Increment], cycle: LoadCycle) -> list[Increment]:
    """The increments of a cycle, from the one at whose end it begins."""
    return [
        i
        for i in increments
        if cycle.start < i.step <= cycle.end
        or (i.step == cycle.start and i.index == i.increments_in_step)
    ]


def _fretting_cycle(
    cycle: LoadCycle, path: Sequence[Increment], tension: Field | None
) -> FrettingCycle:
    start, end = path[0], path[-1]
    slips = [i.slip for i in path if i.slip is not None]
    shears = [np.hypot(*i.shear) for i in path if i.shear is not None]
    return FrettingCycle(
        cycle=cycle,
        input_work=_gain(start.input_work, end.input_work),
        dissipated_energy=_gain(start.dissipated_energy, end.dissipated_energy),
        dissipation=_gain(start.dissipation, end.dissipation),
        slip_amplitude=_slip_amplitude(slips),
        largest_shear=np.max(shears, axis=0),
        surface_tension=tension,
    )


def _gain(start: Value | None, end: Value | None) -> Value:
    """What is known at both ends, without the first."""
    assert start is not None
    assert end is not None
    return end - start


def _slip_amplitude(slips: Sequence[VectorField]) -> Field:
    """Half the largest distance between any two of the slips, cell by cell."""
    moves = np.any([np.any(slip != slips[0], axis=0) for slip in slips], axis=0)
    amplitude = np.zeros(moves.shape)
    paths = np.stack([slip[:, moves] for slip in slips])
    parts = [
        _half_diameter(paths[..., first : first + CELLS_AT_ONCE])
        for first in range(0, paths.shape[-1], CELLS_AT_ONCE)
    ]
    if parts:
        amplitude[moves] = np.concatenate(parts)
    return amplitude


def _half_diameter(path: NDArray[np.float64]) -> Vector:
    """Of sets of points (points, 2, sets), half the largest distance in each set."""
    largest = np.zeros(path.shape[-1])
    for n in range(1, len(path)):
        x, y = np.moveaxis(path[n] - path[:n], 1, 0)
        largest = np.maximum(largest, np.max(x * x + y * y, axis=0))
    return 0.5 * np.sqrt(largest)


def _direction(path: Sequence[Increment], cell_area: float) -> Vector | None:
    """Unit vector along the largest change of the tangential force since the cycle began."""
    force = np.array([increment.tangential_force for increment in path])
    changes = force - force[0]
    sizes = np.hypot(changes[:, 0], changes[:, 1])
    carried = max(float(np.sum(np.hypot(*i.shear))) for i in path if i.shear is not None)
    if np.max(sizes) <= ROUND_OFF * carried * cell_area:
        return None
    return np.asarray(changes[np.argmax(sizes)] / np.max(sizes))


def _in_plane_stress(scene: Scene, grid: SurfaceGrid, end: Increment) -> Field:
    """σ_xx, σ_yy, σ_xy (3, nx, ny) at z = 0, tension positive."""
    # Not even imported unless asked for.
    from semi_analytical.stress import subsurface

    body, shear = scene.body, end.shear
    if not body.deforms:
        body = Body(material=scene.indenter.material, layers=scene.indenter.layers)
        shear = None if shear is None else -shear
    stress = subsurface(body, grid, end.pressure, shear, (0.0,)).stress[0]
    return np.asarray(stress[[0, 1, 5]])


def _along(direction: Vector, stress: Field) -> Field:
    """n·σ n."""
    (x, y), (xx, yy, xy) = direction, stress
    return np.asarray(x * x * xx + y * y * yy + 2 * x * y * xy)
