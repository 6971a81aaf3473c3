"""Where the shear of two solvers is not compared: at kinks that stick keeps, and nowhere else."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from verification.cases.cross_check import Line, Pressed, kept_edges, kept_fronts
from verification.problems.paper_scene import HERTZ

RETURNING = Pressed(4.0, 0.25, 0.3, 64, 32)
WIDTH = 1 / 32  # of an element
PLACES = np.arange(6.0)

growths = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20).map(sorted)


@given(radii=growths)
def test_an_edge_that_only_spreads_keeps_one_kink(radii: list[float]) -> None:
    assert kept_edges(radii, 0.0) == (radii[-1],)


@given(inner=st.floats(0.1, 0.5), back=st.floats(0.05, 0.4), steps=st.integers(2, 9))
def test_an_edge_that_comes_back_and_spreads_again_keeps_where_it_turned(
    inner: float, back: float, steps: int
) -> None:
    there = np.linspace(inner, inner + back, steps).tolist()
    path = [*there, *there[::-1], *there]
    assert kept_edges(path, 0.9 * back) == (inner, there[-1])


@given(inner=st.floats(0.1, 0.5), back=st.floats(0.05, 0.4))
def test_coming_back_by_less_than_is_resolved_is_none(inner: float, back: float) -> None:
    assert kept_edges([inner + back, inner, inner + back], 1.1 * back) == (inner + back,)


def test_slip_that_comes_further_in_wipes_the_kink_out() -> None:
    assert kept_edges([0.5, 0.3, 0.6, 0.1, 0.7], 0.05) == (0.1, 0.7)
    assert kept_edges([0.5, 0.3, 0.6, 0.1], 0.05) == (0.1,)


def stuck(*increments: str) -> NDArray[np.bool_]:
    """One character per place: + sticks."""
    return np.array([[place == "+" for place in places] for places in increments])


def test_a_front_is_kept_where_both_sides_stick_on() -> None:
    history = stuck("--++--", "++++++", "++++++")
    assert kept_fronts(PLACES, history, [0, 2]) == [1.5, 3.5]


def test_a_front_is_lost_on_the_side_where_slip_passes() -> None:
    history = stuck("--++--", "+++++-", "++++--", "+++++-")
    assert kept_fronts(PLACES, history, [0, 3]) == [1.5, 4.5]


def test_only_a_load_that_turns_leaves_a_front_behind() -> None:
    history = stuck("--++--", "-++++-", "++++++")
    assert kept_fronts(PLACES, history, [2]) == []


def pushed_after_pressing() -> Line:
    """Stick within 3 of 20 elements while pressing; then all behind the axis sticks."""
    h = HERTZ.contact_radius / 20
    radii, x = h * np.arange(22), h * np.arange(-21, 22)
    pressing, behind = np.arange(22) < 3, np.arange(22) < 10

    def rays(ahead: NDArray[np.bool_], astern: NDArray[np.bool_]) -> NDArray[np.bool_]:
        return np.stack([ahead, astern], axis=1)

    def increments(
        places: NDArray[np.float64], *stick: NDArray[np.bool_]
    ) -> tuple[SimpleNamespace, ...]:
        return tuple(
            SimpleNamespace(step=step, in_stick=one, radii=places, contact_radius=20 * h)
            for step, one in enumerate(stick, 1)
        )

    fem = increments(radii, pressing, rays(np.zeros(22, dtype=bool), behind))
    on_cells = (np.abs(x) < 2.5 * h, (x > -9.5 * h) & (x < -0.5 * h))
    sam = increments(x, *(stick[:, None] for stick in on_cells))
    return Line(
        SimpleNamespace(
            increments=fem, steps=fem, discretisation=SimpleNamespace(elements_per_radius=20)
        ),
        SimpleNamespace(
            increments=sam, steps=sam, grid=SimpleNamespace(x=x, cells=(43, 1), spacing=(h, h))
        ),
        1,
    )


def test_the_line_leaves_out_the_kink_that_a_push_has_frozen() -> None:
    line = pushed_after_pressing()
    places = line.x / line.x[-1] * 21
    kink = np.abs(np.abs(places) - 2.5) < 1
    *_, near = line.left_out.values()
    np.testing.assert_array_equal(near & kink, kink)
    *_, near = replace(line, step=2).left_out.values()
    np.testing.assert_array_equal(near & kink, kink & (line.x < 0))
    assert not np.any(near & (np.abs(places + 5.5) < 1e-9))


@pytest.mark.parametrize("increments", [20, 80])
def test_stick_turns_where_the_coating_says_not_where_increments_do(increments: int) -> None:
    scene = RETURNING.scene
    (press,) = scene.loading
    scene = scene.model_copy(
        update={"loading": (press.model_copy(update={"increments": increments}),)}
    )
    result = replace(RETURNING.on_elements[1], scene=scene).solve()
    unit = RETURNING.frictionless.contact_radius
    radii = [one.stick_radius / unit for one in result.increments]
    turned, end = kept_edges(radii, WIDTH / 4)
    assert turned == pytest.approx(0.0857, abs=WIDTH / 2)  # 128 elements, 80 increments
    assert end == pytest.approx(0.5547, abs=WIDTH)
