"""Healthy contacts of many kinds: other loads, bodies, windows and places of the grid.

Each is drawn by the number of its draw, and has an exact or semi-closed solution.
"""

from __future__ import annotations

from collections.abc import Callable
from math import radians

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
from verification.cases.fem_levels import allowed, label
from verification.cases.fem_levels import levels as fem_levels
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.coated_indentation import paraboloid_under
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.moduli import contact_modulus, tangential_modulus
from verification.defects.drawn_contact import (
    LEVELS,
    WIDEST,
    Random,
    any_material,
    approach_within,
    between,
    constants,
    on_grids,
    part_of_cell,
    pressed,
    radius_within,
)
from verification.judging.case import Case, Derived, Level, Quantity, Required
from verification.judging.run import SectionRun, per_radius
from verification.observed.end_state import approach, peak_pressure, shift, stick_radius
from verification.problems.layered_scene import semi_closed, surface_of
from verification.problems.reference import closed_form

SOURCE = "the closed form of the contact"
RESOLVED = (
    0.8  # thickness over Hertz's radius of the substrate: about ten cells of the coarsest grid
)


def hertz(random: Random) -> Case:
    """Two balls of any materials."""
    one, other = any_material(random), any_material(random)
    radius, load = between(random, 1e-3, 1.0), between(random, 1e-1, 1e4)
    exact = PointContact.under_load(load, radius, contact_modulus(constants(one), constants(other)))
    scene = pressed(Paraboloid(radius=radius, material=one), Body(material=other), load)
    return on_grids("hertz", scene, exact.contact_radius, random, lambda runs: (
        approach_within(runs, closed_form(exact.approach, SOURCE)),
        radius_within(runs, closed_form(exact.contact_radius, SOURCE)),
    ))  # fmt: skip


def cone(random: Random) -> Case:
    """A cone of any slope on any materials."""
    one, other = any_material(random), any_material(random)
    slope, load = radians(random.uniform(0.3, 3.0)), between(random, 1e-1, 1e4)
    exact = ConeContact.under_load(load, slope, contact_modulus(constants(one), constants(other)))
    scene = pressed(Cone(slope_angle=slope, material=one), Body(material=other), load)
    return on_grids("cone", scene, exact.contact_radius, random, lambda runs: (
        radius_within(runs, closed_form(exact.contact_radius, SOURCE)),
    ))  # fmt: skip


def partial_slip(random: Random) -> Case:
    """Cattaneo and Mindlin's contact: two alike bodies of ν = 0, any friction and force."""
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
    return on_grids("partial_slip", scene, a, random, lambda runs: (
        Quantity(
            "shift", "tangential shift", "m", runs[-1], shift,
            closed_form(exact.shift, SOURCE, exact.sliding_shift),
            Derived(runs, 1.5, 1e-3, "order 3/2 of the square-root edges"),
            exact.sliding_shift, "the shift at gross sliding",
        ),
        Quantity(
            "stick_radius", "√(stick area / π)", "m", runs[-1], stick_radius,
            closed_form(exact.stick_radius, SOURCE, a),
            Derived(runs, 1.0, 2 * part_of_cell(runs), "order 1: known to a part of a cell"),
            a, "the contact radius",
        ),
    ))  # fmt: skip


def coated(random: Random) -> Case:
    """A ball on one layer of any stiffness and ratio, and a thickness that all grids resolve."""
    return _coated("coated", random, (RESOLVED, 3.0))


def coated_thinly(random: Random) -> Case:
    """A ball on a thin layer, which the coarser grids do not resolve: their errors are of no one
    order."""
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
    return on_grids(name, scene, exact.contact_radius, random, lambda runs: (
        approach_within(runs, semi_closed(exact.approach)),
        radius_within(runs, semi_closed(exact.contact_radius)),
    ))  # fmt: skip


def flat_punch(random: Random) -> Case:
    """A flat punch of any size; its tolerances are those of the case flat_punch."""
    one, other = any_material(random), any_material(random)
    radius, load = between(random, 1e-4, 1e-2), between(random, 1e-1, 1e4)
    exact = FlatPunchContact(radius, contact_modulus(constants(one), constants(other)), load)
    scene = pressed(FlatPunch(radius=radius, material=one), Body(material=other), load)
    return on_grids("flat_punch", scene, radius, random, lambda runs: (
        Quantity(
            "approach", "approach", "m", runs[-1], approach, closed_form(exact.approach, SOURCE),
            Required(0.5 * WIDEST / LEVELS[-1], "half a cell: the rim is a staircase of cells"),
        ),
    ))  # fmt: skip


def fem_hertz(random: Random) -> Case:
    """Two balls of any materials by finite elements."""
    one, other = any_material(random), any_material(random)
    radius, load = between(random, 1e-3, 1.0), between(random, 1e-1, 1e4)
    exact = PointContact.under_load(load, radius, contact_modulus(constants(one), constants(other)))
    scene = pressed(Paraboloid(radius=radius, material=one), Body(material=other), load)
    meshes = fem_levels(Level.QUICK)
    place = random.uniform(0.3, 0.7)  # of the edge of the contact in its element
    runs = tuple(
        SectionRun(label(n), scene, per_radius(n, exact.contact_radius * n / (n + place)))
        for n in meshes
    )
    labels = tuple(run.label for run in runs)
    cap = allowed(1e-4, meshes[-1], 2)
    return Case("fem_hertz", "fem_hertz", "", runs, tuple(
        Quantity(
            name, name, unit, labels[-1], measure, closed_form(value, SOURCE),
            Derived(labels, 2.0, cap, "order 2; the cap is the figure of the case fem_hertz"),
        )
        for name, unit, measure, value in (
            ("approach", "m", approach, exact.approach),
            ("peak_pressure", "Pa", peak_pressure, exact.peak_pressure),
        )
    ))  # fmt: skip


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
