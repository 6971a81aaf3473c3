"""Print all numbers of the closed forms for one contact of each kind, inside, at and outside it."""

from dataclasses import fields, replace
from functools import partial
from inspect import getmembers, signature

import numpy as np

from verification.closed_forms import (
    cattaneo_mindlin,
    coated_indentation,
    flat_punch,
    hertz,
    huber_stress,
    line_contact,
    torsion,
)
from verification.closed_forms.bonded_film import BondedFilm

FILM, BASE = (2.1, 0.25), (1.3, 0.4)  # shear modulus, Poisson's ratio
BALL = hertz.PointContact.under_load(0.8, 3.0, hertz.contact_modulus(FILM, BASE))
LARGER = hertz.PointContact.under_load(1.3, 3.0, BALL.contact_modulus)
A = BALL.contact_radius
PLACES = A * np.array([0.0, 0.2, 0.55, 0.8, 0.95, 1.0, 1.3])
ALONG, ACROSS = PLACES - 0.1 * A, 0.4 * PLACES
MANY = 20
INSIDE = PLACES[:-1]
PUSHED = cattaneo_mindlin.PartialSlip(0.8, A, 0.3, hertz.tangential_modulus(FILM, BASE), 0.15)
VIRGIN = replace(PUSHED, tangential_force=0.0)
LOOP = cattaneo_mindlin.TangentialHistory(VIRGIN).loaded_to(0.2).loaded_to(-0.1).loaded_to(0.04)
CYLINDER = line_contact.CylinderContact(0.5, 4.0, 1.7, 20.0)
LAYER = coated_indentation.LayeredSurface(
    BondedFilm(FILM, BASE, 0.6, 40.0, 15.0).normal_response, 2 * FILM[0] / (1 - FILM[1]), 0.6
)
TURNED = coated_indentation.LayeredSurface(
    partial(torsion.one_layer, thickness=0.6, shear_modulus=2.1, base_modulus=1.3), 4.2, 0.6
)


def limit(r):
    return 0.2 * BALL.pressure(r)


CONTACTS = (
    BALL,
    hertz.SphereContact.under_load(0.8, 3.0, 1.9),
    hertz.EllipticalContact.under_load(0.8, (3.0, 7.0), 1.9),
    flat_punch.FlatPunchContact(A, 1.9, 0.8, (0.1 * A, -0.15 * A)),
    flat_punch.ConeContact.under_load(0.8, 0.1, 1.9),
    PUSHED,
    LOOP,
    cattaneo_mindlin.GrownContact((BALL, LARGER), (0.2, -0.1), 1.2),
    cattaneo_mindlin.CycledContact(PUSHED, BALL.peak_pressure),
    coated_indentation.flat_punch(LAYER, A),
    coated_indentation.paraboloid(LAYER, 3.0, A),
    coated_indentation.paraboloid_under(0.8, LAYER, 3.0),
    CYLINDER,
    line_contact.PushedCylinder(CYLINDER, 0.3, 0.06, 1e-3),
    line_contact.WedgeContact(0.5, 0.1, 1.7),
    line_contact.FlatStrip(0.5, A, 1.7, 0.05),
    line_contact.SlidingCylinder(0.5, 4.0, 1.7, 0.3, 0.2),
    torsion.StuckTorsion(A, 0.7, 0.02),
    torsion.TorsionalPartialSlip.under_moment(0.04, A, BALL.peak_pressure, 0.3, 0.7),
    torsion.CoatedTorsion.under_torque(0.02, TURNED, A, limit),
)
NUMBERS = (
    line_contact.rounded_strip_load(1.0, 0.6, 8.0, 1.7),
    huber_stress.trailing_edge_tension(1.1, 0.3, 0.25),
    huber_stress.stress_by_hertz_shear(PLACES, A, 0.3, 0.25),
    huber_stress.stress_by_partial_slip(PLACES, A, 0.5 * A, 0.3, 0.25),
    huber_stress.stress_by_hertz_pressure(PLACES, A, 1.1, 0.25),
    huber_stress.hamilton_stress(ALONG, ACROSS, 0.3 * A + PLACES, A, 1.1, 0.3, 0.25),
)
STRESS = huber_stress.huber_stress(PLACES, 0.4 * PLACES + 0.1 * A, A, 1.1, 0.25)


def show(name, value):
    """Print the numbers of a value if they are few."""
    found = np.ravel(value)
    if found.dtype.kind == "f" and found.size < MANY:
        print(name, *found.tolist())


def of_places(method):
    """Evaluate a method of one or two coordinates within its range; None for another one."""
    match tuple(signature(method).parameters):
        case ("r",):
            return method(INSIDE)
        case ("x",):
            return method(ALONG[:-1])
        case ("x", "y"):
            return method(ALONG[:-1], ACROSS[:-1])


for contact in CONTACTS:
    kind = type(contact).__name__
    for name, value in getmembers(contact):
        if not name.startswith("_") and not hasattr(value, "__dataclass_fields__"):
            show(f"{kind}.{name}", of_places(value) if callable(value) else value)
for one in NUMBERS:
    show("number", one)
for one in fields(STRESS):
    show(f"stress {one.name}", getattr(STRESS, one.name))
