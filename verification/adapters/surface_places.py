"""Our semi-analytical method at places: stress below cells, and the surface beside a patch."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RectBivariateSpline

from contact_scene import RIGID, Body
from semi_analytical import Increment, Result
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.stress import subsurface
from verification.challenge.answer import Answer, Key, Vector
from verification.challenge.python_api import Posed
from verification.quantities import shear_of

COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
# What the reference of influence coefficients calls what moves and under which traction.
MOVED = {
    "u_z_by_pressure": "zz", "u_x_by_shear_x": "xx", "u_y_by_shear_y": "yy",
    "u_x_by_shear_y": "xy", "u_z_by_shear_x": "zx",
}  # fmt: skip


def stress_at(result: Result, end: Increment, places: Vector) -> Vector:
    """(6, places), cubic between the cells below which it is computed [force/length²]."""
    grid = result.grid
    depths, of = np.unique(places[:, 2], return_inverse=True)
    field = subsurface(result.scene, grid, end.pressure, shear_of(end), list(depths)).stress
    return np.array(
        [
            [
                float(RectBivariateSpline(grid.x, grid.y, field[level, n])(x, y)[0, 0])
                for (x, y, _), level in zip(places, of, strict=True)
            ]
            for n in range(6)
        ]
    )


def under_a_patch(posed: Posed) -> Answer:
    """Influence coefficients: the patch is a cell, the places are centres of others."""
    side, traction = (posed.scene["patch"][name] for name in ("side", "traction"))
    body = Body.model_validate(posed.scene["body"])
    points: dict[Key, Vector] = {}
    for key, places in posed.places.items():
        i, j = np.rint(places[:, :2].T / side).astype(int)
        offsets = int(i.max()) + 1, int(np.abs(j).max()) + 1
        K = getattr(
            influence_coefficients(body, Body(material=RIGID), (side, side), offsets), MOVED[key[0]]
        )
        odd = np.where(key[0] == "u_x_by_shear_y", np.sign(j), 1)
        points[key] = traction * odd * K[i, np.abs(j)]
    return Answer(side, unknowns=1, points=points)
