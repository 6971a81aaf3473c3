"""The numbers of a result that have an error: scalars of its steps and of the cycles they close."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from contact_scene.increment import SCALARS, State
from contact_scene.reported import reported

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from contact_results.surface import Result

# A scalar is (1,), a vector (2,).
Values: TypeAlias = Mapping[str, NDArray[np.float64]]

PHYSICAL = tuple(name for name, mark in reported(State).items() if mark.physical)
LOST, LOST_IN_CYCLE = "dissipated_energy", "energy_per_cycle"
OF_CYCLES = (LOST_IN_CYCLE, "slip_amplitude", "ruiz_f1", "ruiz_f2")


def values_of(result: Result, cycles: Sequence[FrettingCycle]) -> tuple[Values, ...]:
    """Of every step what is defined at its end, by the names of the summary."""
    closed = {cycle.cycle.end: _of_cycle(cycle) for cycle in cycles}
    return tuple(
        {
            name: np.atleast_1d(np.asarray(value, dtype=float))
            for name, value in (
                {name: getattr(end, name) for name in PHYSICAL} | closed.get(end.step, {})
            ).items()
            if value is not None
        }
        for end in result.steps
    )


def lost_by_steps(
    values: Sequence[Values], cycles: Sequence[FrettingCycle]
) -> tuple[Mapping[str, Mapping[int, float]], ...]:
    """Of every step the energies lost in it and before, by the steps, from 0, that they add up
    over [force length]; nothing of one that is not known."""
    starts = {cycle.cycle.end: cycle.cycle.start for cycle in cycles}
    lost: dict[int, float] = {}
    found: list[Mapping[str, Mapping[int, float]]] = []
    before = 0.0
    for n, here in enumerate(values):
        if LOST not in here:
            found.append({})
            continue
        now = float(here[LOST][0])
        lost[n], before = abs(now - before), now
        of_cycle = {k: size for k, size in lost.items() if k >= starts.get(n + 1, n + 1)}
        found.append({LOST: dict(lost)} | ({LOST_IN_CYCLE: of_cycle} if of_cycle else {}))
    return tuple(found)


def charged_by_increments(
    result: Result, cycles: Sequence[FrettingCycle]
) -> tuple[Mapping[str, float | None], ...]:
    """Of every step by how much increments leave its energies uncertain, so far as increments tell
    that themselves [force length]; None of one that they ought to tell and do not."""
    uncertain = [end.dissipation_uncertainty for end in result.steps]
    starts = {cycle.cycle.end: cycle.cycle.start for cycle in cycles}
    found = []
    for end, after in zip(result.steps, uncertain, strict=True):
        known: dict[str, float | None] = {"input_work": _open_work(end)}
        if after is not None:
            known[LOST] = after
        before = uncertain[starts[end.step] - 1] if end.step in starts else None
        if after is not None and before is not None:
            known[LOST_IN_CYCLE] = after - before
        found.append(known)
    return tuple(found)


def _open_work(end: State) -> float | None:
    """By how much the sum of trapezoids misses the work of the loads, which is all that is stored
    and lost [force length]; None where the balance is not known."""
    lost = 0.0 if end.dissipated_energy is None else end.dissipated_energy
    left = end.unresolved_work
    if left is None:
        if end.input_work is None or end.elastic_energy is None:
            return None
        left = end.input_work - end.elastic_energy - lost
    return abs(left) + (end.dissipation_uncertainty or 0.0)


def _of_cycle(cycle: FrettingCycle) -> dict[str, float | None]:
    f2 = cycle.ruiz_f2
    return {
        "energy_per_cycle": cycle.dissipated_energy,
        "slip_amplitude": float(np.max(cycle.slip_amplitude)),
        "ruiz_f1": float(np.max(cycle.ruiz_f1)),
        "ruiz_f2": None if f2 is None else float(np.max(f2)),
    }


def scale(name: str, values: Values) -> float:
    """Size of the contact in the unit of a number: what a residual is relative to; zero for what
    has none."""
    sizes = {key: float(np.max(np.abs(value))) for key, value in values.items()}
    length, force = sizes["approach"], sizes["normal_force"]
    radius = sizes["contact_radius"]
    by_unit = {
        "m": length,
        "m^2": sizes["contact_area"],
        "N": force,
        "N m": force * radius,
        "rad": length / radius if radius else 0.0,
        "Pa": sizes["peak_pressure"],
        "J": force * length,
    }
    return by_unit.get(SCALARS[name].unit, 0.0) if name in SCALARS else 0.0
