"""Tests of the judgement of other codes, by files or from Python: their errors are detected."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from contact_results.directory.atomic_file import Refused
from contact_scene import Body, load_scene
from slipstick.cli import main
from tests.cell_means import ellipse_means
from verification import Answer, CannotDo, Field, Solver, judge
from verification.adapters import own_solvers as own
from verification.challenge.cases import challenges
from verification.challenge.files import read_answers, toml_text
from verification.challenge.python_api import judged
from verification.challenge.requested_quantities import (
    AskedPoints,
    Challenge,
    Grade,
    Patch,
    RoundTable,
)
from verification.challenge.solver_process import Posed
from verification.judging.outcome import Status
from verification.problems.indentation import EXACT as ELLIPSE
from verification.problems.problem import HERTZ
from verification.report.page import render_sheet, row_texts

POINT = challenges()["hertz_point"]
NAMES = sorted(challenges())
LEVEL_HEAD = "level,status,reason,h,h_unit,unknowns,cpu_seconds\n"


def exact_field(challenge: Challenge, step: int = 1, cells: int = 400) -> Field:
    """The reference at the centres of cells, coarse enough to carry the load to 1e-3."""
    (asked,) = (f for f in challenge.fields if f.step == step)
    half = 1.05 * max(asked.traction.semi_axes)
    x = (np.arange(cells) + 0.5) * 2 * half / cells - half
    x, y = (part.ravel() for part in np.meshgrid(x, x, indexing="ij"))
    area = np.full(x.size, (2 * half / cells) ** 2)
    return Field(x, y, asked.traction.at(x, y), area)


def exact(
    challenge: Challenge, off: float | Callable[[Any], Any] = 0.0, h: float = 1e-5, cells: int = 0
) -> Answer:
    """All numbers, off by a part of their scale; fields where cells are given, off likewise."""

    def part(asked: Any) -> Any:
        return off(asked) if callable(off) else off

    scalars = {(v.quantity, v.step): v.value + part(v) * v.scale for v in challenge.values}
    points = {(p.quantity, p.step): p.values + part(p) * p.scale for p in challenge.points}
    fields = {}
    for asked in challenge.fields if cells else ():
        field = exact_field(challenge, asked.step, cells)
        times = 1 + part(asked) * asked.scale / np.sum(np.abs(field.value) * field.area)
        fields[asked.quantity, asked.step] = replace(field, value=field.value * times)
    return Answer(h, scalars, fields, points=points)


def twice_the_bound(asked: Any) -> Any:
    """An error that fails; of numbers at several places, at the middle one alone."""
    off = 2 * (asked.par.bound + asked.uncertainty)
    if not isinstance(asked, AskedPoints):
        return off
    return off * (np.arange(asked.values.size) == asked.values.size // 2)


def statuses(
    challenge: Challenge, *answers: Answer, solver: Solver | None = None
) -> dict[str, Status]:
    found = judged(challenge, solver or Solver("stranger"), answers)
    return {row.quantity: row.status for row in found.rows}


# ---- what is right ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_a_scene_written_for_others_reads_back_as_itself(name: str, tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    scene = challenges()[name].scene
    file.write_text(toml_text(scene), encoding="utf-8")
    if isinstance(scene, Patch):
        tables = tomllib.loads(file.read_text())
        assert Patch(Body.model_validate(tables["body"]), **tables["patch"]) == scene
    else:
        assert load_scene(file) == scene


def test_a_field_for_others_carries_the_load_of_its_step() -> None:
    fields = [field for challenge in challenges().values() for field in challenge.fields]
    assert fields
    for field in fields:
        assert field.traction.total == pytest.approx(field.total, rel=1e-10, abs=1e-9 * field.scale)


def test_a_twisting_shear_for_others_has_the_torque_of_its_step() -> None:
    challenge = challenges()["torsion"]
    assert challenge.fields
    for field in challenge.fields:
        assert isinstance(field.traction, RoundTable)
        torque = challenge.ramps[field.step - 1].twisting.end
        assert field.traction.torque == pytest.approx(torque, rel=5e-5)


def test_a_field_for_others_is_that_of_the_closed_form() -> None:
    a, b = ELLIPSE.semi_axes
    x, y = np.array([0.0, 0.3 * a, 0.9 * a]), np.array([0.0, 0.5 * b, 0.1 * b])
    (field,) = challenges()["hertz_elliptical"].fields
    assert field.traction.at(x, y) == pytest.approx(ELLIPSE.pressure(x, y), rel=1e-12)


def test_a_version_changes_with_what_is_asked() -> None:
    versions = {challenge.version for challenge in challenges().values()}
    assert len(versions) == len(challenges())


# ---- verdicts -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_the_right_numbers_pass(name: str) -> None:
    """An exact solver has equal numbers on all levels, as uncertain as the reference at most."""
    challenge = challenges()[name]
    for off in (0.0, min(number.uncertainty for number in challenge.numbers)):
        levels = [exact(challenge, off, h) for h in (4e-5, 2e-5, 1e-5)]
        found = judged(challenge, Solver("exact"), levels)
        assert found.count(Status.PASS) == len(found.rows) == len(challenge.numbers)
        assert found.exit_code(strict=True) == 0


@pytest.mark.parametrize("name", NAMES)
def test_each_wrong_answer_fails_and_each_missing_one_is_left_open(name: str) -> None:
    """By twice its bound; or missing on the finest level, where it would hide the worst."""
    challenge = challenges()[name]
    right, wrong = (exact(challenge, off, cells=48) for off in (0.0, twice_the_bound))
    for answers, status in (([wrong], Status.FAIL), ([right, Answer(5e-6)], Status.INCONCLUSIVE)):
        rows = judged(challenge, Solver("s"), answers).rows
        found = {
            (row.quantity.removesuffix(": finest level"), row.step)
            for row in rows
            if row.status is status
        }
        assert found >= {(a.quantity, a.step) for a in (*challenge.numbers, *challenge.fields)}


@pytest.mark.parametrize("name", NAMES)
def test_by_either_door_the_right_answer_passes_and_five_per_cent_off_fails(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    challenge = challenges()[name]
    for off, code in ((0.0, 0), (0.05, 1)):
        answer = exact(challenge, off, cells=48)
        found = judge(name, lambda *_, given=answer: given, levels=1)
        folder = tmp_path / str(code)
        assert slipstick("challenge", "export", name, "-o", folder, "--blind") == 0
        fill(folder, answer, challenge)
        assert (found.exit_code(strict=code == 0), slipstick("judge", folder)) == (code, code)
        assert found.line.replace(found.solver.name, "stranger <b>") in capsys.readouterr().out
        answered = [row for row in found.rows if row.grade or row.status is Status.FAIL]
        judged_ones = {(row.quantity, row.step) for row in answered}
        assert judged_ones >= {
            (v.quantity, v.step) for v in (*challenge.numbers, *challenge.fields)
        }


def test_exchanged_axes_are_seen() -> None:
    challenge = challenges()["hertz_elliptical"]
    right = exact_field(challenge)
    turned = Field(right.y, right.x, right.value, right.area)
    for field, status in ((right, Status.PASS), (turned, Status.FAIL)):
        found = statuses(challenge, Answer(1e-5, fields={("pressure", 1): field}))
        assert found["pressure"] is status


def test_leaving_out_the_edge_does_not_carry_the_load() -> None:
    whole = exact_field(POINT)
    inner = np.hypot(whole.x, whole.y) < 0.773 * HERTZ.contact_radius
    part = Field(*(getattr(whole, n)[inner] for n in ("x", "y", "value", "area")))
    found = statuses(POINT, Answer(1e-5, fields={("pressure", 1): part}))
    assert (found["pressure"], found["pressure: load carried"]) == (Status.PASS, Status.FAIL)
    assert (
        statuses(POINT, Answer(1e-5, fields={("pressure", 1): whole}))["pressure: load carried"]
        is Status.PASS
    )


@pytest.mark.parametrize(
    "name", ["hertz_point", "hertz_elliptical", "coated_paraboloid/E1_over_E2=4"]
)
@pytest.mark.parametrize(("cells", "reach"), [(47, 0.95), (180, 0.98)])
def test_who_leaves_out_the_rim_has_not_answered(name: str, cells: int, reach: float) -> None:
    """There the errors are largest, and of the load only a hundredth."""
    challenge = challenges()[name]
    whole = exact_field(challenge, cells=cells)
    (asked,) = challenge.fields
    b_x, b_y = asked.traction.semi_axes
    key = ("pressure", 1)
    for kept, failed in ((1.0, set()), (reach, {"pressure: contact covered"})):
        inside = np.hypot(whole.x / b_x, whole.y / b_y) < kept
        part = Field(*(getattr(whole, n)[inside] for n in ("x", "y", "value", "area")))
        answer = replace(exact(challenge), fields={key: part})
        found = judged(challenge, Solver("s"), [answer], Grade("C"))
        told = {row.quantity for row in found.rows if row.status is Status.FAIL}
        assert told == failed or (cells < 99 and told >= failed != set())
        assert (found.grade == "none") == bool(failed)


@pytest.mark.parametrize("beyond", [0, 3])
@pytest.mark.parametrize("off", [0.0, 0.4, 0.9])
def test_rings_cover_the_contact_with_the_last_node_in_it_or_beyond(
    off: float, beyond: int
) -> None:
    (asked,) = POINT.fields
    h = HERTZ.contact_radius / (24 + off)
    r = h * np.arange(25.0 + beyond)
    ends = np.maximum(np.array([r - h / 2, r + h / 2]), 0.0)
    area = np.asarray(np.pi * np.diff(ends**2, axis=0)[0], dtype=np.float64)
    field = Field(r, np.zeros_like(r), asked.traction.at(r, np.zeros_like(r)), area)
    key, told = ("pressure", 1), "pressure: contact covered"
    assert statuses(POINT, Answer(h, fields={key: field}))[told] is Status.PASS
    short = Field(*(getattr(field, n)[:22] for n in ("x", "y", "value", "area")))
    assert statuses(POINT, Answer(h, fields={key: short}))[told] is Status.FAIL


def test_a_field_that_nobody_answered_is_told() -> None:
    found = judged(POINT, Solver("s"), [exact(POINT)])
    assert found.omitted == (("pressure", 1, False),)
    assert found.line.endswith("1 of 4 omitted")


def test_right_means_over_cells_are_of_the_best_class() -> None:
    """Their error is that of the judge's own means, next to the edge too."""
    field = exact_field(POINT, cells=32)
    side, (a, p0) = np.sqrt(field.area[0]), (HERTZ.contact_radius, HERTZ.peak_pressure)
    at = field.x.reshape(32, 32) / side + 15.5, field.y.reshape(32, 32) / side + 15.5
    assert np.allclose(at, np.indices((32, 32)))
    means = p0 * ellipse_means(32, (a / side, a / side), (15.5, 15.5)).ravel()
    answer = Answer(1e-5, fields={("pressure", 1): replace(field, value=means)})
    (row, *_) = judged(POINT, Solver("cells", sampling="cell"), [answer]).rows
    assert (row.quantity, row.grade) == ("pressure", "A")


