"""Catalogue of the tables of reference numbers, by name.

The numbers are computed by the radial solver in dimensionless form.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from contact_scene import RIGID, FlatPunch
from radial.normal.disc import disc
from radial.normal.pressing import (
    Target,
    normal_contact,
)
from radial.normal.surface import pressure
from radial.plan import MAX_CONTRAST
from radial.response.bodies import Bodies
from radial.torsion.torsion import Torsion
from radial.torsion.twist_path import TwistPath
from semi_analytical.frf.stack import Stack
from slipstick.tables.frictional import (
    BALL,
    FORCE,
    FRONT,
    MODULUS,
    OF_RING,
    indentation_row,
    tractions_row,
)
from slipstick.tables.table import ROUND_OFF, Axis, RowValues, Table

LEBEDEV = (
    "Lebedev and Ufliand 1958; for layers, Perriot and Barthel 2004; by Legendre polynomials on "
    "exact frequency responses"
)
PUNCH = FlatPunch(radius=1.0, material=RIGID)
COULOMB = (
    "Coulomb's law on rings in the increments of the load, after Spence 1975; for layers by exact "
    "frequency responses"
)
HERTZ = "; Hertz's values are those of the same force on the bare half-space"
ON_COATING = "on a layer of thickness h that is bonded to a half-space, both of the same ratio nu"
RUBBED = (
    "2 times the change of a number for 2 times the rings and increments, plus the relative error "
    f"of the load, plus {ROUND_OFF:g} of the number for round-off"
)
MAX_FRICTION = 10.0  # the contact sticks nearly everywhere
COATING = {
    "E1_over_E2": Axis(
        "Young's modulus of the layer over that of the substrate",
        (0.25, 0.5, 1.0, 2.0, 4.0),
        1 / MAX_CONTRAST,
        MAX_CONTRAST,
    ),
    "h_over_aH": Axis(
        "thickness of the layer over Hertz's contact radius on the substrate", (0.25, 1.0)
    ),
    "nu": Axis("Poisson's ratio of both", (0.3,), -1.0, 0.5),
}
FRICTION = {"mu": Axis("coefficient of friction", (0.1, 0.3), most=MAX_FRICTION)}
FIGURE = {
    **COATING,
    "E1_over_E2": replace(COATING["E1_over_E2"], values=(0.5, 1.0, 2.0, 4.0)),
    "h_over_aH": Axis(COATING["h_over_aH"].meaning, (1.0,)),
}


def _punch_row(place: Sequence[float], fineness: int) -> RowValues:
    """Compute the stiffness of a rigid flat punch on a bonded layer over that on a half-space,
    from radius over thickness and Poisson's ratio."""
    over, ratio = place
    shear = (1 - ratio) / 2  # E* = 2G/(1-ν) = 1
    layer = Bodies([Stack([(shear, ratio, 1 / over)])], 1.0)
    return RowValues((disc(layer, PUNCH, 1.0, 1.0, fineness).load / 2,))


def _ball_row(place: Sequence[float], fineness: int) -> RowValues:
    """Compute contact radius, pressure on the axis and approach of a ball on a coated half-space.

    The results are relative to the Hertz contact of the same force on the bare substrate.

    place     E1/E2, h/a_H and ν: modulus of the layer over that of the substrate, layer thickness
              over Hertz's contact radius, Poisson's ratio
    """
    moduli, thickness, ratio = place
    shear = MODULUS * (1 - ratio) / 2
    film, base = (moduli * shear, ratio, thickness), (shear, ratio)
    bodies = Bodies([Stack([film], base)], moduli * MODULUS)
    contact = normal_contact(bodies, BALL, Target(FORCE, None), fineness).contact
    p0 = float(pressure(contact, np.zeros(1))[0])
    return RowValues((contact.radius, p0, contact.approach), abs(contact.load / FORCE - 1))


