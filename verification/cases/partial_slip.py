"""Verification cases of a growing tangential force: partial slip and gross slip.

A ball is solved on cells.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from contact_scene import (
    IsotropicMaterial,
    LoadStep,
)
from verification.judging.case import Case, Level
from verification.judging.declared_case import (
    ENERGY,
    SHEAR,
    SHIFT,
    SQUARE_ROOTS,
    STICK_BORDER,
    STICK_RADIUS,
    WORK,
    Falls,
    Observable,
    Refined,
    Row,
    Within,
    case,
    error_norm,
    judged,
    named,
    on_cells,
    part_of_side,
    refinement,
)
from verification.judging.drawings import Drawn, convergence, profile
from verification.problems.cattaneo_mindlin import (
    OVER_SLIDING_SHIFT,
    sheared,
)
from verification.problems.problem import (
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NU_ZERO,
    OFFSETS,
    STEEL,
    UNLIKE,
    Problem,
    ReferenceKind,
    frictional,
    paraboloid,
    partial_slip,
)
from verification.quantities import force_along_x, shear_of

PARTS = (0.3, 0.6, 0.9, 0.99)  # of µW, one loading step each
STOPS = dict(enumerate(PARTS, 1))  # by step
LOOPED = 3  # the step to 0.9 µW, the amplitude of the fretting loop
CATTANEO = sheared("Cattaneo-Mindlin, ν = 0", PARTS)
SHEARS = {part: SHEAR.at(step, part, "µW") for step, part in STOPS.items()}


def _slip_error(result: Any, step: int, problem: Problem) -> float:
    end = result.steps[step]
    exact = problem.on_surface(problem.ends[step].slip, *result.grid.coordinates())
    missed = np.hypot(end.slip[0] - exact, end.slip[1])
    return float(np.mean(missed[end.in_contact]))


SLIP = error_norm(
    "slip",
    "mean difference of the slip in the contact{when}",
    _slip_error,
    unit="m",
    over=OVER_SLIDING_SHIFT,
)


def _stop_rows(step: int, part: float) -> tuple[Row, ...]:
    """Return the rows (quantities with tolerances) that are judged for the ball after one
    tangential load step.

    The quantities are shear, stick radius, shift and slip.

    step  index of the load step
    part  tangential force over the friction limit µW
    """
    return (
        Within(
            SHEARS[part],
            2e-3,
            "required of the fretting loop at 128 x 128, which includes this state",
        ),
        Refined(STICK_RADIUS.at(step, part, "µW"), 1.0, part_of_side(0.2), STICK_BORDER),
        Within(
            SHIFT.at(step, part, "µW"),
            3e-5,
            "four times the error of 128 cells; 1e-4 is required of the fretting loop",
        ),
        Refined(
            SLIP.at(step, part, "µW"),
            1.5,
            1e-4,
            "order 3/2 of the shear's L1 error; the cap is the accuracy target of the shift, "
            "which includes the slip",
        ),
    )


def cattaneo_mindlin(level: Level = Level.QUICK, cells: Sequence[int] = ()) -> Case:
    """Create the verification case of a ball under constant normal and growing tangential force, on
    cells.

    For ν = 0 the solution of Cattaneo and Mindlin is exact. Judged are shear, slip, stick radius,
    shift and dissipated energy, and the orders of convergence. At the quick level the order of the
    shear is computed from coarse grids that are shifted relative to the contact.

    level  amount of computation: quick, standard or full
    cells  numbers of cells per side; default: those of the level, with shifted grids
    """
    most = 128 * 2**level
    grids = on_cells(CATTANEO, cells or refinement(32, most))
    quick = level is Level.QUICK and not cells
    at_once = sheared("Cattaneo-Mindlin at once, ν = 0", (STOPS[LOOPED],))
    followed = (
        on_cells(at_once, refinement(32, most), offsets=UNLIKE, of="at once") if quick else grids
    )
    edges = f"{SQUARE_ROOTS}: an error of O(√h) on rings one cell wide leaves O(h^3/2) in L1"
    order = Falls(SHEAR.at(1 if quick else LOOPED, STOPS[LOOPED], "µW"), 1.5, edges)
    energy = Within(
        ENERGY.at(LOOPED, STOPS[LOOPED], "µW"),
        1e-4,
        "four times the error of 128 cells; 5e-4 is required of the fretting loop's cycle",
    )
    stopped = "0.3, 0.6, 0.9 and 0.99 µW"
    means = (
        Falls(
            SHIFT.over_stops(stopped),
            2.5,
            "the shift is the difference of two approaches, of the contact and of the stick zone "
            "(Cattaneo), with the same error of 0.04 h²/R; the remaining error depends on the "
            "division of cells by circles, O(h^5/2)",
        ),
    )
    shifted = [] if quick or cells else [on_cells(CATTANEO, refinement(32, 256), offsets=OFFSETS)]
    return case(
        "cattaneo_mindlin",
        "Cattaneo-Mindlin partial slip",
        "The paper's contact with ν = 0 and the same E*, under 1 kN and tangential forces of "
        "0.3, 0.6, 0.9 and 0.99 of µW. The slip of the closed form opposes its traction "
        "everywhere only for ν = 0, so that it is the exact solution of Coulomb's vector law "
        "only there.",
        judged(grids, (*(row for stop in STOPS.items() for row in _stop_rows(*stop)), energy)),
        judged(followed, (order,)),
        *(judged(one, means) for one in shifted),
        charts=(
            profile(
                grids,
                "cattaneo_profiles",
                "Shear next to y = 0",
                f"Computed shear on {grids.judged.label} cells at four tangential forces, "
                "the closed form, and their difference, which is largest at the stick edge and "
                "at the contact edge.",
                "qₓ / µp₀",
                FRICTION * HERTZ.peak_pressure,
                *shears_along_x(STOPS),
            ),
            convergence(
                grids,
                (replace(order, what=SHEARS[STOPS[LOOPED]]),),
                "cattaneo_convergence",
                "Convergence of the shear",
                "Σ|q - q_exact| / Σµp against cell side for four tangential forces, with a line of "
                "the expected slope 3/2.",
                also=[shear for part, shear in SHEARS.items() if part != STOPS[LOOPED]],
            ),
            *(
                convergence(
                    one,
                    means,
                    "cattaneo_convergence_of_means",
                    "Convergence of shift and dissipated energy",
                    "Errors at all four tangential forces, root mean square over grids in "
                    "several positions; single errors change sign.",
                    also=(WORK.over_stops(stopped),),
                )
                for one in shifted
            ),
        ),
        shows=("(2)", "(4)", "(11)", "known solutions"),
    )


def shears_along_x(stops: dict[int, float]) -> list[Drawn]:
    """Describe the chart curves of the computed and the exact shear q_x at the ends of load steps.

    stops  tangential force over µW, by index of the load step
    """
    return [
        Drawn(lambda end: shear_of(end)[0], lambda exact: exact.shear, f"{part:g} µW", step)
        for step, part in stops.items()
    ]


def near_sliding(level: Level = Level.QUICK) -> Case:
    """Create the verification case of tangential forces just below the friction limit, and of gross
    slip.

    For ν = 0 the shift is compared with the closed form. In gross slip under a prescribed shift the
    tangential force must equal the friction limit µW.
    """
    cells = 64 if level is Level.QUICK else 128
    materials = {"ν = 0": NU_ZERO, "ν = 0.3": STEEL}
    of_step = (
        Within(
            SHIFT,
            4e-4,
            "the stick zone is a few cells wide or less: its force and with it the shift is "
            "known to a fraction of that of a cell; four times the error of the narrowest stick "
            "zone",
        ),
    )
    of_sliding = (
        Within(
            Observable(
                "sliding_force",
                "tangential force while sliding",
                "N",
                lambda result, step, _: force_along_x(result.steps[step]),
                lambda limit: float(limit),
                scalar=("tangential_force", 0),
            ),
            1e-7,
            "ten times the solver's tolerance, for sums over all cells",
        ),
    )
    return case(
        "near_sliding",
        "Gross slip and the approach to it",
        "The paper's contact is loaded in a single step to 0.99, 0.999 and 0.9999 of µW, with ν "
        "= 0 and ν = 0.3, and moved to five times the shift at gross slip. Judged are the "
        "convergence of every solve and the force µW at gross slip, where each particle slips "
        "along x for any ν.",
        *(
            judged(
                named(
                    f"{name}, {part:g} µW",
                    on_cells(
                        sheared(f"One step to {part:g} µW, {name}", (part,), material), (cells,)
                    ),
                ),
                of_step if material is NU_ZERO else (),
            )
            for name, material in materials.items()
            for part in (0.99, 0.999, 0.9999)
        ),
        *(
            judged(
                named(f"{name}, sliding", on_cells(_sliding_problem(material), (cells,))),
                of_sliding,
            )
            for name, material in materials.items()
        ),
        limits=("Under force control at µW the shift is undefined; there is no such case.",),
        no_order="the stick zone is a few cells wide or less: its radius scatters with the grid",
        shows=("stick zone up to µW", "hard contacts"),
    )


def _sliding_problem(material: IsotropicMaterial) -> Problem:
    """Create the problem of a ball with prescribed tangential shifts up to 5 times that of gross
    slip.

    The exact answer is the tangential force µW.

    material  material of both bodies
    """
    beyond, at_sliding = 5.0, partial_slip(material, 0.0).sliding_shift
    scene = frictional(
        f"Dragged to {beyond:g} sliding shifts, ν = {material.poisson_ratio:g}",
        paraboloid(material),
        material,
        LoadStep(tangential_shift=(0.8 * at_sliding, 0.0), increments=2),
        LoadStep(tangential_shift=(beyond * at_sliding, 0.0), increments=6),
    )
    return Problem(
        scene,
        (FRICTION_LIMIT,),
        HERTZ.contact_radius,
        "at gross slip along x the shear is µp everywhere: T = µW",
        ReferenceKind.IDENTITY,
        uncertainty=0.0,
        equations=(r"T = \int \mu p \, dA = \mu W",),
    )