def test_points_that_stand_for_all_others_do_not_spread_the_load() -> None:
    (asked,) = POINT.fields
    peak = HERTZ.peak_pressure
    middle = Field(*(np.array([v]) for v in (0.0, 0.0, peak, asked.total / peak)))
    found = statuses(POINT, Answer(1e-5, fields={("pressure", 1): middle}))
    assert found["pressure"] is Status.PASS
    assert found["pressure: load carried"] is Status.PASS
    assert found["pressure: spread of the load"] is Status.FAIL
    whole = exact_field(POINT, cells=48)
    found = statuses(POINT, Answer(1e-5, fields={("pressure", 1): whole}))
    assert set(found.values()) == {Status.PASS}


def test_what_refinement_does_not_cure_stalls() -> None:
    key = ("approach", 1)
    sizes = (4e-5, 2e-5, 1e-5, 5e-6)

    def answers(error: Callable[[float], float]) -> list[Answer]:
        return [Answer(h, {key: HERTZ.approach * (1 + error(h))}) for h in sizes]

    biased = statuses(POINT, *answers(lambda h: 9e-4 + 1e-6 * h / sizes[0]))
    assert biased["approach"] is Status.PASS
    assert biased["approach: stalls"] is Status.FAIL
    falling = statuses(POINT, *answers(lambda h: 9e-4 * h / sizes[0]))
    assert "approach: stalls" not in falling


