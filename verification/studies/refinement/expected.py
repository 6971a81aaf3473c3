"""Orders of convergence that theory, or a measurement on known solutions, leads one to expect."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from contact_scene import Ellipsoid, Paraboloid, Scene, Sphere
from semi_analytical import Coupling, Plan

SHEAR = "shear"


@dataclass(frozen=True)
class Expected:
    """An order p of h^p, and why."""

    order: float
    because: str


FIRST_ORDER = Expected(
    1.0,
    "an increment decides once what slips, and where to (backward Euler): first order where the "
    "direction of slip changes along the path",
)
SELF_SIMILAR = Expected(
    2.0,
    "slip keeps its direction while the contact grows; what the increments miss of the stick zone "
    "alternates and cancels in a mean",
)
STUCK_SHEAR = Expected(
    1.5,
    "the shear of a ring is fixed where the edge of stick passes; next to it the shear leaves the "
    "friction limit as a square root: O(√h) on bands of width h",
)
EDGE_SHEAR = Expected(
    1.5,
    "square-root edges of stick zone and contact: O(√h) on rings one cell wide leaves O(h^3/2) in "
    "L1",
)
MEAN = Expected(
    2.0, "a weighted mean of the displacement: errors at the edges alternate and cancel"
)
RADIUS = Expected(1.0, "the edge is known to a part of a cell")
PEAK = Expected(
    2.0, "even counts of cells put the centre h/√2 from the next cell centre, on a smooth top"
)


def by_increments(scene: Scene, plan: Plan) -> Mapping[str, Expected]:
    """Orders in the increment size, by the names of `named_values` and SHEAR.

    Orders are expected at the end of the last step, and first order everywhere once something
    pushes sideways.
    """
    ramps = scene.load_path()
    sideways = any(any(r.tangential.end) or r.twisting.end != 0 for r in ramps)
    names = ("approach", "peak_pressure", "contact_radius", "dissipated_energy", "twist", "torque")
    pairs = ("tangential_shift", "tangential_force")
    named = (*names, *(f"{name}_{axis}" for name in pairs for axis in "xy"))
    if sideways or len(ramps) > 1:
        return dict.fromkeys((*named, SHEAR, "stick_radius", "normal_force"), FIRST_ORDER)
    if plan.coupling is Coupling.NONE:
        return {}
    averaged = dict.fromkeys(("approach", "normal_force", "contact_radius"), SELF_SIMILAR)
    return {**averaged, SHEAR: STUCK_SHEAR}


def by_mesh(scene: Scene, plan: Plan) -> Mapping[str, Expected]:
    """Orders in the cell side, by the names of `named_values` and SHEAR; of smooth shapes only."""
    if not isinstance(scene.indenter, Sphere | Paraboloid | Ellipsoid):
        return {}
    orders = {"approach": MEAN, "contact_radius": RADIUS, "stick_radius": RADIUS}
    orders |= dict.fromkeys(("tangential_shift_x", "tangential_shift_y", "twist"), MEAN)
    orders[SHEAR] = EDGE_SHEAR
    if plan.coupling is Coupling.NONE:
        orders["peak_pressure"] = PEAK
    return orders
