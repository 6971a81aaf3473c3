"""What the map asks of the semi-analytical solver."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

from verification.judging.case import Level
from verification.studies.stability.cell import LoadingPath, Surface
from verification.studies.stability.view import BARE, BEYOND, HARD_PUSH, ORDINARY, View, grid


def surface_views(level: Level) -> list[View]:
    """Its views at a level."""
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
    ]
    return made + _volume() if level is Level.FULL else made


def _friction_and_force(wide: bool) -> View:
    friction = (1e-6, 0.01, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0) if wide else (1e-6, 0.1, 1.0, 2.0, 5.0)
    push = (0.0, 0.3, 0.6, 0.9, 0.99, 0.9999, 0.99999) if wide else (0.0, 0.5, 0.9, 0.99999)
    bases = (BARE, replace(BARE, poisson_ratio=0.3, base_ratio=0.3)) if wide else (BARE,)
    return View(
        "friction", "Friction and force on a homogeneous body under a rigid ball, T in one step",
        "push", "friction", tuple(c for b in bases for c in grid(b, friction=friction, push=push)),
    )  # fmt: skip


def _coating(wide: bool) -> View:
    few = (1e-3, 0.05, 0.5, 4.0, 20.0, 1e3)
    all_of_them = (1e-6, 1e-3, 0.05, 0.5, 1.0, 2.0, 4.0, 20.0, 100.0, 1e3, 1e4, 1e5, 1e6)
    ratios = all_of_them if wide else few
    thickness = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0) if wide else (0.01, 0.1, 1.0, 10.0)
    frictions = (0.1, 1.0) if wide else (0.3,)
    return View(
        "coating", f"Stiffness and thickness of the coating, T = {HARD_PUSH:g} µW in one step",
        "modulus_ratio", "thickness",
        grid(replace(ORDINARY, push=HARD_PUSH), modulus_ratio=ratios, thickness=thickness,
              friction=frictions),
    )  # fmt: skip


def _layer_poisson(wide: bool) -> View:
    ratios = (1e-3, 0.05, 0.5, 1.0, 2.0, 20.0, 1e3) if wide else (0.05, 1.0, 1e3)
    nu = (-0.5, 0.0, 0.3, 0.45, 0.499, 0.5) if wide else (0.0, 0.499, 0.5)
    thickness = (0.01, 0.1, 1.0) if wide else (0.01,)
    return View(
        "poisson", "Poisson's ratio of the coating, incompressible included",
        "modulus_ratio", "poisson_ratio",
        grid(ORDINARY, modulus_ratio=ratios, poisson_ratio=nu, thickness=thickness),
    )  # fmt: skip


def _paths(wide: bool) -> View:
    ratios = (1e-3, 0.05, 0.5, 1.0, 2.0, 4.0, 20.0, 1e3) if wide else (0.5, 1.0, 4.0)
    frictions = (0.1, 1.0) if wide else (0.1,)
    return View(
        "paths", "Loading paths", "modulus_ratio", "path",
        grid(replace(ORDINARY, push=0.8), path=tuple(LoadingPath), modulus_ratio=ratios,
              friction=frictions),
    )  # fmt: skip


def _surfaces(wide: bool) -> View:
    push = (0.0, 0.5, 0.9, 0.99) if wide else (0.5, 0.99)
    ratios = (0.05, 1.0, 2.0, 20.0) if wide else (2.0,)
    frictions = (0.1, 1.0) if wide else (0.1,)
    return View(
        "surfaces", "Shapes, rough surfaces and uneven friction", "push", "surface",
        grid(ORDINARY, surface=tuple(Surface), push=push, modulus_ratio=ratios,
              friction=frictions),
    )  # fmt: skip


def _scale(wide: bool) -> View:
    length = (1e-9, 1e-6, 1e-3, 1.0) if wide else (1e-9, 1.0)
    modulus = (1e3, 1e6, 1e9, 1e12) if wide else (1e3, 1e12)
    return View(
        "scale", "Nanometres to metres, kilopascals to terapascals", "length", "modulus",
        grid(ORDINARY, length=length, modulus=modulus),
    )  # fmt: skip


def _light(wide: bool) -> View:
    load = (1e-5, 1e-4, 1e-3, 0.01, 0.1) if wide else (1e-4, 0.01)
    push = (0.0, 0.6, 0.99) if wide else (0.6,)
    return View(
        "light", "Loads so light that few cells touch", "load", "push",
        grid(ORDINARY, load=load, push=push),
    )  # fmt: skip


def _limits() -> View:
    """At µW all slides and the shift is undefined; beyond it the scene is refused."""
    return View(
        "limits", "At the limit of friction and beyond it", "push", "modulus_ratio",
        grid(ORDINARY, push=(1.0, BEYOND), modulus_ratio=(0.5, 4.0)),
    )  # fmt: skip


def _volume() -> list[View]:
    """Every combination of five coordinates, shown over two of them for each of two others."""
    return [
        View(
            f"volume-{thickness:g}-{nu:g}".replace(".", "p"),
            f"h/a = {thickness:g}, ν = {nu:g} of the layer; every T/µW in one step",
            "modulus_ratio", "friction",
            grid(
                replace(ORDINARY, thickness=thickness, poisson_ratio=nu),
                modulus_ratio=(1e-3, 0.05, 0.5, 2.0, 4.0, 20.0, 1e3),
                friction=(1e-6, 0.1, 0.3, 1.0, 2.0, 5.0),
                push=(0.0, 0.5, 0.9, 0.99, 0.9999),
            ),
        )
        for thickness, nu in product((0.01, 0.1, 1.0, 10.0), (0.0, 0.3, 0.5))
    ]  # fmt: skip
