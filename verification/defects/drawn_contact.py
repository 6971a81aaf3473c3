"""Contacts on grids that fall anywhere, and what is judged of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from contact_scene import (
    Body,
    Cone,
    FlatPunch,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from verification.judging.case import Case, Derived, Quantity
from verification.judging.refinement import refinement
from verification.judging.run import Run
from verification.observed.end_state import approach, contact_radius
from verification.problems.reference import Reference
from verification.problems.shifted_grid import ShiftedGrid

Random = np.random.Generator
LEVELS = refinement(32, 96)
NARROWEST, WIDEST = 2.6, 3.6  # window over contact radius
APPROACH = 1e-4  # cap: the 5e-5 of hertz_point at 128 cells, by its order
PART_OF_CELL = 0.2  # cap: twice that of hertz_point, whose axis is always a corner of cells


def on_grids(
    name: str,
    scene: Scene,
    radius: float,
    random: Random,
    quantities: Callable[[tuple[str, ...]], tuple[Quantity, ...]],
) -> Case:
    """On grids that fall anywhere on the contact, of a window of any size."""
    width = radius * random.uniform(NARROWEST, WIDEST)
    runs = tuple(
        Run(f"{n}x{n}", scene, ShiftedGrid((n, n), (width, width), _anywhere(random)))
        for n in LEVELS
    )
    labels = tuple(run.label for run in runs)
    return Case(name, name, "", runs, quantities(labels))


def _anywhere(random: Random) -> tuple[float, float]:
    """A place in a cell."""
    return float(random.uniform(-0.5, 0.5)), float(random.uniform(-0.5, 0.5))


def pressed(indenter: Paraboloid | Cone | FlatPunch, body: Body, load: float) -> Scene:
    """Pressed once, without friction."""
    return Scene(
        title="Pressed", indenter=indenter, body=body, loading=(LoadStep(normal_force=load),)
    )


def approach_within(runs: tuple[str, ...], reference: Reference) -> Quantity:
    """The approach, on the finest of these runs."""
    return Quantity(
        "approach", "approach", "m", runs[-1], approach, reference,
        Derived(runs, 2.0, APPROACH, "order 2, and the cap of hertz_point by that order"),
    )  # fmt: skip


def radius_within(runs: tuple[str, ...], reference: Reference) -> Quantity:
    """The contact radius, on the finest of these runs."""
    return Quantity(
        "contact_radius", "√(contact area / π)", "m", runs[-1], contact_radius, reference,
        Derived(runs, 1.0, part_of_cell(runs), "order 1: the edge is known to a part of a cell"),
    )  # fmt: skip


def part_of_cell(runs: tuple[str, ...]) -> float:
    """A part of a cell of the finest grid, over the radius, for a window of three radii."""
    return PART_OF_CELL * 3.0 / int(runs[-1].partition("x")[0])


def any_material(random: Random) -> IsotropicMaterial:
    """Of any stiffness, and ν from 0 to ½."""
    return IsotropicMaterial(
        young_modulus=between(random, 1e9, 1e12), poisson_ratio=float(random.uniform(0.0, 0.5))
    )


def constants(material: IsotropicMaterial) -> tuple[float, float]:
    """E and ν."""
    return material.young_modulus, material.poisson_ratio


def between(random: Random, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return float(np.exp(random.uniform(np.log(low), np.log(high))))
