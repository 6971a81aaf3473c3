"""Tests of checkpoints: a resumed load history has identical results; foreign files are refused."""

import hashlib
import os
import pickle
import shutil
import tracemalloc
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from signal import SIGINT, default_int_handler
from typing import Any

import numpy as np
import pytest

import fem_reference
import radial
import semi_analytical
from contact_results.directory.checkpoint import (
    CheckpointDirectory,
    provide_checkpoints,
)
from contact_results.directory.checkpoint_file import (
    FORMAT,
    Unusable,
    read_checkpoint_file,
    write_checkpoint_file,
)
from contact_results.result_files import write_result
from contact_scene import (
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
    Sphere,
    SurfaceDiscretisation,
)
from contact_scene.discretisation import EdgeCorrection
from contact_scene.quantities import stored_fields
from contact_scene.quantities.stored_fields import StoredArray, WithFields
from contact_scene.solver_errors import GrossSliding
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    CheckpointStore,
)
from fem_reference.elasticity.motion import PRESSING, SHEARING, TORSION

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
SOFT = IsotropicMaterial(young_modulus=70e9, poisson_ratio=0.33)
BALL = Sphere(radius=0.01, material=STEEL)
PLAIN = Body(material=STEEL)
COATED = Body(material=STEEL, layers=(Layer(thickness=5e-5, material=SOFT),))
PRESSED = LoadStep(normal_force=100.0, increments=2)
LOOP = (
    PRESSED,
    LoadStep(tangential_force=(20.0, 0.0), increments=2),
    LoadStep(tangential_force=(-15.0, 0.0), increments=2),
)
ACROSS = LoadStep(tangential_force=(0.0, 15.0), increments=2)
LED = (*LOOP, LoadStep(tangential_shift=(1e-8, 0.0), increments=3))
SOFTER = Body(material=SOFT)
LIFTED = (*LOOP, LoadStep(normal_force=0.0, tangential_force=(0.0, 0.0), increments=2), *LOOP[:2])
TURNED = (PRESSED, LoadStep(torque=1e-4, increments=2), LoadStep(torque=-1e-4, increments=2))
TILTED = (
    LoadStep(normal_force=100.0, moment=(0.0, 1e-3), increments=2),
    LoadStep(tangential_force=(20.0, 0.0), increments=2),
)
# The first increments touch no cell.
APPROACHED = (
    LoadStep(approach=1e-6, increments=8),
    LoadStep(tangential_force=(2.0, 0.0), increments=1),
)
SURFACE = SurfaceDiscretisation(cells=(16, 16), edge="off")
SECTION = FiniteElementDiscretisation(elements_per_radius=4, contact_radius=2e-4)
Solve = Callable[[CheckpointStore | None], Any]


def scene(body: Body, loading: tuple[LoadStep, ...], ball: Sphere = BALL) -> Scene:
    friction = CoulombFriction(coefficient=0.3)
    return Scene(title="killed", indenter=ball, body=body, friction=friction, loading=loading)


def on_surface(
    body: Body, loading: tuple[LoadStep, ...], surface: SurfaceDiscretisation = SURFACE
) -> Solve:
    return lambda store: semi_analytical.solve_discretised(
        scene(body, loading), surface, store=store
    )


def with_edges(body: Body, edge: EdgeCorrection, ball: Sphere | None = None) -> Solve:
    """On enough cells to have edges; below a ball that is the body's like, unless it is another."""
    ball = ball or BALL.model_copy(update={"layers": body.layers})
    surface = SurfaceDiscretisation(cells=(32, 32), edge=edge)

    def solve(store):
        result = semi_analytical.solve_discretised(scene(body, LED, ball), surface, store=store)
        assert any(step.edge_change is not None for step in result.steps)
        return result

    return solve


def on_section(body: Body, loading: tuple[LoadStep, ...], method: fem_reference.Method) -> Solve:
    return lambda store: fem_reference.solve(scene(body, loading), SECTION, method, store=store)


def on_rings(loading: tuple[LoadStep, ...]) -> Solve:
    posed = scene(SOFTER, loading)
    rough = replace(radial.plan(posed), fineness=0.5)
    return lambda store: radial.solve(posed, plan=rough, store=store)


