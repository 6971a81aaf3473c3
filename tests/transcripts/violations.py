"""Print all numbers of the laws of contact, friction and energy for wrong results of each solver,
and the features of the right ones.

In a wrong result each number and each field of the last increment is off by a different amount, a
field by one that varies from point to point: by a factor alone, or without contact as well.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, fields, replace

import numpy as np

from contact_results.solvers import solver_of
from contact_scene import read_scene_file
from slipstick import solve
from verification.observed.cells import states_on_cells
from verification.observed.contact_state import imbalances, missed, violations
from verification.observed.elements import states_on_elements
from verification.observed.radii import states_on_radii

RESULTS = (
    ("semi-analytical", states_on_cells, "strained edges torsion rig"),
    ("radial", states_on_radii, "frictionless ring turning elements"),
    ("fem-complementarity", states_on_elements, "ring elements"),
    ("fem", states_on_elements, "ring frictionless"),
)
SHOWN = 20  # laws of the last increments
OFF = 0.03
ROUND_OFF = 1e-6  # of a number that is zero if a result is right


def wrong(value: object, number: float, *, by_factor: bool) -> object:
    """Return a number or a field that is off, and anything else as it is."""
    if isinstance(value, tuple):
        return tuple(wrong(one, number + k, by_factor=by_factor) for k, one in enumerate(value))
    found = np.asarray(value)
    if found.dtype.kind != "f":
        return value
    finite = np.where(np.isfinite(found), found, 0.0)
    amount = OFF * np.sin(number + 0.7 * np.arange(found.size)).reshape(found.shape)
    return found + amount * (finite if by_factor else np.max(np.abs(finite)))


def show(name: str, numbers: Sequence[float]) -> None:
    found = np.array(numbers[-SHOWN:])
    print(name, *np.where(np.abs(found) > ROUND_OFF, found, 0.0).tolist())


for solver, states_of, names in RESULTS:
    for name in names.split():
        result = solve(read_scene_file(f"{name}.toml"), solver)
        for step in solver_of(result).features(result):
            # `left` is a ratio of residuals, which differ between processors.
            print(name, solver, json.dumps(asdict(replace(step, left={})), default=float))
        *early, last = result.increments
        held = [one.name for one in fields(last) if one.init]
        for by_factor in (True, False):
            off = {
                one: wrong(getattr(last, one), k, by_factor=by_factor) for k, one in enumerate(held)
            }
            made = replace(result, increments=(*early, replace(last, **off)))
            states = states_of(made)
            print(name, solver, *(state.unseen or state.not_compared for state in states))
            show("laws", list(violations(states)))
            show("balance", list(imbalances(states)))
            show("prescribed", list(missed(made.scene, made.steps)))
