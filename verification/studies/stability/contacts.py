"""Contacts of the stability map: coordinates, scene, solve and verdict of a contact, and all maps.

The stability map shows which contacts the solvers can solve. The code calls one contact of the map
a cell.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from itertools import product
from typing import Any

import numpy as np

import fem_reference
from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    FiniteElementDiscretisation,
    FlatPunch,
    FrictionMap,
    HeightMap,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SceneError,
)
from contact_scene.array_types import Field
from contact_scene.solver_errors import (
    GrossSliding,
    NotConverged,
    ResourceRefused,
    SolverError,
    UnsupportedScene,
)
from fem_reference import Method
from semi_analytical import (
    ContactAtWindowEdge,
    Coupling,
    Plan,
    Result,
    solve,
)
from semi_analytical.grid import SurfaceGrid
from verification.closed_forms.coated_indentation import (
    LayeredIndentation,
    LayeredSurface,
    flat_punch,
    paraboloid,
)
from verification.judging.case import OTHER_NORMS, Level
from verification.judging.outcome import finite
from verification.observed.observed_laws import observed
from verification.problems.problem import surface_of
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

        Finite elements require bodies of revolution and a uniform friction coefficient.
        """
        return not (self.solver.by_elements and self.surface in NOT_OF_REVOLUTION)

    def compute(self) -> CaseRecord:
        """Solve the contact and record its outcome; an error of the solver is an outcome, too."""
        return judge_contact(self).of_cell(self)

    @property
    def name(self) -> str:
        """File name of the record of the contact: those of its values that differ from the default
        values."""
        ordinary = StabilityCell()
        parts = [
            f"{SHORT[key]}{value:g}" if isinstance(value, float | int) else str(value)
            for key, value in vars(self).items()
            if value != getattr(ordinary, key)
        ]
        return "-".join(parts).replace(".", "p").replace("+", "") or "ordinary"


NOT_OF_REVOLUTION = (Surface.TWO_SPOTS, Surface.ROUGH, Surface.PATCHY, Surface.GREASED)
SHORT = {
    "friction": "mu",
    "push": "T",
    "modulus_ratio": "E",
    "thickness": "h",
    "poisson_ratio": "nu",
    "base_ratio": "base",
    "path": "",
    "surface": "",
    "load": "W",
    "length": "a",
    "modulus": "Pa",
    "cells": "N",
    "solver": "",
}


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
        return max((r for r in (self.residual, self.observed) if r is not None), default=None)


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
            ((Solver.SEMI_ANALYTICAL,), OF_SURFACES),
            (sections, OF_SECTIONS),
        )
        for asked in all_asked
        if level >= asked.least
    )


def study_cells(level: Level, cells: int) -> tuple[StabilityCell, ...]:
    """Return the contacts of all stability maps at a level (quick, standard or full) of the study,
    without duplicates.

    cells  cells per side of the surface grid
    """
    found = {cell.name: cell for view in views(level, cells) for cell in view.cells}
    return tuple(found.values())


