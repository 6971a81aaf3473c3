"""Verification cases of indentation with friction: a rigid ball that is pressed on an elastic body.

The surface moves towards the axis below the ball; friction resists, so that the contact sticks in a
central disc and slips outside. All solvers are judged, also under refinement of cells and
increments.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from math import log
from typing import Any

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    FlatPunch,
    IsotropicMaterial,
    LoadStep,
)
from contact_scene.discretisation import EdgeCorrection
from verification.judging import field_errors
from verification.judging.case import (
    AnyRun,
    Case,
    Level,
    Order,
    Run,
)
from verification.judging.declared_case import (
    APPROACH,
    CONTACT_RADIUS,
    ELEMENT_RADIUS,
    JUDGED_BY,
    PENALTY,
    STICK_RADIUS,
    Drawing,
    Judged,
    Observable,
    RefinementLevels,
    Within,
    because,
    case,
    cells_label,
    compared,
    error_norm,
    finest,
    judged,
    named,
    on_cells,
    on_elements,
    on_radii,
    on_springs,
    part_of_side,
    scaled_tolerance,
)
from verification.judging.drawings import Drawn, profile
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.indentation import (
    COATED,
    FEW,
    MANY,
    NO_POISSON_BALL,
    OVER_HERTZ_RADIUS,
    STRONG,
    WEAK,
    Indentation,
)
from verification.problems.problem import (
    CONTACT_MODULUS,
    HERTZ,
    NORMAL_FORCE,
    ROUNDING,
    WINDOW_PER_RADIUS,
    Problem,
    ReferenceKind,
    half_space,
    pressed,
    pressing,
    rigid_ball,
    square_grid,
)
from verification.quantities import relative_difference, shear_of

PRESSURE = error_norm(
    "pressure",
    "largest error of the pressure from {between} of the radius, over p_H",
    field_errors.tabulated_pressure_error,
    "p_H, the peak pressure without friction",
)
SHEAR = error_norm(
    "shear",
    "largest error of the shear from {between} of the radius, {but}over µp_H",
    field_errors.radial_shear_error,
    OVER_LIMIT,
)
SHEAR_AT_EDGE = error_norm(
    "shear_at_stick_edge",
    "the same within two cells of the stick edge",
    field_errors.stick_edge_error,
    OVER_LIMIT,
)


STICK_PART = Observable(
    "stick_radius",
    "stick radius over contact radius",
    "",
    lambda result, *_: result.steps[-1].stick_radius / result.steps[-1].contact_radius,
    lambda exact: float(exact.stick_part),
)


def _shear_profile(
    of: RefinementLevels, one: Indentation, name: str, by: str, drawn: Drawn
) -> Drawing:
    """Return a function that draws the computed and the tabulated shear of an indentation over the
    radius.

    of     refinement levels of the indentation, of which the judged level is drawn
    one    contact with the tabulated reference
    name   beginning of the file name of the chart
    by     name of the discretisation in the caption
    drawn  computed and exact shear
    """
    count = of.problem.scene.loading[0].increments
    return profile(
        of,
        f"{name}_{one.file_name}",
        f"Shear over the radius, {one.name}",
        f"Shear by {by} after {count} increments, the reference, and their difference. The shear "
        "depends on the whole load history.",
        f"{drawn.label} / µp_H",
        of.problem.scale(OVER_LIMIT),
        drawn,
    )


MAGNITUDE = Drawn(
    lambda end: np.hypot(*shear_of(end)), lambda exact: lambda r: np.abs(exact.shear(r)), "|q|"
)
OUTWARD = Drawn(lambda end: end.shear_radial, lambda exact: exact.shear, "q")


def frictional_indentation(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a rigid ball that is pressed with friction on an elastic
    body.

    Pressure and shear are coupled. Approach, contact radius, pressure and shear on cells are
    compared with tabulated solutions of integral equations. The quick level has a coarse grid; the
    other levels judge the stick radius in addition.
    """
    why = "accuracy target of the coupled solver on 256 x 256 cells"
    cells, contacts = 256, [WEAK, STRONG, NO_POISSON_BALL, COATED]
    if level is Level.QUICK:
        cells, contacts = 96, [WEAK, STRONG, COATED]
    rows = (
        Within(APPROACH, 2e-4, why),
        Within(CONTACT_RADIUS, 3e-3, why),
        Within(PRESSURE, 5e-3, why),
        Within(SHEAR, 1e-2, why),
        Within(SHEAR_AT_EDGE, 3e-2, why),
    )
    stuck = Within(STICK_PART, 1e-2, why)
    grids = {
        one: named(
            f"{one.name}, {cells_label(cells)}, {one.increments} increments",
            on_cells(one.problem(one.increments), (cells,), of=one.name),
        )
        for one in contacts
    }
    return case(
        "frictional_indentation",
        "Indentation with friction",
        "The paper's ball, rigid, is pressed by 1 kN on bodies of the paper's E* and on its "
        "coated body. The surfaces move towards the axis below the ball. Friction resists this "
        "motion, and the contact slips outside a central stick disc. Pressure and shear are "
        "coupled, and the shear in the stick disc depends on the whole load history. The "
        "references are solutions of integral equations over the radius.",
        *(
            judged(
                grid,
                (*rows, stuck) if level is not Level.QUICK and one in (WEAK, STRONG) else rows,
            )
            for one, grid in grids.items()
        ),
        charts=tuple(
            _shear_profile(grid, one, "frictional_indentation", "cells", MAGNITUDE)
            for one, grid in grids.items()
        ),
        limits=(
            f"{STRONG.name} needs {MANY} increments for an error of the shear within 1e-2. With "
            f"{FEW} increments the motion of the stick edge leaves ripples of up to 2e-2 in the "
            "stick zone.",
            "The stick disc of the coated body is a few cells wide; its radius is not judged.",
        ),
        no_order=JUDGED_BY.format("sheared_increments, in increments"),
        shows=("(9)", "(10)", "(13)", "coated friction", "shear at T = 0"),
    )


