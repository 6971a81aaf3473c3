"""Contacts of the stability map: coordinates, outcome and record of one contact, and all maps.

The stability map shows which contacts the solvers can solve. The code calls one contact of the map
a cell.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from itertools import product
from typing import Any

from verification.judging.case import Level
from verification.running.study import CaseRecord, TypedRow, parameters_of


class Surface(StrEnum):
    """Kinds of indenter in the stability map, in part with nonuniform friction on the body."""

    BALL = "ball"
    ALIKE_BALL = "alike-ball"  # equal to the body, so pressure and shear do not couple
    FLAT_PUNCH = "flat-punch"
    CONE = "cone"
    TWO_SPOTS = "two-spots"
    ROUGH = "rough"
    PATCHY = "patchy"  # a ball; friction varies from cell to cell and is zero in places
    GREASED = "greased"  # a ball; no friction in the middle of the contact


class LoadingPath(StrEnum):
    """Sequences of normal force W and tangential force T in the stability map, such as a load
    cycle."""

    PRESS = "press"  # no tangential load
    PUSH = "push"  # press, then T in one increment
    LOOP = "loop"  # T to +, - and + its largest value
    CIRCLE = "circle"  # the direction of T turns by 360°
    REVERSED = "reversed"  # T is reversed while W falls
    RELOADED = "reloaded"  # W down to a hundredth and back
    SHEARED_RELOAD = "sheared-reload"  # W and T fall and rise together
    FALLING = "falling"  # W falls at constant T until T is 0.98 µW
    SLIDE = "slide"  # shift far beyond sliding and back
    APPROACH = "approach"  # approach and shift prescribed instead of forces


class Solver(StrEnum):
    """Solvers that the stability map compares, by their names on the command line."""

    SEMI_ANALYTICAL = "semi-analytical"
    COMPLEMENTARITY = "fem-complementarity"  # finite elements without a penalty
    PENALTY = "fem"  # finite elements with a penalty

    @property
    def by_elements(self) -> bool:
        """True for the two finite-element solvers, False for the semi-analytical solver."""
        return self is not Solver.SEMI_ANALYTICAL


@dataclass(frozen=True)
class StabilityCell:
    """One contact of the stability map, as plain values from which its scene is built.

    The stability map shows which contacts the solvers can solve.

    friction        coefficient of friction µ
    push            tangential force T over µW
    modulus_ratio   E1/E2, Young's modulus of the coating over that of the substrate
    thickness       h/a, thickness of the coating over the contact radius
    poisson_ratio   ν1 of the coating
    base_ratio      ν2 of the substrate; with E1/E2 = 1 and ν1 = ν2 there is no coating
    path            sequence of loads
    surface         kind of indenter
    load            normal force W over the force that makes the contact radius a
    length          contact radius a under that force [m]
    modulus         E2 [Pa]
    cells           cells per side of the surface grid; finite elements use a quarter of this number
                    per contact radius, which is about as fine
    solver          solver of the contact
    """

    friction: float = 0.1
    push: float = 0.6
    modulus_ratio: float = 2.0
    thickness: float = 1.0
    poisson_ratio: float = 0.3
    base_ratio: float = 0.3
    path: LoadingPath = LoadingPath.PUSH
    surface: Surface = Surface.BALL
    load: float = 1.0
    length: float = 1e-3
    modulus: float = 210e9
    cells: int = 32
    solver: Solver = Solver.SEMI_ANALYTICAL

    @property
    def posable(self) -> bool:
        """True if the solver of the contact has a model of the scene.

        Finite elements require bodies of revolution, a uniform friction coefficient and a
        tangential load along one line.
        """
        uneven = self.surface in NOT_OF_REVOLUTION or self.path is LoadingPath.CIRCLE
        return not (self.solver.by_elements and uneven)

    @property
    def coordinates(self) -> dict[str, Any]:
        """Values that define the contact in the stability map (friction, load, coating, …), by
        name."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    @property
    def name(self) -> str:
        """File name of the record of the contact: those of its values that differ from the default
        values."""
        ordinary = StabilityCell()
        parts = [
            f"{SHORT[key]}{value:g}" if isinstance(value, float | int) else str(value)
            for key, value in self.coordinates.items()
            if value != getattr(ordinary, key)
        ]
        return "-".join(parts).replace(".", "p").replace("+", "") or "ordinary"


