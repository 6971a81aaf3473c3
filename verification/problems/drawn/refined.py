"""Families without closed form: bodies under a tangential force, known from finer solves.

Layers respond to shear otherwise than to pressure, and bodies with ν > 0 slip across the load. The
reference is a solve on finer cells with more increments; a second one on other cells with half of
these increments states its uncertainty. Cells and increments are refined beyond those of the error
estimate, and separately of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import semi_analytical
from contact_errors.values import Values, values_of
from contact_results.cycles import fretting_cycles
from contact_scene import (
    RIGID,
    Body,
    Cone,
    Ellipsoid,
    Paraboloid,
    Sphere,
    SurfaceDiscretisation,
)
from contact_scene.geometry import Indenter
from contact_scene.increment_error import with_error
from verification.closed_forms.coated_indentation import paraboloid
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.elliptical_contact import EllipticalContact
from verification.closed_forms.sphere import SphereContact
from verification.problems.drawn import coated, drawing
from verification.problems.drawn.branches import led
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import (
    AMPLITUDE,
    APPROACH,
    CYCLE,
    ELASTIC,
    ENERGY,
    F1,
    SHIFT,
    TANGENTIAL,
    WORK,
    Fineness,
    KnownScene,
    Truth,
)
from verification.problems.layered_scene import surface_of
from verification.problems.reference import Reference, ReferenceKind

FINEST, COUPLED_FINEST = 10.0, 7.0  # cells per radius that are judged
COARSE_PATH = 4e-2  # accuracy of the path where friction acts back on the pressure


class Finer(NamedTuple):
    """Refinement of the cells along a side and of the increments; least increments of a step."""

    cells: float
    increments: int
    least: int


FINER = Finer(3.5, 4, 32), Finer(2.5, 2, 16)


def sheared(rng: Rng) -> KnownScene:
    """Alike coated balls under a tangential force, pushed or to and fro."""
    radius, a = drawing.sizes(rng)
    body, mu = drawing.coated_body(rng, a), drawing.friction(rng)
    contact = paraboloid(surface_of(body, body), radius, a)
    forces = [part * mu * contact.load for part in drawing.parts(rng)]
    fine = drawing.fineness(rng, (a, a), False, finest=FINEST)
    scene = led(drawing.ball_like(body, radius), body, mu, contact.load, TANGENTIAL, forces)
    pressed = tuple(coated.pressed_truths(contact, coated.stored_energy(contact)))
    known = KnownScene(scene, pressed, fine)
    return KnownScene(scene, (*pressed, *_refined(known, forces)), fine)


def similar(rng: Rng) -> KnownScene:
    """Bare bodies of one material with ν > 0 below any tip, pushed or to and fro."""
    radius, a = drawing.sizes(rng)
    body, mu = Body(material=drawing.material(rng)), drawing.friction(rng)
    indenter, load, reach = _tip(rng, body, radius, a)
    forces = [part * mu * load for part in drawing.parts(rng)]
    fine = drawing.fineness(rng, reach, False, finest=FINEST)
    posed = KnownScene(led(indenter, body, mu, load, TANGENTIAL, forces), (), fine)
    return replace(posed, truths=tuple(_refined(posed, forces, (APPROACH,))))


def _tip(
    rng: Rng, body: Body, radius: float, a: float
) -> tuple[Indenter, float, tuple[float, float]]:
    """An indenter of the material of the body, its load, and the semi-axes of the contact."""
    matter = body.elastic_materials[0]
    modulus = matter.plane_strain_modulus / 2
    match int(rng.integers(4)):
        case 0:
            slope = drawing.logarithmic(rng, 0.005, 0.05)
            cone = Cone(slope_angle=slope, material=matter)
            return cone, ConeContact(slope, modulus, a).load, (a, a)
        case 1:
            radii = (radius, radius * drawing.logarithmic(rng, 0.3, 3.0))
            load = modulus * a**3 / radius
            contact = EllipticalContact.under_load(load, radii, modulus)
            return Ellipsoid(radii=radii, material=matter), load, contact.semi_axes
        case 2:
            load = SphereContact(radius, modulus, a).load
            return Sphere(radius=radius, material=matter), load, (a, a)
    return Paraboloid(radius=radius, material=matter), 4 * modulus * a**3 / (3 * radius), (a, a)


def coupled(rng: Rng) -> KnownScene:
    """A rigid ball pressed on a coating with friction, and pushed or led to and fro."""
    known, forces = _coupled(rng)
    return replace(known, truths=tuple(_refined(known, forces, (APPROACH,))))


def unsolved(rng: Rng) -> KnownScene:
    """The same scene, of which nothing is known."""
    return _coupled(rng)[0]


def _coupled(rng: Rng) -> tuple[KnownScene, Sequence[float]]:
    """It, and the forces that lead."""
    radius, a = drawing.sizes(rng)
    body, mu = drawing.coated_body(rng, a), drawing.friction(rng)
    contact = paraboloid(surface_of(body), radius, a)
    forces = [part * mu * contact.load for part in drawing.parts(rng)]
    fine = drawing.fineness(rng, (a, a), False, finest=COUPLED_FINEST)
    asked = fine.asked.model_copy(update={"path_accuracy": COARSE_PATH})
    ball = Paraboloid(radius=radius, material=RIGID)
    scene = led(ball, body, mu, contact.load, TANGENTIAL, forces)
    return KnownScene(scene, (), Fineness(fine.solver, asked, fine.per_radius)), forces


def _refined(
    known: KnownScene,
    forces: Sequence[float],
    others: tuple[str, ...] = (),
) -> Iterator[Truth]:
    """Of the finer of two fine solves, at ends of steps that symmetry does not repeat."""
    best, other = (_solved(known, times) for times in FINER)
    times, less = FINER
    source = (
        f"the same solver on {times.cells:g} times as many cells along a side and "
        f"{times.increments} times as many increments, at least {times.least}; compared with "
        f"{less.cells:g}, {less.increments} and {less.least}"
    )
    for step, quantity in _wanted(forces, others):
        value, beside = (found[step - 1].get(quantity) for found in (best, other))
        if value is not None and beside is not None:
            apart = abs(float(value[0] - beside[0]))
            reference = Reference(float(value[0]), ReferenceKind.OWN_REFINEMENT, source, apart)
            yield Truth(step, quantity, reference)


def _wanted(forces: Sequence[float], others: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    """Steps and quantities."""
    closed = drawing.closes(forces)
    for step, force in enumerate(forces, start=2):
        if step == 2 or abs(force) != forces[0]:
            yield from ((step, name) for name in (SHIFT, ELASTIC, WORK, *others))
            if step > 2 or not closed:  # the energy of a closed loop is four times this one
                yield step, ENERGY
    if closed:
        yield from ((len(forces) + 1, name) for name in (CYCLE, AMPLITUDE, F1))


def _solved(known: KnownScene, times: Finer) -> Sequence[Values]:
    """What the steps have, on finer cells and by more increments."""
    asked = known.fineness.asked
    assert isinstance(asked, SurfaceDiscretisation)
    assert asked.cells is not None
    cells = tuple(round(times.cells * n) for n in asked.cells)
    plan = semi_analytical.plan(known.scene, asked.path_accuracy)
    counts = zip(plan.increments, with_error(known.scene), strict=True)
    plan = plan.cut_into(
        [max(times.least, times.increments * n) if matters else n for n, matters in counts]
    )
    finer = asked.model_copy(update={"cells": cells})
    result = semi_analytical.solve_discretised(known.scene, finer, plan=plan)
    return values_of(result, fretting_cycles(result))