def _change(
    runs: Sequence[AnyRun],
    of: str,
    meaning: str,
    difference: Callable[[Any, Any], float],
    name: str = "",
) -> Order:
    """Declare that the difference of two runs falls with the first power of the increment.

    Used where no exact solution is known: the difference falls with the order of the error.

    runs        runs with more and more increments, coarse to fine
    of          quantity whose order is judged
    meaning     description of the difference
    difference  function from the results of a run and the next one to the difference
    name        name of the verdict after `order_of_`; default: the name of the quantity
    """
    return Order(
        f"order_of_{name or of}",
        of,
        meaning,
        tuple(run.label for run in runs),
        difference,
        1.0,
        "the direction of slip and the friction limit change during an increment, which takes both "
        "at its end: the backward Euler rule",
        refined="increments",
        size=_increment_size,
        apart=1,
    )


APPROACH_CHANGE = partial(relative_difference, "approach", -1)
SHIFT_CHANGE = partial(relative_difference, "tangential_shift", -1)


def _shear_change(coarse: Any, fine: Any) -> float:
    """Compute the difference of the final shear on one grid, Σ|q_coarse - q_fine| / Σµp [1]."""
    found, other = shear_of(coarse.steps[-1]), shear_of(fine.steps[-1])
    size = np.hypot(*(found - other))
    return float(size.mean() / (HALF.friction * fine.steps[-1].pressure.mean()))


def _increment_size(result: Any) -> float:
    """Return the number of load steps over the number of increments of a result: the increment size
    h.

    Used as discretisation parameter for the order of convergence in the increments.
    """
    return len(result.steps) / len(result.increments)


# Contact whose stick radius is half the contact radius. Stick edge and contact edge are then far
# from each other and from the axis. Stick radius, contact radius and approach follow from the
# superposition of Spence's punches, with δ R = 1.04015 a² (δ: approach, a: contact radius).
HALF = Indentation(
    {
        "mu": 0.2986,
        "c_over_a": 0.49972,
        "a_over_aH": 0.97037,
        "delta_over_deltaH": 1.04015 * 0.97037**2,
    },
    "ν = 0, µ = 0.2986",
    "half",
    Body(material=IsotropicMaterial(young_modulus=CONTACT_MODULUS, poisson_ratio=0.0)),
    "self-similar (Spence 1975), to five digits",
)


