"""Slip amplitude, dissipated energy and Ruiz's parameters of load cycles.

Ruiz, Boddington and Chen (1984, Exp. Mech. 24, 208-217) rank the points of a fretting contact by
the parameters F1 = τ δ and F2 = σ_T τ δ. At every point, δ is half the range of slip over one
cycle, τ the largest shear, and σ_T the largest tensile stress along the surface in the cycle. With
the full range for δ, both parameters are twice as large.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from itertools import chain, groupby
from typing import TYPE_CHECKING, Annotated, Any, TypeVar, cast

import numpy as np

from contact_results.edge_slip import CycleEdge
from contact_results.loop import loop_numbers
from contact_results.surface import Cells, Surface, surface_of
from contact_scene.array_types import Field, Indices
from contact_scene.quantities.cycles import (
    LoadCycle,
    load_cycles,
)
from contact_scene.quantities.field_metadata import (
    Kind,
    Reported,
)
from contact_scene.quantities.stored_fields import (
    FieldStore,
    WithFields,
)

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result

Value = TypeVar("Value", float, Field)
F = Kind.FIELD

DIRECTIONS = 16  # of slip: the largest distance of two slips is then exact within 0.5 %


@dataclass(frozen=True)
class FrettingCycle(WithFields):
    """Energies and surface fields of one closed load cycle.

    The fields are scalar fields of the surface grid, (nx, ny) on cells.

    cycle            numbers of the load steps at whose ends the cycle begins and closes
    input_work       None if a displacement of the indenter is undefined
    dissipation      None if the solver does not compute this field
    largest_slip     largest slip amplitude in the contact, at its edge [length]
    largest_f1       largest F1 in the contact [force/length]
    largest_f2       largest F2 in the contact [force^2/length^3]; None if σ_T is None
    loop             numbers of the fretting loop from `loop_numbers`, by name
    surface_tension  σ_T of Ruiz [force/length^2]: largest normal stress of the surface along the
                     change of the tangential force, over the ends of the load steps in the cycle;
                     positive if tensile. None on rings, or if the tangential force is constant
    """

    cycle: LoadCycle
    input_work: Annotated[
        float | None,
        Reported("J", "Work of the loads in the cycle, the area of their loops over the motions."),
    ]
    energy_per_cycle: Annotated[float, Reported("J", "Energy lost to friction in the cycle.")]
    dissipation: Annotated[
        Field | None, Reported("J/m^2", "Energy per area lost to friction in the cycle.", F)
    ]
    slip_amplitude: Annotated[Field, Reported("m", "Half the range of slip in the cycle.", F)]
    largest_shear: Annotated[Field, Reported("Pa", "Largest shear in the cycle.", F)]
    largest_slip: float
    largest_f1: float
    largest_f2: float | None
    surface_tension: Annotated[
        Field | None,
        Reported("Pa", "Largest stress of the surface along the change of tangential force.", F),
    ] = None
    loop: Mapping[str, Any] = field(default_factory=dict)

    @property
    def numbers(self) -> dict[str, Any]:
        """Scalars of the load cycle for the summary of a run.

        The names are those of `contact_scene.quantities.summary.ClosedCycle`. A field is
        represented by its largest value in the contact. The slip amplitude is fitted near the edge,
        F1 on rings and F2 on cells, too.
        """
        return {
            "cycle_start": self.cycle.start,
            "energy_per_cycle": self.energy_per_cycle,
            "slip_amplitude": self.largest_slip,
            "ruiz_f1": self.largest_f1,
            "ruiz_f2": self.largest_f2,
            **self.loop,
        }

    @property
    def ruiz_f1(self) -> Annotated[Field, Reported("Pa m", "Largest shear times amplitude.", F)]:
        """Ruiz's parameter F1 = τ δ: largest shear times slip amplitude [force/length]."""
        return self.largest_shear * self.slip_amplitude

    @property
    def ruiz_f2(
        self,
    ) -> Annotated[
        Field | None,
        Reported(
            "Pa^2 m", "F1 times the tensile stress along the surface, zero under compression.", F
        ),
    ]:
        """Ruiz's parameter F2 = σ_T τ δ [force^2/length^3]; None if σ_T is None.

        F2 is zero where σ_T is compressive.
        """
        if self.surface_tension is None:
            return None
        return np.maximum(self.surface_tension, 0.0) * self.ruiz_f1


# Cycles of the results that are in use, by the identity of the result: errors, files and sweeps
# need the cycles of one result, whose computation takes up to a tenth of the solve.
_KEPT: dict[int, tuple[FrettingCycle, ...]] = {}


def fretting_cycles(result: Result) -> tuple[FrettingCycle, ...]:
    """Return energies and fields of all closed load cycles of a result, ordered by their ends.

    They are computed once for a result and kept as long as the result.
    """
    key = id(result)
    if key not in _KEPT:
        _KEPT[key] = _compute_cycles(result)
        weakref.finalize(result, _KEPT.pop, key)
    return _KEPT[key]


