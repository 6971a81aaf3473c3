"""Driver of ContactMechanics: constrained conjugate gradients with a free-space kernel; no
friction.
"""

from __future__ import annotations

from importlib import import_module

import numpy as np

from verification.peers.drivers.exchange import Answer, CannotDo, Request, answer, gap_of


def solve(request: Request) -> Answer:
    """Solve a frictionless contact with ContactMechanics; return pressure and approach.

    Raises CannotDo for friction.
    """
    if request["friction"]:
        raise CannotDo("no friction")
    contact, surfaces = import_module("ContactMechanics"), import_module("SurfaceTopography")
    n, side = request["cells"], request["window"]
    substrate = contact.FreeFFTElasticHalfSpace((n, n), request["modulus"], (side, side))
    topography = surfaces.Topography(-gap_of(request), (side, side))
    system = contact.Systems.NonSmoothContactSystem(substrate, topography)
    found = system.minimize_proxy(
        external_force=request["force"],
        forcetol=request["tolerance"],
        pentol=request["tolerance"] * side,
    )
    area = (side / n) ** 2
    return {
        "pressure": np.array(substrate.force)[:n, :n] / area,
        "shear": None,
        "approach": float(np.squeeze(found.offset)) if hasattr(found, "offset") else None,
        "converged": bool(found.success),
    }


if __name__ == "__main__":
    answer(solve, "ContactMechanics", "SurfaceTopography")
