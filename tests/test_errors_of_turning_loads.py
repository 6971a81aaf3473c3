"""Where a push turns, or a torque comes beside it, steps leave errors of either sign in one number:
what other increments of all steps change together is no measure of them."""

from typing import Any

import pytest
from contact_scenes import LOAD, RADIUS, steel

import slipstick
from contact_errors.by_step import undone
from contact_scene import RIGID, CoulombFriction, LoadStep, Paraboloid, Scene

MU = 0.3
LIMIT = MU * LOAD
SLOW = pytest.mark.slow
FINENESS: dict[str, Any] = {
    "semi-analytical": slipstick.SurfaceDiscretisation(cells=(32, 32), edge="off"),
    "radial": slipstick.RadialDiscretisation(rings=8),
}
ALONG, ACROSS, BACK = (LIMIT / 3, 0.0), (0.2 * LIMIT, 0.8 * LIMIT / 3), (-LIMIT / 3, 0.0)


def turned(increments: int, *pushes: tuple[float, float], torque: float | None = None) -> Scene:
    loads: list[dict[str, Any]] = [{"normal_force": LOAD}]
    loads += [{"tangential_force": push} for push in pushes]
    if torque is not None:
        loads.append({"torque": torque})
    return Scene(
        title="pushed this way and that",
        indenter=Paraboloid(radius=RADIUS, material=RIGID),
        body=slipstick.Body(material=steel(0.25)),
        friction=CoulombFriction(coefficient=MU),
        loading=tuple(LoadStep(**load, increments=increments) for load in loads),
    )


def test_steps_undo_what_others_did_where_loads_turn() -> None:
    assert undone(turned(1, ALONG, ACROSS))
    assert undone(turned(1, ALONG, torque=1e-3))
    assert not undone(turned(1, ALONG, BACK))
    assert not undone(turned(1, torque=1e-3))


def solved(solver: str, increments: int) -> Any:
    described = turned(increments, ALONG, ACROSS, torque=0.01)
    return slipstick.solve(described, solver, FINENESS[solver])


@pytest.mark.parametrize("solver", ["semi-analytical", pytest.param("radial", marks=SLOW)])
def test_errors_cover_what_increments_miss(solver: str) -> None:
    """The torque that holds the indenter while the push turns, and the twist by a torque then."""
    result = solved(solver, 4)
    errors = slipstick.stated_errors(result).steps
    exact = solved(solver, 8).steps
    for step, name in ((2, "torque"), (3, "twist")):
        missed = abs(getattr(result.steps[step], name) - getattr(exact[step], name))
        assert missed <= errors[step][name].error
