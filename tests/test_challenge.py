"""Tests of the judgement of other codes, by files or from Python: their errors are detected."""

import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from command import slipstick

from contact_scene import Body, load_scene
from verification import Answer, Field, Solver, judge
from verification.challenge.cases import challenges
from verification.challenge.files import toml_text
from verification.challenge.python_api import judged
from verification.challenge.requested_quantities import Challenge, Grade, Patch
from verification.judging.outcome import Status
from verification.problems.problem import HERTZ

POINT = challenges()["hertz_point"]
NAMES = sorted(challenges())


def exact_field(asked, cells=48):
    """The reference at the centres of cells."""
    half = 1.05 * max(asked.traction.semi_axes)
    x = (np.arange(cells) + 0.5) * 2 * half / cells - half
    x, y = (part.ravel() for part in np.meshgrid(x, x, indexing="ij"))
    area = np.full(x.size, (2 * half / cells) ** 2)
    return Field(x, y, asked.traction.at(x, y), area)


def answered(challenge: Challenge, off: Callable[[Any], Any]) -> Answer:
    """All numbers and fields, off by a part of their scale."""
    scalars = {v.key: v.value + off(v) * v.scale for v in challenge.values}
    points = {p.key: p.value + off(p) * p.scale for p in challenge.points}
    fields = {}
    for asked in challenge.fields:
        field = exact_field(asked)
        times = 1 + off(asked) * asked.scale / np.sum(np.abs(field.value) * field.area)
        fields[asked.key] = replace(field, value=field.value * times)
    return Answer(1e-5, scalars, fields, points=points)


def nothing(asked):
    return 0.0


def twice_the_bound(asked):
    """An error that fails; of numbers at several places, at the middle one alone."""
    off = 2 * (asked.par.bound + asked.uncertainty)
    if getattr(asked, "places", None) is None:
        return off
    return off * (np.arange(asked.value.size) == asked.value.size // 2)


def statuses(*answers: Answer, solver: Solver | None = None) -> dict[str, Status]:
    found = judged(POINT, solver or Solver("stranger"), answers)
    return {row.quantity: row.status for row in found.rows}


# ---- what is right ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_a_scene_written_for_others_reads_back_as_itself(name, tmp_path):
    file = tmp_path / "scene.toml"
    scene = challenges()[name].scene
    file.write_text(toml_text(scene), encoding="utf-8")
    if isinstance(scene, Patch):
        tables = tomllib.loads(file.read_text())
        assert Patch(Body.model_validate(tables["body"]), **tables["patch"]) == scene
    else:
        assert load_scene(file) == scene


def test_a_twisting_shear_for_others_has_the_torque_of_its_step():
    challenge = challenges()["torsion"]
    assert challenge.fields
    for field in challenge.fields:
        torque = challenge.ramps[field.step - 1].twisting.end
        assert field.traction.torque == pytest.approx(torque, rel=1e-9)


def test_a_version_changes_with_what_is_asked():
    versions = {challenge.version for challenge in challenges().values()}
    assert len(versions) == len(challenges())


# ---- verdicts -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMES)
def test_right_answers_pass_wrong_ones_fail_and_missing_ones_are_left_open(name):
    """Wrong by twice the bound; missing on the finest level, where they would hide the worst."""
    challenge = challenges()[name]
    right, wrong = (answered(challenge, off) for off in (nothing, twice_the_bound))
    for answers, status in (
        ([right], Status.PASS),
        ([wrong], Status.FAIL),
        ([right, Answer(5e-6)], Status.INCONCLUSIVE),
    ):
        rows = judged(challenge, Solver("s"), answers).rows
        found = {
            (row.quantity.removesuffix(": finest level"), row.step)
            for row in rows
            if row.status is status
        }
        assert found >= {a.key for a in challenge.asked}


@pytest.mark.parametrize("beyond", [0, 3])
@pytest.mark.parametrize("off", [0.0, 0.4, 0.9])
def test_rings_cover_the_contact_with_the_last_node_in_it_or_beyond(off, beyond):
    (asked,) = POINT.fields
    h = HERTZ.contact_radius / (24 + off)
    r = h * np.arange(25.0 + beyond)
    ends = np.maximum(np.array([r - h / 2, r + h / 2]), 0.0)
    area = np.asarray(np.pi * np.diff(ends**2, axis=0)[0], dtype=np.float64)
    field = Field(r, np.zeros_like(r), asked.traction.at(r, np.zeros_like(r)), area)
    key, told = ("pressure", 1), "pressure: contact covered"
    assert statuses(Answer(h, fields={key: field}))[told] is Status.PASS
    short = Field(*(getattr(field, n)[:22] for n in ("x", "y", "value", "area")))
    assert statuses(Answer(h, fields={key: short}))[told] is Status.FAIL


@pytest.mark.parametrize(
    ("part", "grade", "status"),
    [
        (-1.5, "A", Status.PASS),
        (-0.5, "B", Status.INCONCLUSIVE),
        (0.5, "B", Status.INCONCLUSIVE),
        (1.5, "B", Status.FAIL),
    ],
)
def test_a_class_has_room_for_the_uncertainty_of_the_reference(part, grade, status):
    """The error is the bound of the class and a part of twice the uncertainty."""
    each = ((one, asked) for one in challenges().values() for asked in one.values)
    challenge, asked = next(pair for pair in each if pair[1].uncertainty > 1e-7)
    off = (Grade.A.bound + part * 2 * asked.uncertainty) * asked.scale
    answer = Answer(1e-5, {asked.key: asked.value + off})
    (row,) = (r for r in judged(challenge, Solver("s"), [answer], Grade.A).rows if r.grade)
    assert (row.quantity, row.grade, row.status) == (asked.quantity, grade, status)


# ---- files --------------------------------------------------------------------------------------


def test_an_export_that_is_killed_leaves_no_part_that_looks_whole(tmp_path):
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
        assert len(found) == 5 if "answers.json" in found else code == "9"
        assert folder.parent.name == "old" or len(found) in (0, 5), found


@pytest.mark.parametrize("name", NAMES)
def test_a_blind_export_does_not_print_the_answer(name, tmp_path):
    assert slipstick("challenge", "export", name, "-o", tmp_path, "--blind") == 0
    challenge = challenges()[name]
    numbers = np.concatenate([np.ravel(one.value) for one in challenge.numbers])
    values = {f"{number:.9e}"[: 7 + (number < 0)].lstrip("-") for number in numbers if number}
    text = "".join(file.read_text() for file in tmp_path.iterdir())
    digits = {value.replace(".", "") for value in values}
    assert not any(d in text.replace(".", "") for d in digits)
    assert not (tmp_path / "reference.json").exists()


def test_the_problem_that_a_solver_sees_has_no_answer():
    seen = []

    def solve(posed, level):
        seen.append(posed)
        return Answer(1e-5 / 2**level, {("approach", 1): HERTZ.approach})

    assert judge("hertz_point", solve, levels=2, seconds=None).exit_code(partial=True) == 0
    assert str(HERTZ.approach) not in repr(seen[0])
