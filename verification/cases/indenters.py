"""Verification cases of cones, flat punches, and indenters under a moment.

The pressure is infinite below the apex of the cone and at the rim of the punch. Moments tilt the
indenter or let it roll.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_scene import Body, FlatPunch, LoadStep
from verification.closed_forms.flat_punch import TiltedPunch
from verification.judging.case import (
    Case,
    Level,
    NotYetAsymptotic,
    Quantity,
    Required,
    compare_runs,
)
from verification.judging.declared_case import (
    APPROACH,
    CENTRAL_PRESSURE,
    CONTACT_RADIUS,
    PRESSURE_L1,
    Falls,
    Observable,
    Refined,
    Within,
    case,
    error_norm,
    judged,
)
from verification.judging.drawings import convergence, profile
from verification.judging.refinement_levels import (
    EDGE,
    IDENTITY,
    STAIRCASE,
    levels,
    on_cells,
    on_elements,
    part_of_side,
    refinement,
    scaled_tolerance,
    with_edge_at,
)
from verification.judging.run import Run
from verification.problems import paper_scene as paper
from verification.problems.classical import CONE, PUNCH, PUNCH_RADIUS, PUNCH_WINDOW, mean_pressure
from verification.problems.paper_scene import (
    HERTZ,
    NORMAL_FORCE,
    STEEL,
    SUBSTRATE,
    UNLIKE,
    pressed,
    rigid_ball,
)
from verification.problems.problem import ROUNDING, Problem, Reference, ReferenceKind

if TYPE_CHECKING:
    from semi_analytical import Result


def cone_contact(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cone on a half-space, whose pressure is infinite at the
    apex.

    Approach, contact radius and pressure on cells are compared with the closed form.

    level  amount of computation: quick, standard or full
    """
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    grids = on_cells(CONE, cells)
    rows = (
        Refined(
            APPROACH, 2.0, 1e-4,
            "order 2: the apex lies between cells and shifts the load of a few of them; the cap "
            "is twice the target of the ball",
        ),
        Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
    )  # fmt: skip
    order = Falls(
        PRESSURE_L1, 1.5,
        "at the edge O(√h) on a ring one cell wide; the logarithm at the apex is O(1) in a few "
        "cells, O(h²)",
    )  # fmt: skip
    return case(
        "cone_contact",
        "Cone on a half-space",
        "A cone with flanks of 1° under 1 kN. The pressure is infinite below the apex, as a "
        "logarithm, and falls to zero at the edge.",
        judged(grids, rows),
        judged(on_cells(CONE, cells, offsets=UNLIKE), (order,)),
        charts=(
            profile(
                grids, "cone_profile", "Pressure next to y = 0",
                "Computed pressure, exact pressure, and their difference, in units of the mean "
                "pressure.",
                "p / mean p", mean_pressure(CONE),
            ),
        ),
        limits=("The pressure of the cells at the apex is an average of an infinite peak.",),
    )  # fmt: skip


