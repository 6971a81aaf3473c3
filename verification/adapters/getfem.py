"""GetFEM as anybody's code: a ball or cone pressed on a half-space or a coating, through its
driver, by the Python that Debian installs it for."""

from __future__ import annotations

from functools import cache
from math import pi, sqrt, tan
from pathlib import Path
from subprocess import run
from types import SimpleNamespace

import numpy as np

from verification.adapters.driven import driven
from verification.adapters.own_numbers import pressed_alone, scene_of
from verification.adapters.rings import between
from verification.challenge.answer import Answer, Key, Solver, Vector
from verification.challenge.door import CannotDo, Posed
from verification.peers.environment import Peer

GETFEM, PEER = Solver("GetFEM"), Peer("getfem", "getfem")
PYTHON = Path("/usr/bin/python3")
COARSEST = 16  # elements over a third of the window; both double
TOLERANCE = 1e-9
EDGE, AT_EDGE = 0.2, 5  # of the mean pressure, and nodes before
THICK = 1.0  # in place of a coating: of the same material


def answer(posed: Posed, level: int) -> Answer:
    """On COARSEST elements, twice as many, …; CannotDo without GetFEM."""
    if not _installed():
        raise CannotDo("GetFEM is not installed: apt-get install python3-getfem")
    scene_of(posed)
    indenter, body = posed.scene["indenter"], posed.scene["body"]
    bodies = [each["material"] for each in (indenter, body) if each["material"] != "rigid"]
    layers = (*(indenter.get("layers") or ()), *body["layers"])
    if (
        not pressed_alone(posed)
        or posed.scene["friction"]
        or indenter["shape"] not in ("paraboloid", "cone")
    ):
        raise CannotDo("a ball or cone that is pressed without friction, here")
    if len(layers) > 1 or (len(bodies) > 1 and layers):
        raise CannotDo("one layer under a rigid ball, here")
    # Without friction two bodies are one of their modulus.
    substrate = body["material"]
    stress = 1 / sum((1 - m["poisson_ratio"] ** 2) / m["young_modulus"] for m in bodies)
    nu = [m["poisson_ratio"] for m in (layers[0]["material"] if layers else substrate, substrate)]
    over = [
        m["young_modulus"] / substrate["young_modulus"]
        for m in (layers[0]["material"] if layers else substrate, substrate)
    ]
    length = posed.window / 3
    h, radius = length / (COARSEST * 2**level), indenter.get("radius")
    found = driven(
        PYTHON, PEER, {
            "elements": COARSEST * 2**level, "poisson_ratios": nu,
            "moduli": [(1 - nu[1] ** 2) * each for each in over],
            "thickness": layers[0]["thickness"] / length if layers else THICK,
            "curvature": length / radius if radius else 0.0,
            "slope": 0.0 if radius else tan(indenter["slope_angle"]),
            "approach": length / radius if radius else tan(indenter["slope_angle"]),
            "force": posed.loads[0][0] / (stress * length**2), "tolerance": TOLERANCE,
        },
    )  # fmt: skip
    r, p = length * np.array(found["radii"]), stress * np.array(found["pressure"])
    order = np.argsort(r)
    r, p = r[order], p[order]
    touching = between(SimpleNamespace(radii=r, contact_radius=r[-1] / 1.05), p)
    own = {
        "approach": length * found["approach"], "central_pressure": float(p[0]),
        "contact_radius": _edge(r, p, posed.loads[0][0]),
    }  # fmt: skip
    scalars: dict[Key, float] = {
        (q, s): value for q, s in posed.asked if (value := own.get(q)) is not None
    }
    gave_up = {} if found["converged"] else {1: "did not converge"}
    return Answer(
        h, scalars, dict.fromkeys(posed.fields, touching), gave_up, seconds=found["seconds"]
    )


def _edge(r: Vector, pressure: Vector, force: float) -> float | None:
    """Where the square of the pressure, a line in r² close to the edge, would vanish: beyond, what
    is left of a projection ripples about zero. None where it does not fall."""
    last = int(np.flatnonzero(pi * r**2 * pressure > EDGE * force)[-1])
    near = slice(last - AT_EDGE, last)
    slope, at_axis = np.polyfit(r[near] ** 2, pressure[near] ** 2, 1)
    return sqrt(-at_axis / slope) if slope < 0 < at_axis else None


@cache
def _installed() -> bool:
    probe = [str(PYTHON), "-c", "import getfem"]
    return PYTHON.exists() and not run(probe, capture_output=True, check=False).returncode
