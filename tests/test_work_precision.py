"""What accuracy costs: the Pareto line, the cheapest setting, the counters, and the peers."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from radial.wavenumbers import _even_transforms, waves
from verification.cell_means import round_means
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.peers import profile
from verification.peers.asked import ASKED, CATTANEO, HERTZ, UNIT, AskedContact
from verification.peers.costs import cost_table, exponents
from verification.peers.environment import (
    FAILED,
    OURSELVES,
    PEERS,
    WITH_EDGES,
    Peer,
    made_environment,
)
from verification.peers.measure import errors_of, one_run
from verification.peers.profile import EDGES, ITERATION, PART_OF, SOLVER, part_of, profile_of
from verification.report.prices import price_table
from verification.running.cold_cache import CACHE, cold_cache
from verification.running.provenance import provenance
from verification.running.record import StudyRecord, dump_study
from verification.running.row import CaseRecord, parameters_of, value_of
from verification.running.row_files import row_files
from verification.running.study import Conclusion, Settings
from verification.studies.work_precision.charts import SERIES
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.point import (
    TARGETS,
    Point,
    beyond,
    cheapest,
    dependable,
    pareto,
    seconds,
)
from verification.studies.work_precision.points import points_of
from verification.studies.work_precision.price import (
    CLOCK,
    WORK,
    answer_in,
    statements_in,
    tables_in,
)
from verification.studies.work_precision.recorded_peers import (
    OTHERS,
    peer_answer,
    peer_points,
    recorded_peers,
)
from verification.studies.work_precision.setting import OPERATIONS, OWN, Method, PrecisionCase
from verification.studies.work_precision.study import STUDY, cases

SETTINGS = Settings(Level.QUICK)
KEPT = Path(__file__).parents[1] / "reports/studies/work-precision/study.json"
positive = st.floats(1e-6, 1.0)
points = st.lists(
    st.builds(
        lambda method, fineness, error, seconds: Point(
            method, "", "", fineness, error, seconds, 1.0
        ),
        st.sampled_from(["one", "other"]),
        st.integers(1, 64),
        positive,
        positive,
    ),
    max_size=20,
)


@given(points)
def test_no_point_beats_one_of_the_pareto_line(all_points: list[Point]) -> None:
    line = pareto(all_points, seconds)
    assert bool(line) == bool(all_points)
    for kept in line:
        assert not any(
            p.seconds <= kept.seconds
            and p.error <= kept.error
            and (p.seconds, p.error) != (kept.seconds, kept.error)
            for p in all_points
        )


@given(points)
def test_every_point_is_beaten_by_the_pareto_line_or_on_it(all_points: list[Point]) -> None:
    line = pareto(all_points, seconds)
    assert len(line) <= len(all_points)
    for p in all_points:
        assert any(kept.seconds <= p.seconds and kept.error <= p.error for kept in line)


@given(points, st.sampled_from(TARGETS))
def test_the_cheapest_is_on_the_pareto_line(all_points: list[Point], target: float) -> None:
    best = cheapest(all_points, target, seconds)
    good = [p for p in all_points if p.error <= target]
    assert (best is None) == (not good)
    if best is not None:
        assert best.seconds == min(p.seconds for p in good)
        assert (best.seconds, best.error) in {
            (p.seconds, p.error) for p in pareto(all_points, seconds)
        }


def test_a_setting_whose_error_is_no_number_makes_none_dependable() -> None:
    points = [Point("a", "", "", n, e, n, n) for n, e in ((16, 1e-3), (32, np.nan), (64, 1e-4))]
    assert [p.fineness for p in dependable(points) if p.error <= 1] == [64]


@given(points)
def test_a_finer_setting_of_a_curve_is_never_less_dependable(all_points: list[Point]) -> None:
    steady = dependable(all_points)
    assert sorted(p.seconds for p in steady) == sorted(p.seconds for p in all_points)
    for p in steady:
        finer = [q for q in all_points if q.method == p.method and q.fineness > p.fineness]
        assert all(q.error <= p.error for q in finer)


def curve_of(order: float, floor: float = 0.0) -> list[Point]:
    """An error that falls by an order to a floor, at costs that go with the square."""
    sizes = (16, 32, 64, 128)
    return [Point("m", "", "", n, floor + n**-order, 1e-3 * n**2, 1.0) for n in sizes]


@given(st.floats(0.6, 3.0), st.floats(1.1, 10.0))
def test_a_power_law_is_continued_along_itself(order: float, finer: float) -> None:
    found = beyond(curve_of(order), (128 * finer) ** -order, seconds)
    assert found is not None
    assert found.order == pytest.approx(order)
    assert found.fineness == pytest.approx(128 * finer)
    assert found.cost == pytest.approx(1e-3 * (128 * finer) ** 2)


def test_an_error_that_stalls_is_not_continued() -> None:
    assert beyond(curve_of(1.0, floor=0.02), 0.02, seconds) is None
    assert beyond(curve_of(1.0)[:2], 1e-3, seconds) is None
    assert beyond(curve_of(1.0), 1e-6, seconds) is None  # too far to tell


def test_what_is_not_reached_is_priced_and_marked() -> None:
    """No setting reaches 0.1 % in one field: its cell has a mark and the cost of the power law."""
    poor = concluded(lambda r: with_error(r, 0.5 / r.counters["unknowns"] ** 0.5))
    cells = [row[3] for table in poor.tables for row in table.rows if row[0] == "finite elements"]
    assert cells
    assert all(cell.startswith("≈ ") and "extrapolated to 500 cells" in cell for cell in cells)
    good = {row[3] for t in poor.tables for row in t.rows if row[0] == "semi-analytical"}
    assert not any(cell.startswith("≈") for cell in good if "512 x 512" in cell)


def test_a_change_of_sign_earns_nothing() -> None:
    lucky = Point("m", "", "lucky", 16, 1e-6, 0.1, 1e6)
    honest = Point("m", "", "honest", 32, 1e-3, 0.2, 2e6)
    assert cheapest((lucky, honest), 1e-4, seconds) == lucky
    assert cheapest(dependable((lucky, honest)), 1e-4, seconds) is None


def measured(case: PrecisionCase) -> CaseRecord:
    """Errors of order two and seconds that go with the cells, the same for all methods."""
    errors = dict.fromkeys(CONTACTS[case.contact].errors, 2.0 / case.fineness**2)
    return CaseRecord(
        parameters=parameters_of(case),
        measures={**errors, OPERATIONS: 1e3 * case.fineness**2},
        counters={"unknowns": case.fineness**2, "increments": 1},
        seconds=1e-5 * case.fineness**2,
        repeats=5,
    )


def with_error(record: CaseRecord, error: float) -> CaseRecord:
    """The same with this error of everything."""
    errors = {name: error for name in record.measures if name != OPERATIONS}
    return record.model_copy(update={"measures": record.measures | errors})


def concluded(change: Callable[[CaseRecord], CaseRecord] = lambda record: record) -> Conclusion:
    records = {case.name: change(measured(case)) for case in cases(SETTINGS)}
    return STUDY.conclude(SETTINGS, records)


def test_every_setting_has_a_name_of_its_own() -> None:
    for level in Level:
        names = [case.name for case in STUDY.cases(Settings(level))]
        assert len(set(names)) == len(names)


def test_good_settings_pass_and_poor_ones_fail() -> None:
    assert not concluded().failed
    poor = concluded(lambda r: with_error(r, 0.5))
    claims = [s.claim for s in poor.statements if s.outcome is Status.FAIL]
    assert claims == ["every quantity is had to 1 %"]


def test_a_lost_setting_fails_the_study() -> None:
    records = {case.name: measured(case) for case in cases(SETTINGS)[1:]}
    conclusion = STUDY.conclude(SETTINGS, records)
    assert conclusion.statements[0].outcome is Status.FAIL
    assert STUDY.conclude(SETTINGS, {}).failed


def test_the_clock_changes_the_provenance_alone() -> None:
    """At other speeds with equal errors and counters, the rest has the same bytes."""

    def record(pace: Callable[[int], float]) -> StudyRecord:
        records = {
            case.name: measured(case).model_copy(update={"seconds": pace(case.fineness)})
            for case in cases(SETTINGS)
        }
        files.append(row_files(records))
        return StudyRecord(
            name=STUDY.name, title=STUDY.title, question=STUDY.question, level="quick",
            conclusion=STUDY.conclude(SETTINGS, records), lost=(),
            provenance=provenance("slipstick", {}, timed=STUDY.timed(SETTINGS, records)),
        )  # fmt: skip

    files: list[Mapping[str, str]] = []
    one, other = record(lambda n: 1e-5 * n**2), record(lambda n: 1.0 / n)
    assert one.provenance.timed is not None
    assert one.provenance.timed != other.provenance.timed
    assert dump_study(other.model_copy(update={"provenance": one.provenance})) == dump_study(one)
    assert files[0]["rows.csv"] == files[1]["rows.csv"]
    assert files[0]["seconds.csv"] != files[1]["seconds.csv"]


def test_the_kept_record_says_what_its_numbers_say() -> None:
    """Statements, tables and answers, by counted work and by the clock; it is of before units."""
    kept = StudyRecord.model_validate_json(KEPT.read_bytes())
    assert kept.provenance.timed is not None
    for price, said in ((WORK, kept.conclusion), (CLOCK, kept.provenance.timed)):
        own = [row for row in said.rows if row.parameters["method"] in SERIES]
        assert statements_in(own) == said.statements[-len(statements_in(own)) :]
        found = [one.model_copy(update={"units": None}) for one in tables_in(price, said.rows)]
        kept_tables = said.tables[: len(found)]
        assert found == [one.model_copy(update={"units": None}) for one in kept_tables]
        assert said.answer.startswith(answer_in(price, own))


def test_the_clock_judges_nothing() -> None:
    records = {case.name: measured(case) for case in cases(SETTINGS)}
    timed = STUDY.timed(SETTINGS, records)
    assert timed is not None
    assert timed.statements
    assert {statement.outcome for statement in timed.statements} == {None}


def test_other_codes_are_in_the_tables_by_the_clock_and_told_where_they_are_cheaper() -> None:
    records = {case.name: measured(case) for case in cases(SETTINGS)}
    timed = STUDY.timed(SETTINGS, records)
    assert timed is not None
    peers = recorded_peers()
    shown = price_table(timed, "")
    assert shown is not None
    others = dict(zip((r[0] for r in shown.rows), (dict(zip(shown.columns, r, strict=True))
                      for r in shown.rows), strict=True))  # fmt: skip
    for (contact, quantity), runs in peer_points(peers).items():
        title = f"{CONTACTS[contact].title}: {CONTACTS[contact].errors[quantity]}"
        best = cheapest([p for p in dependable(runs) if p.method == OTHERS], 1e-3, seconds)
        assert best is not None
        assert others[title][OTHERS].endswith(f"({best.curve})")
    told = peer_answer(peers)
    for name in ("aspher", "tamaas", "ContactMechanics", "slipstick"):
        assert name in told
    assert told in timed.answer
    faster = {**peers, "runs": [
        {**run, "seconds": run.get("seconds", 0) * (1e-6 if run["code"] == "tamaas" else 1)}
        for run in peers["runs"]
    ]}  # fmt: skip
    assert "to 0.1 %: tamaas" in peer_answer(faster)
    assert told != peer_answer(faster)


def test_extrapolation_leaves_what_is_not_of_order_two() -> None:
    constant = 1e-3
    found = {
        case: with_error(measured(case), constant + 2.0 / case.fineness**2)
        for case in cases(SETTINGS)
        if case.contact == "hertz"
    }
    extrapolated = [
        p for p in points_of(found, "hertz", "approach") if p.method == Method.EXTRAPOLATED.value
    ]
    assert extrapolated
    assert all(p.error == pytest.approx(constant) for p in extrapolated)
    paid = {p.fineness: p.seconds for p in extrapolated}
    assert paid[64] == pytest.approx(1e-5 * (64**2 + 32**2))


@pytest.mark.parametrize(
    ("method", "options"),
    [
        (Method.SURFACE, {}),
        (Method.EDGES, {}),
        (Method.RADIAL, {}),
        (Method.ELEMENTS, {}),
        (Method.PENALTY, {"penalty": 10.0}),
    ],
)
def test_counters_are_the_same_at_every_run(method: Method, options: dict[str, Any]) -> None:
    fineness = OWN if method is Method.RADIAL else 8 if "elements" in method else 16
    case = PrecisionCase("coated", method, fineness, **options)
    first, second = case.compute(), case.compute()
    clock = {"seconds", "repeats"}
    assert first.model_dump(exclude=clock) == second.model_dump(exclude=clock)
    assert value_of(first, OPERATIONS) > 0


def test_a_measurement_starts_from_an_empty_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(CACHE, "/somewhere/else")
    with cold_cache():
        place = Path(os.environ[CACHE])
        assert list(place.iterdir()) == []
    assert os.environ[CACHE] == "/somewhere/else"
    assert not place.exists()


def test_a_measurement_finds_nothing_in_memory() -> None:
    """What contacts have in common is made again, with its functions called."""
    asked = waves(0.01, 1.0, 1.0)
    with cold_cache():
        first = _even_transforms(asked, 2)
        assert _even_transforms(asked, 2) is first
    with cold_cache():
        assert _even_transforms(asked, 2) is not first


def answered(contact: str, cells: int) -> dict[str, Any]:
    """The closed form, as a driver would send it."""
    asked = ASKED[contact]
    request = asked.request(cells)
    side = request["window"] / cells
    x = (np.arange(cells) + 0.5) * side - request["window"] / 2
    X, Y = np.meshgrid(x, x, indexing="ij")
    unit, c = UNIT, (1 - asked.part) ** (1 / 3)
    pressure = round_means(unit.pressure, X, Y, (side, side))
    shear = round_means(
        lambda r: asked.friction * (unit.pressure(r) - c * unit.pressure(r / c)), X, Y, (side, side)
    )
    return {
        "version": "1", "iterations": 3, "converged": True, "seconds": 0.1, "repeats": 5,
        "memory": 1.0,
        "approach": -unit.approach, "pressure": pressure.tolist(),
        "shear": [shear.tolist(), np.zeros_like(shear).tolist()],
    }  # fmt: skip


def driver_that_prints(text: str) -> Callable[..., subprocess.CompletedProcess[str]]:
    def run(*command: Any, **options: Any) -> subprocess.CompletedProcess[str]:
        json.loads(options["input"])
        return subprocess.CompletedProcess(command, 0, stdout=text, stderr="")

    return run


@pytest.mark.parametrize("contact", ["hertz", "cattaneo"])
def test_the_closed_form_has_no_error_as_an_answer(contact: str) -> None:
    run = driver_that_prints(json.dumps(answered(contact, 16)))
    record = one_run(Path("python"), PEERS[0], ASKED[contact], 16, run)
    assert "lost" not in record
    limit = {"peak": 1.01 * (3 / 16) ** 2 / 3}  # the mean of r² / 2a² over a cell next to the axis
    assert all(abs(error) < limit.get(name, 1e-12) for name, error in record["errors"].items())


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"cannot": "no friction"}', "no friction"),
        ("", "JSONDecodeError"),
        ('{"pressure": [[1]]}', "KeyError"),
        (json.dumps(answered("hertz", 8)), "shape (8, 8)"),
        (json.dumps(answered("hertz", 16) | {"pressure": [[float("nan")] * 16] * 16}), "finite"),
    ],
)
def test_an_answer_that_is_none_is_reported(text: str, reason: str) -> None:
    record = one_run(Path("python"), PEERS[0], ASKED["hertz"], 16, driver_that_prints(text))
    assert reason in record["lost"]
    assert "errors" not in record


def test_a_driver_that_dies_is_reported() -> None:
    missing = Peer("nothing==1", "nothing_of_this_name")
    record = one_run(Path(sys.executable), missing, ASKED["hertz"], 16)
    assert "nothing_of_this_name_driver" in record["lost"]


@pytest.mark.parametrize("peer", PEERS, ids=lambda peer: str(peer.module))
def test_a_driver_without_its_code_is_reported(peer: Peer) -> None:
    record = one_run(Path(sys.executable), peer, ASKED["hertz"], 16)
    assert f"No module named '{peer.module}'" in record["lost"]


def test_a_peer_that_cannot_be_installed_is_left_out_and_named(tmp_path: Path) -> None:
    asked: list[list[str]] = []

    def run(command: list[str], **options: Any) -> subprocess.CompletedProcess[str]:
        asked.append(command)
        fails = "aspher" in command[-1]
        return subprocess.CompletedProcess(command, int(fails), "", "a\nno compiler\n")

    installed = made_environment(tmp_path, run=run)
    assert installed.missing == {"aspher==0.1.3.post1": "no compiler"}
    assert [peer.module for peer in installed.peers()] == ["tamaas", "ContactMechanics"]
    assert asked[0][1:3] == ["-m", "venv"]
    assert all("==" in peer.distribution for peer in PEERS)


def test_what_could_not_be_installed_is_not_tried_again(tmp_path: Path) -> None:
    """A build that waits for a download is ended, and remembered; the reason is told again."""
    asked: list[str] = []

    def run(command: list[str], **options: Any) -> subprocess.CompletedProcess[str]:
        if "install" in command:
            asked.append(command[-1])
            raise subprocess.TimeoutExpired(command, options["timeout"])
        return subprocess.CompletedProcess(command, int("tamaas" in command[-1]), "", "")

    first, second = (made_environment(tmp_path, run=run) for _ in range(2))
    assert asked == ["tamaas==2.9.0"]
    assert first.missing == second.missing == {"tamaas==2.9.0": "not installed within 180 s"}
    (tmp_path / FAILED).unlink()
    made_environment(tmp_path, run=run)
    assert asked == ["tamaas==2.9.0"] * 2


def test_errors_of_a_peer_are_those_of_the_study() -> None:
    request = ASKED["hertz"].request(16)
    found = answered("hertz", 16)
    found["pressure"] = (1.01 * np.array(found["pressure"])).tolist()
    assert errors_of(ASKED["hertz"], request, found)["pressure"] == pytest.approx(0.01)


@pytest.mark.parametrize("contact", [HERTZ, CATTANEO], ids=lambda contact: str(contact.name))
def test_edges_inside_cells_are_an_entry_of_their_own(contact: AskedContact) -> None:
    """Fields that other codes' cells err a hundred times as much in."""
    run = one_run(Path(sys.executable), WITH_EDGES, contact, 32)
    assert run["code"] == "slipstick, edges inside cells"
    assert abs(next(iter(run["errors"].values()))) < 2e-4