def flat_punch(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a flat punch on a half-space, whose pressure is infinite at
    the rim.

    Approach and central pressure on cells are compared with the closed form.

    level  amount of computation: quick, standard or full
    """
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    grids = on_cells(PUNCH, cells, PUNCH_WINDOW)
    rows = (
        Within(APPROACH, part_of_side(0.5), f"half a cell over the radius: {STAIRCASE}"),
        Within(
            CENTRAL_PRESSURE, part_of_side(1.0),
            f"one cell over the radius: pressure goes as 1/radius², and {STAIRCASE}",
        ),
    )  # fmt: skip
    return case(
        "flat_punch",
        "Flat punch on a half-space",
        "A flat-ended cylinder of 0.4 mm radius under 1 kN. Force and approach are proportional; "
        "the pressure is singular at the rim, as 1/√(distance).",
        judged(grids, rows),
        charts=(
            convergence(
                grids, (Falls(APPROACH, 1.0, STAIRCASE),), "flat_punch_convergence",
                "Convergence of the flat punch",
                "Relative errors against cell side, with a line of slope one.",
                also=(CENTRAL_PRESSURE,),
            ),
        ),
        no_order="first order in the cell side with scatter: the division of cells by the circle "
        "differs from grid to grid",
    )  # fmt: skip


# Oblique to the grid, and a little less than the third of the radius at which the punch lifts off.
ECCENTRICITY = (0.18 * PUNCH_RADIUS, 0.24 * PUNCH_RADIUS)
TILTED = TiltedPunch(PUNCH_RADIUS, paper.CONTACT_MODULUS, NORMAL_FORCE, ECCENTRICITY)


def _vector_component(name: str, axis: int, result: Any, *_: Any) -> float:
    """Return one component of a vector quantity at the end of the last load step.

    The result is NaN if the increment does not have the quantity.

    name    name of the quantity, such as "tilt"
    axis    index of the component
    result  result of a solver
    """
    vector = getattr(result.steps[-1], name)
    return float("nan") if vector is None else float(vector[axis])


def _exact_slope(axis: int, exact: Any) -> float:
    return float(exact.tilt[axis])


def _inner_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the largest relative pressure error of a flat punch within half its radius [1].

    The pressure is infinite at the rim, where cells have no useful value.

    result   result on cells
    step     index of the load step
    problem  problem with the exact pressure
    """
    x, y = result.grid.coordinates()
    inside = np.hypot(x, y) < 0.5 * PUNCH_RADIUS
    exact = problem.ends[step].pressure(x[inside], y[inside])
    return float(np.max(np.abs(result.steps[step].pressure[inside] / exact - 1)))


def _stiffness_difference(one: Any, other: Any) -> float:
    """Compute the largest relative difference of the stiffnesses of two flat punches [1].

    The stiffnesses are normal force over approach and moments over tilts, at the end of the last
    step.
    """

    def of(result: Any) -> np.ndarray:
        end = result.steps[-1]
        return np.array([end.normal_force / end.approach, *(end.moment / end.tilt)])

    return float(np.max(np.abs(of(one) / of(other) - 1)))


def tilted_punch(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a flat punch that is tilted by an eccentric normal force, on
    cells.

    Tilt, approach and pressure are compared with the closed form. Prescribed moment and prescribed
    tilt must give equal stiffnesses.

    level  amount of computation: quick, standard or full
    """
    punch = FlatPunch(radius=PUNCH_RADIUS, material=STEEL)
    forced, tilted = (
        paper.frictionless(title, punch, STEEL, step)
        for title, step in {
            "Flat punch pressed beside its axis": LoadStep(
                normal_force=NORMAL_FORCE,
                moment=(NORMAL_FORCE * ECCENTRICITY[1], NORMAL_FORCE * ECCENTRICITY[0]),
            ),
            "Flat punch tilted as it is pressed": LoadStep(
                approach=TILTED.approach, tilt=(TILTED.tilt[1], TILTED.tilt[0])
            ),
        }.items()
    )
    problem = Problem(
        forced,
        (TILTED,),
        PUNCH_RADIUS,
        "Galin's theorem; tilting stiffness (4/3) E* a³",
        equations=(
            r"W = 2 E^* a \delta,\quad M = \tfrac{4}{3} E^* a^3 \varphi,\quad "
            r"p = \frac{W}{2 \pi a^2} \frac{1 + 3 \mathbf{e} \cdot \mathbf{r} / a^2}"
            r"{\sqrt{1 - r^2/a^2}}",
        ),
    )
    rows = (
        *(
            Within(
                # The slope along an axis is a rotation about the other one.
                Observable(
                    f"tilt_{axis}", f"slope along {axis}", "rad",
                    partial(_vector_component, "tilt", 1 - along), partial(_exact_slope, along),
                    scalar=("tilt", 1 - along),
                ),
                part_of_side(1.5),
                "one and a half cells over the radius, because the tilt depends on its third "
                f"power: {STAIRCASE}",
            )
            for along, axis in enumerate("xy")
        ),
        Within(APPROACH, part_of_side(0.5), f"half a cell over the radius: {STAIRCASE}"),
        Within(
            error_norm(
                "inner_pressure", "largest |p - p_exact| / p_exact within half the radius",
                _inner_error, "p_exact",
            ),
            part_of_side(1.5), "as the tilt",
        ),
    )  # fmt: skip
    grids = on_cells(problem, refinement(32, 128 if level is Level.QUICK else 256), PUNCH_WINDOW)
    finest = grids.judged.run
    assert isinstance(finest, Run)
    return case(
        "tilted_punch",
        "Flat punch with an eccentric force",
        "A flat punch of 0.4 mm radius with its force of 1 kN 0.3 radii from the axis in a "
        "direction oblique to the grid. For eccentricities up to a third of the radius the whole "
        "face is in contact, and the solution for a plane of displacements has a closed form.",
        judged(grids, rows),
        runs=(Run("given tilt", tilted, finest.grid),),
        quantities=(
            compare_runs(
                "both_controls", "prescribed moment against prescribed tilt, by the stiffnesses: "
                "load over approach and moment over tilt", (finest.label, "given tilt"),
                _stiffness_difference, 1e-6,
                "the whole face is in contact: the response is linear to the "
                "tolerance of the solver", "linearity of a contact that does not change",
            ),
        ),
        no_order="first order in the cell side with scatter, as in flat_punch",
    )  # fmt: skip


MOVED = (8, 5)  # cells between the tip and the force, along x and y
ROLLED = "an identity of the discrete equations: the error is the tolerance of the solver"


def _shifted_field_difference(beside: Result, centred: Result) -> float:
    """Compute the largest traction difference between an eccentrically and a centrally loaded ball
    [1].

    The ball rolls until the contact lies below the force. Its tractions must be those of the
    central contact, shifted by whole cells. Differences are over the peak pressure, and µ times it
    for the shear.

    beside   result of the ball with the eccentric force
    centred  result of the ball with the central force
    """
    one, other = beside.steps[-1], centred.steps[-1]
    pressure = np.roll(other.pressure, MOVED, axis=(0, 1))
    worst = np.max(np.abs(one.pressure - pressure)) / other.peak_pressure
    if one.shear is None or other.shear is None:
        return float(worst)
    shear = np.roll(other.shear, MOVED, axis=(1, 2))
    limit = paper.FRICTION * other.peak_pressure
    return float(np.maximum(worst, np.max(np.abs(one.shear - shear)) / limit))


def eccentric_ball(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a ball under an eccentric normal force, on cells.

    The ball rolls until the contact lies below the force. Motion and tractions must be those of a
    central contact that is shifted by whole cells.

    level  amount of computation: quick, standard or full
    """
    cells, increments = 64 if level is Level.QUICK else 128, 5
    source = "x²/2R - φx = (x - Rφ)²/2R - Rφ²/2: a tilted paraboloid is a shifted paraboloid"
    grid = paper.square_grid(cells, 2 * HERTZ.contact_radius)
    e = tuple(number * side for number, side in zip(MOVED, grid.spacing, strict=True))
    roll = tuple(length / paper.RADIUS for length in e)
    drop = 0.5 * paper.RADIUS * (roll[0] ** 2 + roll[1] ** 2)
    forced = LoadStep(
        normal_force=NORMAL_FORCE,
        moment=(NORMAL_FORCE * e[1], NORMAL_FORCE * e[0]),
        increments=increments,
    )
    tilted = LoadStep(normal_force=NORMAL_FORCE, tilt=(roll[1], roll[0]), increments=1)
    steel = (paper.paraboloid(STEEL), Body(material=STEEL))
    unlike = (rigid_ball(), Body(material=SUBSTRATE))
    runs = tuple(
        Run(label, pressed(title, *bodies, step, friction=paper.FRICTION), grid)
        for label, title, bodies, step in (
            ("centred", "Ball pressed at its tip", steel, paper.pressing(increments)),
            ("beside", "Ball pressed beside its tip", steel, forced),
            ("given tilt", "Tilted ball", steel, tilted),
            ("centred, unlike bodies", "Rigid ball", unlike, paper.pressing(increments)),
            ("beside, unlike bodies", "Rigid ball beside its tip", unlike, forced),
        )
    )

    def rolled(
        name: str, meaning: str, unit: str, run: str, scalar: tuple[str, int], value: float
    ) -> Quantity:
        reference = Reference(value, ReferenceKind.IDENTITY, source, ROUNDING * abs(value))
        return Quantity(
            name, meaning, unit, run, partial(_vector_component, *scalar), reference,
            Required(1e-6, ROLLED), scalar=(*scalar, -1),
        )  # fmt: skip

    return case(
        "eccentric_ball",
        "Ball with an eccentric force",
        "The paper's ball with its force of 1 kN a whole number of cells from the tip. The ball "
        "rolls until the contact is below the force. The contact then equals the centred "
        "contact, shifted by whole cells, so that the fields agree to the tolerance of the "
        "solver, also for coupled pressure and shear.",
        runs=runs,
        quantities=(
            *(
                rolled(
                    f"tilt_{axis}", f"slope along {axis}", "rad", "beside",
                    ("tilt", 1 - along), roll[along],
                )
                for along, axis in enumerate("xy")
            ),
            rolled(
                "moment_of_given_tilt", "moment M_y at the prescribed tilt", "N m",
                "given tilt", ("moment", 1), NORMAL_FORCE * e[0],
            ),
            *(
                compare_runs(
                    f"fields{suffix}", "largest difference of pressure and shear, shifted, over "
                    "the largest pressure and the largest friction limit",
                    (f"beside{suffix}", f"centred{suffix}"), _shifted_field_difference, 1e-5,
                    ROLLED, source,
                )
                for suffix in ("", ", unlike bodies")
            ),
            compare_runs(
                "approach", "approach at the origin plus the rise of the tip by rolling, against "
                "the approach of the centred ball", ("beside", "centred"),
                lambda beside, centred: abs(
                    (beside.steps[-1].approach + drop) / centred.steps[-1].approach - 1
                ),
                1e-6, ROLLED, source,
            ),
        ),
        equations=(
            r"\frac{x^2}{2R} - \varphi x = \frac{(x - R\varphi)^2}{2R} - \frac{R\varphi^2}{2}",
        ),
        no_order=IDENTITY,
    )  # fmt: skip


def _mid_pressure_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the largest relative pressure error of finite elements between apex and edge of a
    cone [1].

    The rings lie between 0.2 and 0.8 of the contact radius, because the pressure is infinite at the
    apex and falls to zero at the edge.

    result   finite element result
    step     index of the load step
    problem  problem with the exact pressure
    """
    end = result.steps[step]
    part = end.radii / problem.radius
    away = (part > 0.2) & (part < 0.8)
    exact = problem.ends[step].pressure(end.radii[away])
    return float(abs(end.pressure[away] / exact - 1).max())


def fem_classical(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cone and a flat punch by finite elements.

    Approach, contact radius and pressure are compared with closed forms. The order of convergence
    of the central pressure of the punch is judged above the quick level.

    level  amount of computation: quick, standard or full
    """
    why = "set by hand at 64 elements per radius, on other meshes scaled by the order"
    rim = "the error of hat functions at the infinite pressure of the rim has an energy of O(h)"
    cones = with_edge_at(CONE, levels(level), of="cone")
    punches = on_elements(PUNCH, levels(level), of="punch")
    between = error_norm(
        "pressure_of_cone",
        "largest error of the pressure over its exact value, from 0.2 to 0.8 of the radius",
        _mid_pressure_error,
        "the exact one",
    )
    of_cone = (
        Within(APPROACH, scaled_tolerance(1e-4, 2), why, name="approach_of_cone"),
        Within(CONTACT_RADIUS, part_of_side(0.05), "1/20 of an element", name="radius_of_cone"),
        Within(between, scaled_tolerance(5e-4, 2), why),
    )
    of_punch = (
        Within(APPROACH, scaled_tolerance(5e-4, 1), f"{why}; {rim}", name="approach_of_punch"),
        Within(
            CENTRAL_PRESSURE,
            scaled_tolerance(1e-3, 1),
            f"{why}; {rim}",
            name="central_pressure_of_punch",
        ),
        Falls(APPROACH, 1.0, rim),
    )
    # On meshes coarser than 22 elements per radius the second term makes 0.8 of that order.
    fine = replace(punches, followed=tuple(rung for rung in punches.rungs if rung.count >= 22))
    of_fine = Falls(
        CENTRAL_PRESSURE, 1.0, rim,
        NotYetAsymptotic(
            0.15,
            "the error is A h - B h² with B = 3.5 A / a: neighbouring meshes from 22 elements "
            "per radius on have the orders 0.86, 0.90, 0.93",
        ),
    )  # fmt: skip
    caption = "Relative errors against the side of an element over the contact radius."
    return case(
        "fem_classical",
        "Finite elements: cone and flat punch",
        "The scenes of cone_contact and flat_punch by finite elements. Below the punch the "
        "outermost hat function of the pressure is half a hat that ends at the rim.",
        judged(cones, of_cone),
        judged(punches, of_punch),
        judged(fine, () if level is Level.QUICK else (of_fine,)),
        charts=(
            convergence(
                punches, (*of_punch, of_fine), "fem_classical_convergence",
                "Convergence of the punch", caption,
            ),
            convergence(
                cones, (), "fem_classical_cone", "Convergence of the cone", caption,
                also=(APPROACH,),
            ),
        ),
    )  # fmt: skip