NOT_OF_REVOLUTION = (Surface.TWO_SPOTS, Surface.ROUGH, Surface.PATCHY, Surface.GREASED)
SHORT = {
    "friction": "mu", "push": "T", "modulus_ratio": "E", "thickness": "h", "poisson_ratio": "nu",
    "base_ratio": "base", "path": "", "surface": "", "load": "W", "length": "a", "modulus": "Pa",
    "cells": "N", "solver": "",
}  # fmt: skip


class Verdict(StrEnum):
    """Outcome of the solve of a contact in the stability map.

    A contact is converged, refused, not converged, or wrong without a message.
    """

    CONVERGED = "converged"
    REFUSED = "refused"  # the scene has no solution or no model
    NOT_CONVERGED = "not converged"  # reported by the solver
    SILENT = "silent"  # a result that violates the equations without a message


class Refusal(StrEnum):
    """Reason for which a solver refuses a contact of the stability map.

    The tangential force exceeds µW, the solver has no model of the scene, or the reason is another
    one.
    """

    NONE = ""
    FORCE = "force"  # above µW
    POSE = "pose"  # the solver has no model of the scene
    OTHER = "other"


class CellRecord(TypedRow):
    """Outcome, residuals and cost of the solve of one contact of the stability map."""

    verdict: Verdict
    refused_for: Refusal = Refusal.NONE
    reason: str = ""
    """Name and message of the error; empty if the contact converged."""

    tolerance: float
    residual: float | None = None
    """Largest residual of any increment, as the solver states it."""

    observed: float | None = None
    """Largest residual of any increment, computed from the returned fields alone."""

    increments: int = 0
    halvings: int = 0
    """Number of bisections of increments."""

    rounds: int = 0
    """Largest number of alternating iterations of pressure and shear in any increment."""

    way: str = ""
    """Solution method in words."""

    iterations: int = 0
    """Number of linear systems of finite elements, or of steps of conjugate gradients."""

    convolutions: int = 0
    """Number of convolutions; zero for finite elements."""

    def of_cell(self, cell: StabilityCell) -> CaseRecord:
        """Convert the outcome of a contact to the record that the stability study stores.

        cell  contact, whose values become the parameters of the record
        """
        return CaseRecord(**dict(self.row()) | {"parameters": parameters_of(cell)})

    @property
    def work(self) -> int:
        """Work of the solve: number of convolutions on a surface grid, or of linear systems of
        finite elements."""
        return self.convolutions or self.iterations

    @property
    def worst(self) -> float | None:
        """Larger of the two residuals of the contact: the stated one, and the one computed from its
        fields.

        The value is None if both are missing.
        """
        known = [r for r in (self.residual, self.observed) if r is not None]
        return max(known, default=None)


ORDINARY = StabilityCell()
# The coupling of pressure and shear is strongest for ν = 0 and a rigid ball: β = ½.
BARE = replace(ORDINARY, modulus_ratio=1.0, poisson_ratio=0.0, base_ratio=0.0)
UNCOATED = replace(BARE, poisson_ratio=0.3, base_ratio=0.3)
ALIKE = replace(ORDINARY, surface=Surface.ALIKE_BALL)
HARD_PUSH = 0.95
HARD = replace(ORDINARY, push=HARD_PUSH)
FIRM = replace(ORDINARY, push=0.8)
AT_LIMIT = (1.0, 1.001)  # T/µW: at 1 gross slip with undefined shift; above 1 refused

Axes = Mapping[str, Sequence[Any]]


