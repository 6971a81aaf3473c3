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
from verification.judging.case import Case
from verification.judging.declared_case import Refined, Row, case, judged
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.judging.refinement import refinement
from verification.judging.refinement_levels import (
    RefinementLevel,
    ladder,
    on_cells,
)
from verification.problems.problem import Problem

Random = np.random.Generator
LEVELS = refinement(32, 96)
NARROWEST, WIDEST = 2.6, 3.6  # window over contact radius


def on_grids(name: str, problem: Problem, random: Random, *rows: Row) -> Case:
    """On grids that fall anywhere on the contact, of a window of any size."""
    window = random.uniform(NARROWEST, WIDEST)
    grids = [on_cells(problem, (n,), window, offsets=(_anywhere(random),)) for n in LEVELS]
    rungs = [rung for grid in grids for rung in grid.rungs]
    return case(name, name, "", judged(ladder(problem, rungs), rows))


def _anywhere(random: Random) -> tuple[float, float]:
    """A place in a cell."""
    return float(random.uniform(-0.5, 0.5)), float(random.uniform(-0.5, 0.5))


def pressed(indenter: Paraboloid | Cone | FlatPunch, body: Body, load: float) -> Scene:
    """Pressed once, without friction."""
    return Scene(
        title="Pressed", indenter=indenter, body=body, loading=(LoadStep(normal_force=load),)
    )


def part_of_cell(part: float) -> Callable[[RefinementLevel], float]:
    """A part of a cell, over the radius, for a window of three radii."""
    return lambda rung: part * 3.0 / rung.count


APPROACH_WITHIN = Refined(
    APPROACH, 2.0, 1e-4, "order 2, and the cap of hertz_point at 128 cells by that order"
)
# Twice the part of hertz_point, whose axis is always a corner of cells.
RADIUS_WITHIN = Refined(
    CONTACT_RADIUS, 1.0, part_of_cell(0.2), "order 1: the edge is known to a part of a cell"
)


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