def _compute_cycles(result: Result) -> tuple[FrettingCycle, ...]:
    """Compute energies and fields of all closed load cycles of a result, ordered by their ends.

    Cycles that contain an increment without dissipated energy are omitted: cycles without shear,
    and cycles that reach the friction limit under force control, whose slip is undefined.

    On cells, σ_T and F2 require the stress at the surface of the lower body, or of the indenter if
    the lower body is rigid. This stress adds 2 to 5 % to the time of the solve.
    """
    surface = surface_of(result)
    closed = load_cycles(result.scene.load_path())
    tension: Any = None
    if closed and isinstance(surface, Cells):
        from semi_analytical.surface_tensile_stress import SurfaceTensileStress

        tension = SurfaceTensileStress(cast(Any, result))
    cycles: list[FrettingCycle] = []
    fields = FieldStore()
    increments: Sequence[Increment] = result.increments
    steps = [list(within) for _, within in groupby(increments, lambda i: i.step)]
    for cycle in closed:
        # The path starts with the increment at whose end the cycle begins.
        path = [steps[cycle.start - 1][-1], *chain(*steps[cycle.start : cycle.end])]
        if all(increment.dissipated_energy is not None for increment in path):
            stress = tension.within(path) if tension else None
            found = _fretting_cycle(surface, cycle, path, stress)
            loop = loop_numbers(path, found.energy_per_cycle, result.scene.friction, surface)
            cycles.append(fields.store(replace(found, loop={"from_virgin": not cycles, **loop})))
    return tuple(cycles)


def _fretting_cycle(
    surface: Surface, cycle: LoadCycle, path: Sequence[Increment], tension: Field | None
) -> FrettingCycle:
    """Compute the energies and fields of one load cycle, without the numbers of its loop.

    path     increments of the cycle, preceded by the increment at whose end the cycle begins
    tension  σ_T of Ruiz [force/length^2], see `FrettingCycle`
    """
    start, end = path[0], path[-1]
    shears = (reduce(np.hypot, shear) for shear in _vectors_along_path(surface, path, "shear"))
    dissipated = _change_over_cycle(start.dissipated_energy, end.dissipated_energy)
    assert dissipated is not None
    amplitude = _slip_amplitude(lambda: _vectors_along_path(surface, path, "slip"))
    # The edge of the contact is corrected at the ends of load steps alone.
    ends = [increment for increment in path if increment.index == increment.increments_in_step]
    widest = max(ends, key=lambda end: end.contact_area)
    pressure, report = surface.scalar(widest, "pressure"), getattr(widest, "edge_report", None)
    assert pressure is not None
    corrected = report is not None and report.cause is None
    shear = reduce(np.maximum, shears)
    edge = CycleEdge(surface, corrected, pressure, amplitude, shear, tension, widest.contact_radius)
    return FrettingCycle(
        cycle=cycle,
        input_work=_change_over_cycle(start.input_work, end.input_work),
        energy_per_cycle=dissipated,
        dissipation=_change_over_cycle(
            getattr(start, "dissipation", None), getattr(end, "dissipation", None)
        ),
        slip_amplitude=amplitude,
        largest_slip=edge.largest_amplitude(),
        largest_f1=edge.largest_f1(),
        largest_f2=edge.largest_f2(),
        largest_shear=shear,
        surface_tension=tension,
    )


def _change_over_cycle(start: Value | None, end: Value | None) -> Value | None:
    return None if start is None or end is None else end - start


def _vectors_along_path(surface: Surface, path: Sequence[Increment], name: str) -> Iterator[Field]:
    """Yield the components (2, …) of "shear" or "slip" of the increments that have them."""
    return (found for i in path if (found := surface.vector(i, name)) is not None)


def _slip_amplitude(slips: Callable[[], Iterable[Field]]) -> Field:
    """Compute the slip amplitude: at each point, half the largest distance between two slips.

    The distance is that of the slip vectors at the ends of two increments of one load cycle. For
    each of DIRECTIONS fixed directions, it is the distance of the two slips that are farthest apart
    along this direction; the largest of these distances counts. It is exact for slips on a line,
    and otherwise at most 1 - cos(π/2n) = 0.5 % too small with n directions: a direction differs by
    at most π/2n from that of the largest distance. The directions x and y alone have this bound
    where slips extend along one of them, with a width below tan(π/2n) of their length. Time and
    memory are linear in the increments and in the points.

    slips  function that iterates over the slip vectors of the increments (2, …) [length]
    """
    first = next(iter(slips()))
    moves = reduce(np.logical_or, (np.any(slip != first, axis=0) for slip in slips()))
    amplitude = np.zeros(moves.shape)

    def extend_amplitude(places: Indices, number: int) -> Field:
        """Raise the amplitude of some points to that along a direction; return the extents."""
        angle = np.pi / DIRECTIONS * number
        direction = np.array([np.cos(angle), np.sin(angle)])
        ends = [first.reshape(2, -1)[:, places] for _ in range(2)]
        farthest = [direction @ end for end in ends]
        for slip in slips() if len(places) else ():
            reached = slip.reshape(2, -1)[:, places]
            along = direction @ reached
            for end, most, beyond in zip(ends, farthest, (np.less, np.greater), strict=True):
                new = beyond(along, most)
                np.copyto(most, along, where=new)
                np.copyto(end, reached, where=new)
        apart = 0.5 * np.linalg.norm(ends[1] - ends[0], axis=0)
        amplitude.flat[places] = np.maximum(amplitude.flat[places], apart)
        return np.asarray(farthest[1] - farthest[0])

    places, y = np.flatnonzero(moves), DIRECTIONS // 2
    shorter, longer = np.sort([extend_amplitude(places, number) for number in (0, y)], axis=0)
    wide = places[shorter > np.tan(np.pi / (2 * DIRECTIONS)) * longer]
    for number in range(DIRECTIONS):
        if number not in (0, y):
            extend_amplitude(wide, number)
    return amplitude
