"""`slipstick verify` and `slipstick maintain report` from end to end, on one small case."""

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from command import outcome

from contact_scene.solver_errors import NotConverged
from verification.cases.fretting import fretting_loop
from verification.cases.hertz import hertz_point
from verification.cases.histories import load_paths
from verification.cases.partial_slip import near_sliding
from verification.defects.defect import planted
from verification.defects.registry import DEFECTS
from verification.judging.case import Case
from verification.judging.judgement import judge
from verification.judging.outcome import CaseOutcome, Status
from verification.judging.refinement import refinement
from verification.report.files import PAGE, RECORD


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("verify")
    ended = outcome("verify", "dissimilar_bodies", "--output", "out/put", cwd=directory)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "dissimilar_bodies" in ended.stderr
    assert f"report: {Path('out/put') / PAGE}" in ended.stdout
    return directory / "out" / "put"


def test_one_case_is_verified_and_reported(made: Path) -> None:
    record = json.loads((made / RECORD).read_text(encoding="utf-8"))
    assert [case["name"] for case in record["cases"]] == ["dissimilar_bodies"]
    assert record["counts"]["fail"] == 0
    assert record["provenance"]["command"] == "slipstick verify dissimilar_bodies --level quick"


def test_report_is_rendered_again_from_its_record(made: Path) -> None:
    page = (made / PAGE).read_bytes()
    (made / PAGE).unlink()
    ended = outcome("maintain", "report", str(made), cwd=made)
    assert ended.returncode == 0, ended.stderr
    assert (made / PAGE).read_bytes() == page


def test_cases_are_listed_without_solving(tmp_path: Path) -> None:
    ended = outcome("verify", "--list", cwd=tmp_path)
    assert ended.returncode == 0
    assert "fretting_loop" in ended.stdout
    assert list(tmp_path.iterdir()) == []


def test_unknown_case_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    ended = outcome("verify", "herz", cwd=tmp_path)
    assert ended.returncode == 2
    assert "herz" in ended.stderr
    assert "hertz_point" in ended.stderr
    assert list(tmp_path.iterdir()) == []


# ---- Defects planted in the solver are seen by the verification, which passes without them.


CASES: dict[str, Callable[[], Case]] = {
    "hertz_point": lambda: hertz_point(cells=refinement(32, 128)),
    "fretting_loop": lambda: fretting_loop(cells=(96,), quarter=2),
    "near_sliding": lambda: near_sliding(cells=64),
    "load_paths": lambda: load_paths(cells=32),
}


def failed(outcome: CaseOutcome) -> set[str]:
    return {verdict.name for verdict in outcome.verdicts if verdict.status is Status.FAIL}


@cache
def healthy(name: str) -> CaseOutcome:
    return judge(CASES[name]())


# Defects of the registry, with a case that is smaller than the catalogue's and what it must see.
SEEN_BY = {
    "normal-bias-stiff": ("hertz_point", "approach"),
    "normal-bias": ("hertz_point", "peak_pressure"),
    "gap-too-deep": ("hertz_point", "approach"),
    "tangential-bias": ("fretting_loop", "largest_shift_error"),
    "friction-root-two": ("fretting_loop", "largest_shear_error"),
    "history-dropped": ("fretting_loop", "energy_per_cycle"),
    "work-halved": ("fretting_loop", "largest_energy_imbalance"),
    "dissipation-halved": ("fretting_loop", "largest_energy_imbalance"),
    "slip-range": ("fretting_loop", "ruiz_f1"),
    "tension-across": ("fretting_loop", "ruiz_f2"),
}


@pytest.mark.parametrize("name", CASES)
def test_healthy_solver_passes(name: str) -> None:
    assert failed(healthy(name)) == set()


@pytest.mark.parametrize("defect", SEEN_BY)
def test_planted_defect_fails(defect: str) -> None:
    name, quantity = SEEN_BY[defect]
    with planted(DEFECTS[defect]):
        assert quantity in failed(judge(CASES[name]()))


def test_friction_defect_is_seen_while_sliding() -> None:
    with planted(DEFECTS["friction-root-two"]):
        assert "sliding_force" in failed(judge(CASES["near_sliding"]()))


def test_residual_above_tolerance_fails() -> None:
    case = CASES["load_paths"]()
    lax = {run.label: run for run in case.runs}

    def solve(run: Any) -> Any:
        loose = type(run)(run.label, run.scene, run.grid, 1e-4)
        return loose.solve() if run.label == next(iter(lax)) else run.solve()

    # By the word of the solver, and by its fields.
    seen = {"largest_residual", "observed_violation", "energy_imbalance"}
    assert failed(judge(case, solve)) == seen


def test_solver_that_gives_up_fails_and_the_rest_is_still_judged() -> None:
    case = CASES["near_sliding"]()

    def solve(run: Any) -> Any:
        if run is case.runs[0]:
            raise NotConverged("the shear", 60, 1e-3, 1e-8)
        return run.solve()

    outcome = judge(case, solve)
    assert failed(outcome) == {"solved"}
    assert "1.00e-03" in outcome.verdicts[0].meaning
    assert len(outcome.runs) == len(case.runs) - 1
    assert outcome.count(Status.PASS) > 1
