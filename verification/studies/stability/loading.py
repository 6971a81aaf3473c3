"""The loading steps of each path."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contact_scene import LoadStep
from verification.studies.stability.cell import LoadingPath

PRESSING = 3  # increments: large steps are the hard ones
LEAST = 0.01  # of the normal force when it is taken away
REVERSED_AT = 0.85  # of the normal force
NEARLY_ALL = 0.98  # T/µW where falling W ends
ONCE_ROUND = 6  # increments of a circle
SLIDES_FAR = 20.0  # times µδ, about the shift at gross sliding


@dataclass(frozen=True)
class Loads:
    """Normal force [force], approach it makes without friction [length], µ, and T/µW."""

    normal_force: float
    approach: float
    friction: float
    push: float


Steps = tuple[LoadStep, ...]


def loading(path: LoadingPath, loads: Loads) -> Steps:
    """The steps of a path, their increments set: the map is about the size of one increment."""
    return PATHS[path](loads)


def _press(loads: Loads, part: float = 1.0, increments: int = PRESSING) -> LoadStep:
    return LoadStep(normal_force=part * loads.normal_force, increments=increments)


def _push(loads: Loads, part: float = 1.0, increments: int = 1) -> LoadStep:
    """T to a part of the cell's T."""
    return LoadStep(tangential_force=(part * _force(loads), 0.0), increments=increments)


def _both(loads: Loads, part: float, pressed: float, increments: int) -> LoadStep:
    return LoadStep(
        tangential_force=(part * _force(loads), 0.0),
        normal_force=pressed * loads.normal_force,
        increments=increments,
    )


def _force(loads: Loads) -> float:
    return loads.push * loads.friction * loads.normal_force


def _press_only(loads: Loads) -> Steps:
    return (_press(loads),)


def _press_and_push(loads: Loads) -> Steps:
    return _press(loads), _push(loads)


def _loop(loads: Loads) -> Steps:
    return _press(loads), _push(loads), _push(loads, -1.0, 2), _push(loads, 1.0, 2)


def _circle(loads: Loads) -> Steps:
    T = _force(loads)
    angles = np.linspace(0, 2 * np.pi, ONCE_ROUND + 1)
    turns = (
        LoadStep(tangential_force=(T * float(np.cos(t)), T * float(np.sin(t))), increments=1)
        for t in angles
    )
    return _press(loads), *turns


def _reversed(loads: Loads) -> Steps:
    part = min(1.0, REVERSED_AT / max(loads.push, REVERSED_AT))
    return _press(loads), _push(loads), _both(loads, -0.99 * part, REVERSED_AT, 3)


def _reloaded(loads: Loads) -> Steps:
    return _press(loads), _press(loads, LEAST, 4), _press(loads, 1.0, 3)


def _sheared_reload(loads: Loads) -> Steps:
    away, back = _both(loads, 0.0, LEAST, 4), _both(loads, 1.0, 1.0, 3)
    return _press(loads), _push(loads), away, back


def _falling(loads: Loads) -> Steps:
    return _press(loads), _push(loads), _press(loads, min(1.0, loads.push / NEARLY_ALL), 3)


def _slide(loads: Loads) -> Steps:
    unit = max(loads.friction, LEAST) * loads.approach
    shifts = (0.5 * unit, SLIDES_FAR * unit, 0.0)
    return _press(loads), *(
        LoadStep(tangential_shift=(shift, 0.0), increments=2) for shift in shifts
    )


def _approach(loads: Loads) -> Steps:
    shift = loads.push * loads.friction * loads.approach
    return (
        LoadStep(approach=loads.approach, increments=PRESSING),
        LoadStep(tangential_shift=(shift, 0.0), increments=1),
        LoadStep(approach=0.5 * loads.approach, increments=2),
    )


PATHS: dict[LoadingPath, Callable[[Loads], Steps]] = {
    LoadingPath.PRESS: _press_only,
    LoadingPath.PUSH: _press_and_push,
    LoadingPath.LOOP: _loop,
    LoadingPath.CIRCLE: _circle,
    LoadingPath.REVERSED: _reversed,
    LoadingPath.RELOADED: _reloaded,
    LoadingPath.SHEARED_RELOAD: _sheared_reload,
    LoadingPath.FALLING: _falling,
    LoadingPath.SLIDE: _slide,
    LoadingPath.APPROACH: _approach,
}