@dataclass(frozen=True)
class View:
    """Map of contacts over two coordinates, such as friction and tangential force: a chart of the
    study.

    name   name for files
    title  title of the chart
    x, y   names of the two coordinates
    cells  all contacts of the map; contacts at one point (x, y) differ in other coordinates
    """

    name: str
    title: str
    x: str
    y: str
    cells: tuple[StabilityCell, ...]

    def values(self, axis: str) -> tuple[Any, ...]:
        """Return the values of one coordinate that occur in the map of contacts, in ascending
        order.

        Enumeration members are in the order of their definition.

        axis  name of the coordinate
        """
        found = {getattr(cell, axis) for cell in self.cells}
        members = [*LoadingPath, *Surface, *Solver]
        return tuple(sorted(found, key=lambda v: members.index(v) if v in members else v))

    @property
    def wide(self) -> bool:
        """True if the map of contacts has more than one point (x, y), so that a chart makes
        sense."""
        return len(self.values(self.x)) * len(self.values(self.y)) > 1

    @property
    def by_elements(self) -> bool:
        """True if a finite-element solver solves the contacts of the map."""
        return self.cells[0].solver.by_elements

    def at(self, x: Any, y: Any) -> tuple[StabilityCell, ...]:
        """Return the contacts at one point (x, y) of the map.

        x, y  values of the two coordinates of the map, such as friction coefficient and T/µW
        """
        return tuple(c for c in self.cells if getattr(c, self.x) == x and getattr(c, self.y) == y)


@dataclass(frozen=True)
class Asked:
    """Definition of a map of contacts for every level of the study, by values of its coordinates.

    The map contains all combinations of the coordinate values.

    name     name for files
    title    title of the chart
    x, y     names of the two coordinates of the chart
    quick    coordinate values at the quick level
    more     coordinate values at higher levels; None for those of the quick level
    bases    contacts that supply all other coordinates
    further  additional contacts for the other coordinates at higher levels
    least    lowest level that includes the map
    """

    name: str
    title: str
    x: str
    y: str
    quick: Axes
    more: Axes | None = None
    bases: tuple[StabilityCell, ...] = (ORDINARY,)
    further: tuple[StabilityCell, ...] = ()
    least: Level = Level.QUICK

    def view(self, level: Level, cells: int, solvers: Sequence[Solver]) -> View:
        """Build the map of contacts for one level (quick, standard or full) of the study.

        level    level of the study
        cells    cells per side of the surface grid
        solvers  solvers by which each contact is solved
        """
        quick = level is Level.QUICK
        axes = {"solver": solvers, **(self.quick if quick or self.more is None else self.more)}
        found = (
            replace(base, cells=cells, **dict(zip(axes, values, strict=True)))
            for base in (*self.bases, *(() if quick else self.further))
            for values in product(*axes.values())
        )
        return View(self.name, self.title, self.x, self.y, tuple(found))


def views(level: Level, cells: int) -> tuple[View, ...]:
    """Return all maps of contacts at a level (quick, standard or full) of the stability study, for
    all solvers.

    cells  cells per side of the surface grid; the number of finite elements is derived from it
    """
    sections = tuple(solver for solver in Solver if solver.by_elements)
    return tuple(
        asked.view(level, cells, solvers)
        for solvers, all_asked in (
            ((Solver.SEMI_ANALYTICAL,), OF_SURFACES), (sections, OF_SECTIONS)
        )
        for asked in all_asked
        if level >= asked.least
    )  # fmt: skip


def study_cells(level: Level, cells: int) -> tuple[StabilityCell, ...]:
    """Return the contacts of all stability maps at a level (quick, standard or full) of the study,
    without duplicates.

    cells  cells per side of the surface grid
    """
    found = {cell.name: cell for view in views(level, cells) for cell in view.cells}
    return tuple(found.values())