OF_SURFACES = (
    Asked(
        "friction",
        "Friction and force on a homogeneous body under a rigid ball, T in one step",
        "push",
        "friction",
        {"friction": (1e-6, 0.1, 1.0, 2.0, 5.0), "push": (0.0, 0.5, 0.9, 0.99999)},
        {
            "friction": (1e-6, 0.01, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0),
            "push": (0.0, 0.3, 0.6, 0.9, 0.99, 0.9999, 0.99999),
        },
        (BARE,),
        (UNCOATED,),
    ),
    Asked(
        "coating",
        f"Stiffness and thickness of the coating, T = {HARD_PUSH:g} µW in one step",
        "modulus_ratio",
        "thickness",
        {
            "modulus_ratio": (1e-3, 0.05, 0.5, 4.0, 20.0, 1e3),
            "thickness": (0.01, 0.1, 1.0, 10.0),
            "friction": (0.3,),
        },
        {
            "modulus_ratio": (
                1e-6,
                1e-3,
                0.05,
                0.5,
                1.0,
                2.0,
                4.0,
                20.0,
                100.0,
                1e3,
                1e4,
                1e5,
                1e6,
            ),
            "thickness": (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0),
            "friction": (0.1, 1.0),
        },
        (HARD,),
    ),
    Asked(
        "poisson",
        "Poisson's ratio of the coating, incompressible included",
        "modulus_ratio",
        "poisson_ratio",
        {
            "modulus_ratio": (0.05, 1.0, 1e3),
            "poisson_ratio": (0.0, 0.499, 0.5),
            "thickness": (0.01,),
        },
        {
            "modulus_ratio": (1e-3, 0.05, 0.5, 1.0, 2.0, 20.0, 1e3),
            "poisson_ratio": (-0.5, 0.0, 0.3, 0.45, 0.499, 0.5),
            "thickness": (0.01, 0.1, 1.0),
        },
    ),
    Asked(
        "paths",
        "Loading paths",
        "modulus_ratio",
        "path",
        {"path": tuple(LoadingPath), "modulus_ratio": (0.5, 1.0, 4.0), "friction": (0.1,)},
        {
            "path": tuple(LoadingPath),
            "modulus_ratio": (1e-3, 0.05, 0.5, 1.0, 2.0, 4.0, 20.0, 1e3),
            "friction": (0.1, 1.0),
        },
        (FIRM,),
    ),
    Asked(
        "surfaces",
        "Shapes, rough surfaces and uneven friction",
        "push",
        "surface",
        {
            "surface": tuple(Surface),
            "push": (0.5, 0.99),
            "modulus_ratio": (2.0,),
            "friction": (0.1,),
        },
        {
            "surface": tuple(Surface),
            "push": (0.0, 0.5, 0.9, 0.99),
            "modulus_ratio": (0.05, 1.0, 2.0, 20.0),
            "friction": (0.1, 1.0),
        },
    ),
    Asked(
        "scale",
        "Nanometres to metres, kilopascals to terapascals",
        "length",
        "modulus",
        {"length": (1e-9, 1.0), "modulus": (1e3, 1e12)},
        {"length": (1e-9, 1e-6, 1e-3, 1.0), "modulus": (1e3, 1e6, 1e9, 1e12)},
    ),
    Asked(
        "light",
        "Loads so light that few cells touch",
        "load",
        "push",
        {"load": (1e-4, 0.01), "push": (0.6,)},
        {"load": (1e-5, 1e-4, 1e-3, 0.01, 0.1), "push": (0.0, 0.6, 0.99)},
    ),
    Asked(
        "limits",
        "At the limit of friction and beyond it",
        "push",
        "modulus_ratio",
        {"push": AT_LIMIT, "modulus_ratio": (0.5, 4.0)},
    ),
    # Every combination of five coordinates, shown over two of them for each of two others.
    *(
        Asked(
            f"volume-{thickness:g}-{nu:g}".replace(".", "p"),
            f"h/a = {thickness:g}, ν = {nu:g} of the layer; every T/µW in one step",
            "modulus_ratio",
            "friction",
            {
                "modulus_ratio": (1e-3, 0.05, 0.5, 2.0, 4.0, 20.0, 1e3),
                "friction": (1e-6, 0.1, 0.3, 1.0, 2.0, 5.0),
                "push": (0.0, 0.5, 0.9, 0.99, 0.9999),
            },
            bases=(replace(ORDINARY, thickness=thickness, poisson_ratio=nu),),
            least=Level.FULL,
        )
        for thickness, nu in product((0.01, 0.1, 1.0, 10.0), (0.0, 0.3, 0.5))
    ),
)