@pytest.mark.parametrize(("u", "status"), [(1e-4, Status.FAIL), (6e-4, Status.PASS)])
def test_a_claimed_uncertainty_must_cover_the_error(u: float, status: Status) -> None:
    value = HERTZ.approach * (1 + 1e-3)
    found = statuses(POINT, Answer(1e-5, {("approach", 1): (value, u * HERTZ.approach)}))
    assert found["approach: own uncertainty"] is status


@pytest.mark.parametrize(
    ("u", "status"),
    [(0.25, Status.INCONCLUSIVE), (2e-2, Status.PASS), (4e-4, Status.PASS), (1e-5, Status.FAIL)],
)
def test_a_claimed_uncertainty_of_half_the_value_says_nothing(u: float, status: Status) -> None:
    """Not where one level in three is that far off, nor where it vouches for the class asked."""
    off = {8e-5: 8e-3 if u == 2e-2 else 5e-4, 4e-5: 3e-4, 2e-5: 2e-4}
    answers = [
        Answer(h, {("approach", 1): (HERTZ.approach * (1 + e), u * HERTZ.approach)})
        for h, e in off.items()
    ]
    assert statuses(POINT, *answers)["approach: own uncertainty"] is status


def test_an_order_that_no_level_tells_is_not_a_number() -> None:
    answers = [
        Answer(h, {("approach", 1): HERTZ.approach * (1 + e)})
        for h, e in ((8e-5, 1e-4), (4e-5, 8e-4), (2e-5, 5e-5))
    ]
    who = Solver("stranger", claimed_orders={"approach": 2.0})
    rows = {row.quantity: row for row in judged(POINT, who, answers).rows}
    assert rows["approach: order"].status is Status.INCONCLUSIVE
    assert "order not known" in rows["approach: order"].because
    assert row_texts(rows["approach"])[7] == "not known"