OF_SURFACES = (
    Asked(
        "friction", "Friction and force on a homogeneous body under a rigid ball, T in one step",
        "push", "friction",
        {"friction": (1e-6, 0.1, 1.0, 2.0, 5.0), "push": (0.0, 0.5, 0.9, 0.99999)},
        {
            "friction": (1e-6, 0.01, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0),
            "push": (0.0, 0.3, 0.6, 0.9, 0.99, 0.9999, 0.99999),
        },
        (BARE,), (UNCOATED,),
    ),
    Asked(
        "coating", f"Stiffness and thickness of the coating, T = {HARD_PUSH:g} µW in one step",
        "modulus_ratio", "thickness",
        {
            "modulus_ratio": (1e-3, 0.05, 0.5, 4.0, 20.0, 1e3),
            "thickness": (0.01, 0.1, 1.0, 10.0), "friction": (0.3,),
        },
        {
            "modulus_ratio":
                (1e-6, 1e-3, 0.05, 0.5, 1.0, 2.0, 4.0, 20.0, 100.0, 1e3, 1e4, 1e5, 1e6),
            "thickness": (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0), "friction": (0.1, 1.0),
        },
        (HARD,),
    ),
    Asked(
        "poisson", "Poisson's ratio of the coating, incompressible included",
        "modulus_ratio", "poisson_ratio",
        {
            "modulus_ratio": (0.05, 1.0, 1e3), "poisson_ratio": (0.0, 0.499, 0.5),
            "thickness": (0.01,),
        },
        {
            "modulus_ratio": (1e-3, 0.05, 0.5, 1.0, 2.0, 20.0, 1e3),
            "poisson_ratio": (-0.5, 0.0, 0.3, 0.45, 0.499, 0.5), "thickness": (0.01, 0.1, 1.0),
        },
    ),
    Asked(
        "paths", "Loading paths", "modulus_ratio", "path",
        {"path": tuple(LoadingPath), "modulus_ratio": (0.5, 1.0, 4.0), "friction": (0.1,)},
        {
            "path": tuple(LoadingPath),
            "modulus_ratio": (1e-3, 0.05, 0.5, 1.0, 2.0, 4.0, 20.0, 1e3), "friction": (0.1, 1.0),
        },
        (FIRM,),
    ),
    Asked(
        "surfaces", "Shapes, rough surfaces and uneven friction", "push", "surface",
        {
            "surface": tuple(Surface), "push": (0.5, 0.99), "modulus_ratio": (2.0,),
            "friction": (0.1,),
        },
        {
            "surface": tuple(Surface), "push": (0.0, 0.5, 0.9, 0.99),
            "modulus_ratio": (0.05, 1.0, 2.0, 20.0), "friction": (0.1, 1.0),
        },
    ),
    Asked(
        "scale", "Nanometres to metres, kilopascals to terapascals", "length", "modulus",
        {"length": (1e-9, 1.0), "modulus": (1e3, 1e12)},
        {"length": (1e-9, 1e-6, 1e-3, 1.0), "modulus": (1e3, 1e6, 1e9, 1e12)},
    ),
    Asked(
        "light", "Loads so light that few cells touch", "load", "push",
        {"load": (1e-4, 0.01), "push": (0.6,)},
        {"load": (1e-5, 1e-4, 1e-3, 0.01, 0.1), "push": (0.0, 0.6, 0.99)},
    ),
    Asked(
        "limits", "At the limit of friction and beyond it", "push", "modulus_ratio",
        {"push": AT_LIMIT, "modulus_ratio": (0.5, 4.0)},
    ),
    # Every combination of five coordinates, shown over two of them for each of two others.
    *(
        Asked(
            f"volume-{thickness:g}-{nu:g}".replace(".", "p"),
            f"h/a = {thickness:g}, ν = {nu:g} of the layer; every T/µW in one step",
            "modulus_ratio", "friction",
            {
                "modulus_ratio": (1e-3, 0.05, 0.5, 2.0, 4.0, 20.0, 1e3),
                "friction": (1e-6, 0.1, 0.3, 1.0, 2.0, 5.0),
                "push": (0.0, 0.5, 0.9, 0.99, 0.9999),
            },
            bases=(replace(ORDINARY, thickness=thickness, poisson_ratio=nu),), least=Level.FULL,
        )
        for thickness, nu in product((0.01, 0.1, 1.0, 10.0), (0.0, 0.3, 0.5))
    ),
)  # fmt: skip

