"""The contacts of the study: their scenes, how each solver meets them, and the errors they leave.

Errors are relative to the reference, and signed where the quantity is one number, so that two grids
can be extrapolated. Fields are judged by one norm for both solvers, edge included where the
reference reaches to it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.quantities import shear_of, shift_along_x
from contact_scene import LoadStep, Scene
from fem_reference import Result as Section
from semi_analytical import Result as Surface
from semi_analytical import SurfaceGrid
from verification.cases import coated_paraboloid as coated
from verification.cases.fretting_loop import WINDOW_PER_RADIUS
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.judging.observables import APPROACH, PRESSURE_L2
from verification.norms import shear_error
from verification.observed.end_state import approach, peak_pressure
from verification.observed.radial_profile import along_radii, outward
from verification.observed.ring_errors import at_radii
from verification.problems import paper_scene as paper
from verification.problems.coated_ball import SOURCE as COATINGS
from verification.problems.hertz import BALL
from verification.problems.indentation import COATED
from verification.problems.loop_history import SOURCE as LOOP_SOURCE
from verification.problems.loop_history import ExactLoop, loop_energy, loop_steps
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, HERTZ, NU_ZERO
from verification.problems.sheared import SLIDING_SHIFT
from verification.studies.work_precision.frozen_route import FrozenHistory

Field = NDArray[np.float64]
Errors = Mapping[str, float]

SHEARED = 0.9  # of µW
LOOPED = ExactLoop(NU_ZERO)
LARGEST = LOOPED.end.shift
QUARTER = 3  # increments from T = 0 to the largest
JUDGED = (0.1, 0.9)  # part of the radius where the tractions of the last contact are judged


@dataclass(frozen=True)
class PreciseContact:
    """A contact with a reference.

    title      for people
    errors     what is measured, in words: fields, which are judged by a norm, and numbers
    radius     expected contact radius [length]
    window     over that radius
    scene      by the number of increments, where the path decides
    increments of the step that decides, unless the study varies them; None: one will do
    surface    errors of the semi-analytical method
    section    errors of the finite elements
    source     of the reference
    turns      shifts at which a tangential motion turns, and its end [length]; empty without one
    frozen     errors of the usual route along them
    """

    name: str
    title: str
    errors: Mapping[str, str]
    radius: float
    scene: Callable[[int], Scene]
    surface: Callable[[Surface], Errors]
    section: Callable[[Section], Errors]
    source: str
    window: float = paper.WINDOW_PER_RADIUS
    increments: int | None = None
    turns: tuple[float, ...] = ()
    frozen: Callable[[FrozenHistory], Errors] = lambda history: {}

    def grid(self, cells: int, window: float | None = None) -> SurfaceGrid:
        """A square grid around the contact."""
        return paper.square_grid(cells, (window or self.window) / 2 * self.radius)


def _hertz(result: Any) -> Errors:
    return {
        "peak": peak_pressure(result) / HERTZ.peak_pressure - 1,
        "approach": approach(result) / HERTZ.approach - 1,
    }


def _hertz_surface(result: Surface) -> Errors:
    return {"pressure": PRESSURE_L2.error(BALL)(result), **_hertz(result)}


def _hertz_section(result: Section) -> Errors:
    return {"pressure": _norm(result, HERTZ.pressure), **_hertz(result)}


def _norm(result: Section, exact: Callable[[Field], Field]) -> float:
    """Relative L2 error of the pressure over the rings."""
    end = result.steps[-1]
    known, r = exact(end.radii), end.radii
    missed = np.trapezoid((end.pressure - known) ** 2 * r, r)
    return float(np.sqrt(missed / np.trapezoid(known**2 * r, r)))


def _coated_surface(result: Surface) -> Errors:
    return {
        "pressure": PRESSURE_L2.error(coated.EXACT)(result),
        "approach": APPROACH.error(coated.EXACT)(result),
    }


def _coated_section(result: Section) -> Errors:
    return {
        "pressure": _norm(result, coated.EXACT.ends[-1].pressure),
        "approach": APPROACH.error(coated.EXACT)(result),
    }


@cache
def sheared() -> PartialSlip:
    """The closed form at the end of the shearing."""
    return paper.partial_slip(NU_ZERO, SHEARED * FRICTION_LIMIT)


def _cattaneo_surface(result: Surface) -> Errors:
    end = result.steps[-1]
    exact = sheared().shear(np.hypot(*result.grid.coordinates()))
    return {"shear": shear_error(shear_of(end), exact, FRICTION * end.pressure),
            "shift": _shift(end)}  # fmt: skip


def _cattaneo_section(result: Section) -> Errors:
    end: Any = result.steps[-1]
    r, limit = end.radii, FRICTION * end.pressure
    missed = np.trapezoid(np.abs(end.shear_along_load - sheared().shear(r)) * r, r)
    return {"shear": float(missed / np.trapezoid(limit * r, r)), "shift": _shift(end)}


def _cattaneo_frozen(history: FrozenHistory) -> Errors:
    (end,) = history.turned
    exact = replace(sheared(), tangential_force=end.force)
    r = np.hypot(*history.grid.coordinates())
    return {"shear": shear_error(end.shear, exact.shear(r), history.bound),
            "shift": (end.shift - exact.shift) / SLIDING_SHIFT}  # fmt: skip


def _shift(end: Any) -> float:
    return (shift_along_x(end) - sheared().shift) / SLIDING_SHIFT


def _loop(result: Any) -> Errors:
    exact = LOOPED
    return {
        "energy": loop_energy(result) / exact.energy_per_cycle - 1,
        "shift": exact.largest_shift_error(result) / LARGEST,
    }


def _loop_frozen(history: FrozenHistory) -> Errors:
    """All under the forces that came with the shift."""
    state, worst, exact = LOOPED.virgin, 0.0, []
    for found in history.states:
        state = state.loaded_to(found.force)
        worst = max(worst, abs(found.shift - state.shift))
        exact += [state.dissipated_energy] if found.turning else []
    start, _, end = (found.dissipated_energy for found in history.turned)
    return {
        "energy": (end - start) / (exact[-1] - exact[0]) - 1,
        "shift": worst / LARGEST,
    }


def _judged(key: str) -> tuple[Field, Field]:
    r, values = np.array(COATED.row["r_over_a"]), np.array(COATED.row[key])
    inside = (r >= JUDGED[0] - 1e-9) & (r <= JUDGED[1] + 1e-9)
    return r[inside] * COATED.contact_radius, values[inside]


def _pressed_surface(result: Surface) -> Errors:
    end, grid = result.steps[-1], result.grid
    return _pressed(
        result,
        lambda r: along_radii(end.pressure, grid, r),
        lambda r: along_radii(outward(shear_of(end), grid), grid, r),
    )


def _pressed_section(result: Section) -> Errors:
    end = result.steps[-1]
    assert end.shear_radial is not None
    shear = end.shear_radial
    return _pressed(
        result,
        lambda r: at_radii(end, end.pressure, r)[:, None],
        lambda r: at_radii(end, shear, r)[:, None],
    )


def _pressed(
    result: Any, pressure: Callable[[Field], Field], shear: Callable[[Field], Field]
) -> Errors:
    unit = HERTZ.peak_pressure
    r, p = _judged("p_over_pH")
    _, q = _judged("q_over_mu_pH")
    return {
        "shear": float(np.max(np.abs(shear(r) / (COATED.friction * unit) - q[:, None]))),
        "pressure": float(np.max(np.abs(pressure(r) / unit - p[:, None]))),
        "approach": approach(result) / COATED.approach - 1,
    }


def _pressing(increments: int) -> Scene:
    return COATED.problem(increments).scene


def _frictional(title: str, *loading: LoadStep) -> Scene:
    return paper.frictional(title, paper.paraboloid(NU_ZERO), NU_ZERO, *loading)


HERTZIAN = PreciseContact(
    "hertz", "Hertz",
    {"pressure": "pressure, L2", "peak": "peak pressure", "approach": "approach"},
    HERTZ.contact_radius, lambda _: BALL.scene, _hertz_surface, _hertz_section,
    "Hertz 1882",
)  # fmt: skip
CATTANEO = PreciseContact(
    "cattaneo", "Cattaneo-Mindlin, ν = 0",
    {"shear": "shear at 0.9 µW, Σ|q - q_exact| / Σµp", "shift": "shift over the sliding shift"},
    HERTZ.contact_radius,
    lambda k: _frictional("Cattaneo-Mindlin, ν = 0", paper.tangential_step(SHEARED, k)),
    _cattaneo_surface, _cattaneo_section, "Cattaneo 1938; Mindlin 1949",
    turns=(sheared().shift,), frozen=_cattaneo_frozen,
)  # fmt: skip
COATING = PreciseContact(
    "coated", "Coated, E1/E2 = 2, without friction",
    {"pressure": "pressure, L2", "approach": "approach"},
    coated.EXACT.radius, lambda _: coated.EXACT.scene,
    _coated_surface, _coated_section, COATINGS,
)  # fmt: skip
INDENTATION = PreciseContact(
    "indentation", "Coated, pressed with friction",
    {
        "shear": "shear from 0.1 to 0.9 of the radius, largest, over µp_H",
        "pressure": "pressure there, largest, over p_H", "approach": "approach",
    },
    COATED.contact_radius, _pressing, _pressed_surface, _pressed_section, COATED.source,
    increments=20,
)  # fmt: skip
LOOP = PreciseContact(
    "loop", "Fretting loop, ν = 0",
    {"energy": "energy of a cycle", "shift": "largest error of the shift"},
    HERTZ.contact_radius,
    lambda k: _frictional("Fretting loop, ν = 0", *loop_steps(k)),
    _loop, _loop, LOOP_SOURCE, window=WINDOW_PER_RADIUS, increments=QUARTER,
    turns=(LARGEST, -LARGEST, LARGEST), frozen=_loop_frozen,
)  # fmt: skip
CONTACTS = {c.name: c for c in (HERTZIAN, CATTANEO, COATING, INDENTATION, LOOP)}