@pytest.mark.parametrize(("claimed", "status"), [(1.0, Status.PASS), (2.0, Status.FAIL)])
def test_a_claimed_order_is_held_to(claimed: float, status: Status) -> None:
    answers = [
        Answer(h, {("approach", 1): HERTZ.approach * (1 + 10 * h * (1 + 1e-3 * (-1) ** n))})
        for n, h in enumerate((8e-5, 4e-5, 2e-5, 1e-5))
    ]
    who = Solver("stranger", claimed_orders={"approach": claimed})
    assert statuses(POINT, *answers, solver=who)["approach: order"] is status


def test_who_gives_up_on_the_finest_level_has_no_class() -> None:
    gave_up = Answer(1e-5, gave_up={0: "no convergence"})
    for answers in ([gave_up], [exact(POINT, h=2e-5), gave_up]):
        found = judged(POINT, Solver("stranger"), answers)
        assert (found.exit_code(), found.grade, len(found.omitted)) == (3, "partial", 4)
        assert not any("finest level" in row.quantity for row in found.rows)
    coarse, wrong = Answer(2e-5, gave_up={0: "no convergence"}), exact(POINT, off=0.5)
    assert judged(POINT, Solver("stranger"), [coarse, wrong]).exit_code() == 1
    assert "no convergence" in found.rows[0].because


def test_a_slip_of_sign_or_unit_is_named() -> None:
    expected = "expected: approach of points far from the contact in both bodies; positive"
    for factor, off, words in (
        (-1.0, 0.0, f"with the sign reversed it meets class A; {expected}"),
        (-1.0, 5e-4, "with the sign reversed it meets class B; "),
        (-1.0, 5e-3, "with the sign reversed it meets class C; "),
        (1e3, 0.0, "times 1e-3 it meets class A"),
        (0.5, 0.0, "doubled it meets class A"),
    ):
        answer = Answer(1e-5, {("approach", 1): factor * (1 + off) * HERTZ.approach})
        assert words in judged(POINT, Solver("s"), (answer,)).rows[0].because


@pytest.mark.parametrize("name", NAMES)
def test_reversed_sign_is_named_with_the_class_that_it_meets(name: str) -> None:
    """Of numbers, numbers at points, and fields: each verdict states the expected sign."""
    challenge = challenges()[name]
    right = exact(challenge, cells=100)
    wrong = Answer(
        right.h,
        {(number.quantity, number.step): -number.value for number in challenge.values},
        {key: replace(field, value=-field.value) for key, field in right.fields.items()},
        points={key: -values for key, values in right.points.items()},
    )
    best = {
        (row.quantity, row.step): row.grade for row in judged(challenge, Solver("s"), [right]).rows
    }
    verdicts = {
        (row.quantity, row.step): row for row in judged(challenge, Solver("s"), [wrong]).rows
    }
    for asked in (*challenge.numbers, *challenge.fields):
        key = asked.quantity, asked.step
        hint = f"with the sign reversed it meets class {best[key]}; expected: {asked.meaning}"
        assert hint in verdicts[key].because


def test_a_number_that_is_none_fails() -> None:
    answer = Answer(1e-5, {("approach", 1): float("nan")})
    (row,) = judged(POINT, Solver("s"), [answer]).rows
    assert (row.status, row.because) == (Status.FAIL, "no finite number")


