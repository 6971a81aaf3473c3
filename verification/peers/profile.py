"""Where the CPU seconds of ours go on three scenes: samples of the stack while it solves."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

import semi_analytical
from contact_scene import Scene
from contact_scene.discretisation import EdgeCorrection
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.peers.asked import TOLERANCE
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed_and_pushed
from verification.problems.loop_history import loop_steps
from verification.running.cold_cache import cold_cache

SOLVER = Path(semi_analytical.__file__).parent
EVERY = 1e-3  # seconds of CPU between two samples, or as few as the system's clock tells
ENOUGH_SECONDS = 1.0
MOST_CELLS = 256  # a side
QUARTER = 18  # increments to the turning point of the paper's loop
EDGES = "edges inside cells"
ITERATION = "iteration"
# Modules and packages of the solver; `ITERATION` is what is left of it. Transforms and products of
# edges are theirs.
PARTS: Mapping[str, tuple[str, ...]] = {
    "transforms": ("transforms",),
    "products": ("operator", "grades"),
    "influence": ("influence", "frf", "spectra"),
    "friction": ("admissible_shear", "generalised_derivative", "shear_zones"),
    EDGES: ("edge", "edge_correction"),
}
NAMES = (*PARTS, ITERATION)
PART_OF = {module: part for part, modules in PARTS.items() for module in modules}


@dataclass(frozen=True)
class ProfiledScene:
    """A scene with the edges that `run` puts inside its cells."""

    title: str
    scene: Scene
    edge: EdgeCorrection = "last"


def profiled_scenes() -> Iterator[ProfiledScene]:
    """A ball that is pressed, the paper's loop, and its figures 3 and 4 under both loads."""
    ball = paper.paraboloid(paper.STEEL)
    yield ProfiledScene(
        "a ball, pressed", paper.frictionless("", ball, paper.STEEL, paper.pressing())
    )
    yield ProfiledScene(
        f"the paper's loop, {1 + 5 * QUARTER} increments",
        paper.frictional("", ball, paper.STEEL, *loop_steps(QUARTER)),
    )
    yield ProfiledScene(
        "a coated ball, E1/E2 = 2, pressed and pushed in 35 increments",
        pressed_and_pushed("", coated(film(2.0, 1.0))),
    )


def profile_of(asked: ProfiledScene, cells: int) -> dict[str, Any]:
    """CPU seconds of every part of a solve, nothing cached, a mean of as many as take a second.
    Only in the main thread, on systems with POSIX's timers."""
    grid, plan = paper.hertz_grid(cells), semi_analytical.plan(asked.scene, edge=asked.edge)
    solves = 0
    # One clock for all of them: begun anew with each it would always tick at the same places.
    with sampled() as spent:
        while sum(spent.values()) < ENOUGH_SECONDS:
            with cold_cache():
                semi_analytical.solve(asked.scene, grid, TOLERANCE, plan=plan)
            solves += 1
    parts = {part: spent[part] / solves for part in NAMES}
    return {"scene": asked.title, "cells": cells, "seconds": sum(parts.values()), "parts": parts}


@contextmanager
def sampled() -> Iterator[Mapping[str, float]]:
    """CPU seconds so far of every part of the solver that was at work at a sample."""
    spent = dict.fromkeys(NAMES, 0.0)
    last = time.process_time()

    def sample(_: int, frame: FrameType | None) -> None:
        nonlocal last
        # A signal waits for the library that computes: what it took weighs as much.
        now = time.process_time()
        if (part := part_of(modules_at(frame))) is not None:
            spent[part] += now - last
        last = now

    before = signal.signal(signal.SIGPROF, sample)
    signal.setitimer(signal.ITIMER_PROF, EVERY, EVERY)
    try:
        yield spent
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def modules_at(frame: FrameType | None) -> list[str]:
    """Modules and packages of the solver that are at work in a frame, innermost first."""
    modules: list[str] = []
    while frame is not None:
        path = Path(frame.f_code.co_filename)
        if SOLVER in path.parents:
            package = path.relative_to(SOLVER).parts[0].removesuffix(".py")
            modules.append(path.stem if path.stem in PART_OF else package)
        frame = frame.f_back
    return modules


def part_of(modules: Sequence[str]) -> str | None:
    """The part of the solver whose modules are at work, innermost first: edges if any is of theirs,
    else that of the innermost; None outside the solver."""
    if any(PART_OF.get(module) == EDGES for module in modules):
        return EDGES
    return PART_OF.get(modules[0], ITERATION) if modules else None


def profile_table(record: Mapping[str, Any]) -> Table:
    """Shares of the parts, scene by scene."""
    rows = tuple(
        (
            profile["scene"],
            f"{profile['cells']} x {profile['cells']}",
            plain(profile["seconds"], 2),
            *(f"{100 * profile['parts'][part] / profile['seconds']:.0f} %" for part in NAMES),
        )
        for profile in record["profiles"]
    )
    return Table(
        title="Where the CPU seconds of ours go",
        columns=("scene", "cells", "CPU time", *NAMES),
        rows=rows,
        note="Samples of the stack, nothing cached. Products are with spectra of influence "
        "coefficients and of the preconditioner, between two transforms; friction is its law and "
        "the derivative of that; edges have their own transforms and products in them. "
        f"{ITERATION.capitalize()} is what is left: vectors, contact sets, loads, energies.",
        units={"CPU time": "s"},
    )