# Bodies of revolution with uniform friction. Of turning loads one cell stands for all.
SHAPES = tuple(surface for surface in Surface if surface not in NOT_OF_REVOLUTION)
PATHS = tuple(path for path in LoadingPath if path is not LoadingPath.CIRCLE)
OF_SECTIONS = (
    Asked(
        "elements-friction",
        "Finite elements: friction and force, T in one step",
        "push",
        "friction",
        {"friction": (0.1, 5.0), "push": (0.5, 0.999)},
        {
            "friction": (1e-6, 0.1, 0.5, 1.0, 2.0, 5.0),
            "push": (0.0, 0.5, 0.9, 0.99, 0.999, 0.9999),
        },
        (BARE,),
        (ALIKE,),
    ),
    Asked(
        "elements-coating",
        f"Finite elements: stiffness and thickness of the coating, T = {HARD_PUSH:g} µW",
        "modulus_ratio",
        "thickness",
        {"modulus_ratio": (0.05, 20.0), "thickness": (0.1,), "friction": (0.3,)},
        {
            "modulus_ratio": (1e-6, 1e-3, 0.05, 0.5, 4.0, 20.0, 1e3, 1e6),
            "thickness": (0.01, 0.1, 1.0, 10.0),
            "friction": (0.1, 1.0),
        },
        (HARD,),
    ),
    Asked(
        "elements-poisson",
        "Finite elements: Poisson's ratio of a coating of a/10",
        "modulus_ratio",
        "poisson_ratio",
        {"modulus_ratio": (0.05,), "poisson_ratio": (0.5,)},
        {"modulus_ratio": (1e-3, 0.05, 2.0, 1e3), "poisson_ratio": (0.0, 0.3, 0.45, 0.499, 0.5)},
        (replace(ORDINARY, thickness=0.1),),
    ),
    Asked(
        "elements-paths",
        "Finite elements: loading paths",
        "solver",
        "path",
        {"path": PATHS, "modulus_ratio": (2.0,), "friction": (0.1,)},
        {"path": PATHS, "modulus_ratio": (0.05, 0.5, 2.0, 20.0), "friction": (0.1, 1.0)},
        (FIRM,),
        (replace(ALIKE, push=FIRM.push),),
    ),
    Asked(
        "elements-surfaces",
        "Finite elements: shapes",
        "solver",
        "surface",
        {"surface": (Surface.ALIKE_BALL, Surface.FLAT_PUNCH), "push": (0.99,), "friction": (0.1,)},
        {"surface": SHAPES, "push": (0.0, 0.5, 0.9, 0.99), "friction": (0.1, 1.0, 3.0)},
    ),
    Asked(
        "elements-scale",
        "Finite elements: nanometres to metres, kilopascals to terapascals",
        "length",
        "modulus",
        {"length": (1e-9,), "modulus": (1e3,)},
        {"length": (1e-9, 1e-6, 1.0), "modulus": (1e3, 1e6, 1e12)},
    ),
    Asked(
        "elements-light",
        "Finite elements: loads far below that of the coordinates",
        "load",
        "push",
        {"load": (1e-3,), "push": (0.6,)},
        {"load": (1e-5, 1e-3, 0.1), "push": (0.0, 0.6, 0.99)},
    ),
    Asked(
        "elements-limits",
        "Finite elements: at the limit of friction and beyond it",
        "push",
        "surface",
        {"push": AT_LIMIT, "surface": (Surface.BALL, Surface.ALIKE_BALL)},
    ),
    Asked(
        "elements-refused",
        "Finite elements: one of each kind that they cannot pose",
        "path",
        "surface",
        {},
        bases=(
            replace(ORDINARY, surface=Surface.ROUGH),
            replace(ORDINARY, surface=Surface.PATCHY),
            replace(ORDINARY, path=LoadingPath.CIRCLE),
        ),
    ),
    Asked(
        "elements-volume",
        "Finite elements: h/a from a hundredth to ten, ν of the layer up to ½, every T/µW in one "
        "step",
        "modulus_ratio",
        "friction",
        {
            "modulus_ratio": (1e-3, 0.05, 2.0, 20.0, 1e3),
            "thickness": (0.01, 0.1, 10.0),
            "poisson_ratio": (0.0, 0.5),
            "friction": (0.3, 2.0, 5.0),
            "push": (0.5, 0.999),
        },
        least=Level.FULL,
    ),
)


PRESSING = 3  # increments; large increments are the difficult ones
LEAST = 0.01  # remaining fraction of the normal force after unloading
REVERSED_AT = 0.85  # of the normal force
NEARLY_ALL = 0.98  # T/µW where falling W ends
ONCE_ROUND = 6  # increments of a circle
SLIDES_FAR = 20.0  # multiple of µδ, which is about the shift at gross slip


