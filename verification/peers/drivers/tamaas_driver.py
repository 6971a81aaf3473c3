"""Driver of tamaas: method of Polonsky and Keer with a non-periodic kernel.

Friction is not requested: that of tamaas is periodic and follows another law.
"""

from __future__ import annotations

from importlib import import_module

import numpy as np

from verification.peers.drivers.exchange import (
    Answer,
    CannotDo,
    Request,
    answer,
    approach_of,
    gap_of,
)


def solve(request: Request) -> Answer:
    """Solve a frictionless contact with tamaas; return pressure and, if requested, the approach.

    The approach takes one more application of the elastic operator. Raises CannotDo for friction.
    """
    if request["friction"]:
        raise CannotDo("friction on a periodic surface only, with another law")
    tamaas = import_module("tamaas")
    tamaas.set_log_level(tamaas.LogLevel.error)
    n, side = request["cells"], request["window"]
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [side, side], [n, n])
    model.E, model.nu = request["modulus"], 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, "free")
    gap, approach = gap_of(request), None
    solver = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(-gap), request["tolerance"])
    solver.setIntegralOperator("free")
    solver.max_iter = 10000
    error = solver.solve(request["force"] / side**2)
    pressure = np.array(model.traction).reshape(n, n)
    if request.get("approach"):
        # The solver leaves a displacement that is off by a constant.
        model.operators["free"](model.traction, model.displacement)
        approach = approach_of(gap, np.array(model.displacement).reshape(n, n), pressure)
    return {
        "pressure": pressure,
        "shear": None,
        "approach": approach,
        "converged": bool(error <= request["tolerance"]),
    }


if __name__ == "__main__":
    answer(solve, "tamaas")
