"""Tests of the stability map of the finite elements: hard contacts, and detection of wrong
fields."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

from contact_scene import FiniteElementDiscretisation
from fem_reference import Increment, Method, Result, solve
from verification.observed.observed_laws import observed
from verification.studies.stability.contacts import (
    TOLERANCE,
    LoadingPath,
    Refusal,
    Solver,
    StabilityCell,
    Surface,
    Verdict,
    judge_contact,
    pose,
)

BOTH = [solver for solver in Solver if solver.by_elements]
ORDINARY = StabilityCell(solver=Solver.COMPLEMENTARITY)
ALIKE = replace(ORDINARY, surface=Surface.ALIKE_BALL)
SOFT_FILM = replace(ORDINARY, friction=5.0, modulus_ratio=1e-3, thickness=0.1, poisson_ratio=0.5)
HALF_SPACE = replace(ORDINARY, modulus_ratio=1.0, poisson_ratio=0.0, base_ratio=0.0)
CELLS = [
    replace(ORDINARY, push=0.99),
    replace(ORDINARY, push=1.0),
    *(replace(ALIKE, path=path, push=0.8) for path in (LoadingPath.FALLING, LoadingPath.SLIDE)),
    replace(ORDINARY, path=LoadingPath.SHEARED_RELOAD, push=0.8),
    replace(ORDINARY, surface=Surface.FLAT_PUNCH, push=0.9),
    # Pressures that jump to and fro between the turns unless they are damped.
    replace(HALF_SPACE, friction=5.0, push=0.9),
    # Several states obey all laws, and pairs of them vanish on the way to one.
    pytest.param(replace(SOFT_FILM, push=0.5), marks=pytest.mark.slow),
    # So little friction that slip is no more than the rounding of what pressing moves.
    replace(HALF_SPACE, friction=1e-6, push=0.0, cells=48),
]


@pytest.mark.parametrize("solver", BOTH)
@pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
def test_hard_cell_converges(cell: StabilityCell, solver: Solver) -> None:
    record = judge_contact(replace(cell, solver=solver))
    assert record.verdict is Verdict.CONVERGED, record.reason
    assert record.residual is not None
    assert record.observed is not None
    assert record.residual <= record.tolerance == TOLERANCE
    assert record.halvings == 0
    assert record.work == record.iterations > 0


@pytest.mark.parametrize("solver", BOTH)
@pytest.mark.parametrize(
    ("change", "kind"),
    [
        ({"push": 1.001}, Refusal.FORCE),
        ({"push": 1.001, "surface": Surface.ALIKE_BALL}, Refusal.FORCE),
        ({"surface": Surface.ROUGH}, Refusal.POSE),
        ({"surface": Surface.GREASED}, Refusal.POSE),
    ],
)
def test_what_has_no_solution_is_refused_by_name(
    change: dict[str, Any], kind: Refusal, solver: Solver
) -> None:
    record = judge_contact(replace(ORDINARY, **change, solver=solver))
    assert record.verdict is Verdict.REFUSED
    assert record.refused_for is kind
    assert replace(ORDINARY, **change).posable == (kind is not Refusal.POSE)


SOLVED = {
    "radial shear": replace(ORDINARY, path=LoadingPath.RELOADED),
    "shear along the load": replace(ALIKE, path=LoadingPath.LOOP),
    "harmonics": replace(ORDINARY, path=LoadingPath.LOOP),
    "whole circle": replace(ORDINARY, path=LoadingPath.CIRCLE),
}


@cache
def solved(name: str, method: Method) -> Result:
    discretisation = FiniteElementDiscretisation(
        elements_per_radius=8,
        harmonics=4,
        augmentations=0 if name in ("harmonics", "whole circle") else 1,
        overlap=100.0,
    )
    return solve(pose(SOLVED[name]).scene, discretisation, method)


Change = Callable[[Increment], dict[str, Any]]


def scaled(part: float, *names: str, increment: Increment) -> dict[str, Any]:
    """Whatever of these fields there is, times a factor."""
    values = {name: getattr(increment, name) for name in names}
    return {n: part * np.asarray(v) for n, v in values.items() if v is not None}


SHEAR = ("shear_radial", "shear_circumferential", "shear_along_load")
SLIP = ("slip_radial", "slip_circumferential", "slip_along_load")
MUCH = 1 + 1e-4
DEFECTS: dict[str, Change] = {
    "tension": lambda i: {
        "pressure": np.where(i.pressure > 0, i.pressure, -1e-4 * i.peak_pressure)
    },
    "indenter too deep": lambda i: {"approach": i.approach * MUCH},
    "indenter too high": lambda i: {"approach": i.approach / MUCH},
    "another gap": lambda i: {"gap": i.gap * MUCH},
    "another normal force": lambda i: {"normal_force": i.normal_force * MUCH},
    "more pressure": lambda i: {"pressure": i.pressure * MUCH},
    "pressure elsewhere": lambda i: {"pressure": np.roll(i.pressure, 1, axis=0)},
    "more shear than friction allows": lambda i: partial(scaled, MUCH, *SHEAR)(increment=i),
    "shear the other way": lambda i: partial(scaled, -1.0, *SHEAR)(increment=i),
    "not a number": lambda i: {"pressure": np.where(i.pressure > 0, np.nan, 0.0)},
    "energy won by friction": lambda i: {"dissipated_energy": -(i.dissipated_energy or 0.0)},
}
OF_A_LOAD: dict[str, Change] = {
    "another tangential force": lambda i: {"tangential_force": (2 * i.tangential_force[0], 0.0)},
    "another shift": lambda i: {"tangential_shift": (2 * i.tangential_shift[0], 0.0)},
}
OF_SPRINGS: dict[str, Change] = {
    "another overlap": lambda i: {"overlap": 2 * i.overlap},
    "slip along the shear": lambda i: partial(scaled, -1.0, *SLIP)(increment=i),
    "slip without motion": lambda i: partial(scaled, 3.0, *SLIP)(increment=i),
}


def spoilt(result: Result, change: Change) -> float:
    *others, last = result.increments
    wrong = replace(last, **change(last))
    return observed(replace(result, increments=(*others, wrong))).violation


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize(
    ("name", "defect"),
    [
        *((name, defect) for name in SOLVED for defect in DEFECTS),
        *((name, defect) for name in SOLVED if name != "radial shear" for defect in OF_A_LOAD),
    ],
)
def test_a_wrong_field_is_seen_without_the_solver(name: str, method: Method, defect: str) -> None:
    result = solved(name, method)
    assert observed(result).violation <= TOLERANCE
    assert spoilt(result, (DEFECTS | OF_A_LOAD)[defect]) > 100 * TOLERANCE


@pytest.mark.parametrize("name", ["radial shear", "shear along the load"])
@pytest.mark.parametrize("defect", OF_SPRINGS)
def test_what_springs_tell_of_themselves_is_held_against_their_law(name: str, defect: str) -> None:
    assert spoilt(solved(name, Method.PENALTY), OF_SPRINGS[defect]) > 100 * TOLERANCE
