"""Orders of convergence: what is judged, of runs that share a size, and how it is drawn."""

from functools import cache
from itertools import product
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from verification.cases.case import (
    Case,
    Derived,
    Followed,
    Level,
    OrderOfConvergence,
    Quantity,
    Refinement,
    identity,
)
from verification.cases.catalogue import catalogue
from verification.cases.chart import Look
from verification.cases.convergence_chart import convergence_chart
from verification.cases.orders import LATER, REASONS, SECTION, SURFACE, not_judged
from verification.cases.outcome import Status, Verdict
from verification.cases.verdicts import judge_order, judge_quantity
from verification.convergence import observed_order

SIZES = 0.1 * 2.0 ** (-np.arange(6) / 2)
NAMED = (Followed.PRESSURE, Followed.PEAK_PRESSURE, Followed.APPROACH, Followed.SHIFT)
Place = tuple[Followed, str, Refinement]
PLACES: list[Place] = list(product(Followed, (SURFACE, SECTION), Refinement))


@cache
def judged_at(level: Level) -> frozenset[Place]:
    """What a level judges the order of."""
    return frozenset(
        (
            order.of,
            case.run(order.levels[0]).solver,
            Refinement.MESH if isinstance(order, OrderOfConvergence) else order.refined,
        )
        for case in catalogue(level).values()
        for order in case.orders
    )


def judged(errors: np.ndarray, expected: float) -> Verdict:
    """The verdict on levels with these errors, one run each or several (sizes, runs)."""
    several = np.reshape(errors, (len(SIZES), -1))
    results = {
        f"{n}, {k}": SimpleNamespace(error=error)
        for n, row in enumerate(several)
        for k, error in enumerate(row)
    }
    runs: Any = tuple(
        SimpleNamespace(label=label, solver=SURFACE, spacing=SIZES[int(label.partition(",")[0])])
        for label in results
    )
    order = OrderOfConvergence(
        "order", Followed.SHIFT, "a planted value", tuple(results), lambda result: result.error,
        expected, "planted",
    )  # fmt: skip
    return judge_order(order, Case("planted", "", "", runs, (), orders=(order,)), results)


@pytest.mark.parametrize("place", PLACES, ids=str)
def test_every_order_is_judged_or_has_a_reason_why_not(place: Place) -> None:
    assert (place in judged_at(Level.STANDARD)) != (place in REASONS or place in LATER)
    assert (place in judged_at(Level.FULL)) != (place in REASONS)


@pytest.mark.parametrize(
    "place", list(product(NAMED, (SURFACE, SECTION), [Refinement.MESH])), ids=str
)
def test_headline_quantities_are_judged_on_finer_meshes(place: Place) -> None:
    assert place in judged_at(Level.STANDARD)


def test_a_judged_order_needs_no_reason() -> None:
    verdict = judged(SIZES, 1.0)
    assert verdict.order is not None
    place = (Followed.CONTACT_RADIUS, SECTION, Refinement.MESH)
    assert place in {(gap.of, gap.solver, gap.refined) for gap in not_judged(())}
    order = verdict.order.model_copy(update={"of": place[0], "solver": place[1]})
    outcome: Any = SimpleNamespace(verdicts=(verdict.model_copy(update={"order": order}),))
    assert place not in {(gap.of, gap.solver, gap.refined) for gap in not_judged((outcome,))}


def test_runs_of_one_size_tell_the_order_that_each_alone_hides(rng: np.random.Generator) -> None:
    """Errors that change their sign from run to run, as where a circle falls on the cells."""
    signed = SIZES[:, None] ** 2.5 * np.sin(rng.uniform(0, 2 * np.pi, (len(SIZES), 24)))
    together = judged(signed, 2.5)
    assert together.status is Status.PASS
    assert together.order is not None
    assert together.order.sizes == pytest.approx(SIZES)
    alone = [judged(np.abs(column), 2.5).status for column in signed.T]
    assert alone.count(Status.INCONCLUSIVE) > len(alone) / 2
    assert judged(signed * SIZES[:, None], 2.5).status is Status.FAIL


def test_drawn_line_is_the_judged_one(rng: np.random.Generator) -> None:
    errors = SIZES**1.5 * np.exp(0.1 * rng.standard_normal(len(SIZES)))
    chart = convergence_chart("c", "", "", list(SIZES), {"value": list(errors)}, {"value": 1.5})
    by_look = {curve.look: curve for curve in chart.rows[0][0].curves}
    line, band = by_look[Look.FITTED], by_look[Look.BAND]
    observed = observed_order(list(SIZES), list(errors))
    slope = np.log(line.y[0] / line.y[1]) / np.log(line.x[0] / line.x[1])
    assert slope == pytest.approx(observed.order, rel=1e-3)
    assert f"{observed.order:.2f} ± {observed.half_width:.2f}" in by_look[Look.LEVELS].label
    assert min(band.y) < min(line.y)
    assert max(band.y) > max(line.y)
    assert by_look[Look.SLOPE].label == "slope 1.5"


def test_errors_that_vanish_are_drawn_without_a_line() -> None:
    chart = convergence_chart("c", "", "", list(SIZES), {"value": [0.0] * len(SIZES)}, {})
    assert {curve.look for curve in chart.rows[0][0].curves} == {Look.POINTS}


@pytest.mark.parametrize(
    ("reference", "status", "clearance"), [(0.0, Status.PASS, 0.0), (0.5, Status.FAIL, None)]
)
def test_values_that_refinement_does_not_change_are_judged_exactly(
    reference: float, status: Status, clearance: float | None
) -> None:
    labels = "coarse", "finer", "finest"
    runs: Any = tuple(
        SimpleNamespace(label=label, spacing=size)
        for label, size in zip(labels, SIZES, strict=False)
    )
    quantity = Quantity(
        "constant", "", "", "finest", lambda result: result, identity(reference, "planted"),
        Derived(labels, 1.0, 1.0, "planted"), 1.0,
    )  # fmt: skip
    case = Case("planted", "", "", runs, (quantity,))
    verdict = judge_quantity(quantity, case, dict.fromkeys(labels, 0.0))
    assert (verdict.allowed, verdict.status, verdict.clearance) == (0.0, status, clearance)