def sheared_increments(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a rigid ball that is pressed and pushed in more and more
    increments.

    Pressure and shear are coupled, and no exact solution is known. Judged is the rate at which
    shift, shear and approach change with smaller increments.
    """
    cells = 48
    counts = {
        Level.QUICK: (4, 8),
        Level.STANDARD: (4, 8, 16, 32, 64, 128),
        Level.FULL: (4, 8, 16, 32, 64, 128, 256),
    }[level]
    part = 0.5  # of µW
    push = (part * HALF.friction * NORMAL_FORCE, 0.0)
    grid = square_grid(cells, WINDOW_PER_RADIUS / 2 * HALF.contact_radius)
    scene = HALF.problem(1).scene
    # Orders of the increments are judged without edge correction, whose changes are up to 1e-6.
    several = level is not Level.QUICK
    edge: EdgeCorrection = "off" if several else "last"
    runs = tuple(
        Run(
            f"{count} increments" + (", edge off" if several else ""),
            scene.model_copy(
                update={
                    "loading": (
                        pressing(count),
                        LoadStep(tangential_force=push, increments=count),
                    )
                }
            ),
            grid,
            edge=edge,
        )
        for count in counts
    )
    orders = (
        _change(runs, "tangential shift", "tangential shift", SHIFT_CHANGE, "shift"),
        _change(runs, "shear", "shear (L1)", _shear_change),
        _change(runs[1:], "approach", "approach", APPROACH_CHANGE),
    )
    return case(
        "sheared_increments",
        "Tangential loading of a coupled contact in smaller increments",
        "A rigid ball is pressed on a body of ν = 0, with friction "
        f"of {HALF.friction:.2f}, and then loaded by a tangential force of {part:g} µW. Shear "
        "and pressure are coupled, and the slip turns from the radial direction to that of the "
        "force. The result depends on the load path and has no known exact solution. Each "
        "doubling of the increments must reduce the change.",
        compared(
            "shift",
            f"change of the shift from {counts[-2]} to {counts[-1]} increments",
            runs[-2],
            runs[-1],
            SHIFT_CHANGE,
            2e-2 * 4 / counts[-2],
            "2 % from 4 to 8 increments, and half of that with each further doubling: first order",
            "the same solver with half the increments",
            ReferenceKind.OWN_REFINEMENT,
            coarse=runs[-2].label,
        ),
        Judged(runs=runs[:-2], orders=orders if several else ()),
        limits=(
            "Contact and stick radius change by fractions of a cell with the number of "
            "increments: no order.",
            "The dissipated energy has no constant order: neighbouring changes give 1.58, 1.61, "
            "2.17, 1.67 and 2.03 on 4 to 256 increments.",
            "Changes of the approach have the order 0.82 on the three coarsest levels and 0.99 "
            "on the finest; the coarsest level is omitted from the order.",
        ),
        equations=(
            r"|\mathbf{q}| \le \mu p,\quad \mu p \, \dot{\mathbf{s}} = "
            r"-|\dot{\mathbf{s}}| \, \mathbf{q}",
        ),
        no_order="" if several else "orders are judged above the quick level",
        shows=("increments", "coated friction"),
    )


NO_SLIP_SOURCE = "Mossakovskii 1963; Spence 1968: (1 - ν) ln(3 - 4ν) / (1 - 2ν)"
NO_SLIP_BALL_SOURCE = "Spence 1968, superposition of bonded flat punches"
NO_SLIP_RATIOS = (0.0, 0.3)  # Poisson's
NO_SLIP_FRICTION = 2.0  # |q|/p in full stick is smaller everywhere; µ|beta| = 1 for ν = 0
# Approach over a²/R, and load over Hertz's at equal contact radius.
NO_SLIP_BALL = {0.0: (1.0887337, 1.1960963), 0.3: (1.0245802, 1.0539106)}


def _factor_error(nu: float, bonded: Any, smooth: Any) -> float:
    factor = (1 - nu) * log(3 - 4 * nu) / (1 - 2 * nu)
    return abs(smooth.steps[-1].approach / bonded.steps[-1].approach / factor - 1)


def _bonded_ball_error(nu: float, few: Any, many: Any) -> float:
    approach_factor, load_factor = NO_SLIP_BALL[nu]
    exact = HERTZ.approach * approach_factor / load_factor ** (2 / 3)
    return abs((2 * many.steps[-1].approach - few.steps[-1].approach) / exact - 1)


def no_slip_indentation(level: Level = Level.QUICK) -> Case:
    """Create the verification case of indentation in full stick by a flat punch and a ball, on
    cells.

    Friction is so large that no cell slips, which makes the contact stiffer. The effect on the
    approach is compared with closed forms. The ball is added above the quick level.
    """
    few, many = 20, 40
    grid = square_grid(96, 1.2 * HERTZ.contact_radius)
    punch = FlatPunch(radius=HERTZ.contact_radius, material=RIGID)

    def run(
        label: str,
        title: str,
        indenter: Any,
        nu: float,
        friction: Any,
        count: int,
        edge: EdgeCorrection = "last",
    ) -> Run:
        scene = pressed(title, indenter, half_space(nu), pressing(count), friction=friction)
        return Run(label, scene, grid, edge=edge)

    # The contact radius is fixed and nothing slips, so that the load path has no effect.
    bonded, smooth = (
        {
            nu: run(f"{kind} punch, ν = {nu:g}", title, punch, nu, friction, 1)
            for nu in NO_SLIP_RATIOS
        }
        for kind, title, friction in (
            ("bonded", "Flat punch that does not slip", NO_SLIP_FRICTION),
            ("smooth", "Flat punch", None),
        )
    )
    balls = {
        nu: [
            run(
                f"ball, ν = {nu:g}, {count} increments, edge off",
                "Rigid ball that does not slip",
                rigid_ball(),
                nu,
                NO_SLIP_FRICTION,
                count,
                "off",
            )
            for count in (few, many)
        ]
        for nu in (() if level is Level.QUICK else NO_SLIP_RATIOS)
    }

    def text(nu: float) -> str:
        return f"{nu:g}".replace(".", "_")

    return case(
        "no_slip_indentation",
        "Indentation without slip",
        "A rigid flat punch and a rigid ball are pressed on homogeneous bodies with so much "
        "friction that no cell slips. Bonding stiffens the contact by a factor due to "
        "Mossakovskii. The coupling is strong: a plain alternating iteration between pressure "
        "and shear hardly converges.",
        *(
            compared(
                f"punch_nu_{text(nu)}",
                f"ν = {nu:g}: load factor of the bonded over the smooth punch, relative error",
                bonded[nu],
                smooth[nu],
                partial(_factor_error, nu),
                1e-3,
                "the singular edge leaves errors of the order of a cell in both stiffnesses",
                NO_SLIP_SOURCE,
                ReferenceKind.CLOSED_FORM,
                ROUNDING,
            )
            for nu in NO_SLIP_RATIOS
        ),
        *(
            compared(
                f"ball_nu_{text(nu)}",
                f"ν = {nu:g}: approach of the ball, extrapolated from "
                f"{few} and {many} increments, relative error",
                pair[0],
                pair[1],
                partial(_bonded_ball_error, nu),
                2e-4,
                "accuracy target of the coupled solver; first order in the increment",
                # Eight digits of both factors.
                NO_SLIP_BALL_SOURCE,
                ReferenceKind.SEMI_CLOSED,
                1e-7,
            )
            for nu, pair in balls.items()
        ),
        equations=(
            r"\frac{W_\mathrm{bonded}}{W_\mathrm{smooth}} = "
            r"\frac{(1 - \nu) \ln(3 - 4\nu)}{1 - 2\nu}",
        ),
        no_order="errors of both stiffnesses cancel in their ratio, and scatter from grid to grid",
        shows=("known solutions", "hard contacts"),
    )


def _mesh_level(one: Indentation, elements: int, increments: int) -> RefinementLevels:
    """Create the finite element run of an indentation with a tabulated solution, as a refinement
    level.

    one         contact with the tabulated solution
    elements    number of elements per contact radius
    increments  number of increments of the normal loading
    """
    meshes = on_elements(one.problem(increments), (elements,), over=0.97, of=one.name)
    return named(f"{one.name}, {increments} increments", meshes)


OF_SPRINGS = (
    Within(APPROACH, 1e-3, PENALTY),
    Within(CONTACT_RADIUS, part_of_side(0.12), "an eighth of an element: the last points ripple"),
    Within(PRESSURE, 5e-3, PENALTY),
    Within(SHEAR, 3e-2, PENALTY),
)


def fem_indentation(level: Level = Level.QUICK) -> Case:
    """Create the verification case of indentation with friction by finite elements with exact
    contact laws.

    Approach, contact radius, pressure and shear of a rigid ball on homogeneous and coated bodies
    are compared with tabulated solutions of integral equations.
    """
    n, many, why = finest(level), 60, "accuracy target of the finite elements"
    meshes = {
        one: _mesh_level(one, n, increments)
        for one, increments in {WEAK: FEW, STRONG: many, COATED: FEW}.items()
    }

    rows = (
        Within(APPROACH, 2e-4, why),
        Within(CONTACT_RADIUS, 2e-3, ELEMENT_RADIUS),
        Within(PRESSURE, scaled_tolerance(2e-3, 1), because(1)),
        Within(SHEAR, 1e-2, why),
    )

    def stuck(one: Indentation) -> Within:
        part = 1 / (n * one.stick_part)
        return Within(STICK_PART, part, "the border may lie anywhere in an element")

    return case(
        "fem_indentation",
        "Finite elements: indentation with friction",
        "The scenes of frictional_indentation by finite elements. The pressure solves a linear "
        "complementarity problem, the radial shear a quadratic program within the friction "
        "limit; the two are iterated until they agree. Contact and stick are exact in the mean "
        "over the hat functions of the tractions. Runs with a penalty at Gauss points have "
        "Coulomb's law by return mapping: a trial shear is computed from the state at the "
        "preceding increment and scaled back to µp where it exceeds the limit.",
        *(judged(mesh, rows) for mesh in meshes.values()),
        *(judged(meshes[one], (stuck(one),)) for one in (WEAK, STRONG)),
        *(
            judged(
                on_springs(
                    _mesh_level(one, finest(level), FEW), f"{one.name}, {FEW} increments, penalty"
                ),
                OF_SPRINGS,
            )
            for one in meshes
        ),
        charts=tuple(
            _shear_profile(
                mesh, one, "fem_indentation", "finite elements, positive outwards,", OUTWARD
            )
            for one, mesh in meshes.items()
        ),
        limits=(
            f"The shear is judged where the increments allow: {FEW} for µ = 0.1, {many} for "
            "µ = 0.3.",
            "The stick disc of the coated body is about one element wide and is not judged.",
            f"With a penalty the shear is that of {FEW} increments, whose error is included: each "
            "position of the stick edge leaves a ripple, of 0.02 µp_H for µ = 0.3.",
        ),
        no_order=JUDGED_BY.format("sheared_increments, in increments"),
        shows=("finite elements", "coated friction", "penalty"),
    )


# Radii where shear is not compared, over the contact radius: at the axis, beside the front.
INNERMOST = 0.05
BESIDE = 0.05


def _mean_shear(result: Any, _: int, problem: Problem) -> float:
    """Compute the mean error of the final radial shear at the radii of a reference table [µp_H].

    p_H is the Hertz peak pressure. Radii near the axis and near the edge of the stick zone are left
    out. The computed shear is divided by √(1 - x²) before the interpolation, because the quotient
    has no root at the edge (x: radius over contact radius).

    result   result of the radial solver
    problem  problem with the tabulated shear
    """
    end, one = result.steps[-1], problem.ends[-1]
    r = end.radii[end.pressure > 0] / end.contact_radius
    smooth = end.shear_radial[: len(r)] / np.sqrt(1 - r**2)
    x = one.radii / one.contact_radius
    compared = (x >= INNERMOST) & (np.abs(x / one.stick_part - 1) > BESIDE)
    off = np.interp(x, r, smooth) * np.sqrt(1 - x**2) - one.shear(one.radii)
    return float(np.mean(np.abs(off[compared]))) / problem.scale(OVER_LIMIT)


def radial_indentation(level: Level = Level.QUICK) -> Case:
    """Create the verification case of indentation with friction by the radial solver.

    Approach, contact radius, stick radius and shear are compared with tabulated solutions of
    integral equations. All levels are equal.
    """
    increments, rings = 64, 512  # twice the increments for contacts that also need twice on cells
    why = "accuracy target of the radial solver at these increments"
    of_contacts = (
        Within(APPROACH, 1e-6, why),
        Within(CONTACT_RADIUS, 1e-6, why),
        Within(replace(STICK_RADIUS, over=OVER_HERTZ_RADIUS), 1e-3, why),
        Within(
            error_norm(
                "mean_shear",
                f"mean error of the shear from {INNERMOST:g} a on, away from the stick edge",
                _mean_shear,
                OVER_LIMIT,
            ),
            1e-4,
            why,
        ),
    )
    return case(
        "radial_indentation",
        "Radial solver: indentation with friction",
        "The paper's ball, rigid, is pressed by 1 kN on half-spaces and on a coating that move "
        f"towards the axis below the ball, in {increments} increments, or twice that number "
        "where nearly all of the contact sticks, by the radial solver. The references are "
        "solutions of integral equations over the radius.",
        *(
            judged(
                on_radii(one.problem(increments * one.increments // FEW), one.name, rings=rings),
                of_contacts,
            )
            for one in (WEAK, STRONG, NO_POISSON_BALL, COATED)
        ),
        no_order="judged at the increments of the case, not on several numbers of them",
        shows=("radial solver", "coated friction"),
    )
