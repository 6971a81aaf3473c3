"""Tests of seeded defects: the verification detects them, and they are removed afterwards."""

from typing import Any

import pytest

from verification.cases.catalogue import CASES
from verification.defects.defect import planted, product_modules
from verification.defects.registry import DEFECTS
from verification.judging.case import Level
from verification.running import case_pool as case_store
from verification.running.study import Settings
from verification.studies.seeded_defects import DefectRun, failed_verdicts

QUICK = Settings(Level.QUICK)
# Cases that take a fraction of a second. `test_declared_cases` solves them without a defect.
FAST = (
    "hertz_approach_control",
    "layered_reference",
    "led_histories",
    "subsurface_stress",
    "tilted_punch",
)
FAST_RUNS = [
    DefectRun(defect.name, case)
    for defect in DEFECTS.values()
    if (case := next((case for case in defect.cases if case in FAST), None))
]
# A quicker defect is caught by the same law.
SLOW = (
    "approach-taken-over",
    "force-scaled",
    "force-taken-over",
    "increments-halved",
    "one-increment",
)


def namespaces() -> dict[str, dict[str, Any]]:
    """What every name of the product stands for: of its modules, and of their classes."""
    found = {module.__name__: vars(module).copy() for module in (*product_modules(), case_store)}
    for place, names in list(found.items()):
        for name, value in names.items():
            if isinstance(value, type) and value.__module__ == place:
                found[f"{place}.{name}"] = dict(vars(value))
    return found


def different(one: dict[str, dict[str, Any]], other: dict[str, dict[str, Any]]) -> set[Any]:
    """Names of one that stand for something else in the other, or for nothing."""
    return {
        (place, name)
        for place, names in one.items()
        if names != other.get(place)
        for name, value in names.items()
        if value is not other.get(place, {}).get(name)
    }


def test_defects_are_many_and_name_cases_of_the_catalogue():
    known = set(CASES)
    assert len(DEFECTS) >= 22
    for defect in DEFECTS.values():
        assert defect.cases
        assert set(defect.cases) <= known
        assert defect.broken.endswith(".")


@pytest.fixture(scope="module")
def left():
    """What names stood for when the last defect had been taken out."""
    return [namespaces()]


@pytest.mark.parametrize("name", DEFECTS)
def test_defect_changes_something_and_leaves_nothing_behind(name, left):
    with planted(DEFECTS[name]):
        during = namespaces()
    after, before = namespaces(), left.pop()
    left.append(after)
    assert different(during, before)
    assert not different(before, after)


def test_defect_is_taken_out_when_something_goes_wrong_under_it():
    before = namespaces()
    with pytest.raises(ArithmeticError), planted(DEFECTS["normal-bias"]):
        raise ArithmeticError
    assert not different(before, namespaces())


@pytest.mark.parametrize(
    "run",
    [
        pytest.param(run, id=run.name, marks=[pytest.mark.slow] * (run.defect in SLOW))
        for run in FAST_RUNS
    ],
)
def test_defect_is_caught(run):
    assert failed_verdicts(run.compute())
