"""What the map asks of the finite elements, with a penalty and without."""

from __future__ import annotations

from dataclasses import replace

from verification.judging.case import Level
from verification.studies.stability.cell import LoadingPath, Solver, StabilityCell, Surface
from verification.studies.stability.view import BARE, BEYOND, HARD_PUSH, ORDINARY, View, grid

BOTH = tuple(solver for solver in Solver if solver.by_elements)
# Of revolution, under friction that is the same everywhere and loads along a line: what they pose.
SURFACES = (Surface.BALL, Surface.ALIKE_BALL, Surface.FLAT_PUNCH, Surface.CONE)
PATHS = tuple(path for path in LoadingPath if path is not LoadingPath.CIRCLE)
ALIKE = replace(ORDINARY, surface=Surface.ALIKE_BALL)


def section_views(level: Level) -> list[View]:
    """Their views at a level; both methods stand at each place."""
    wide = level is not Level.QUICK
    made = [
        _friction_and_force(wide),
        _coating(wide),
        _layer_poisson(wide),
        _paths(wide),
        _surfaces(wide),
        _scale(wide),
        _light(wide),
        _limits(),
        _unposable(),
    ]
    if level is Level.FULL:
        made.append(_volume())
    return made


def _friction_and_force(wide: bool) -> View:
    friction = (1e-6, 0.1, 0.5, 1.0, 2.0, 5.0) if wide else (0.1, 5.0)
    push = (0.0, 0.5, 0.9, 0.99, 0.999, 0.9999) if wide else (0.5, 0.999)
    bodies = (BARE, ALIKE) if wide else (BARE,)
    return View(
        "elements-friction", "Finite elements: friction and force, T in one step",
        "push", "friction",
        tuple(c for b in bodies for c in grid(b, solver=BOTH, friction=friction, push=push)),
    )  # fmt: skip


def _coating(wide: bool) -> View:
    ratios = (1e-6, 1e-3, 0.05, 0.5, 4.0, 20.0, 1e3, 1e6) if wide else (0.05, 20.0)
    thickness = (0.01, 0.1, 1.0, 10.0) if wide else (0.1,)
    frictions = (0.1, 1.0) if wide else (0.3,)
    return View(
        "elements-coating",
        f"Finite elements: stiffness and thickness of the coating, T = {HARD_PUSH:g} µW",
        "modulus_ratio", "thickness",
        grid(replace(ORDINARY, push=HARD_PUSH), solver=BOTH, modulus_ratio=ratios,
             thickness=thickness, friction=frictions),
    )  # fmt: skip


def _layer_poisson(wide: bool) -> View:
    nu = (0.0, 0.3, 0.45, 0.499, 0.5) if wide else (0.5,)
    ratios = (1e-3, 0.05, 2.0, 1e3) if wide else (0.05,)
    return View(
        "elements-poisson", "Finite elements: Poisson's ratio of a coating of a/10",
        "modulus_ratio", "poisson_ratio",
        grid(replace(ORDINARY, thickness=0.1), solver=BOTH, modulus_ratio=ratios,
             poisson_ratio=nu),
    )  # fmt: skip


def _paths(wide: bool) -> View:
    bodies = (ORDINARY, ALIKE) if wide else (ORDINARY,)
    ratios = (0.05, 0.5, 2.0, 20.0) if wide else (2.0,)
    frictions = (0.1, 1.0) if wide else (0.1,)
    return View(
        "elements-paths", "Finite elements: loading paths", "solver", "path",
        tuple(
            c for b in bodies
            for c in grid(replace(b, push=0.8), solver=BOTH, path=PATHS, modulus_ratio=ratios,
                          friction=frictions)
        ),
    )  # fmt: skip


def _surfaces(wide: bool) -> View:
    shapes = SURFACES if wide else (Surface.ALIKE_BALL, Surface.FLAT_PUNCH)
    push = (0.0, 0.5, 0.9, 0.99) if wide else (0.99,)
    frictions = (0.1, 1.0, 3.0) if wide else (0.1,)
    return View(
        "elements-surfaces", "Finite elements: shapes", "solver", "surface",
        grid(ORDINARY, solver=BOTH, surface=shapes, push=push, friction=frictions),
    )  # fmt: skip


def _scale(wide: bool) -> View:
    length = (1e-9, 1e-6, 1.0) if wide else (1e-9,)
    modulus = (1e3, 1e6, 1e12) if wide else (1e3,)
    return View(
        "elements-scale", "Finite elements: nanometres to metres, kilopascals to terapascals",
        "length", "modulus", grid(ORDINARY, solver=BOTH, length=length, modulus=modulus),
    )  # fmt: skip


def _light(wide: bool) -> View:
    load = (1e-5, 1e-3, 0.1) if wide else (1e-3,)
    push = (0.0, 0.6, 0.99) if wide else (0.6,)
    return View(
        "elements-light", "Finite elements: loads far below that of the coordinates",
        "load", "push", grid(ORDINARY, solver=BOTH, load=load, push=push),
    )  # fmt: skip


def _limits() -> View:
    return View(
        "elements-limits", "Finite elements: at the limit of friction and beyond it",
        "push", "surface",
        grid(ORDINARY, solver=BOTH, push=(1.0, BEYOND), surface=(Surface.BALL, Surface.ALIKE_BALL)),
    )  # fmt: skip


def _unposable() -> View:
    """One cell of each kind that is not axisymmetric enough."""
    cells: tuple[StabilityCell, ...] = (
        replace(ORDINARY, surface=Surface.ROUGH),
        replace(ORDINARY, surface=Surface.PATCHY),
        replace(ORDINARY, path=LoadingPath.CIRCLE),
    )
    return View(
        "elements-refused", "Finite elements: one of each kind that they cannot pose",
        "path", "surface", tuple(c for cell in cells for c in grid(cell, solver=BOTH)),
    )  # fmt: skip


def _volume() -> View:
    return View(
        "elements-volume",
        "Finite elements: h/a from a hundredth to ten, ν of the layer up to ½, every T/µW in one "
        "step",
        "modulus_ratio", "friction",
        grid(ORDINARY, solver=BOTH, modulus_ratio=(1e-3, 0.05, 2.0, 20.0, 1e3),
             thickness=(0.01, 0.1, 10.0), poisson_ratio=(0.0, 0.5), friction=(0.3, 2.0, 5.0),
             push=(0.5, 0.999)),
    )  # fmt: skip