# Bodies of revolution with uniform friction, and tangential loads along one line.
SHAPES = tuple(surface for surface in Surface if surface not in NOT_OF_REVOLUTION)
PATHS = tuple(path for path in LoadingPath if path is not LoadingPath.CIRCLE)
OF_SECTIONS = (
    Asked(
        "elements-friction", "Finite elements: friction and force, T in one step",
        "push", "friction",
        {"friction": (0.1, 5.0), "push": (0.5, 0.999)},
        {
            "friction": (1e-6, 0.1, 0.5, 1.0, 2.0, 5.0),
            "push": (0.0, 0.5, 0.9, 0.99, 0.999, 0.9999),
        },
        (BARE,), (ALIKE,),
    ),
    Asked(
        "elements-coating",
        f"Finite elements: stiffness and thickness of the coating, T = {HARD_PUSH:g} µW",
        "modulus_ratio", "thickness",
        {"modulus_ratio": (0.05, 20.0), "thickness": (0.1,), "friction": (0.3,)},
        {
            "modulus_ratio": (1e-6, 1e-3, 0.05, 0.5, 4.0, 20.0, 1e3, 1e6),
            "thickness": (0.01, 0.1, 1.0, 10.0), "friction": (0.1, 1.0),
        },
        (HARD,),
    ),
    Asked(
        "elements-poisson", "Finite elements: Poisson's ratio of a coating of a/10",
        "modulus_ratio", "poisson_ratio",
        {"modulus_ratio": (0.05,), "poisson_ratio": (0.5,)},
        {"modulus_ratio": (1e-3, 0.05, 2.0, 1e3), "poisson_ratio": (0.0, 0.3, 0.45, 0.499, 0.5)},
        (replace(ORDINARY, thickness=0.1),),
    ),
    Asked(
        "elements-paths", "Finite elements: loading paths", "solver", "path",
        {"path": PATHS, "modulus_ratio": (2.0,), "friction": (0.1,)},
        {"path": PATHS, "modulus_ratio": (0.05, 0.5, 2.0, 20.0), "friction": (0.1, 1.0)},
        (FIRM,), (replace(ALIKE, push=FIRM.push),),
    ),
    Asked(
        "elements-surfaces", "Finite elements: shapes", "solver", "surface",
        {"surface": (Surface.ALIKE_BALL, Surface.FLAT_PUNCH), "push": (0.99,), "friction": (0.1,)},
        {"surface": SHAPES, "push": (0.0, 0.5, 0.9, 0.99), "friction": (0.1, 1.0, 3.0)},
    ),
    Asked(
        "elements-scale", "Finite elements: nanometres to metres, kilopascals to terapascals",
        "length", "modulus",
        {"length": (1e-9,), "modulus": (1e3,)},
        {"length": (1e-9, 1e-6, 1.0), "modulus": (1e3, 1e6, 1e12)},
    ),
    Asked(
        "elements-light", "Finite elements: loads far below that of the coordinates",
        "load", "push",
        {"load": (1e-3,), "push": (0.6,)},
        {"load": (1e-5, 1e-3, 0.1), "push": (0.0, 0.6, 0.99)},
    ),
    Asked(
        "elements-limits", "Finite elements: at the limit of friction and beyond it",
        "push", "surface",
        {"push": AT_LIMIT, "surface": (Surface.BALL, Surface.ALIKE_BALL)},
    ),
    Asked(
        "elements-refused", "Finite elements: one of each kind that they cannot pose",
        "path", "surface", {},
        bases=(
            replace(ORDINARY, surface=Surface.ROUGH), replace(ORDINARY, surface=Surface.PATCHY),
            replace(ORDINARY, path=LoadingPath.CIRCLE),
        ),
    ),
    Asked(
        "elements-volume",
        "Finite elements: h/a from a hundredth to ten, ν of the layer up to ½, every T/µW in one "
        "step",
        "modulus_ratio", "friction",
        {
            "modulus_ratio": (1e-3, 0.05, 2.0, 20.0, 1e3), "thickness": (0.01, 0.1, 10.0),
            "poisson_ratio": (0.0, 0.5), "friction": (0.3, 2.0, 5.0), "push": (0.5, 0.999),
        },
        least=Level.FULL,
    ),
)  # fmt: skip
