"""A family without closed form: alike coated bodies sheared, known from much finer cells.

Layers answer shear otherwise than pressure, so that the difference of two pressed contacts is not
the sheared one. Shift and energy lost converge with the second power of the cells: on cells a
fourth as wide they are off by a sixteenth of what is judged.
"""

from __future__ import annotations

from collections.abc import Iterator

import semi_analytical
from contact_scene import SurfaceDiscretisation
from verification.closed_forms.coated_indentation import paraboloid
from verification.problems.drawn import coated, drawing
from verification.problems.drawn.branches import led
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import (
    CYCLE,
    ENERGY,
    SHIFT,
    KnownScene,
    Truth,
)
from verification.problems.layered_scene import surface_of
from verification.problems.reference import Reference, ReferenceKind

FINEST = 10.0  # cells per radius that are judged
FINER = (3.5, 4.5)  # times as many, where borders cut cells elsewhere
SOURCE = "the same solver on 3.5 and 4.5 times as many cells, which differ by the uncertainty"


def sheared(rng: Rng) -> KnownScene:
    """Alike coated balls under a tangential force, pushed or to and fro."""
    radius, a = drawing.sizes(rng)
    body, mu = drawing.coated_body(rng, a), drawing.friction(rng)
    contact = paraboloid(surface_of(body, body), radius, a)
    forces = [part * mu * contact.load for part in drawing.parts(rng)]
    fine = drawing.fineness(rng, (a, a), False, finest=FINEST)
    ball = drawing.ball_like(body, radius)
    scene = led(ball, body, mu, contact.load, "tangential_force", forces)
    known = KnownScene(scene, coated.pressed_truths(contact), fine)
    return KnownScene(scene, (*known.truths, *_refined(known, forces)), fine)


def _refined(known: KnownScene, forces: list[float]) -> Iterator[Truth]:
    """Mean of the two fine solves, at ends of steps that symmetry does not repeat."""
    asked = known.fineness.asked
    assert isinstance(asked, SurfaceDiscretisation)
    assert asked.cells is not None
    several = [
        semi_analytical.solve_discretised(
            known.scene,
            asked.model_copy(update={"cells": tuple(round(times * n) for n in asked.cells)}),
        ).steps
        for times in FINER
    ]
    closed = forces[-1] == forces[0]
    wanted = [
        (step, quantity, None)
        for step, force in enumerate(forces, start=2)
        for quantity in (SHIFT, ENERGY)
        if (step == 2 and not (closed and quantity == ENERGY)) or abs(force) != forces[0]
    ]
    loop = [(len(forces) + 1, CYCLE, 2)] if closed else []
    for step, quantity, since in (*wanted, *loop):
        one = Truth(step, quantity, Reference(0.0, ReferenceKind.OWN_REFINEMENT, SOURCE), since)
        values = [value for steps in several if (value := one.read(steps)) is not None]
        if len(values) == len(FINER):
            mean, apart = sum(values) / len(values), abs(values[1] - values[0])
            reference = Reference(mean, ReferenceKind.OWN_REFINEMENT, SOURCE, apart)
            yield Truth(step, quantity, reference, since)
