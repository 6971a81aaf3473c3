"""The limit of fine increments, from a history and the same in half as many (Richardson 1911).

What finite increments leave of a pushed contact goes with their length: twice the numbers of the
finer history less those of the coarser have it no more. The work of the loads, by trapezoids, falls
faster and is that of the finer history, and what is left of the balance of energies follows. Fields
are those of the finer history, too, and so are the peak of the pressure and the stick radius, which
goes from ring to ring.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from radial.fields import Increment
from radial.plan import Plan

# What a history leads to; what was prescribed is the same in both.
LED_TO = (
    *("normal_force", "approach", "contact_radius", "tangential_force", "tangential_shift"),
    *("torque", "twist", "dissipated_energy", "elastic_energy"),
    *("actuator_approach", "actuator_shift"),
)


def doubled(plan: Plan) -> Plan:
    """With twice the increments."""
    return replace(plan, increments=tuple(2 * count for count in plan.increments))


def extrapolated(coarse: Increment, fine: Increment) -> Increment:
    """An increment of the limit, from those of both histories at the same loads."""
    values = {name: _limit(getattr(coarse, name), getattr(fine, name)) for name in LED_TO}
    for energy in ("elastic_energy", "dissipated_energy"):
        values[energy] = max(values[energy], 0.0)  # few increments extrapolate beyond zero
    stored, lost = values["elastic_energy"], values["dissipated_energy"]
    assert fine.trapezoidal_work is not None
    assert fine.dissipated_energy is not None
    values["input_work"] = stored + lost
    values["unresolved_work"] = fine.trapezoidal_work - stored - lost
    values["dissipation_uncertainty"] = abs(fine.dissipated_energy - lost)
    spent = fine.iterations + coarse.iterations
    return replace(
        fine, **values, index=coarse.index, increments_in_step=coarse.increments_in_step,
        iterations=spent,
    )  # fmt: skip


def _limit(coarse: Any, fine: Any) -> Any:
    if isinstance(fine, tuple):
        return tuple(_limit(*pair) for pair in zip(coarse, fine, strict=True))
    return fine if fine is None else 2 * fine - coarse