SOLVES = {
    "similar": on_surface(PLAIN, LED),
    "edges inside the cells": with_edges(PLAIN, "all"),
    "coupled": on_surface(COATED, LOOP),
    "separated": on_surface(PLAIN, LIFTED),
    "before first touch": on_surface(
        SOFTER, APPROACHED, SurfaceDiscretisation(cells=(12, 12), window=(5e-4, 5e-4))
    ),
    "coupled, edges inside the cells": with_edges(SOFTER, "last", BALL),
    "pressed on rings": on_rings((PRESSED, LoadStep(normal_force=60.0, increments=2))),
    "pushed on rings": on_rings(LOOP[:2]),
    "torsion": on_surface(PLAIN, TURNED),
    "tilt": on_surface(PLAIN, TILTED),
    **{
        f"{name} by {method.value}": on_section(body, loading, method)
        for method in fem_reference.Method
        for name, body, loading in (
            ("similar", PLAIN, LED),
            ("coupled", COATED, LOOP),
            ("turned and twisted", COATED, (*LOOP[:2], ACROSS, TURNED[1])),
            ("coupled torsion", COATED, TURNED),
        )
    },
}


@dataclass
class All:
    """Keeps every standing in memory; `since` is what it says was kept before."""

    since: Checkpoint | None = None
    kept: list[Checkpoint] = field(default_factory=list)

    def last(self) -> Checkpoint | None:
        return self.since

    def keep(self, standing: Checkpoint) -> None:
        self.kept.append(standing)


class Killed(BaseException):
    """Stands for the end of a process."""


@dataclass
class Ending:
    """Passes on to a keeper, and dies after so many increments."""

    store: CheckpointStore
    lives: int

    def last(self) -> Checkpoint | None:
        return self.store.last()

    def keep(self, standing: Checkpoint) -> None:
        self.store.keep(standing)
        self.lives -= 1
        if not self.lives:
            raise Killed


def bits(value):
    """All bits of a value, however often it has an object."""
    pickler = pickle.Pickler(content := BytesIO())
    pickler.fast = True
    pickler.dump(value)
    return content.getvalue()


def checkpoint(
    directory: Path, said: list[str], identity: str = "this solve"
) -> CheckpointDirectory:
    return CheckpointDirectory(directory / "checkpoint", identity, said.append)


def keep_every_increment(patch: pytest.MonkeyPatch) -> None:
    patch.setattr("contact_results.directory.checkpoint.SHARE", np.inf)
    patch.setattr("contact_results.directory.checkpoint.SECONDS_BETWEEN", 0.0)


@pytest.fixture(autouse=True)
def _every_increment(monkeypatch):
    keep_every_increment(monkeypatch)


@pytest.mark.parametrize("name", SOLVES)
def test_going_on_after_any_increment_gives_the_same_bits(name, tmp_path):
    """The next increment from each, and so all; from the first to the end."""
    solve, every = SOLVES[name], All()
    whole = solve(every)
    assert len(every.kept) == len(whole.increments)
    path = tmp_path / "standing"
    for standing, following in pairwise(every.kept):
        write_checkpoint_file(standing, "this solve", path)
        resumed = All(read_checkpoint_file(path, "this solve"))
        with pytest.raises(Killed):
            solve(Ending(resumed, 1))
        assert bits([following]) == bits(resumed.kept)
    resumed = All(every.kept[0])
    assert bits(whole.increments) == bits(solve(resumed).increments)
    assert len(resumed.kept) == len(whole.increments) - 1


@pytest.mark.parametrize("motion", [PRESSING, TORSION, SHEARING])
def test_motions_of_the_elements_return_from_a_file(motion, tmp_path):
    """With the function of their far field, which is the only kind of code that a file may name."""
    write_checkpoint_file(motion, "this solve", tmp_path / "motion")
    assert read_checkpoint_file(tmp_path / "motion", "this solve") == motion


def test_writer_keeps_none_of_the_arrays_that_it_has_written(tmp_path):
    size, peaks = 1 << 20, []
    with (tmp_path / "fields").open("wb+") as fields:
        fields.write(bytes(size))
        fields.flush()
        for count in (4, 40):
            arrays = tuple(StoredArray(fields, 0, np.dtype("B"), (size,)) for _ in range(count))
            tracemalloc.start()
            write_checkpoint_file(arrays, "solve", tmp_path / "part")
            peaks.append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
            assert np.shape(read_checkpoint_file(tmp_path / "part", "solve")) == (count, size)
    assert peaks[1] < 1.1 * peaks[0] < 3 * size