def _torsion_row(place: Sequence[float], fineness: int) -> RowValues:
    """Compute gross-slip torque, stick radius and twist of two equal coated balls in torsion.

    The results are dimensionless: torque over µ W a_H, stick radius over the contact radius, and
    twist times G a_H²/(µ W). W is the normal force, a_H Hertz's contact radius on the substrate,
    and G the shear modulus with 1/G summed over both substrates.

    place     E1/E2, h/a_H, ν, and torque over the torque of gross slip, with the layer thickness h
    """
    moduli, thickness, ratio, part = place
    base = MODULUS * (1 - ratio)  # shear modulus; the E* of two equal bodies is G/(1-ν)
    stacks = [Stack([(moduli * base, ratio, thickness)], (base, ratio))] * 2
    bodies = Bodies(stacks, moduli * MODULUS)
    contact = normal_contact(bodies, BALL, Target(FORCE, None), fineness).contact
    torsion = Torsion(contact, stacks, moduli * base / 2, 1.0, fineness)
    path = TwistPath(torsion).continue_to_torque(part * torsion.gross_slip_torque)
    values = (torsion.gross_slip_torque / FORCE, path.stick, path.twist * base / 2 / FORCE)
    return RowValues(values, abs(contact.load / FORCE - 1))


TABLES: Mapping[str, Table] = {
    table.name: table
    for table in (
        Table(
            "punch",
            {
                "a_over_h": Axis(
                    "radius of the punch over the thickness of the layer",
                    (0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0),
                ),
                "nu": Axis(
                    "Poisson's ratio of the layer",
                    (0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.49, 0.5),
                    -1.0,
                    0.5,
                ),
            },
            {"kappa": "W(1-nu)/(4 G a delta): the stiffness over that of a half-space"},
            "A rigid flat punch of radius a, frictionless, on a layer of thickness h that is "
            "bonded to a rigid base",
            LEBEDEV,
            _punch_row,
        ),
        Table(
            "ball",
            {
                "E1_over_E2": Axis(
                    "Young's modulus of the layer over that of the substrate",
                    (0.1, 0.2, 0.5, 0.8, 1.25, 2.0, 4.0, 10.0),
                    1 / MAX_CONTRAST,
                    MAX_CONTRAST,
                ),
                "h_over_aH": Axis(
                    "thickness of the layer over Hertz's contact radius on the substrate",
                    (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0),
                ),
                "nu": Axis("Poisson's ratio of both", (0.3,), -1.0, 0.5),
            },
            {
                "a_over_aH": "contact radius over Hertz's on the substrate",
                "p0_over_pH": "pressure on the axis over Hertz's on the substrate",
                "delta_over_deltaH": "approach over Hertz's on the substrate",
            },
            "A rigid paraboloid, frictionless, on a layer of thickness h that is bonded to a "
            "half-space; Hertz's values are those of the same force on the bare half-space",
            LEBEDEV,
            _ball_row,
        ),
        Table(
            "torsion",
            {
                **COATING,
                "M_over_Ms": Axis("torque over the torque of gross slip", (0.5, 0.9), most=0.999),
            },
            {
                "Ms_over_muWaH": "torque of gross slip over mu W a_H",
                "c_over_a": "stick radius over the contact radius",
                "twist": "G a_H^2/(mu W) times the twist; 1/G is the sum over both substrates",
            },
            f"Two equal paraboloids, both with a bonded layer of thickness h, pressed and then "
            f"twisted; layers and substrates have the same ratio nu{HERTZ}",
            "Lubkin 1951; for layers by Legendre polynomials on exact frequency responses",
            _torsion_row,
        ),
        Table(
            "pressing",
            {**COATING, **FRICTION},
            {
                "a_over_aH": "contact radius over Hertz's on the substrate",
                "delta_over_deltaH": "approach over Hertz's on the substrate",
                "c_over_a": "stick radius over the contact radius",
            },
            f"A rigid paraboloid, pressed with friction from the first contact {ON_COATING}{HERTZ}",
            COULOMB,
            indentation_row,
            f"{RUBBED}; for the stick radius plus {FRONT:g} a, the resolution of the rings",
        ),
        Table(
            "tractions",
            {
                **FIGURE,
                **FRICTION,
                "r_over_a": Axis(
                    "distance from the axis over the contact radius",
                    (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95),
                    0.0,
                    1.0,
                ),
            },
            {
                "p_over_pH": "pressure over Hertz's on the axis on the substrate",
                "q_over_mu_pH": "radial shear, outward on the layer, over mu p_H",
            },
            f"A rigid paraboloid, pressed with friction from the first contact {ON_COATING}{HERTZ}",
            COULOMB,
            tractions_row,
            f"{RUBBED}; plus {OF_RING:g} p_H for the rings, or near the stick radius the change "
            f"over {FRONT:g} a",
        ),
    )
}
