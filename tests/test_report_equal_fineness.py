"""Which solver is nearer to a reference: asked at equal fineness, and only of what both refined."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
from report_examples import case, report_of, run_record

from semi_analytical.grid import SurfaceGrid
from verification.cases.coatings import coated_paraboloid, fem_coated
from verification.cases.fretting import fem_partial_slip
from verification.cases.hertz import hertz_point
from verification.cases.partial_slip import cattaneo_mindlin
from verification.cases.torsion import fem_torsion, torsion
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.outcome import CaseOutcome, RefinedErrors
from verification.judging.refined_errors import LEAST, followed_on, refined_errors
from verification.judging.run import Run
from verification.problems.paper_scene import NU_ZERO
from verification.problems.reference import closed_form
from verification.report.answers import answers
from verification.report.both_solvers import WORDS, shared_references
from verification.report.equal_fineness import (
    BEYOND,
    PER_RADIUS,
    TELLING,
    nearer_table,
    silences,
    typical_error,
    votes,
)
from verification.running.report_record import Report
from verification.solver import Solver

COARSE, FINE = np.geomspace(8, PER_RADIUS, 9), np.geomspace(16, 8 * PER_RADIUS, 11)
RATHER_SURE = 1e-7


def levels(per_radius: np.ndarray, factor: float, scatter: float = 1.0) -> RefinedErrors:
    """Errors factor h² with a scatter up and down."""
    ups = scatter ** ((-1.0) ** np.arange(len(per_radius)))
    errors = factor * per_radius**-2.0 * ups
    return RefinedErrors(per_radius=tuple(per_radius), errors=tuple(errors))


def judged(
    name: str, refined: RefinedErrors | None, *, cells: bool, known_to: float
) -> CaseOutcome:
    error = 0.0 if refined is None else refined.errors[-1]
    outcome = case(
        name, {"approach": ((1 + error) * 1e-6, 1e-6)},
        run_record(512 if cells else None, None if cells else 64), drawn=False,
    )  # fmt: skip
    (verdict,) = outcome.verdicts
    update = {"refined": refined, "reference_uncertainty": known_to * 1e-6}
    return outcome.model_copy(update={"verdicts": (verdict.model_copy(update=update),)})


def of_both(
    cells: RefinedErrors | None, elements: RefinedErrors | None, known_to: float = RATHER_SURE
) -> Report:
    return report_of((
        judged("hertz_point", cells, cells=True, known_to=known_to),
        judged("fem_hertz", elements, cells=False, known_to=known_to),
    ))  # fmt: skip


@pytest.mark.parametrize(
    ("cells", "elements"), [(FINE, COARSE), (COARSE, FINE), (FINE, FINE), (COARSE, COARSE)]
)
@pytest.mark.parametrize(("factor", "nearer"), [(0.2, Solver.CELLS), (5.0, Solver.ELEMENTS)])
def test_finer_runs_buy_no_vote(
    cells: np.ndarray, elements: np.ndarray, factor: float, nearer: Solver
) -> None:
    report = of_both(levels(cells, factor), levels(elements, 1.0))
    (vote,) = votes(shared_references(report))
    assert vote.nearer is nearer
    assert vote.cells.value == pytest.approx(factor / PER_RADIUS**2)
    answer = answers(report)[2]
    said, word = answer.sentences[0], WORDS[nearer]
    assert said.startswith(f"{word[0].upper()}{word[1:]}, throughout: at {PER_RADIUS} cells or")
    assert f"{word} are nearer" in said
    assert answer.table is not None
    assert [row[-1] for row in answer.table.rows] == [word]


@pytest.mark.parametrize(("scatter", "nearer"), [(1.0, Solver.ELEMENTS), (3.0, None)])
def test_scatter_of_single_grids_makes_a_tie(scatter: float, nearer: Solver | None) -> None:
    (vote,) = votes(shared_references(of_both(levels(FINE, 2.0, scatter), levels(FINE, 1.0))))
    assert vote.nearer is nearer


def test_scatter_between_runs_of_one_fineness_makes_a_tie_too() -> None:
    smooth = levels(FINE, 2.0)
    halves = {up: tuple(error * up for error in smooth.errors) for up in (0.4, 2.5)}
    rough = RefinedErrors(per_radius=2 * smooth.per_radius, errors=halves[0.4] + halves[2.5])
    for cells, nearer in ((smooth, Solver.ELEMENTS), (rough, None)):
        (vote,) = votes(shared_references(of_both(cells, levels(FINE, 1.0))))
        assert vote.nearer is nearer


@pytest.mark.parametrize(("known_to", "nearer"), [(RATHER_SURE, Solver.ELEMENTS), (0.005, None)])
def test_reference_that_is_too_uncertain_makes_a_tie(
    known_to: float, nearer: Solver | None
) -> None:
    report = of_both(levels(FINE, 9.0), levels(FINE, 1.0), known_to)
    (vote,) = votes(shared_references(report))
    assert vote.nearer is nearer
    named = any("furthest apart in approach" in said for said in answers(report)[2].sentences)
    coarse = of_both(levels(COARSE, 9.0), levels(COARSE, 1.0), known_to)
    named |= any("furthest apart in approach" in said for said in answers(coarse)[2].sentences)
    assert named is (nearer is not None)


@pytest.mark.parametrize(
    "elements",
    [None, levels(np.geomspace(1, 0.9 * PER_RADIUS / BEYOND, 5), 1.0),
     levels(np.geomspace(1.1 * PER_RADIUS, 4 * PER_RADIUS, 5), 1.0)],
    ids=["one run", "too coarse", "too fine"],
)  # fmt: skip
def test_value_that_one_solver_did_not_refine_to_there_does_not_count(
    elements: RefinedErrors | None,
) -> None:
    report = of_both(levels(FINE, 0.1), elements)
    assert votes(shared_references(report)) == ()
    answer = answers(report)[2]
    assert "not decided by this report: none of the 1 values" in answer.sentences[0]
    assert answer.table is None


def test_one_reference_has_one_vote() -> None:
    one = of_both(levels(FINE, 0.1), levels(FINE, 1.0))
    again = judged("again", levels(FINE, 0.1), cells=True, known_to=RATHER_SURE)
    report = report_of((*one.cases, again))
    assert len(shared_references(report)) == 2
    assert len(votes(shared_references(report))) == 1
    assert "1 more that both were judged by" in answers(report)[2].sentences[1]


def test_power_law_is_met_and_its_interval_holds_it() -> None:
    error = typical_error(levels(COARSE, 3.0, 1.3))
    assert error is not None
    assert error.low < 3.0 / PER_RADIUS**2 < error.high
    assert error.high / error.low > 1.3**2


def test_levels_of_a_value_are_the_runs_that_differ_in_fineness_alone() -> None:
    (base,) = hertz_point().runs[:1]
    other_scene = base.scene.model_copy(update={"title": "another"})
    sides = [64, 32, 16, 8, 8]
    grids = [SurfaceGrid((n, n), (2.0, 2.0)) for n in sides]
    runs = [Run(f"run {k}", base.scene, grid) for k, grid in enumerate(grids)]
    strangers = (Run("other scene", other_scene, grids[0]),
                 Run("other tolerance", base.scene, grids[0], tolerance=1e-3))  # fmt: skip
    errors = dict(zip((run.label for run in runs), (1e-4, 4e-4, 1.6e-3, 6e-3, 8e-3), strict=True))
    results = {
        label: SimpleNamespace(value=1 + error, increments=[SimpleNamespace(contact_radius=0.5)])
        for label, error in errors.items()
    } | {run.label: SimpleNamespace(value=7.0) for run in strangers}
    quantity = Quantity(
        "value", "", "m", "run 0", lambda result: result.value, closed_form(1.0, "planted"),
        Required(1.0, "planted"),
    )  # fmt: skip
    planted = Case("planted", "", "", (*runs, *strangers), (quantity,))
    found = refined_errors(quantity, planted, results)
    assert found is not None
    assert found.per_radius == pytest.approx((2, 2, 4, 8, 16))
    assert found.errors == pytest.approx((6e-3, 8e-3, 1.6e-3, 4e-4, 1e-4))
    assert len(set(found.per_radius)) == LEAST
    assert refined_errors(quantity, planted, {k: results[k] for k in ("run 0", "run 4")}) is None


@pytest.mark.parametrize(("scatter", "votes_cast"), [(1.3, 1), (TELLING, 0)])
def test_errors_that_scatter_beyond_telling_have_no_vote(scatter: float, votes_cast: int) -> None:
    shared = shared_references(of_both(levels(FINE, 2.0, scatter), levels(FINE, 1.0)))
    cast = votes(shared)
    assert len(cast) == votes_cast
    reasons = {f"errors of single runs scatter more than {TELLING:g} times": {"hertz point": 1}}
    assert silences(shared) == ({} if cast else reasons)


def test_every_value_votes_or_is_accounted_for() -> None:
    (cells, elements) = of_both(levels(FINE, 0.1), levels(FINE, 1.0)).cases
    again = judged("again", levels(FINE, 0.1), cells=True, known_to=RATHER_SURE)
    once = judged("once", None, cells=True, known_to=RATHER_SURE)
    rough = judged("rough", levels(COARSE / 4, 1.0), cells=True, known_to=RATHER_SURE)
    shared = shared_references(report_of((cells, elements, again, once, rough)))
    cast, silent = votes(shared), silences(shared)
    assert silent == {
        "the reference votes already": {"again": 1},
        "one of the two on fewer than four levels": {"once": 1},
        "no level near this fineness": {"rough": 1},
    }
    assert len(cast) + sum(sum(count.values()) for count in silent.values()) == len(shared)
    note = nearer_table(cast, shared).note
    assert all(f"{reason}: {case} (1)" in note for reason, (case,) in silent.items())


@pytest.mark.parametrize(("of_cells", "of_elements"), [(0.005, 1e-12), (1e-12, 0.005)])
def test_reference_that_is_approximate_for_either_solver_does_not_decide(
    of_cells: float, of_elements: float
) -> None:
    one = judged("hertz_point", levels(FINE, 9.0), cells=True, known_to=of_cells)
    other = judged("fem_hertz", levels(FINE, 1.0), cells=False, known_to=of_elements)
    (vote,) = votes(shared_references(report_of((one, other))))
    assert vote.nearer is None


def test_of_runs_as_fine_as_each_other_the_one_with_coarser_ones_votes() -> None:
    cells = judged("hertz_point", levels(FINE, 1.0), cells=True, known_to=RATHER_SURE)
    alone = judged("single", None, cells=False, known_to=RATHER_SURE)
    followed = judged("fem_hertz", levels(FINE, 9.0), cells=False, known_to=RATHER_SURE)
    (vote,) = votes(shared_references(report_of((cells, alone, followed))))
    assert vote.shared.elements.case == "fem_hertz"


TANGENTIAL = {
    f"{what}_at_{part:g}" for what in ("shift", "stick_radius") for part in (0.3, 0.6, 0.9)
}
TWISTED = {f"{what}_at_{part:g}" for what in ("twist", "stick_radius") for part in (0.5, 0.9, 0.99)}


@pytest.mark.parametrize("level", [Level.QUICK, Level.FULL])
@pytest.mark.parametrize(
    ("cases", "followed"),
    [((cattaneo_mindlin, fem_partial_slip), {*TANGENTIAL, "energy_at_0.9"}),
     ((torsion, fem_torsion), {*TWISTED, "stuck_twist"}),
     ((coated_paraboloid, fem_coated), {"approach", "central_pressure", "contact_radius"})],
    ids=["tangential", "torsion", "coated"],
)  # fmt: skip
def test_tangential_torsional_and_coated_values_are_followed_by_both(
    cases: tuple[Callable[[Level], Case], ...], followed: set[str], level: Level
) -> None:
    """On levels enough, to references that are the same number."""
    known: list[set[tuple[str, str]]] = []
    for case_of in cases:
        made = case_of(level)
        known.append({
            (q.name, f"{q.reference.value:.9g}")
            for q in made.quantities
            if len({run.spacing for run in followed_on(q, made)}) >= LEAST
        })  # fmt: skip
    assert {name for name, _ in known[0] & known[1]} >= followed


def test_shearing_that_is_compared_needs_no_slip_across_the_load() -> None:
    made = fem_partial_slip(Level.QUICK)
    runs = {q.run for q in made.quantities if q.name in TANGENTIAL | {"energy_at_0.9"}}
    assert runs
    for name in runs:
        scene = made.run(name).scene
        assert scene.body.material == scene.indenter.material == NU_ZERO