def forged(content: bytes) -> bytes:
    """A checkpoint of this solve with this pickle."""
    own = hashlib.sha256(content).hexdigest().encode()
    return b"\n".join([FORMAT, b"this solve", own, content])


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A result, and a folder with the checkpoint of its solve after every increment."""
    folder = tmp_path_factory.mktemp("whole")
    with pytest.MonkeyPatch.context() as patch:
        keep_every_increment(patch)
        return SOLVES["similar"](checkpoint(folder, [])), folder


@pytest.mark.parametrize(
    ("number", "damage", "problem"),
    [
        (2, lambda c: c[:-40] + bytes([c[-40] ^ 1]) + c[-39:], "is damaged"),
        (2, lambda c: c[:-1], "is damaged"),
        (2, lambda c: b"", "is not a checkpoint of this version"),
        (2, lambda c: b"PK" + c, "is not a checkpoint of this version"),
        (2, lambda c: c.replace(b"this solve", b"that solve", 1), "is of another scene"),
        (0, lambda c: forged(pickle.dumps(1.0)), "contains no checkpoint"),
    ],
)
def test_part_that_cannot_be_used_is_named_and_computed_again(
    damage,
    problem,
    number,
    whole,
    tmp_path,
):
    result, folder = whole
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    path = tmp_path / "checkpoint" / f"part-{number:06d}"
    path.write_bytes(damage(path.read_bytes()))
    said = []
    store = checkpoint(tmp_path, said)
    last = store.last()
    assert (last.point.done if last else 0) == number
    assert str(path) in said[0]
    assert problem in said[0]
    assert bits(result.increments) == bits(SOLVES["similar"](store).increments)


@dataclass
class Trap:
    """What runs a command when a pickle is read without care."""

    directory: str

    def __reduce__(self):
        return os.mkdir, (self.directory,)


@pytest.mark.parametrize("protocol", [0, 2, 5])
def test_file_of_a_stranger_runs_nothing(protocol, tmp_path):
    path = tmp_path / "part"
    path.write_bytes(forged(pickle.dumps(Trap(str(tmp_path / "made")), protocol)))
    with pytest.raises(Unusable, match="may not contain"):
        read_checkpoint_file(path, "this solve")
    assert not (tmp_path / "made").exists()


@pytest.mark.parametrize(
    ("error", "stays"), [(None, False), (GrossSliding("no"), False), (OSError(28, "full"), True)]
)
def test_checkpoint_stays_only_where_it_is_of_use(error, stays, tmp_path):
    outcome = nullcontext() if error is None else pytest.raises(type(error))
    with outcome, provide_checkpoints(tmp_path / "out", "this solve", print) as store:
        SOLVES["similar"](store)
        assert (tmp_path / ".out.checkpoint").is_dir()
        if error is not None:
            raise error
    assert (tmp_path / ".out.checkpoint").is_dir() is stays


def test_signal_just_after_a_write_leaves_the_written_increment_counted(tmp_path, monkeypatch):
    rename, store = os.replace, checkpoint(tmp_path, [])
    monkeypatch.setattr(os, "replace", lambda *a: (rename(*a), default_int_handler(SIGINT, None)))
    with pytest.raises(KeyboardInterrupt):
        SOLVES["similar"](store)
    assert "goes on after increment 1," in store.how_to_go_on()


# ---- stored fields


@pytest.fixture
def stored(monkeypatch):
    """Whatever can be is in a file."""
    monkeypatch.setattr(stored_fields, "MAX_IN_MEMORY", 0)
    monkeypatch.setattr(stored_fields, "LEAST_STORED", 1)


def in_file(value: WithFields) -> list[str]:
    kept = vars(value).items()
    return [name for name, array in kept if isinstance(array, stored_fields.StoredArray)]


@pytest.mark.parametrize("name", ["similar", "torsion", "similar by penalty"])
def test_files_are_the_same_to_the_byte(name, tmp_path, request):
    results = [SOLVES[name](None)]
    request.getfixturevalue("stored")
    results.append(SOLVES[name](None))
    assert not in_file(results[0].increments[-1])
    assert {"pressure", "gap", "in_stick"} <= {*in_file(results[1].increments[-1])}
    written = []
    for number, result in enumerate(results):
        directory = tmp_path / str(number)
        directory.mkdir()
        write_result(result, directory, figures="none", all_fields=True)
        written.append({path.name: path.read_bytes() for path in directory.iterdir()})
    assert written[0] == written[1]