@pytest.mark.parametrize("contact", ASKED.values(), ids=lambda contact: str(contact.name))
def test_ours_enters_by_the_door_of_the_others(contact: AskedContact) -> None:
    run = one_run(Path(sys.executable), OURSELVES, contact, 32)
    assert "lost" not in run, run
    assert run["seconds"] > 0
    assert all(abs(error) < 0.05 for error in run["errors"].values())
    assert bool(run["errors"]) == contact.others


def test_costs_grow_by_the_power_that_they_were_made_with() -> None:
    runs = [
        {"code": "slipstick", "contact": "hertz", "cells": n, "seconds": 1e-6 * n**2.2,
         "iterations": 9, "memory": 1.0}
        for n in (32, 64, 128, 256)
    ]  # fmt: skip
    assert exponents({"runs": runs})["hertz"] == pytest.approx(1.1)
    assert exponents({"runs": runs[:2]}) == {}


def test_a_lost_run_is_a_row_with_its_reason() -> None:
    lost = {"code": "slipstick", "contact": "hertz", "cells": 64, "lost": "gave up"}
    table = cost_table({"runs": [lost]})
    assert len(table.rows[0]) == len(table.columns)
    assert "gave up" in table.rows[0]


def test_the_cheapest_other_code_is_the_one_that_ours_is_beside() -> None:
    def run(code: str, seconds: float, **more: Any) -> dict[str, Any]:
        return {"code": code, "contact": "hertz", "cells": 64, "seconds": seconds,
                "iterations": 30, "memory": 2.0, "converged": True, **more}  # fmt: skip

    runs = [run("slipstick", 0.5), run("a", 0.25), run("b", 0.2), run("c", 0.1, converged=False)]
    (row,) = cost_table({"runs": runs}).rows
    assert row[-3:] == ("b", "0.2", "2.5")


@pytest.mark.parametrize(
    ("modules", "part"),
    [
        ([], None),
        (["solve"], ITERATION),
        (["transforms", "operator", "solve"], "transforms"),
        (["operator", "transforms", "tangential", "solve"], "products"),
        (["transforms", "operator", "edge_correction", "history", "solve"], EDGES),
    ],
)
def test_seconds_are_of_the_innermost_part_or_of_the_edges_that_called_it(
    modules: list[str], part: str | None
) -> None:
    assert part_of(modules) == part


def test_parts_of_the_profile_are_parts_of_the_solver() -> None:
    assert set(PART_OF) <= {path.stem for path in SOLVER.rglob("*")}


def test_a_profile_sees_edges_where_there_are_some(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(profile, "ENOUGH_SECONDS", 0.2)
    pressed, *_ = profile.profiled_scenes()
    with_edges, without = (
        profile_of(profile.ProfiledScene("", pressed.scene, edge), 32)["parts"][EDGES]
        for edge in ("last", "off")
    )
    assert with_edges > 0
    assert without == 0
