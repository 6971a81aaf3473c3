"""Coated bodies pressed by a rigid ball with friction, known from fine finite elements.

Radially symmetric, so that many elements and increments are cheap; the other solver shares no
numerics with what is judged.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

import fem_reference
from contact_scene import (
    RIGID,
    CoulombFriction,
    FiniteElementDiscretisation,
    LoadStep,
    Paraboloid,
    Scene,
)
from verification.closed_forms.coated_indentation import paraboloid
from verification.problems.drawn import drawing
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import (
    APPROACH,
    ELASTIC,
    ENERGY,
    PEAK,
    RADIUS,
    STICK,
    WORK,
    KnownScene,
    Truth,
)
from verification.problems.layered_scene import surface_of
from verification.problems.reference import Reference, ReferenceKind

FINEST = 24.0  # cells per radius that are judged
FINE, BESIDE = (48, 80), (32, 40)  # elements per radius, and increments
# What fine elements leave less certain than that, as energy lost where all sticks, is not judged.
UNCERTAIN = 0.1
SOURCE = "finite elements, 48 over the radius and 80 increments; beside 32 and 40"


def pressed(rng: Rng) -> KnownScene:
    """One layer under a rigid ball, with friction."""
    posed = unsolved(rng)
    return replace(posed, truths=tuple(_by_elements(posed.scene)))


def unsolved(rng: Rng) -> KnownScene:
    """The same scene, of which nothing is known."""
    radius, a = drawing.sizes(rng)
    body, mu = drawing.coated_body(rng, a), drawing.friction(rng)
    contact = paraboloid(surface_of(body), radius, a)
    scene = Scene(
        title="Rigid ball pressed on a coating with friction",
        indenter=Paraboloid(radius=radius, material=RIGID),
        body=body,
        friction=CoulombFriction(coefficient=mu),
        loading=(LoadStep(normal_force=contact.load),),
    )
    fine = drawing.fineness(rng, (a, a), False, finest=FINEST)
    return KnownScene(scene, (), fine)


def _by_elements(scene: Scene) -> Iterator[Truth]:
    best, beside = (_solved(scene, *fineness) for fineness in (FINE, BESIDE))
    for quantity, value in best.items():
        apart = abs(value - beside[quantity])
        if apart <= UNCERTAIN * value:
            kind = ReferenceKind.OTHER_SOLVER
            yield Truth(1, quantity, Reference(value, kind, SOURCE, apart))


def _solved(scene: Scene, elements: int, count: int) -> Mapping[str, float]:
    (step,) = scene.loading
    cut = scene.model_copy(update={"loading": (step.model_copy(update={"increments": count}),)})
    mesh = FiniteElementDiscretisation(elements_per_radius=elements)
    found = fem_reference.solve(cut, mesh, fem_reference.Method.COMPLEMENTARITY)
    (end,) = found.steps
    # Load and approach are smooth in the contact radius, which grows as the cube root of the load.
    size = np.cbrt([0.0, *(i.normal_force for i in found.increments)])
    rate = CubicSpline(size, [0.0, *(i.approach for i in found.increments)]).derivative()
    nodes = np.linspace(0.0, size[-1], 20 * count + 1)
    work = float(np.trapezoid(nodes**3 * rate(nodes), nodes))
    known = {name: getattr(end, name) for name in (APPROACH, PEAK, RADIUS, STICK, ENERGY)}
    return known | {WORK: work, ELASTIC: work - known[ENERGY]}
