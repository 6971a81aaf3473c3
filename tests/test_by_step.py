"""Increments are chosen step by step: each leaves its own part of an error."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import PRESS, RIGID_BALL, scene, steel
from hypothesis import given
from hypothesis import strategies as st

from contact_errors import on_elements
from contact_errors.by_step import MOST_APART, ByStep, fewest
from contact_errors.growth import AIM, growth
from contact_errors.ladder import Rung
from contact_errors.rules import APPROACH, Rule
from contact_scene import FiniteElementDiscretisation
from contact_scene.stated_error import ErrorStatus, StatedError, StatedErrors
from fem_reference import Method, solve

NAME = "approach"


class History:
    """A number that misses Σ c/n at the end of every step, c of that and of every step so far."""

    def __init__(self, missed: Sequence[Sequence[float]]) -> None:
        self.missed = np.array(missed)
        self.solved: list[tuple[int, ...]] = []

    def values(self, counts: Sequence[int]):
        self.solved.append(tuple(counts))
        return [
            {NAME: np.atleast_1d(1 + size)}
            for size in self.missed @ np.reciprocal(counts, dtype=float)
        ]

    def by_step(self, counts: tuple[int, ...], matters: tuple[bool, ...] | None = None) -> ByStep:
        cut = ByStep(counts, matters or (True,) * len(counts))
        companions = self.values(counts), self.values(cut.recut_from(0))
        self.solved.clear()
        return replace(cut, companions=companions, solved=self.values)


def test_steps_that_undo_each_other_leave_what_each_leaves_alone() -> None:
    """Halves of the increments change the number by the errors .03 and -.04, together by .01."""
    by_step = History([[0.3, 0.0], [0.3, -0.4]]).by_step((10, 10))
    assert by_step.together is not None
    assert by_step.by_squares is not None
    assert by_step.together[1][NAME] == pytest.approx(0.01)
    assert by_step.by_squares[1][NAME] == pytest.approx(0.05)
    assert by_step.by_squares[0][NAME] == pytest.approx(by_step.together[0][NAME])


@given(
    st.lists(st.tuples(st.floats(0, 1), st.integers(1, 1000)), min_size=1, max_size=5),
    st.floats(1e-4, 1),
)
def test_what_all_steps_leave_together_is_bounded_with_no_more_increments_than_alike(
    steps: list[tuple[float, int]], most: float
) -> None:
    left = {n: size for n, (size, _) in enumerate(steps)}
    counts = [count for _, count in steps]
    factors = fewest(left, counts, most)
    assert all(by >= 1 - 1e-9 for by in factors.values())
    assert sum(size / factors.get(n, 1.0) for n, size in left.items()) <= most * (1 + 1e-9)
    alike = max(1.0, sum(left.values()) / most)
    taken = sum(count * factors.get(n, 1.0) for n, count in enumerate(counts))
    assert taken <= alike * sum(counts) * (1 + 1e-9)
    assert not {n for n, size in left.items() if size == 0} & set(factors)


def test_a_worked_example_of_the_fewest() -> None:
    # √(0.04·100) + √(0.01·400) = 4 over 0.02: 200 √(b/n) = 4 and 1, which leave 0.01 each.
    assert fewest({0: 0.04, 1: 0.01}, (100, 400), 0.02) == pytest.approx({0: 4.0, 1: 1.0})
    # 3.1 over 0.01 would cut the second by 0.31: it keeps its own, and leaves 0.0099 to the first.
    assert fewest({0: 0.09, 1: 0.0001}, (100, 100), 0.01) == pytest.approx({0: 0.09 / 0.0099})


@pytest.mark.parametrize("counts", [(20, 30), (2, 30), (20, 3), (1, 1)])
def test_every_step_has_the_part_that_it_left(counts: tuple[int, int]) -> None:
    """Be it seen at its own end or, of the first, at that of the second alone."""
    history = History([[0.0, 0.0], [3.0, 1.0]])
    by_step = history.by_step(counts)
    left = np.divide([3.0, 1.0], counts)
    shares = by_step.shares(NAME, 1)
    assert shares[0] / shares[1] == pytest.approx(left[0] / left[1])
    assert sum(shares.values()) >= 1 - 1e-9
    assert set(by_step.shares(NAME, 0)) == {0}


def test_what_cancels_today_is_counted_in_full() -> None:
    """More increments of one step alone would leave what the other has done."""
    shares = History([[1.0, 0.0], [1.0, -0.5]]).by_step((20, 20)).shares(NAME, 1)
    assert shares == pytest.approx({0: 2.0, 1: 1.0})
    hardly = History([[1.0, 0.0], [1.0, -0.999]]).by_step((20, 20)).shares(NAME, 1)
    assert sum(hardly.values()) == pytest.approx(4.0)


def test_companions_are_solved_for_what_is_asked_and_few_of_them() -> None:
    history = History(np.tril(np.ones((9, 9))))
    by_step = history.by_step((20,) * 9, (False, *[True] * 8))
    assert history.solved == []
    shares = by_step.shares(NAME, 8)
    assert len(history.solved) == MOST_APART - 1
    assert shares == pytest.approx(dict.fromkeys(range(1, 9), 1 / 8))
    by_step.shares(NAME, 5)
    assert len(history.solved) == MOST_APART - 1
    alone = History([[0.0, 0.0], [0.0, 1.0]])
    assert alone.by_step((20, 20), (False, True)).shares(NAME, 1) == {1: 1.0}
    assert alone.solved == []


def test_steps_that_nothing_tells_apart_are_alike() -> None:
    assert ByStep((10, 30), (True, True)).shares(NAME, 1) == {0: 0.25, 1: 0.75}
    refused = replace(History([[1.0, 0.0], [1.0, 1.0]]).by_step((10, 30)), solved=lambda _: None)
    assert refused.shares(NAME, 1) == {0: 0.25, 1: 0.75}


def rung_of(history: History, counts: tuple[int, int], rule: Rule, space: float) -> Rung[None]:
    """Whose increments are told by their companions alone."""
    by_step = history.by_step(counts)
    steps = []
    for change in by_step.together:
        parts = {"cells": space, "increments": float(change[NAME][0])}
        error = StatedError(error=sum(parts.values()), parts=parts, status=ErrorStatus.ESTIMATED)
        steps.append({NAME: error})
    values = [{NAME: np.ones(1)}] * 2
    stated = StatedErrors(tuple(steps), ())
    return Rung(None, None, stated, values, {NAME: rule}, by_step, 1.0, 1.0)


@given(
    st.floats(0, 10), st.floats(0, 10), st.floats(0, 10), st.floats(1e-6, 0.1), st.floats(1e-3, 0.1)
)
def test_the_next_rung_leaves_what_was_asked(
    early: float, carried: float, late: float, space: float, share: float
) -> None:
    """Cells and increments together, whichever step has missed what, and hardly less."""
    history, counts, rule = History([[early, 0.0], [carried, late]]), (20, 30), Rule(2, 0.1, 0, 1.5)
    by = growth(rung_of(history, counts, rule, space), {NAME: share})
    finer = np.multiply(counts, [by.increments.get(n, 1.0) for n in range(2)])
    left = history.missed @ (1 / finer) + space / by.cells**2
    assert np.all(left <= AIM * share * (1 + 1e-6))
    if by.increments:
        assert np.max(left) == pytest.approx(AIM * share)


def test_a_step_that_decides_what_the_next_one_ends_with_is_refined() -> None:
    rung = rung_of(History([[0.0, 0.0], [9.0, 0.0]]), (20, 30), APPROACH, 0.0)
    assert set(growth(rung, {NAME: 0.01}).increments) == {0}
    rung = rung_of(History([[0.0, 0.0], [0.0, 9.0]]), (20, 30), APPROACH, 0.0)
    assert set(growth(rung, {NAME: 0.01}).increments) == {1}


def test_elements_tell_their_steps_apart_too() -> None:
    """A rigid ball that is pressed with friction, first half as hard: what is open of the energy
    that it has lost in the end is of the first increments, which touch most of the contact."""
    half = {"normal_force": 0.5 * PRESS["normal_force"], "increments": 8}
    of = scene(half, PRESS | {"increments": 8}, indenter=RIGID_BALL, body=steel())
    mesh = FiniteElementDiscretisation(elements_per_radius=8)
    _, by_step = on_elements.judged(solve(of, mesh, Method.COMPLEMENTARITY))
    assert by_step.matters == (True, True)
    assert by_step.shares("dissipated_energy", 0) == {0: pytest.approx(1.0)}
    shares = by_step.shares("dissipated_energy", 1)
    assert shares[0] > 2 * shares[1]
    assert sum(shares.values()) >= 1 - 1e-9
