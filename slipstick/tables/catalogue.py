"""All tables, by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import pi

import numpy as np

from contact_scene import RIGID, FlatPunch, Paraboloid
from radial.bodies import Bodies
from radial.disc import disc
from radial.pressing import Target, pressed
from radial.surface import pressure
from semi_analytical.frf.stack import Stack
from slipstick.tables.table import Axis, Found, Table

LEBEDEV = (
    "Lebedev and Ufliand 1958; for layers, Perriot and Barthel 2004; by Legendre polynomials on "
    "exact frequency responses"
)
PUNCH = FlatPunch(radius=1.0, material=RIGID)
# Of the contact on the bare substrate: a_H = p_H = δ_H = 1, E*_2 = π/2, W = 2π/3.
BALL, MODULUS, FORCE = Paraboloid(radius=1.0, material=RIGID), pi / 2, 2 * pi / 3


def _punch(place: Sequence[float], fineness: int) -> Found:
    over, ratio = place
    shear = (1 - ratio) / 2  # E* = 2G/(1-ν) = 1
    layer = Bodies([Stack([(shear, ratio, 1 / over)])], 1.0)
    return Found((disc(layer, PUNCH, 1.0, 1.0, fineness).load / 2,))


def _ball(place: Sequence[float], fineness: int) -> Found:
    moduli, thickness, ratio = place
    shear = MODULUS * (1 - ratio) / 2
    film, base = (moduli * shear, ratio, thickness), (shear, ratio)
    bodies = Bodies([Stack([film], base)], moduli * MODULUS)
    contact = pressed(bodies, BALL, Target(FORCE, None), fineness).contact
    p0 = float(pressure(contact, np.zeros(1))[0])
    return Found((contact.radius, p0, contact.approach), abs(contact.load / FORCE - 1))


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
            _punch,
        ),
        Table(
            "ball",
            {
                "E1_over_E2": Axis(
                    "Young's modulus of the layer over that of the substrate",
                    (0.1, 0.2, 0.5, 0.8, 1.25, 2.0, 4.0, 10.0),
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
            _ball,
        ),
    )
}
