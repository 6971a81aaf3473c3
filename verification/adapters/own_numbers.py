"""What our solvers have in common: scenes of challenges, and numbers of increments."""

from __future__ import annotations

from collections.abc import Sequence

from contact_scene import Scene
from contact_scene.quantities.increment import State
from verification.challenge.answer import Answer, Key
from verification.challenge.python_api import (
    CannotDo,
    Posed,
)


def scene_of(posed: Posed) -> Scene:
    """As our solvers read it; raises CannotDo where the tractions are given."""
    if "indenter" not in posed.scene:
        raise CannotDo("contacts only, no given tractions")
    return Scene.model_validate(posed.scene)


def given_up(posed: Posed, fineness: int, error: Exception) -> Answer:
    """Of a level whose history did not get to its end: nothing of it is trusted.

    fineness  cells or elements over a contact radius, which is about a third of the window
    """
    return Answer(posed.window / 3 / fineness, gave_up={0: str(error)})


def in_increments(scene: Scene, number: int) -> Scene:
    """With friction the way matters: steps that name no increments take this many, so that finer
    levels do not stall at the error of the path."""
    if scene.friction is None:
        return scene
    steps = (s.model_copy(update={"increments": s.increments or number}) for s in scene.loading)
    return scene.model_copy(update={"loading": tuple(steps)})


def number(posed: Posed, key: Key, steps: Sequence[State]) -> float | None:
    """By the name that a result has for it; None where it has none."""
    quantity, step = key
    end = steps[step - 1]
    if quantity in ("shift_x", "shift_y"):
        shift = end.tangential_shift
        return None if shift is None else float(shift["xy".index(quantity[-1])])
    if quantity in ("moment_x", "moment_y"):
        return None if end.moment is None else float(end.moment["xy".index(quantity[-1])])
    if quantity == "energy_per_cycle":
        lost = end.dissipated_energy
        before = steps[posed.since[key] - 1].dissipated_energy
        return None if lost is None or before is None else lost - before
    found = getattr(end, quantity, None)
    return None if found is None else float(found)