@pytest.mark.parametrize(
    ("part", "grade", "status"),
    [
        (-1.5, "A", Status.PASS),
        (-0.5, "B", Status.INCONCLUSIVE),
        (0.5, "B", Status.INCONCLUSIVE),
        (1.5, "B", Status.FAIL),
    ],
)
def test_a_class_has_room_for_the_uncertainty_of_the_reference(
    part: float, grade: str, status: Status
) -> None:
    """The error is the bound of the class and a part of twice the uncertainty."""
    each = ((one, asked) for one in challenges().values() for asked in one.values)
    challenge, asked = next(pair for pair in each if pair[1].uncertainty > 1e-7)
    off = (Grade.A.bound + part * 2 * asked.uncertainty) * asked.scale
    answer = Answer(1e-5, {(asked.quantity, asked.step): asked.value + off})
    (row,) = (r for r in judged(challenge, Solver("s"), [answer], Grade.A).rows if r.grade)
    assert (row.quantity, row.grade, row.status) == (asked.quantity, grade, status)


# ---- files --------------------------------------------------------------------------------------


def slipstick(*arguments: object) -> int:
    try:
        main([str(argument) for argument in arguments])
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@pytest.fixture
def filled(tmp_path: Path) -> Path:
    """The challenge, answered rightly."""
    folder = tmp_path / "challenge"
    assert slipstick("challenge", "export", "hertz_point", "-o", folder) == 0
    named(folder)
    write(
        folder,
        ("1", "1", "approach", f"{HERTZ.approach * 1e6!r}", "um", ""),
        ("1", "1", "contact_radius", f"{HERTZ.contact_radius!r}", "m", ""),
    )
    return folder


def named(folder: Path) -> None:
    solver = folder / "solver.toml"
    solver.write_text(solver.read_text().replace('name = ""', 'name = "stranger <b>"'))
    (folder / "levels.csv").write_text(
        "level,status,reason,h,h_unit,unknowns,cpu_seconds\n1,solved,,4.5,um,100,0.1\n"
    )


def write(folder: Path, *rows: tuple[str, ...]) -> None:
    with (folder / "answers.csv").open("w", newline="") as file:
        csv.writer(file).writerows(
            (("level", "load_step", "quantity", "value", "unit", "u", "point"), *rows)
        )


def fill(folder: Path, answer: Answer, challenge: Challenge) -> None:
    """Write an answer as a stranger would."""
    named(folder)
    rows: list[tuple[str, ...]] = [
        ("1", str(v.step), v.quantity, repr(float(answer.value((v.quantity, v.step)) or 0)), v.unit)
        for v in challenge.values
    ]
    rows += [
        ("1", str(p.step), p.quantity, repr(float(value)), p.unit, "", str(n))
        for p in challenge.points
        for n, value in enumerate(answer.points[p.quantity, p.step], start=1)
    ]
    write(folder, *rows)
    (folder / "fields").mkdir()
    for (quantity, step), field in answer.fields.items():
        columns = np.stack([field.x, field.y, field.area, field.value], axis=1)
        header = f"x [m],y [m],area [m^2],{quantity} [Pa]"
        np.savetxt(
            folder / "fields" / f"1_{step}.csv", columns, "%.17g", ",", header=header, comments=""
        )


