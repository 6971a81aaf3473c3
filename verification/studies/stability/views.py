"""Which cells the map has: two-dimensional views of it, each over two of the coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from verification.judging.case import Level
from verification.studies.stability.cell import (
    NOT_OF_REVOLUTION,
    LoadingPath,
    Solver,
    StabilityCell,
    Surface,
)

ORDINARY = StabilityCell()
# Nothing is as coupled as ν = 0 below a rigid ball: β = ½.
BARE = replace(ORDINARY, modulus_ratio=1.0, poisson_ratio=0.0, base_ratio=0.0)
UNCOATED = replace(BARE, poisson_ratio=0.3, base_ratio=0.3)
ALIKE = replace(ORDINARY, surface=Surface.ALIKE_BALL)
HARD_PUSH = 0.95
HARD = replace(ORDINARY, push=HARD_PUSH)
FIRM = replace(ORDINARY, push=0.8)
AT_LIMIT = (1.0, 1.001)  # T/µW: all slides and the shift is undefined; beyond, it is refused

Axes = Mapping[str, Sequence[Any]]


@dataclass(frozen=True)
class View:
    """A map over two coordinates.

    name     for files
    x, y     names of coordinates
    cells    every cell of it; several at one place differ in other coordinates
    """

    name: str
    title: str
    x: str
    y: str
    cells: tuple[StabilityCell, ...]

    def values(self, axis: str) -> tuple[Any, ...]:
        """The values of a coordinate, in order."""
        found = {getattr(cell, axis) for cell in self.cells}
        members = [*LoadingPath, *Surface, *Solver]
        return tuple(sorted(found, key=lambda v: members.index(v) if v in members else v))

    @property
    def wide(self) -> bool:
        """Whether there is more than one place to see."""
        return len(self.values(self.x)) * len(self.values(self.y)) > 1

    @property
    def by_elements(self) -> bool:
        """Whether finite elements solve its cells."""
        return self.cells[0].solver.by_elements

    def at(self, x: Any, y: Any) -> tuple[StabilityCell, ...]:
        """The cells at one place."""
        return tuple(c for c in self.cells if getattr(c, self.x) == x and getattr(c, self.y) == y)


@dataclass(frozen=True)
class Asked:
    """A view at every level: all combinations of the values of its axes.

    quick    axes at the quick level
    more     axes at the levels above; the quick ones where there are no others
    bases    cells that have the other coordinates
    further  more of these at the levels above
    least    the lowest level that has it
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
        """With so many cells of a surface grid along each side."""
        quick = level is Level.QUICK
        axes = {"solver": solvers, **(self.quick if quick or self.more is None else self.more)}
        found = (
            replace(base, cells=cells, **dict(zip(axes, values, strict=True)))
            for base in (*self.bases, *(() if quick else self.further))
            for values in product(*axes.values())
        )
        return View(self.name, self.title, self.x, self.y, tuple(found))


def views(level: Level, cells: int) -> tuple[View, ...]:
    """The views of a level: of the semi-analytical solver, and of finite elements by both methods.

    cells  of a surface grid along each side; sections have as many elements as `pose` makes of it
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
    """Every cell of a level, once."""
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

# Of revolution, under friction that is the same everywhere and loads along a line.
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
