"""The cases describe what they say, and their references agree with each other."""

from pathlib import Path

import pytest

import fem_reference
from contact_scene import read_scene_file
from semi_analytical import plan
from verification.cases.catalogue import CASES, choose
from verification.cases.fretting import paper_fretting_loop
from verification.judging.case import Case, Derived, Level
from verification.judging.run import SectionRun
from verification.problems.reference import ReferenceKind

SCENES = Path(__file__).resolve().parents[1] / "scenes"
QUICK = {case.name: case for case in choose(Level.QUICK)}


@pytest.mark.parametrize("level", Level)
def test_names_are_unique_and_fit_for_commands(level: Level) -> None:
    assert tuple(case.name for case in choose(level)) == CASES
    assert len(set(CASES)) == len(CASES)
    assert all(name.isidentifier() and name.islower() for name in CASES)


@pytest.mark.parametrize("case", QUICK.values(), ids=QUICK)
def test_labels_and_verdicts_of_a_case_are_unambiguous(case: Case) -> None:
    labels = [run.label for run in case.runs]
    assert len(set(labels)) == len(labels)
    for quantity in case.quantities:
        assert quantity.run in labels
        assert len(quantity.tolerance.because) > 10
        assert quantity.reference.source
        if isinstance(quantity.tolerance, Derived):
            assert set(quantity.tolerance.levels) <= set(labels)
            assert quantity.run == quantity.tolerance.levels[-1]


@pytest.mark.parametrize("level", Level)
def test_every_case_states_its_equations_its_orders_and_the_errors_of_its_references(
    level: Level,
) -> None:
    """An order is judged, or a reason is given; a reference that somebody computed has an error."""
    computed = (ReferenceKind.CLOSED_FORM, ReferenceKind.SEMI_CLOSED, ReferenceKind.EXTERNAL_CODE)
    assert choose(level)
    for case in choose(level):
        assert case.equations, case.name
        assert bool(case.orders) != bool(case.no_order), case.name
        known = [(q.name, q.reference.kind, q.reference.uncertainty)
                 for q in (*case.quantities, *case.checks)]  # fmt: skip
        known += [(c.name, c.kind, c.uncertainty) for c in case.comparisons]
        for name, kind, uncertainty in known:
            assert kind not in computed or uncertainty > 0, (case.name, name)


def test_every_scene_of_a_case_is_supported() -> None:
    runs = [run for case in QUICK.values() for run in case.runs]
    assert runs
    for run in runs:
        decide = fem_reference.plan if isinstance(run, SectionRun) else plan
        assert decide(run.scene).effects


def test_paper_case_is_the_scene_of_the_repository() -> None:
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
