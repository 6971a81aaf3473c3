"""Random contacts without defects, which the verification must pass.

Loads, bodies, windows and positions on the grid are random. Each contact is drawn from a seed and
has an exact or semi-closed solution.
"""

from __future__ import annotations

from collections.abc import Callable
from math import radians

import numpy as np

from contact_scene import (
    Body,
    Cone,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from verification.cases.levels import levels
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.coated_indentation import paraboloid_under
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import PointContact, contact_modulus, tangential_modulus
from verification.judging.case import Case, Level
from verification.judging.declared_case import (
    APPROACH,
    CONTACT_RADIUS,
    PEAK_PRESSURE,
    SHIFT,
    STICK_RADIUS,
    Refined,
    Row,
    Within,
    case,
    judged,
)
from verification.judging.refinement_levels import (
    RefinementLevel,
    asked,
    ladder,
    mesh_label,
    meshed,
    on_cells,
    refinement,
)
from verification.judging.run import SectionRun, per_radius
from verification.problems.cattaneo_mindlin import OVER_SLIDING_SHIFT
from verification.problems.layered_scene import FREDHOLM, SEMI_CLOSED_ERROR, surface_of
from verification.problems.problem import Problem, ReferenceKind

Random = np.random.Generator
LEVELS = refinement(32, 96)
NARROWEST, WIDEST = 2.6, 3.6  # window over contact radius


def on_grids(name: str, problem: Problem, random: Random, *rows: Row) -> Case:
    """Build a case of a problem on several grids with a random window and random offsets of the
    contact.

    problem  scene with its exact solution
    rows     quantities that are judged, with their tolerances
    """
    window = random.uniform(NARROWEST, WIDEST)
    grids = [on_cells(problem, (n,), window, offsets=(_anywhere(random),)) for n in LEVELS]
    rungs = [rung for grid in grids for rung in grid.rungs]
    return case(name, name, "", judged(ladder(problem, rungs), rows))


def _anywhere(random: Random) -> tuple[float, float]:
    """Draw a random offset of the contact axis in a cell (x, y), each from -0.5 to
    0.5 cell sides."""
    return float(random.uniform(-0.5, 0.5)), float(random.uniform(-0.5, 0.5))


def pressed(indenter: Paraboloid | Cone | FlatPunch, body: Body, load: float) -> Scene:
    """Return a scene with one load step: a normal force without friction."""
    return Scene(
        title="Pressed", indenter=indenter, body=body, loading=(LoadStep(normal_force=load),)
    )


def part_of_cell(part: float) -> Callable[[RefinementLevel], float]:
    """Return a function of the refinement level that gives a tolerance of a fraction of a cell
    side.

    The tolerance is relative to the contact radius; the window is assumed to be three radii wide.
    """
    return lambda rung: part * 3.0 / rung.count


APPROACH_WITHIN = Refined(
    APPROACH, 2.0, 1e-4, "order 2, and the cap of hertz_point at 128 cells by that order"
)
# Twice the part of hertz_point, whose axis is always a corner of cells.
RADIUS_WITHIN = Refined(
    CONTACT_RADIUS, 1.0, part_of_cell(0.2), "order 1: the edge is known to a part of a cell"
)


def any_material(random: Random) -> IsotropicMaterial:
    """Draw a material with a Young's modulus from 1e9 to 1e12 Pa and a Poisson's
    ratio from 0 to ½."""
    return IsotropicMaterial(
        young_modulus=between(random, 1e9, 1e12), poisson_ratio=float(random.uniform(0.0, 0.5))
    )


def constants(material: IsotropicMaterial) -> tuple[float, float]:
    """Return Young's modulus E and Poisson's ratio ν of a material."""
    return material.young_modulus, material.poisson_ratio


def between(random: Random, low: float, high: float) -> float:
    """Draw a number from `low` to `high` whose logarithm is uniformly distributed."""
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


SOURCE = "the closed form of the contact"
RESOLVED = (
    0.8  # thickness over Hertz's radius of the substrate: about ten cells of the coarsest grid
)


def hertz(random: Random) -> Case:
    """Draw a ball, a flat body and a load at random; build the verification case with Hertz's
    solution.
    """
    one, other = any_material(random), any_material(random)
    radius, load = between(random, 1e-3, 1.0), between(random, 1e-1, 1e4)
    exact = PointContact.under_load(load, radius, contact_modulus(constants(one), constants(other)))
    scene = pressed(Paraboloid(radius=radius, material=one), Body(material=other), load)
    problem = Problem(scene, (exact,), exact.contact_radius, SOURCE)
    return on_grids("hertz", problem, random, APPROACH_WITHIN, RADIUS_WITHIN)


def cone(random: Random) -> Case:
    """Draw a cone, a flat body and a load at random; build the verification case with its closed
    form.
    """
    one, other = any_material(random), any_material(random)
    slope, load = radians(random.uniform(0.3, 3.0)), between(random, 1e-1, 1e4)
    exact = ConeContact.under_load(load, slope, contact_modulus(constants(one), constants(other)))
    scene = pressed(Cone(slope_angle=slope, material=one), Body(material=other), load)
    problem = Problem(scene, (exact,), exact.contact_radius, SOURCE)
    return on_grids("cone", problem, random, RADIUS_WITHIN)


def partial_slip(random: Random) -> Case:
    """Draw a Cattaneo-Mindlin contact at random; build the verification case with its closed form.

    The bodies are equal, with ν = 0. The normal force is followed by a tangential force.
    """
    material = IsotropicMaterial(young_modulus=between(random, 1e9, 1e12), poisson_ratio=0.0)
    radius, load = between(random, 1e-3, 1.0), between(random, 1e-1, 1e4)
    friction, part = random.uniform(0.05, 0.8), random.uniform(0.2, 0.9)
    alike = constants(material), constants(material)
    a = PointContact.under_load(load, radius, contact_modulus(*alike)).contact_radius
    force = part * friction * load
    exact = PartialSlip(load, a, friction, tangential_modulus(*alike), force)
    scene = Scene(
        title="Partial slip",
        indenter=Paraboloid(radius=radius, material=material),
        body=Body(material=material),
        friction=CoulombFriction(coefficient=friction),
        loading=(
            LoadStep(normal_force=load, increments=1),
            LoadStep(tangential_force=(force, 0.0), increments=1),
        ),
    )
    return on_grids(
        "partial_slip",
        Problem(scene, (None, exact), a, SOURCE, scales={OVER_SLIDING_SHIFT: exact.sliding_shift}),
        random,
        Refined(SHIFT, 1.5, 1e-3, "order 3/2 of the square-root edges"),
        Refined(STICK_RADIUS, 1.0, part_of_cell(0.4), "order 1: known to a part of a cell"),
    )


def coated(random: Random) -> Case:
    """Draw a ball on a coated body at random; build the verification case with its semi-closed
    solution.

    The coating is thick enough that all grids resolve it.
    """
    return _coated("coated", random, (RESOLVED, 3.0))


def coated_thinly(random: Random) -> Case:
    """Draw a ball on a body with a thin coating at random; build the verification case.

    The coarser grids do not resolve the coating, so that the errors have no constant convergence
    order.
    """
    return _coated("coated_thinly", random, (0.3, RESOLVED))


def _coated(name: str, random: Random, thickness: tuple[float, float]) -> Case:
    film, base = any_material(random), any_material(random)
    film = film.model_copy(
        update={"young_modulus": base.young_modulus * between(random, 0.25, 4.0)}
    )
    radius, load = between(random, 1e-3, 1.0), between(random, 1e-1, 1e4)
    bare = PointContact.under_load(load, radius, base.plane_strain_modulus).contact_radius
    layer = Layer(thickness=bare * between(random, *thickness), material=film)
    body = Body(material=base, layers=(layer,))
    exact = paraboloid_under(load, surface_of(body), radius)
    scene = pressed(Paraboloid.model_validate({"radius": radius, "material": "rigid"}), body, load)
    problem = Problem(
        scene, (exact,), exact.contact_radius, FREDHOLM, ReferenceKind.SEMI_CLOSED,
        SEMI_CLOSED_ERROR,
    )  # fmt: skip
    return on_grids(name, problem, random, APPROACH_WITHIN, RADIUS_WITHIN)


def flat_punch(random: Random) -> Case:
    """Draw a flat punch, a body and a load at random; build the verification case with its closed
    form.

    The tolerance of the approach is half a cell side over the radius.
    """
    one, other = any_material(random), any_material(random)
    radius, load = between(random, 1e-4, 1e-2), between(random, 1e-1, 1e4)
    exact = FlatPunchContact(radius, contact_modulus(constants(one), constants(other)), load)
    scene = pressed(FlatPunch(radius=radius, material=one), Body(material=other), load)
    half_a_cell = 0.5 * WIDEST / LEVELS[-1]
    return on_grids(
        "flat_punch",
        Problem(scene, (exact,), radius, SOURCE),
        random,
        Within(APPROACH, half_a_cell, "half a cell: the rim is a staircase of cells"),
    )


def fem_hertz(random: Random) -> Case:
    """Draw a Hertz contact of elastic bodies at random; build its case for the finite-element
    solver.
    """
    one, other = any_material(random), any_material(random)
    radius, load = between(random, 1e-3, 1.0), between(random, 1e-1, 1e4)
    exact = PointContact.under_load(load, radius, contact_modulus(constants(one), constants(other)))
    scene = pressed(Paraboloid(radius=radius, material=one), Body(material=other), load)
    place = random.uniform(0.3, 0.7)  # of the edge of the contact in its element
    problem = Problem(scene, (exact,), exact.contact_radius, SOURCE)
    rungs = []
    for n in levels(Level.QUICK):
        mesh = per_radius(n, meshed(problem.radius, n, place))
        rungs.append(RefinementLevel(SectionRun(mesh_label(n), scene, mesh), n))
    because = "order 2; the cap is the figure of the case fem_hertz"
    rows = [Refined(what, 2.0, asked(1e-4, 2), because) for what in (APPROACH, PEAK_PRESSURE)]
    return case("fem_hertz", "fem_hertz", "", judged(ladder(problem, rungs), rows))


# Layers that are too thin for the coarser grids.
THIN = "coated_thinly"
FAMILIES: dict[str, Callable[[Random], Case]] = {
    "hertz": hertz,
    "cone": cone,
    "partial_slip": partial_slip,
    "coated": coated,
    "flat_punch": flat_punch,
    "fem_hertz": fem_hertz,
    THIN: coated_thinly,
}
