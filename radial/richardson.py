"""Richardson extrapolation (Richardson 1911) of a load history to infinitely many increments.

The increment error of a contact with tangential load is of first order in the length of the
increments. The extrapolated value is therefore twice the value of the history with doubled
increments minus the value of the planned history. The work of the loads (trapezoidal rule)
converges faster and is taken from the finer history. Fields, peak pressure and stick radius are
also those of the finer history.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from radial.fields import Increment
from radial.plan import Plan

# Extrapolated scalars. Prescribed values are equal in both histories.
EXTRAPOLATED = (
    *("normal_force", "approach", "contact_radius", "tangential_force", "tangential_shift"),
    *("torque", "twist", "dissipated_energy", "elastic_energy"),
    *("actuator_approach", "actuator_shift"),
)


def doubled(plan: Plan) -> Plan:
    """Return a plan with twice the number of increments in every load step.

    The finer load history is used for the extrapolation to infinitely many increments.
    """
    return replace(plan, increments=tuple(2 * count for count in plan.increments))


def extrapolated(coarse: Increment, fine: Increment) -> Increment:
    """Extrapolate the scalars of an increment to infinitely many increments per load step.

    Energies are kept at or above zero. Fields are those of `fine`.

    coarse  increment of the planned history
    fine    increment at the same loads, of the history with twice the number of increments
    """
    values = {name: _limit(getattr(coarse, name), getattr(fine, name)) for name in EXTRAPOLATED}
    for energy in ("elastic_energy", "dissipated_energy"):
        values[energy] = max(values[energy], 0.0)  # extrapolation can give negative energies
    stored, dissipated = values["elastic_energy"], values["dissipated_energy"]
    assert fine.trapezoidal_work is not None
    assert fine.dissipated_energy is not None
    values["input_work"] = stored + dissipated
    values["unresolved_work"] = fine.trapezoidal_work - stored - dissipated
    values["dissipation_uncertainty"] = abs(fine.dissipated_energy - dissipated)
    spent = fine.iterations + coarse.iterations
    return replace(
        fine, **values, index=coarse.index, increments_in_step=coarse.increments_in_step,
        iterations=spent,
    )  # fmt: skip


def _limit(coarse: Any, fine: Any) -> Any:
    """Extrapolate a value to zero length of the load increments: 2 `fine` - `coarse`.

    The error is of first order in the length of the increments. Tuples are extrapolated by
    component. None (a quantity that the scene lacks) is returned as None.

    coarse  value with the planned number of increments
    fine    value with twice this number
    """
    if isinstance(fine, tuple):
        return tuple(_limit(*pair) for pair in zip(coarse, fine, strict=True))
    return fine if fine is None else 2 * fine - coarse
