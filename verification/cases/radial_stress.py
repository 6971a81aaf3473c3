"""Stress below the radial solver's shear: Cattaneo and Mindlin, a twist, sliding on coatings."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.body_regions import REACH
from contact_results.stress.invariants import principal_stresses
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.points import StressPoints
from contact_results.stress.radial_body import RadialBody
from radial.below_circle import BelowCircle
from radial.circle_fit import round_circle
from radial.loaded_circle import LoadedCircle
from semi_analytical.frf.depth import Level as Depth
from semi_analytical.frf.stack import stack_of
from verification.cases.edge_stress import COATED
from verification.closed_forms.hamilton_stress import hamilton_stress
from verification.closed_forms.sheared_surface import (
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
)
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import RINGS_SHOWN, on_radii
from verification.judging.observable import Observable, error_norm
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, HERTZ, STEEL
from verification.problems.problem import Problem
from verification.problems.reference import ReferenceKind
from verification.problems.sheared import sheared
from verification.problems.torsion import TWISTED

Field = NDArray[np.float64]

PART, INCREMENTS = 0.6, 6  # of µW, and how often it is stopped on the way
DEEP = (0.1, 0.5)  # in contact radii
NU, P0, A = STEEL.poisson_ratio, HERTZ.peak_pressure, HERTZ.contact_radius
STUCK = paper.partial_slip(STEEL, PART * paper.FRICTION_LIMIT).stick_radius / A
SUPERPOSED = "Cattaneo 1938, Mindlin 1949; Hamilton 1983"
CARRIED = 0.4  # in contact radii: the depth of the plane that carries the torque


def _below(result: Any) -> RadialBody:
    return RadialBody.of(state_of_result(result, None), indenter=False)


def _points(body: RadialBody, depth: float, x: Field, y: Field) -> StressPoints:
    """At a depth and places in contact radii."""
    return body.points((Depth(depth * A, 0),), A * x, A * y)


def _error_below(result: Any, depth: float) -> float:
    """Along and beside the load."""
    x, y = (part.ravel() for part in np.meshgrid(np.linspace(-1.5, 1.5, 31), (0.0, 0.4, 0.8)))
    most = FRICTION * P0
    exact = hamilton_stress(x, y, depth, 1.0, P0, most, NU)
    exact -= hamilton_stress(x, y, depth, STUCK, 0.0, STUCK * most, NU)
    return float(np.max(np.abs(_points(_below(result), depth, x, y).stress[:, 0] - exact))) / P0


def _error_of_tension(result: Any, *_: Any) -> float:
    most, edge = FRICTION * P0, np.array([-1.0])
    exact = stress_by_hertz_pressure(edge, 1.0, P0, NU) + stress_by_hertz_shear(edge, 1.0, most, NU)
    exact -= stress_by_hertz_shear(edge, STUCK, STUCK * most, NU)
    body = _below(result)
    place = np.array([body.centre - body.parts.radius]) / A
    found = _points(body, 0.0, place, 0 * place).principal[0]
    return abs(float(found[0, 0] / exact[0]) - 1)


def _error_of_torque(result: Any, *_: Any) -> float:
    """∫ σ_θz 2πr² dr over the plane, r/(1 + r) from 0 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(120)
    t = (1 + nodes) / 2
    r, area = t / (1 - t), weights / 2 / (1 - t) ** 2
    stress = _points(_below(result), CARRIED, r, 0 * r).stress[3, 0]
    return abs(-float(2 * np.pi * A**3 * (stress * r * r) @ area) / result.steps[-1].torque - 1)


def _tension(result: Any, _: int, problem: Problem) -> float:
    """On the trailing edge where the contact slides, over p₀."""
    end = result.steps[-1]
    nothing = np.zeros_like(end.radii)
    still = round_circle(end.radii, end.contact_radius, nothing, nothing, end.pressure)
    p = np.broadcast_to(still.smooth[2], (still.smooth.shape[1], 4))
    sliding = LoadedCircle(still.radius, 0.0, np.stack([FRICTION * p, 0 * p, p]))
    below = BelowCircle(sliding, stack_of(problem.scene.body), REACH, 1)
    stress = below.at((Depth(0.0, 0),), np.array([-still.radius]), np.zeros(1))[0, 3:]
    return float(principal_stresses(stress)[0, 0]) / P0


def _deep(depth: float) -> Within:
    what = error_norm(
        f"below_{depth:g}", f"largest error of all components {depth:g} a below the surface",
        lambda result, *_: _error_below(result, depth), "p₀",
    )  # fmt: skip
    return Within(what, 5e-3, "set by hand: what 24 rings leave of the shear where it has a front")


OF_PUSH = (
    *map(_deep, DEEP),
    Within(
        error_norm(
            "trailing_edge", "error of σ₁ on the trailing edge", _error_of_tension, "its value"
        ),
        5e-3, "required of tension at the edge by the project's accuracy targets",
    ),
)  # fmt: skip
OF_TWIST = (
    Within(
        error_norm(
            "torque", f"error of the torque carried {CARRIED:g} a below", _error_of_torque,
            "its value", source="equilibrium",
        ),
        5e-4, f"set by hand: straight lines between {RINGS_SHOWN} rings in the share of slip",
    ),
)  # fmt: skip
OF_COATING = (
    Within(
        Observable(
            "trailing_edge", "σ₁ on the trailing edge over Hertz's p₀", "", _tension,
            lambda value: float(value),
        ),
        2e-4, "set by hand: what points on rays and between radii leave",
    ),
)  # fmt: skip


def _coated(ratio: float, thickness: float, value: float) -> Problem:
    """Pressed without friction; the tension is that of sliding under the same pressure."""
    scene = pressed("Sliding", rigid_ball(), coated(film(ratio, thickness)))
    return Problem(
        scene, (value,), A,
        "rays over the pressure of `paraboloid_under`, and the layer by its Hankel transforms",
        ReferenceKind.SEMI_CLOSED, 1e-6 / value,
    )  # fmt: skip


def radial_stress(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    pushed = replace(sheared("Ball pushed", (PART,), STEEL, INCREMENTS), source=SUPERPOSED)
    twisted = replace(TWISTED, kind=ReferenceKind.IDENTITY)
    return case(
        "radial_stress",
        "Stress below shear on rings and angles",
        f"The paper's ball of steel pushed to {PART:g} of µW: all components below the "
        "edge and the tension on it; the ball twisted: what a plane below carries of the torque; "
        "a ball that slides on coatings: the tension on the trailing edge; by the radial solver, "
        "from its tractions or, sliding, from exact ones.",
        judged(on_radii(pushed, "pushed"), OF_PUSH),
        judged(on_radii(twisted, "twisted"), OF_TWIST),
        *(
            judged(
                on_radii(
                    _coated(*film_of, value), "E1/E2 = {:g}, h = {:g} a_H".format(*film_of),
                ),
                OF_COATING,
            )
            for film_of, value in COATED.items()
        ),
        limits=(
            "Cattaneo and Mindlin neglect slip across the load, which the solver has: of steel at "
            "most a thousandth of the shift.",
            "What a pushed coating has below has no closed form: `slipstick stress` of "
            "coated_fretting.toml by three solvers gives 1.171, 1.169 and 1.172 GPa.",
        ),
    )  # fmt: skip
