"""Tests of the check of returned fields by the laws of contact: violations are detected."""

import re
from dataclasses import replace

import numpy as np
import pytest

from contact_scene import LoadStep
from verification.judging.case import (
    OTHER_NORMS,
    SOLVER_TOLERANCE,
    RadiiRun,
    Run,
    SectionRun,
    per_radius,
)
from verification.observed.cells import states_on_cells
from verification.observed.contact_state import imbalances, missed, violations
from verification.observed.elements import states_on_elements
from verification.observed.observed_laws import observed
from verification.observed.radii import states_on_radii
from verification.problems import problem as paper
from verification.problems.cattaneo_mindlin import torque_step
from verification.problems.problem import (
    FRICTION_LIMIT,
    NU_ZERO,
    STEEL,
)
from verification.solver import Method

ALLOWED = OTHER_NORMS * SOLVER_TOLERANCE
SEEN = 10 * ALLOWED
GRID = paper.hertz_grid(24)
MESH = per_radius(8, 0.97 * paper.HERTZ.contact_radius)


def push(x, y=0.0):
    return LoadStep(tangential_force=(x * FRICTION_LIMIT, y * FRICTION_LIMIT), increments=1)


def scene(*loading):
    return paper.frictional("Pushed", paper.paraboloid(NU_ZERO), NU_ZERO, *loading)


def twisted():
    return paper.frictional("Twisted", paper.paraboloid(STEEL), STEEL, torque_step(0.6))


LOOP = push(0.6), push(-0.3)
RUNS = {
    "cells": Run("cells", scene(*LOOP, push(-0.3, 0.4)), GRID, edge="off"),
    "cells, twisted": Run("cells, twisted", twisted(), GRID),
    "rings": SectionRun("rings", scene(*LOOP), MESH),
    "springs": SectionRun("springs", scene(*LOOP), MESH, Method.PENALTY),
    "radii": RadiiRun("radii", scene(*LOOP)),
    "radii, twisted": RadiiRun("radii, twisted", twisted()),
}


@pytest.fixture(scope="module")
def solved():
    return {name: run.solve() for name, run in RUNS.items()}


def changed(result, **changes):
    """The result with values of its last increment replaced, by functions of what they were."""
    *before, last = result.increments
    new = {name: change(getattr(last, name)) for name, change in changes.items()}
    return replace(result, increments=(*before, replace(last, **new)))


def times(factor):
    return lambda value: factor * value


def shifted(factor):
    return lambda shift: (factor * shift[0], shift[1])


ENERGIES = ("approach", "elastic_energy", "dissipated_energy")
TORN = {  # run, factor: what its last increment tells wrong by it
    ("cells", 1.01): (
        "pressure",
        "shear",
        "slip",
        "normal_force",
        "tangential_force",
        "dissipation",
        "slip_distance",
        "tangential_shift",
        "input_work",
        "unresolved_work",
        *ENERGIES,
    ),
    ("cells, twisted", 1.01): ("torque", "twist"),
    **dict.fromkeys(
        (("rings", 1.01), ("springs", 1.01)),
        (
            "pressure",
            "shear_along_load",
            "slip_along_load",
            "normal_force",
            "approach",
            "dissipated_energy",
            "input_work",
        ),
    ),
    ("radii", 1.02): ("pressure", "shear_radial", "normal_force", "approach", "elastic_energy"),
    ("radii", 1.1): ("slip_radial", "dissipated_energy", "input_work"),
    ("radii, twisted", 1.02): ("torque", "shear_circumferential"),
    ("radii, twisted", -1.0): ("slip_circumferential", "twist"),
}


@pytest.mark.parametrize(
    ("run", "factor", "name"), [(*key, name) for key, names in TORN.items() for name in names]
)
def test_broken_law_is_seen(solved, run, factor, name):
    violation, imbalance, *_ = observed(changed(solved[run], **{name: times(factor)}))
    laws, energy = (SEEN, SEEN) if "radii" not in run else (RUNS[run].laws, RUNS[run].energy)
    assert violation > laws or imbalance > energy
    if run == "cells" and name in ENERGIES:
        assert re.match(r"increment \d+: .* J, .* J; difference ", imbalance.terms)


def test_each_law_alone_is_seen(solved):
    """Fields are changed such that all other laws still hold."""
    *early, now = states_on_cells(solved["cells"])
    stuck = np.argwhere((now.pressure > 0) & np.all(now.slip == early[-1].slip, axis=0))[0]
    pressure, shear = now.pressure.copy(), now.shear.copy()
    pressure[0, 0] = -0.01 * np.max(pressure)
    shear[(0, *stuck)] = 1.2 * now.limit[tuple(stuck)]
    for wrong in (replace(now, pressure=pressure), replace(now, shear=shear)):
        assert max(violations([*early, now])) < ALLOWED
        assert max(violations([*early, wrong])) > SEEN
    # The energy balance follows from the other energies unless springs store a part.
    *early, now = states_on_elements(solved["springs"])
    assert max(imbalances([*early, now])) < ALLOWED
    assert max(imbalances([*early, replace(now, undeformed=1.01 * now.undeformed)])) > SEEN


# Wrong values of the last increment, the runs in which they are seen, and the least violation. A
# shift is known no better than what springs of a penalty can yield.
WRONG = {
    "stick outside the contact": ({"in_stick": np.ones_like}, ("cells", "rings"), 1.0),
    "shift": ({"tangential_shift": shifted(1.01)}, ("rings",), SEEN),
    "shift, springs": ({"tangential_shift": shifted(1.5)}, ("springs",), SEEN),
    "not a number": ({"pressure": times(np.nan)}, ("cells", "rings"), 1e300),
}


@pytest.mark.parametrize(
    ("what", "name"), [(what, name) for what, (_, names, _) in WRONG.items() for name in names]
)
def test_wrong_state_is_seen(solved, what, name):
    changes, _, least = WRONG[what]
    assert max(observed(changed(solved[name], **changes))[:2]) >= least


@pytest.mark.parametrize("name", ["cells", "rings"])
def test_another_prescribed_load_is_seen(solved, name):
    *before, last = solved[name].scene.loading
    x, y = last.tangential_force
    other = last.model_copy(update={"tangential_force": (1.01 * x, y)})
    scene = solved[name].scene.model_copy(update={"loading": (*before, other)})
    assert max(observed(replace(solved[name], scene=scene))[:2]) >= SEEN


@pytest.mark.parametrize("name", ["cells", "rings", "springs"])
def test_prescribed_force_that_is_not_told_is_missed(solved, name):
    untold = changed(solved[name], tangential_force=lambda force: None)
    assert max(missed(untold.scene, untold.steps)) > SEEN


# ---- rings


def test_one_ring_above_its_limit_is_seen(solved):
    *before, last = states_on_radii(solved["radii"])
    slipping = np.argwhere(np.hypot(*last.shear) > 0.999 * last.limit)
    ring = slipping[len(slipping) // 2][0]
    shear = last.shear.copy()
    shear[:, ring] *= 1.02
    bound = RUNS["radii"].laws
    assert max(violations([*before, last])) < bound / 5
    assert max(violations([*before, replace(last, shear=shear)])) > bound
