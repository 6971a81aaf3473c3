"""The tangential force at which the last stick of a ball goes, pressed with friction and pushed.

What sticks carries less than friction could. That deficit D (over µW) is told without a border of
the stick, for it is an integral; of an island of radius c it goes as c³, and c² falls in line with
the shift (a punch of that radius is as stiff as c, so dD ~ c dω), while the force is a smooth
function of the shift. So the force is smooth in y = D^(2/3) and ends where y does.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

import radial
from contact_scene import LoadStep, RadialDiscretisation, Scene
from contact_scene.march import marked_increments
from contact_scene.solver_errors import NotConverged
from radial.pushing import Pushing
from slipstick.tables.frictional import FORCE, scene
from slipstick.tables.table import Found

Array = NDArray[np.float64]

KEPT = 16
# Of a half circle as many angles as there are harmonics: the island is small and off the axis.
AROUND = 2.0
FINER = 1.5  # rings and angles that tell what rings and angles leave
# Increments: of pressing, up to a part of µW that tells how far the shift goes, and of the shift.
PRESSING, FIRST, PART, SHIFTS = 10, 8, 0.5, 32
TIMES = (1, 2, 4)  # as many, until the last stick has enough of them
BEYOND = 1.1  # of the shift at which Cattaneo's stick would go
MOST, DEGREE = 0.05, 3  # of D that is fitted, by which power of y
OF_FIT = 2e-4  # T/µW: what other choices of the two leave


def onset(place: Sequence[float], fineness: int) -> Found:
    """T/µW at which the last stick goes, in the limit of fine increments; half as many rings and
    angles again where all is to be finer. Where pressure moves no surface past the other stick
    goes at µW."""
    if not radial.plan(scene(place)).coupled:
        return Found((1.0,))
    where = tuple(place)
    times = _enough(where)
    coarse, fine = (_onset(where, more, 1.0) for more in (times, 2 * times))
    found = 2 * fine - coarse
    if fineness > 1:
        found += _onset(where, times, FINER) - coarse
    return Found((found,), 0.0, (OF_FIT,))


def _enough(place: tuple[float, ...]) -> int:
    """How many times as many increments tell where the last stick goes."""
    for times in TIMES[:-1]:
        with suppress(NotConverged):
            _onset(place, times, 1.0)
            return times
    return TIMES[-1]


def _onset(place: tuple[float, ...], times: int, rings: float) -> float:
    """With so many times as many increments, and rings and angles."""
    first = _marched(place, LoadStep(tangential_force=(PART * place[-1] * FORCE, 0.0)), FIRST, 0.5)
    *_, (_, shift, _) = first
    furthest = BEYOND * shift / (1 - (1 - PART) ** (2 / 3))
    forces, shifts, y = np.array(
        _marched(place, LoadStep(tangential_shift=(furthest, 0.0)), SHIFTS * times, rings)
    ).T
    if y[-1] > 0:
        raise NotConverged("where the last stick goes (shifts too small)", len(y), y[-1], 0.0)
    near = (y > 0) & (y < MOST ** (2 / 3)) & (shifts > furthest / 2)
    if np.sum(near) <= DEGREE + 1:
        raise NotConverged("where the last stick goes (too few increments)", len(y), 0.0, 0.0)
    end = np.polynomial.Polynomial.fit(y[near], shifts[near], DEGREE)(0.0)
    return float(CubicSpline(shifts, forces)(end))


@lru_cache(maxsize=KEPT)
def _marched(
    place: tuple[float, ...], step: LoadStep, increments: int, rings: float
) -> tuple[tuple[float, float, float], ...]:
    """T/µW, shift and D^(2/3) of increments of a push, up to the first with nothing left: kept,
    for what has too few increments is asked for again, and the first push by every number."""
    asked: Scene = scene(place, step)
    decided = replace(radial.plan(asked), increments=(PRESSING, increments))
    solver = Pushing.of(asked, RadialDiscretisation(), decided, rings, AROUND)
    friction, found = place[-1], []
    for increment, mark in marked_increments(asked, decided.increments, solver, None):
        if increment.step == 1:
            continue
        held = mark.state.held
        unused = friction * np.maximum(held.pressure, 0.0) - np.hypot(*held.shear)
        unused = np.where(held.share < 1, unused, 0.0)  # beyond it is round-off
        deficit = float(unused @ solver.points.areas) / (friction * FORCE)
        force, shift = mark.state.forces[0], mark.state.motions[0]
        found.append((force / (friction * FORCE), shift, deficit ** (2 / 3)))
        if deficit == 0:
            break
    return tuple(found)
