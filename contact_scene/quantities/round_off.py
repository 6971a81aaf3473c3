"""Round-off of scalars: sizes below which a number is not a result but an error of the solve."""

from collections.abc import Sequence

from contact_scene.quantities.increment import State

# Round-off, shown as 0: relative to the largest component of a vector, or to `natural_size`.
ROUND_OFF = 1e-9


def natural_size(ends: Sequence[State], unit: str) -> float:
    """Estimate the magnitude of a contact quantity from its unit and the loads of a history.

    The estimate is the largest normal force W for "N", W times contact radius a for "N m", the
    approach ω_z for "m", W ω_z for "J", and ω_z/a for "rad". Other units, and unloaded contacts,
    give 0. Values that are much smaller than the estimate are round-off.

    ends  states at the ends of the load steps
    unit  SI unit of the quantity
    """
    force, radius, approach = (
        max((abs(getattr(end, name) or 0.0) for end in ends), default=0.0)
        for name in ("normal_force", "contact_radius", "approach")
    )
    sizes = {"N": force, "N m": force * radius, "m": approach, "J": force * approach}
    slope = approach / radius if radius else 0.0
    return (sizes | {"rad": slope}).get(unit, 0.0)