@dataclass(frozen=True)
class Loads:
    """Loads of a contact of the stability map, from which its load steps are built.

    normal_force  W [force]
    approach      rigid approach under W without friction [length]
    friction      coefficient of friction µ
    push          tangential force T over µW
    """

    normal_force: float
    approach: float
    friction: float
    push: float

    @property
    def full(self) -> float:
        """Tangential force T [force] of a complete push."""
        return self.push * self.friction * self.normal_force

    def ramp(self, increments: int, *, W: float | None = None, T: float | None = None) -> LoadStep:
        """Create a load step to fractions of both forces.

        increments  number of increments
        W, T        fractions of the normal and of the full tangential force; None keeps the force
        """
        return LoadStep(
            normal_force=None if W is None else W * self.normal_force,
            tangential_force=None if T is None else (T * self.full, 0.0),
            increments=increments,
        )


def load_steps_of_path(path: LoadingPath, loads: Loads) -> tuple[LoadStep, ...]:
    """Return the load steps of a contact of the stability map for one kind of loading path.

    The increments are few and large, because the map studies if such increments converge.

    path   kind of loading path
    loads  normal force, approach, coefficient of friction, and tangential force over µW
    """

    def shift(increments: int, by: float) -> LoadStep:
        return LoadStep(tangential_shift=(by, 0.0), increments=increments)

    press, push = loads.ramp(PRESSING, W=1.0), loads.ramp(1, T=1.0)
    match path:
        case LoadingPath.PRESS:
            return (press,)
        case LoadingPath.PUSH:
            return press, push
        case LoadingPath.LOOP:
            return press, push, loads.ramp(2, T=-1.0), loads.ramp(2, T=1.0)
        case LoadingPath.CIRCLE:
            angles = np.linspace(0, 2 * np.pi, ONCE_ROUND + 1)
            turns = ((loads.full * float(np.cos(t)), loads.full * float(np.sin(t))) for t in angles)
            return press, *(LoadStep(tangential_force=force, increments=1) for force in turns)
        case LoadingPath.REVERSED:
            part = min(1.0, REVERSED_AT / max(loads.push, REVERSED_AT))
            return press, push, loads.ramp(3, T=-0.99 * part, W=REVERSED_AT)
        case LoadingPath.RELOADED:
            return press, loads.ramp(4, W=LEAST), loads.ramp(3, W=1.0)
        case LoadingPath.SHEARED_RELOAD:
            return press, push, loads.ramp(4, T=0.0, W=LEAST), loads.ramp(3, T=1.0, W=1.0)
        case LoadingPath.FALLING:
            return press, push, loads.ramp(3, W=min(1.0, loads.push / NEARLY_ALL))
        case LoadingPath.SLIDE:
            unit = max(loads.friction, LEAST) * loads.approach
            return press, shift(2, 0.5 * unit), shift(2, SLIDES_FAR * unit), shift(2, 0.0)
        case LoadingPath.APPROACH:
            return (
                LoadStep(approach=loads.approach, increments=PRESSING),
                shift(1, loads.push * loads.friction * loads.approach),
                LoadStep(approach=0.5 * loads.approach, increments=2),
            )


RADIUS = 46.4  # of the ball, over the contact radius: the paper's
SLOPE = 0.02
# half the window over the contact radius
MARGIN = 1.3
ROUGH_MARGIN = 1.6
SPOTS = 0.55  # distance of a spot from the middle, over the contact radius
SPOTS_FORCE = 0.15  # over that of one ball, so that the spots do not touch
ROUGHNESS = 0.02  # standard deviation over the approach
GREASE = 0.5  # radius of the greased disc over the contact radius
WITHOUT_FRICTION = 0.3  # fraction of µ; smaller values become 0 on a patchy surface
SURELY = 0.97
SEED = 3
TOLERANCE = 1e-8
CELLS_PER_ELEMENT = 4  # along a side of the window, per element along a contact radius
# Gaps are rounded relative to the largest in the window, residuals are relative to the approach.
GAP_ROUNDING = 10 * float(np.finfo(float).eps)

Indenter = Paraboloid | FlatPunch | Cone | HeightMap


