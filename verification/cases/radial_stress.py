"""Stress below the radial solver's shear: Cattaneo and Mindlin, a twist, sliding on coatings."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

import radial
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
from verification.judging.case import Case, Check, Level, Required
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, film, pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, HERTZ, STEEL
from verification.problems.reference import Reference, ReferenceKind
from verification.problems.torsion import TWISTED

Field = NDArray[np.float64]

PART, INCREMENTS = 0.6, 6  # of µW, and how often it is stopped on the way
DEEP = (0.1, 0.5)  # in contact radii
NU, P0, A = STEEL.poisson_ratio, HERTZ.peak_pressure, HERTZ.contact_radius
SUPERPOSED = "Cattaneo 1938, Mindlin 1949; Hamilton 1983"
CARRIED = 0.4  # in contact radii: the depth of the plane that carries the torque
OF_STRESS = Required(5e-3, "set by hand: what 24 rings leave of the shear where it has a front")
OF_EDGE = Required(5e-3, "required of tension at the edge by the project's accuracy targets")
OF_TORQUE = Required(5e-4, "set by hand: straight lines between 64 rings in the share of slip")
OF_RAYS = Required(2e-4, "set by hand: what points on rays and between radii leave")


def radial_stress(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return Case(
        name="radial_stress",
        title="Stress below shear on rings and angles",
        problem=f"The paper's ball of steel pushed to {PART:g} of µW: all components below the "
        "edge and the tension on it; the ball twisted: what a plane below carries of the torque; "
        "a ball that slides on coatings: the tension on the trailing edge; by the radial solver, "
        "from its tractions or, sliding, from exact ones.",
        runs=(),
        quantities=(),
        checks=(
            *(
                _check(
                    f"below_{depth:g}",
                    f"largest error of all components {depth:g} a below the surface, over p₀",
                    partial(_error_below, depth), OF_STRESS, SUPERPOSED, "p₀",
                )
                for depth in DEEP
            ),
            _check(
                "trailing_edge", "error of σ₁ on the trailing edge relative to itself",
                _error_of_tension, OF_EDGE, SUPERPOSED, "1",
            ),
            _check(
                "torque", f"error of the torque carried {CARRIED:g} a below, relative to itself",
                _error_of_torque, OF_TORQUE, "equilibrium", "1", ReferenceKind.IDENTITY,
            ),
            *(
                Check(
                    f"coated_{ratio:g}_{thickness:g}", "σ₁ on the trailing edge over Hertz's p₀",
                    "", "the radial solver", partial(_tension_on_coat, ratio, thickness),
                    Reference(
                        value, ReferenceKind.SEMI_CLOSED, "rays over the pressure of "
                        "`paraboloid_under`, and the layer by its Hankel transforms", 1e-6,
                    ),
                    OF_RAYS, value, "its value",
                )
                for (ratio, thickness), value in COATED.items()
            ),
        ),
        limits=(
            "Cattaneo and Mindlin neglect slip across the load, which the solver has: of steel at "
            "most a thousandth of the shift.",
            "What a pushed coating has below has no closed form: `slipstick stress` of "
            "coated_fretting.toml by three solvers gives 1.171, 1.169 and 1.172 GPa.",
        ),
    )  # fmt: skip


def _check(
    name: str, meaning: str, error: Callable[[], float], required: Required, source: str, unit: str,
    kind: ReferenceKind = ReferenceKind.CLOSED_FORM,
) -> Check:  # fmt: skip
    reference = Reference(0.0, kind, source, 0.0)
    return Check(name, meaning, "", "the radial solver", error, reference, required, 1.0, unit)


@cache
def _pushed() -> RadialBody:
    step = paper.tangential_step(PART, INCREMENTS)
    scene = paper.frictional("Ball pushed", paper.paraboloid(STEEL), STEEL, step)
    return RadialBody.of(state_of_result(radial.solve(scene), None), indenter=False)


def _points(body: RadialBody, depth: float, x: Field, y: Field) -> StressPoints:
    """At a depth and places in contact radii."""
    return body.points((Depth(depth * A, 0),), A * x, A * y)


def _error_below(depth: float) -> float:
    """Along and beside the load."""
    x, y = (part.ravel() for part in np.meshgrid(np.linspace(-1.5, 1.5, 31), (0.0, 0.4, 0.8)))
    stuck = paper.partial_slip(STEEL, PART * paper.FRICTION_LIMIT).stick_radius / A
    most = FRICTION * P0
    exact = hamilton_stress(x, y, depth, 1.0, P0, most, NU)
    exact -= hamilton_stress(x, y, depth, stuck, 0.0, stuck * most, NU)
    return float(np.max(np.abs(_points(_pushed(), depth, x, y).stress[:, 0] - exact))) / P0


def _error_of_tension() -> float:
    stuck = paper.partial_slip(STEEL, PART * paper.FRICTION_LIMIT).stick_radius / A
    most, edge = FRICTION * P0, np.array([-1.0])
    exact = stress_by_hertz_pressure(edge, 1.0, P0, NU) + stress_by_hertz_shear(edge, 1.0, most, NU)
    exact -= stress_by_hertz_shear(edge, stuck, stuck * most, NU)
    body = _pushed()
    place = np.array([body.centre - body.parts.radius]) / A
    found = _points(body, 0.0, place, 0 * place).principal[0]
    return abs(float(found[0, 0] / exact[0]) - 1)


def _error_of_torque() -> float:
    """∫ σ_θz 2πr² dr over the plane, r/(1 + r) from 0 to 1."""
    result = radial.solve(TWISTED.scene)
    end = result.steps[-1]
    body = RadialBody.of(state_of_result(result, None), indenter=False)
    nodes, weights = np.polynomial.legendre.leggauss(120)
    t = (1 + nodes) / 2
    r, area = t / (1 - t), weights / 2 / (1 - t) ** 2
    stress = body.points((Depth(CARRIED * A, 0),), A * r, 0 * r).stress[3, 0]
    assert end.torque is not None
    return abs(-float(2 * np.pi * A**3 * (stress * r * r) @ area) / end.torque - 1)


def _tension_on_coat(ratio: float, thickness: float) -> float:
    """Under the paper's force, over p₀."""
    body = coated(film(ratio, thickness))
    scene = pressed("Sliding", rigid_ball(), body)
    end = radial.solve(scene).steps[-1]
    nothing = np.zeros_like(end.radii)
    still = round_circle(end.radii, end.contact_radius, nothing, nothing, end.pressure)
    p = np.broadcast_to(still.smooth[2], (still.smooth.shape[1], 4))
    sliding = LoadedCircle(still.radius, 0.0, np.stack([FRICTION * p, 0 * p, p]))
    below = BelowCircle(sliding, stack_of(body), REACH, 1)
    stress = below.at((Depth(0.0, 0),), np.array([-still.radius]), np.zeros(1))[0, 3:]
    return float(principal_stresses(stress)[0, 0]) / P0
