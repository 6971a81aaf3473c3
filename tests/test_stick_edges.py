"""Where the shear of two solvers is not compared: at kinks that stick keeps, and nowhere else."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from verification.cases.cross_check import kept_edges, kept_fronts

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
