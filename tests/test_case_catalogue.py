"""Tests of all verification cases: names, labels, references and scenes are consistent."""

from functools import cache
from pathlib import Path

import pytest

from contact_scene import read_scene_file
from verification.cases.catalogue import CASES, choose
from verification.cases.fretting import paper_fretting_loop
from verification.cases.requirements import REQUIREMENTS
from verification.judging.case import Derived, Level
from verification.problems.problem import ReferenceKind

SCENES = Path(__file__).resolve().parents[1] / "scenes"
cases = cache(choose)


@pytest.mark.parametrize("level", Level)
def test_names_are_unique_and_fit_for_commands(level):
    assert tuple(case.name for case in cases(level)) == CASES
    assert len(set(CASES)) == len(CASES)
    assert all(name.isidentifier() and name.islower() for name in CASES)


@pytest.mark.parametrize("name", CASES)
def test_labels_and_verdicts_of_a_case_are_unambiguous(name):
    case = cases(Level.QUICK)[CASES.index(name)]
    labels = [run.label for run in case.runs]
    assert len(set(labels)) == len(labels)
    for quantity in case.quantities:
        assert set(quantity.labels) <= set(labels)
        assert len(quantity.tolerance.because) > 10
        assert quantity.reference.source
        if isinstance(quantity.tolerance, Derived):
            assert set(quantity.tolerance.levels) <= set(labels)
            assert quantity.run == quantity.tolerance.levels[-1]


@pytest.mark.parametrize("level", Level)
def test_every_case_states_its_equations_its_orders_and_the_errors_of_its_references(
    level,
):
    """Requirements are named; an order is judged, or a reason is given; a reference that somebody
    computed has an error; a number has a key of its own."""
    computed = (ReferenceKind.CLOSED_FORM, ReferenceKind.SEMI_CLOSED, ReferenceKind.EXTERNAL_CODE)
    assert cases(level)
    known = {name for group in REQUIREMENTS.values() for name in group}
    assert {name for case in cases(level) for name in case.shows} == known
    for case in cases(level):
        assert case.shows, case.name
        assert case.equations, case.name
        assert bool(case.orders) != bool(case.no_order), case.name
        for q in case.quantities:
            exact = q.reference.kind not in computed
            assert exact or q.reference.uncertainty > 0, (case.name, q.name)
        keys = [(q.name, q.run, type(q.tolerance)) for q in case.quantities]
        assert len(set(keys)) == len(keys), case.name


def test_paper_case_is_the_scene_of_the_repository():
    case = paper_fretting_loop(Level.STANDARD)
    file = read_scene_file(SCENES / "fretting_loop.toml")
    run = case.runs[0]
    assert run.grid.cells == file.semi_analytical.cells
    assert run.grid.window == pytest.approx(file.semi_analytical.window)
    described = run.scene.model_copy(update={"loading": ()})
    assert described == file.scene.model_copy(update={"loading": ()})
    for ours, theirs in zip(run.scene.loading, file.scene.loading, strict=True):
        assert ours.normal_force == theirs.normal_force
        assert ours.tangential_force == pytest.approx(theirs.tangential_force)
        assert (ours.increments or 1) == (theirs.increments or 1)
