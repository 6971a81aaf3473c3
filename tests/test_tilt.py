"""Tilt: where the force acts, the contact is; and what cannot be carried."""

import numpy as np
import pytest
from contact_scenes import (
    LOAD,
    PRESS,
    RADIUS,
    A,
    bump,
    grid,
    paraboloid,
    push,
    scene,
)
from rotations import GRID, PUNCH, TOLERANCE, close, end, lean, roll

from contact_scene import HeightMap, SceneError, SurfaceDiscretisation
from semi_analytical import (
    ContactAtWindowEdge,
    ContactNotResolved,
    SurfaceGrid,
    solve,
)
from semi_analytical.discretise import discretise


def test_reciprocity_of_force_and_moment():
    """The ball rolls: dω_z/dM = dφ/dW, both - M/(W²R)."""
    d = 1e-3

    def state(load, moment):
        return end({"normal_force": load, "moment": (0.0, moment)}, friction=None)

    M = 0.3 * A * LOAD
    by_moment = (state(LOAD, (1 + d) * M).approach - state(LOAD, (1 - d) * M).approach) / (
        2 * d * M
    )
    by_load = (state((1 + d) * LOAD, M).tilt[1] - state((1 - d) * LOAD, M).tilt[1]) / (2 * d * LOAD)
    assert by_moment == pytest.approx(by_load, rel=1e-4)
    # The contact passes over few cells: between two of them it rolls by fits and starts.
    assert by_moment == pytest.approx(-M / (LOAD**2 * RADIUS), rel=0.1)


def test_oscillating_tilt_rolls_the_contact_to_and_fro_and_back():
    """Rolling without slip is reversible; with a sideways load it walks."""
    history = (PRESS, roll(0.3), roll(-0.3), roll(0.0))
    upright, one, other, again = solve(scene(*history, friction=None), GRID, TOLERANCE).steps
    close(again.pressure, upright.pressure, 1e-7 * upright.peak_pressure)
    close(one.pressure, other.pressure[::-1], 1e-7 * upright.peak_pressure)
    cuts = {"increments": 4}
    loaded = solve(
        scene(PRESS, push(0.3), *({**roll(x), **cuts} for x in (0.3, -0.3, 0.0))), GRID, TOLERANCE
    )
    shifts = [step.tangential_shift[0] for step in loaded.steps[1:]]
    assert np.all(np.diff(shifts) > 0)
    assert np.all(np.diff([i.dissipated_energy for i in loaded.increments]) >= 0)


def test_a_force_beyond_the_window_asks_for_a_larger_one():
    with pytest.raises(ContactAtWindowEdge, match="outside the window"):
        end({**PRESS, **lean(3.0)}, friction=None)


def test_a_force_on_the_rim_of_a_punch_tips_it_over():
    with pytest.raises(ContactNotResolved, match="tips over"):
        end({**PRESS, **lean(0.999)}, friction=None, indenter=PUNCH, on=grid(32, 1.1))


@pytest.mark.parametrize("step", [lean(2.0, 1.0), roll(2.0, 1.0)], ids=["moment", "tilt"])
def test_the_chosen_window_holds_a_contact_beside_the_origin(step):
    described = scene({**PRESS, **lean(0.0)}, step, friction=None)
    chosen = discretise(described, SurfaceDiscretisation())
    x, y = chosen.coordinates()
    carries = solve(described, chosen, 1e-6).steps[1].pressure > 0
    assert np.mean(x[carries]) == pytest.approx(2 * A, rel=0.05)
    assert np.mean(y[carries]) == pytest.approx(A, rel=0.05)
    assert np.all(np.array(chosen.window) < 2 * 1.4 * np.array([3 * A, 2 * A]))


def test_a_height_map_carries_moments_within_its_extent():
    cells, spacing = 24, 3 * A / 24
    bowl = HeightMap(file=bump(cells, spacing), spacing=spacing, material=paraboloid().material)
    on = SurfaceGrid((cells, cells), bowl.extent)
    one = end({**PRESS, **lean(0.3)}, friction=None, indenter=bowl, on=on)
    other = end({**PRESS, **lean(0.3)}, friction=None, on=on)
    close(one.pressure, other.pressure, 1e-6 * other.peak_pressure)
    with pytest.raises(SceneError, match="tips over"):
        scene({**PRESS, **lean(1.6)}, friction=None, indenter=bowl)
