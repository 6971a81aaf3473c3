"""The loading steps of each path."""

from __future__ import annotations

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


def loading(path: LoadingPath, loads: Loads) -> tuple[LoadStep, ...]:
    """The steps of a path, their increments set: the map is about the size of one increment."""
    full = loads.push * loads.friction * loads.normal_force

    def to(increments: int, *, W: float | None = None, T: float | None = None) -> LoadStep:
        """To a part of the normal force and of the cell's tangential one; the other stays."""
        return LoadStep(
            normal_force=None if W is None else W * loads.normal_force,
            tangential_force=None if T is None else (T * full, 0.0),
            increments=increments,
        )

    def shift(increments: int, by: float) -> LoadStep:
        return LoadStep(tangential_shift=(by, 0.0), increments=increments)

    press, push = to(PRESSING, W=1.0), to(1, T=1.0)
    match path:
        case LoadingPath.PRESS:
            return (press,)
        case LoadingPath.PUSH:
            return press, push
        case LoadingPath.LOOP:
            return press, push, to(2, T=-1.0), to(2, T=1.0)
        case LoadingPath.CIRCLE:
            angles = np.linspace(0, 2 * np.pi, ONCE_ROUND + 1)
            turns = ((full * float(np.cos(t)), full * float(np.sin(t))) for t in angles)
            return press, *(LoadStep(tangential_force=force, increments=1) for force in turns)
        case LoadingPath.REVERSED:
            part = min(1.0, REVERSED_AT / max(loads.push, REVERSED_AT))
            return press, push, to(3, T=-0.99 * part, W=REVERSED_AT)
        case LoadingPath.RELOADED:
            return press, to(4, W=LEAST), to(3, W=1.0)
        case LoadingPath.SHEARED_RELOAD:
            return press, push, to(4, T=0.0, W=LEAST), to(3, T=1.0, W=1.0)
        case LoadingPath.FALLING:
            return press, push, to(3, W=min(1.0, loads.push / NEARLY_ALL))
        case LoadingPath.SLIDE:
            unit = max(loads.friction, LEAST) * loads.approach
            return press, shift(2, 0.5 * unit), shift(2, SLIDES_FAR * unit), shift(2, 0.0)
        case LoadingPath.APPROACH:
            return (
                LoadStep(approach=loads.approach, increments=PRESSING),
                shift(1, loads.push * loads.friction * loads.approach),
                LoadStep(approach=0.5 * loads.approach, increments=2),
            )