@dataclass(frozen=True)
class Posed:
    """Scene and discretisations of a contact of the stability map, as the solvers require them.

    scene      bodies, friction and load steps
    grid       surface grid for the semi-analytical solver, whose window should contain the contact
    elements   elements per contact radius, for finite elements
    tolerance  largest allowed residual, relative
    """

    scene: Scene
    grid: SurfaceGrid
    elements: int
    tolerance: float


def pose(cell: StabilityCell) -> Posed:
    """Build the scene and the discretisation of a contact of the stability map.

    Raises SceneError for an invalid scene.

    cell  values that define the contact
    """
    a = cell.length
    both = (_coated_body(cell),) * (2 if cell.surface is Surface.ALIKE_BALL else 1)
    answer = surface_of(*both)
    ball = paraboloid(answer, RADIUS * a, a)
    half_width = a * (ROUGH_MARGIN if cell.surface is Surface.ROUGH else MARGIN)
    grid = SurfaceGrid((cell.cells, cell.cells), (2 * half_width, 2 * half_width))
    indenter = _indenter(cell, ball.approach, grid)
    W = cell.load * _estimated_force(cell, answer, ball)
    approach = cell.load ** (2 / 3) * ball.approach
    friction = _friction_coefficients(cell, grid)
    scene = Scene(
        title=f"Stability map: {cell.name}",
        indenter=indenter,
        body=_lower_body(cell),
        friction=CoulombFriction(coefficient=friction),
        loading=load_steps_of_path(
            cell.path, Loads(W, approach, _mean_friction(friction, cell, grid), cell.push)
        ),
    )
    gap = indenter.initial_gap(*grid.coordinates())
    rounding = GAP_ROUNDING * float(np.max(gap, where=np.isfinite(gap), initial=0.0)) / approach
    # The mesh of a section is adapted to the contact, so that its gaps have no such round-off.
    tolerance = TOLERANCE if cell.solver.by_elements else max(TOLERANCE, rounding)
    return Posed(scene, grid, cell.cells // CELLS_PER_ELEMENT, tolerance)


def _coating_and_substrate(cell: StabilityCell) -> tuple[IsotropicMaterial, IsotropicMaterial]:
    """Return the elastic materials of coating and substrate of a contact of the stability map."""
    E, ratio = cell.modulus, cell.modulus_ratio
    return (
        IsotropicMaterial(young_modulus=ratio * E, poisson_ratio=cell.poisson_ratio),
        IsotropicMaterial(young_modulus=E, poisson_ratio=cell.base_ratio),
    )


def _coated_body(cell: StabilityCell) -> Body:
    film, base = _coating_and_substrate(cell)
    return Body(
        material=base, layers=(Layer(thickness=cell.thickness * cell.length, material=film),)
    )


def _lower_body(cell: StabilityCell) -> Body:
    """Return the lower body of a contact of the stability map, with its coating.

    The coating is left out if its material equals that of the substrate.
    """
    film, base = _coating_and_substrate(cell)
    return Body(material=base) if film == base else _coated_body(cell)


def _indenter(cell: StabilityCell, approach: float, grid: SurfaceGrid) -> Indenter:
    a, R = cell.length, RADIUS * cell.length
    match cell.surface:
        case Surface.ALIKE_BALL:
            body = _lower_body(cell)
            return Paraboloid(radius=R, material=body.material, layers=body.layers)
        case Surface.FLAT_PUNCH:
            return FlatPunch(radius=a, material=RIGID)
        case Surface.CONE:
            return Cone(slope_angle=float(np.arctan(SLOPE)), material=RIGID)
        case Surface.TWO_SPOTS:
            return _height_map(
                np.minimum(_parabolic_gap(grid, R, -SPOTS * a), _parabolic_gap(grid, R, SPOTS * a)),
                grid,
            )
        case Surface.ROUGH:
            noise = np.random.default_rng(SEED).standard_normal(grid.cells)
            return _height_map(_parabolic_gap(grid, R) + ROUGHNESS * approach * noise, grid)
        case _:
            return Paraboloid(radius=R, material=RIGID)


def _parabolic_gap(grid: SurfaceGrid, radius: float, x0: float = 0.0) -> Field:
    x, y = grid.coordinates()
    return np.asarray(((x - x0) ** 2 + y**2) / (2 * radius))


def _height_map(heights: Field, grid: SurfaceGrid) -> HeightMap:
    return HeightMap.model_validate(
        {"shape": "height_map", "file": heights, "spacing": grid.spacing, "material": RIGID}
    )


def _estimated_force(
    cell: StabilityCell, answer: LayeredSurface, ball: LayeredIndentation
) -> float:
    """Estimate the normal force under which a contact of the stability map has its prescribed
    radius.

    cell    values that define the contact
    answer  elastic response of the surface of the layered body
    ball    frictionless contact of the ball with that contact radius
    """
    match cell.surface:
        case Surface.FLAT_PUNCH:
            return flat_punch(answer, cell.length).load * ball.approach
        case Surface.CONE:
            # On the half-space that the ball would press as deep as this body.
            return ball.load * 3 * np.pi * RADIUS * SLOPE / 8
        case Surface.TWO_SPOTS:
            return SPOTS_FORCE * ball.load
        case _:
            return ball.load


def _mean_friction(friction: float | FrictionMap, cell: StabilityCell, grid: SurfaceGrid) -> float:
    """Return the mean coefficient of friction of a contact, which determines its tangential force.

    Nonuniform coefficients are weighted by the Hertz pressure. Their mean is reduced by 3 %,
    because the actual pressure differs from the Hertz pressure.

    friction  uniform coefficient, or map of coefficients
    cell      values that define the contact
    grid      surface grid
    """
    if not isinstance(friction, FrictionMap):
        return friction
    x, y = grid.coordinates()
    p = np.sqrt(np.maximum(1 - (x**2 + y**2) / cell.length**2, 0.0))
    coefficients = friction.on_grid(grid.cells, grid.spacing).map.values
    return float(SURELY * np.sum(coefficients * p) / np.sum(p))


def _friction_coefficients(cell: StabilityCell, grid: SurfaceGrid) -> float | FrictionMap:
    """Return the coefficient of friction of a contact, or a map of coefficients on the surface
    grid.

    A patchy surface has random coefficients between 0 and 2µ; those below 0.3µ are set to zero. A
    greased surface has no friction in a disc of half the contact radius. Others have the uniform µ.
    """
    if cell.surface is Surface.PATCHY:
        values = np.random.default_rng(SEED).uniform(0, 2 * cell.friction, grid.cells)
        return _reflected_friction_map(
            np.where(values < WITHOUT_FRICTION * cell.friction, 0.0, values), grid
        )
    if cell.surface is Surface.GREASED:
        outside = np.hypot(*grid.coordinates()) > GREASE * cell.length
        return _reflected_friction_map(np.where(outside, cell.friction, 0.0), grid)
    return cell.friction


def _reflected_friction_map(values: Field, grid: SurfaceGrid) -> FrictionMap:
    """Build a friction map that continues coefficients on the grid by reflection beyond the window.

    The continuation is needed if the contact requires a wider window.

    values  coefficients of friction at the cells (nx, ny)
    """
    values = np.pad(values, [(count, count) for count in grid.cells], mode="symmetric")
    return FrictionMap.model_validate({"map": values, "spacing": grid.spacing})


GROWTH = 1.3
MAX_WINDOWS = 4
ELEMENTS_PER_HARMONIC = 2


Solved = tuple[Any, str]  # result of a solver, and its solution method in words


def by_superposition(posed: Posed) -> Solved:
    """Solve a contact of the stability map with the semi-analytical solver.

    If the contact reaches the edge of the window, the solve is repeated in a wider window.

    posed  scene and surface grid of the contact
    """
    result = _solve_in_window(posed)
    return result, _method_text(result.plan)


def by_elements(posed: Posed, method: Method) -> Solved:
    """Solve a contact of the stability map with finite elements.

    posed   scene and discretisation of the contact
    method  enforcement of the contact and friction laws: complementarity or penalty
    """
    path = fem_reference.plan(posed.scene).path
    on_harmonics = path in (fem_reference.Path.HARMONICS, fem_reference.Path.WHOLE_CIRCLE)
    discretisation = FiniteElementDiscretisation(
        elements_per_radius=posed.elements,
        harmonics=posed.elements // ELEMENTS_PER_HARMONIC,
        # The study tests the convergence of the penalty method, not its remaining overlap.
        augmentations=0 if on_harmonics else 1,
        overlap=100.0,
        tolerance=posed.tolerance,
    )
    result = fem_reference.solve(posed.scene, discretisation, method)
    ways = sorted({i.path for i in result.increments if i.path is not None})
    return result, "; ".join([result.plan.path.value, *ways])


SOLVERS: dict[Solver, Callable[[Posed], Solved]] = {
    Solver.SEMI_ANALYTICAL: by_superposition,
    Solver.COMPLEMENTARITY: partial(by_elements, method=Method.COMPLEMENTARITY),
    Solver.PENALTY: partial(by_elements, method=Method.PENALTY),
}


def _solve_in_window(posed: Posed) -> Result:
    grid = posed.grid
    for _ in range(MAX_WINDOWS):
        try:
            return solve(posed.scene, grid, posed.tolerance)
        except ContactAtWindowEdge:
            if posed.scene.indenter.extent is not None:
                raise
            grid = SurfaceGrid(grid.cells, (GROWTH * grid.window[0], GROWTH * grid.window[1]))
    return solve(posed.scene, grid, posed.tolerance)


def _method_text(decided: Plan) -> str:
    if not decided.shear:
        return "pressure alone"
    if decided.coupling is Coupling.NONE:
        return "pressure, then shear"
    return "pressure and shear together"


# Errors that refuse a scene for its load, its kind or its size.
REFUSALS = (GrossSliding, UnsupportedScene, ResourceRefused)


def judge_contact(cell: StabilityCell) -> CellRecord:
    """Solve a contact of the stability map and return its verdict, residuals and cost.

    Errors of the scene or the solver become verdicts and are not raised. A result whose residuals
    exceed the allowed values is wrong without a message.
    """
    try:
        posed = pose(cell)
    except SceneError as error:
        return _failure_record(Verdict.REFUSED, error, TOLERANCE)
    tolerance = posed.tolerance
    try:
        result, way = SOLVERS[cell.solver](posed)
    except REFUSALS as error:
        return _failure_record(Verdict.REFUSED, error, tolerance)
    except SolverError as error:
        return _failure_record(Verdict.NOT_CONVERGED, error, tolerance)
    increments, seen = result.increments, observed(result).violation
    # np.max propagates a residual that is NaN.
    residual = float(np.max([increment.residuals.worst for increment in increments]))
    sound = residual <= tolerance and seen <= OTHER_NORMS * tolerance
    return CellRecord(
        verdict=Verdict.CONVERGED if sound else Verdict.SILENT,
        reason="" if np.isfinite([residual, seen]).all() else "some number is not finite",
        tolerance=tolerance,
        residual=finite(residual),
        observed=finite(seen),
        increments=len(increments),
        halvings=sum(increment.halvings for increment in increments),
        way=way,
        iterations=sum(increment.iterations for increment in increments),
        convolutions=sum(increment.convolutions or 0 for increment in increments),
    )


def _failure_record(verdict: Verdict, error: Exception, tolerance: float) -> CellRecord:
    return CellRecord(
        verdict=verdict,
        refused_for=_refusal_category(error) if verdict is Verdict.REFUSED else Refusal.NONE,
        reason=f"{type(error).__name__}: {error}",
        tolerance=tolerance,
        residual=finite(error.residual) if isinstance(error, NotConverged) else None,
    )


def _refusal_category(error: Exception) -> Refusal:
    """Return the category of an error by which a solver refuses a contact of the stability map.

    The category follows from the type of the error and the keys of the scene that the error names.
    A tangential force can only be refused for its size.
    """
    if isinstance(error, UnsupportedScene):
        return Refusal.POSE
    keys = {problem.path[-1:] for problem in getattr(error, "problems", ())}
    if isinstance(error, GrossSliding) or keys == {("tangential_force",)}:
        return Refusal.FORCE
    return Refusal.OTHER