def test_filled_files_pass_and_their_sheet_is_escaped(
    filled: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "sheet.html"
    assert slipstick("judge", filled, "--page", page, "--class", "A", "--strict") == 0
    assert "hertz_point | stranger <b> | class A | 2 pass, 0 fail" in capsys.readouterr().out
    assert "stranger <b>" not in page.read_text()
    badge = json.loads((tmp_path / "badge.json").read_text())
    assert (badge["message"], badge["color"]) == ("A · 2/2", "brightgreen")


def test_a_number_and_its_uncertainty_share_their_unit(filled: Path) -> None:
    write(filled, ("1", "1", "approach", "2.5", "um", "0.1"))
    *_, (answer,) = read_answers(filled)
    key = "approach", 1
    assert (answer.value(key), answer.uncertainty(key)) == pytest.approx((2.5e-6, 1e-7))


@pytest.mark.parametrize("number", ["nan", "inf", "-inf"])
def test_a_page_shows_levels_whose_numbers_are_not_finite(
    number: str, filled: Path, tmp_path: Path
) -> None:
    page, sizes = tmp_path / "sheet.html", ("4", "2", "1")
    with (filled / "levels.csv").open("a") as levels:
        levels.writelines(f"{n},solved,,{h},um,,{n}\n" for n, h in enumerate(sizes, start=2))
    write(
        filled,
        *((str(n), "1", "approach", number if n > 2 else "1", "um", "") for n in (1, 2, 3, 4)),
    )
    assert slipstick("judge", filled, "--page", page) == 1
    assert "approach" in page.read_text()


def test_an_export_that_is_killed_leaves_no_part_that_looks_whole(tmp_path: Path) -> None:
    """The process stops for good at every call that publishes: a new folder is there with all files
    or not at all, and one that was there has the file of answers last."""
    script = """
import os, sys
from pathlib import Path
from verification.challenge.cases import challenges
from verification.challenge.files import export
def dying(call):
    def counted(*arguments, **named):
        global left
        left -= 1
        if left == 0:
            os._exit(9)
        return call(*arguments, **named)
    return counted
for name in ("rename", "replace", "fsync", "mkdir", "unlink"):
    setattr(os, name, dying(getattr(os, name)))
whole = challenges()["hertz_point"]
for folder in sys.argv[1:]:
    left = int(Path(folder).name)
    if not (child := os.fork()):
        export(whole, Path(folder) / "out", blind=False)
        os._exit(0)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""
    folders = [tmp_path / there / str(n) for there in ("new", "old") for n in range(1, 25)]
    for folder in folders:
        (folder / "out" if folder.parent.name == "old" else folder).mkdir(parents=True)
    ran = subprocess.run(
        [sys.executable, "-c", script, *folders], capture_output=True, text=True, check=True
    )
    codes = ran.stdout.split()
    assert set(codes) == {"0", "9"}
    for folder, code in zip(folders, codes, strict=True):
        found = sorted(path.name for path in (folder / "out").glob("[!.]*"))
        assert len(found) == 9 if "answers.csv" in found else code == "9"
        assert folder.parent.name == "old" or len(found) in (0, 9), found


@pytest.mark.parametrize(
    ("off", "left_out", "message", "colour"),
    [
        (5e-5, 0, "A · 3/3", "brightgreen"),
        (5e-4, 0, "B · 3/3", "green"),
        (5e-3, 0, "C · 0/3", "red"),
        (5e-2, 0, "none · 0/3", "red"),
        (5e-5, 1, "partial · 2/2", "lightgrey"),
    ],
)
def test_a_badge_has_the_colour_of_its_class_and_is_red_where_something_fails(
    off: float, left_out: int, message: str, colour: str
) -> None:
    whole = exact(POINT, off)
    answer = replace(whole, scalars=dict(list(whole.scalars.items())[left_out:]))
    badge = json.loads(judged(POINT, Solver("s"), [answer]).badge())
    assert (badge["message"], badge["color"]) == (message, colour)


def test_what_is_required_and_missing_is_no_class(
    filled: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(filled, ("1", "1", "approach", f"{HERTZ.approach!r}", "m", ""))
    assert slipstick("judge", filled) == 1
    assert "| partial |" in capsys.readouterr().out
    assert slipstick("judge", filled, "--partial") == 0


@pytest.mark.parametrize(
    ("row", "said"),
    [
        (("1", "1", "approach", "8.37", "N", ""), "answers.csv:2: got the unit 'N', expected"),
        (("1", "1", "approach", "8.37", "", ""), "got the unit ''"),
        (("1", "1", "aproach", "8.37", "um", ""), "'aproach' is not asked in step 1; asked: app"),
        (("1", "7", "approach", "8.37", "um", ""), "is not asked in step 7; asked: nothing"),
        (("2", "1", "approach", "8.37", "um", ""), "level '2' is not in levels.csv; there are 1"),
        (("1", "1", "approach", "eight", "um", ""), "value is 'eight', expected a number"),
        (("1", "1", "approach", "8.37", "um", "-1"), "u is -1, expected"),
        (("1", "x", "approach", "8.37", "um", ""), "load_step 'x'"),
        (("1", "1", "approach", "", "um", ""), "nothing to judge"),
        (("1", "1", "approach", "8.37", "um", "", "1"), "approach is one number"),
    ],
)
def test_a_mistake_in_the_answers_is_named_by_file_and_line(
    filled: Path, capsys: pytest.CaptureFixture[str], row: tuple[str, ...], said: str
) -> None:
    write(filled, row)
    assert slipstick("judge", filled) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("point", "said"),
    [
        ("1", "has no value at point 2, 3"),
        ("12", "point '12', expected 1 to 11 of points.csv"),
        ("", "point '', expected 1 to 11"),
        ("9" * 5000, "expected 1 to 11"),
    ],
)
def test_numbers_at_places_are_all_given_each_at_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], point: str, said: str
) -> None:
    slipstick("challenge", "export", "sliding_stress", "-o", tmp_path)
    named(tmp_path)
    write(tmp_path, ("1", "2", "stress_xx", "1", "GPa", "", point))
    assert slipstick("judge", tmp_path) == 2
    assert said in capsys.readouterr().err


def test_a_function_answers_at_every_place_or_none() -> None:
    key = ("stress_xx", 2)
    with pytest.raises(Refused, match="2 numbers, expected one at each of the 11 places"):
        judge("sliding_stress", lambda *_: Answer(1e-5, points={key: np.zeros(2)}), levels=1)


def test_a_value_given_twice_is_refused(filled: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(filled, *2 * [("1", "1", "approach", "8.37", "um", "")])
    assert slipstick("judge", filled) == 2
    assert "answers.csv:3: approach of step 1 twice" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["scene.toml", "asked.csv", "points.csv"])
def test_a_changed_problem_is_refused(
    filled: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    with (filled / name).open("a") as file:
        file.write("\n")
    assert slipstick("judge", filled) == 2
    assert "differs from what was exported" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("manifest.json", "[" * 100_000, "manifest.json: not the manifest of a challenge"),
        ("solver.toml", "a = " + "[" * 100_000, "solver.toml: "),
        (
            "answers.csv",
            "level;load_step;quantity;value;unit;u\n",
            "columns are separated by commas",
        ),
        (
            "answers.csv",
            "level,load_step,quantity,value,units,u\n",
            "no column unit; expected level",
        ),
        (
            "answers.csv",
            "level,load_step,quantity,value,unit,u\n1,1,approach,8,4,um,\n",
            "answers.csv:2: more values than columns; commas are between them",
        ),
        ("levels.csv", f"{LEVEL_HEAD}1,solved,,4.5,mm,,\n", "at most 0.0012 m, that of its window"),
        (
            "levels.csv",
            f"{LEVEL_HEAD}1,solved,,4,um,,\n2,solved,,5,um,,\n",
            "levels.csv:3: h is 5e-06 m",
        ),
        ("levels.csv", f"{LEVEL_HEAD}1,solved,,nan,um,,\n", "levels.csv:2: h is nan m"),
        (
            "levels.csv",
            f"{LEVEL_HEAD}1,solved,,4,um,nan,\n",
            "unknowns is nan, expected a positive",
        ),
        ("solver.toml", "solver = 3", "solver.toml: solver is 3, expected a table"),
        ("solver.toml", "claims = []\nsolver.name = 'a'", "claims is [], expected a table"),
    ],
)
def test_what_is_no_file_of_a_challenge_is_refused_by_name(
    filled: Path, capsys: pytest.CaptureFixture[str], name: str, content: str, said: str
) -> None:
    (filled / name).write_text(content)
    assert slipstick("judge", filled) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("head", "value", "said"),
    [
        ("pressure", "1", "no traction of step 1, expected 'pressure [Pa]'; there is 'x [m]'"),
        ("pressure [Pa]", None, "1_1.csv:1: no points; leave out a field that has none"),
        ("pressure [GPa]", "1", "1_1.csv:1: no traction of step 1, expected 'pressure [Pa]'"),
        ("pressure [Pa]", "1,2", "below its head: the number of columns changed from 4 to 5 at"),
        ("pressure [Pa]", "high", "below its head: could not convert string 'high'"),
    ],
)
def test_a_mistake_in_a_table_of_tractions_is_named(
    filled: Path, capsys: pytest.CaptureFixture[str], head: str, value: str | None, said: str
) -> None:
    (filled / "fields").mkdir(exist_ok=True)
    rows = "" if value is None else f"0,0,1e-10,1\n0,0,1e-10,{value}\n"
    (filled / "fields" / "1_1.csv").write_text(f"x [m], y [m], area [m^2], {head}\n{rows}")
    assert slipstick("judge", filled) == 2
    error = capsys.readouterr().err
    assert said in error
    assert "usecols" not in error


def test_a_traction_that_is_not_asked_of_a_step_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    slipstick("challenge", "export", "cattaneo_mindlin", "-o", tmp_path)
    assert "`x [m],y [m],area [m^2],shear_x [Pa]`" in (tmp_path / "problem.md").read_text()
    named(tmp_path)
    (tmp_path / "fields").mkdir()
    (tmp_path / "fields" / "1_1.csv").write_text("x [m],y [m],area [m^2],pressure [Pa]\n0,0,1,1\n")
    assert slipstick("judge", tmp_path) == 2
    assert "no traction of step 1 is asked, but of step 2, 3, 4, 5" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="has no such devices and queues")
@pytest.mark.parametrize("name", ["manifest.json", "solver.toml", "levels.csv", "answers.csv"])
def test_answers_that_never_end_are_not_waited_for(
    filled: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    (filled / name).unlink()
    os.mkfifo(filled / name)
    assert slipstick("judge", filled) == 2
    assert f"{name}: is not a regular file" in capsys.readouterr().err


def test_answers_to_an_older_version_are_refused(
    filled: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    manifest = json.loads((filled / "manifest.json").read_text())
    (filled / "manifest.json").write_text(json.dumps(manifest | {"case_version": "0"}))
    assert slipstick("judge", filled) == 2
    assert "the answers are for version 0 of hertz_point" in capsys.readouterr().err


def test_answers_are_not_overwritten(filled: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert slipstick("challenge", "export", "hertz_point", "-o", filled) == 2
    assert "exists: take another folder" in capsys.readouterr().err


@pytest.mark.parametrize("name", NAMES)
def test_a_blind_export_does_not_print_the_answer(name: str, tmp_path: Path) -> None:
    assert slipstick("challenge", "export", name, "-o", tmp_path, "--blind") == 0
    challenge = challenges()[name]
    numbers = [v.value for v in challenge.values]
    numbers += [float(value) for p in challenge.points for value in p.values]
    values = {f"{number:.9e}"[: 7 + (number < 0)].lstrip("-") for number in numbers if number}
    text = "".join(file.read_text() for file in tmp_path.iterdir())
    digits = {value.replace(".", "") for value in values}
    assert not any(d in text.replace(".", "") for d in digits)
    assert not (tmp_path / "reference.json").exists()


# ---- from Python --------------------------------------------------------------------------------


def test_our_own_solver_enters_by_the_door_of_all(tmp_path: Path) -> None:
    found = judge("hertz_point", own.answer_on_cells, levels=3, solver=own.ON_CELLS)
    by_name = {row.quantity: row for row in found.rows}
    assert by_name["approach"].status is Status.PASS
    assert by_name["pressure"].grade == "C"
    assert by_name["pressure: load carried"].status is Status.PASS
    assert by_name["contact_radius"].status is Status.FAIL  # on 128 cells: class C
    sheet = render_sheet(found)
    assert "Errors by fineness" in sheet
    assert "Errors by cost" in sheet
    no_clock = tuple(replace(answer, seconds=None) for answer in found.answers)
    assert "Errors by cost" not in render_sheet(replace(found, answers=no_clock))


def test_edges_inside_the_cells_are_worth_a_class(tmp_path: Path) -> None:
    for answer, solver, grade in (
        (own.answer_on_cells, own.ON_CELLS, "C"),
        (own.answer_with_edges, own.WITH_EDGES, "B"),
    ):
        assert judge("hertz_point", answer, levels=3, solver=solver).grade == grade


def test_a_body_that_is_five_per_cent_too_stiff_fails_in_everything() -> None:
    def stiff(posed: Posed, level: int) -> Answer:
        scene = json.loads(json.dumps(posed.scene))
        for body in ("indenter", "body"):
            scene[body]["material"]["young_modulus"] *= 1.05
        return own.answer_on_cells(replace(posed, scene=scene), level)

    found = judge("hertz_point", stiff, levels=2, at_least="C")
    failed = {row.quantity for row in found.rows if row.status is Status.FAIL}
    numbers = {"approach", "contact_radius", "central_pressure", "pressure"}
    assert failed == numbers | {"pressure: spread of the load", "pressure: contact covered"}


def test_the_problem_that_a_solver_sees_has_no_answer() -> None:
    seen: list[Posed] = []

    def solve(posed: Posed, level: int) -> Answer:
        seen.append(posed)
        return Answer(1e-5 / 2**level, {("approach", 1): HERTZ.approach})

    assert judge("hertz_point", solve, levels=2, seconds=None).exit_code(partial=True) == 0
    assert str(HERTZ.approach) not in repr(seen[0])


def test_who_cannot_do_a_problem_says_so() -> None:
    def solve(posed: Posed, level: int) -> Answer:
        raise CannotDo("homogeneous bodies only")

    with pytest.raises(CannotDo, match="homogeneous"):
        judge("coated_paraboloid/E1_over_E2=2", solve)
    with pytest.raises(KeyError, match="hertz_elliptical"):
        judge("hertz", solve)
