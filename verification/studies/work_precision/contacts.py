"""The contacts of the study: problems whose answer is known, and the errors that are looked at.

Errors are relative to the reference. Norms of fields compare what the values of a method mean:
means over cells, values at the rings of the radial solver, functions that are linear between the
rings of finite elements. They include the edge where the reference reaches to it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import radial
from contact_results.surface import surface_of
from semi_analytical import SurfaceGrid
from verification import norms
from verification.cases import coatings as coated
from verification.cell_means import round_means
from verification.judging import field_errors
from verification.judging.observable import Observable, error_norm
from verification.judging.observables import (
    APPROACH,
    ENERGY_PER_CYCLE,
    LARGEST_SHIFT_ERROR,
    PEAK_PRESSURE,
    SHIFT,
)
from verification.judging.pressing_errors import pressure_at, shear_at
from verification.problems import paper_scene as paper
from verification.problems.cattaneo_mindlin import (
    OVER_LIMIT,
    sheared,
)
from verification.problems.hertz import BALL
from verification.problems.indentation import COATED
from verification.problems.loop_history import WINDOW_PER_RADIUS, ExactLoop, fretting_loop
from verification.problems.paper_scene import FRICTION, NU_ZERO
from verification.problems.problem import OVER_PEAK, Problem
from verification.quantities import shear_of

Field = NDArray[np.float64]
Errors = Mapping[str, float]

SHEARED = 0.9  # of µW
LOOPED = ExactLoop(NU_ZERO)
LARGEST = LOOPED.end.shift
QUARTER = 3  # increments from T = 0 to the largest
JUDGED = (0.1 - 1e-9, 0.9 + 1e-9)  # part of the radius where the tractions under friction are


@dataclass(frozen=True)
class PreciseContact:
    """A contact with a reference.

    title       for people
    errors      what is measured, in words: fields, which are judged by a norm, and numbers
    observables the same, as what is read off a result of either solver
    posed       by the number of increments, where the path decides
    window      over the contact radius
    increments  of the step that decides, unless the study varies them; None: one will do
    """

    name: str
    title: str
    errors: Mapping[str, str]
    observables: tuple[Observable, ...]
    posed: Callable[[int], Problem]
    window: float = paper.WINDOW_PER_RADIUS
    increments: int | None = None

    @property
    def problem(self) -> Problem:
        """In one increment."""
        return self.posed(1)

    @property
    def leading(self) -> str:
        """The error that comes first."""
        return next(iter(self.errors))

    def meaning(self, quantity: str) -> str:
        """Of one of the errors, with the contact, for people."""
        return f"{self.title}: {self.errors[quantity]}"

    def errors_of(self, result: Any) -> Errors:
        """By either solver."""
        named = zip(self.errors, self.observables, strict=True)
        return {name: one.error(self.problem)(result) for name, one in named}

    def grid(self, cells: int) -> SurfaceGrid:
        """A square grid around the contact."""
        return paper.square_grid(cells, self.window / 2 * self.problem.radius)


def _pressure_l2(result: Any, step: int, problem: Problem) -> float:
    """Relative L2 error of the pressure [1]."""
    end, exact = result.steps[step], problem.ends[step].pressure
    if hasattr(result, "grid"):
        return norms.relative_l2(end.pressure, _means(exact, result.grid))
    if not isinstance(result, radial.Result):
        return field_errors.pressure_l2(result, step, problem)
    surface: Any = surface_of(result)
    part = np.sqrt(surface.weights)
    known = exact(np.hypot(*surface.positions))
    return norms.relative_l2(part * surface.scalar(end, "pressure"), part * known)


def _shear_l1(result: Any, step: int, problem: Problem) -> float:
    """Σ|q - q_exact| / Σµp [1]."""
    end, exact = result.steps[step], problem.ends[step].shear
    if hasattr(result, "grid"):
        known = _means(exact, result.grid)
        return norms.shear_error(shear_of(end), known, FRICTION * end.pressure)
    if not isinstance(result, radial.Result):
        return field_errors.shear_error(result, step, problem)
    surface: Any = surface_of(result)
    areas, known = surface.weights, exact(np.hypot(*surface.positions))
    limit = areas * FRICTION * surface.scalar(end, "pressure")
    return norms.shear_error(areas * surface.vector(end, "shear"), areas * known, limit)


def _means(exact: Callable[[Field], Field], grid: SurfaceGrid) -> Field:
    return round_means(exact, *grid.coordinates(), grid.spacing)


@cache
def _pushed(increments: int) -> Problem:
    problem = sheared("Cattaneo-Mindlin, ν = 0", (SHEARED,))
    press, push = problem.scene.loading
    loading = (press, push.model_copy(update={"increments": increments}))
    return replace(problem, scene=problem.scene.model_copy(update={"loading": loading}))


def _largest_error(
    at: Callable[[Any, Field], Field], exact: Callable[[Any], Callable[[Field], Field]], scale: str
) -> Observable:
    """Of a traction at the radii of a table, over its scale."""

    def measure(result: Any, step: int, problem: Problem) -> float:
        answer = problem.ends[step]
        part = answer.radii / problem.radius
        r = answer.radii[(part >= JUDGED[0]) & (part <= JUDGED[1])]
        error = at(result, r) - exact(answer)(r)[:, None]
        return float(np.max(np.abs(error)) / problem.scale(scale))

    return error_norm("traction", "", measure, scale)


PRESSURE = error_norm("pressure", "pressure over the {domain}, L2", _pressure_l2, norm="L2")
SHEAR = error_norm("shear", "{sum}|q - q_exact| / {sum}µp{when}", _shear_l1, "Σµp")
HERTZIAN = PreciseContact(
    "hertz",
    "Hertz",
    {"pressure": "pressure, L2", "peak": "peak pressure", "approach": "approach"},
    (PRESSURE, PEAK_PRESSURE, APPROACH),
    lambda _: BALL,
)
CATTANEO = PreciseContact(
    "cattaneo",
    "Cattaneo-Mindlin, ν = 0",
    {"shear": "shear at 0.9 µW, Σ|q - q_exact| / Σµp", "shift": "shift over the sliding shift"},
    (SHEAR, SHIFT),
    _pushed,
)
COATING = PreciseContact(
    "coated",
    "Coated, E1/E2 = 2, without friction",
    {"pressure": "pressure, L2", "approach": "approach"},
    (PRESSURE, APPROACH),
    lambda _: coated.EXACT,
)
INDENTATION = PreciseContact(
    "indentation",
    "Coated, pressed with friction",
    {
        "shear": "shear from 0.1 to 0.9 of the radius, largest, over µp_H",
        "pressure": "pressure there, largest, over p_H",
        "approach": "approach",
    },
    (
        _largest_error(shear_at, lambda answer: answer.shear, OVER_LIMIT),
        _largest_error(pressure_at, lambda answer: answer.pressure, OVER_PEAK),
        APPROACH,
    ),
    COATED.problem,
    increments=20,
)
LOOP = PreciseContact(
    "loop",
    "Fretting loop, ν = 0",
    {"energy": "energy of a cycle", "shift": "largest error of the shift"},
    (ENERGY_PER_CYCLE, LARGEST_SHIFT_ERROR),
    lambda quarter: fretting_loop("Fretting loop, ν = 0", NU_ZERO, quarter),
    window=WINDOW_PER_RADIUS,
    increments=QUARTER,
)
CONTACTS = {c.name: c for c in (HERTZIAN, CATTANEO, COATING, INDENTATION, LOOP)}
