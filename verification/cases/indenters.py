"""Verification cases of Hertz contacts, cones, flat punches, and indenters under a moment.

The Hertz contacts are round and elliptical; a ball has its exact arc, a prescribed approach, or is
unloaded. The pressure is infinite below the apex of the cone and at the rim of the punch. Moments
tilt the indenter or let it roll.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import pi, sqrt
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_scene import FlatPunch, LoadStep, Sphere
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import SphereContact
from verification.judging.case import (
    Case,
    Level,
    NotYetAsymptotic,
    Quantity,
    Required,
    Run,
)
from verification.judging.declared_case import (
    APPROACH,
    ASKED,
    CENTRAL_PRESSURE,
    CONTACT_RADIUS,
    DERIVED,
    EDGE,
    FORCE,
    IDENTITY,
    PEAK_PRESSURE,
    PENALTY,
    PRESSURE_L1,
    PRESSURE_L2,
    PRESSURE_WITHIN,
    STAIRCASE,
    Falls,
    Judged,
    Observable,
    Refined,
    Within,
    because,
    case,
    compared,
    error_norm,
    finest,
    judged,
    ladder,
    levels,
    meshed,
    number,
    on_cells,
    on_elements,
    on_springs,
    order_levels,
    part_of_side,
    refinement,
    scaled_tolerance,
    with_edge_at,
)
from verification.judging.drawings import PRESSURE, convergence, profile
from verification.judging.field_errors import relative_pressure_error
from verification.norms import max_norm
from verification.problems.indentation import (
    BALL,
    BARREL,
    CONE,
    EXACT,
    LED_BALL,
    PUNCH,
    PUNCH_RADIUS,
    PUNCH_WINDOW,
    mean_pressure,
)
from verification.problems.problem import (
    CONTACT_MODULUS,
    FRICTION,
    HERTZ,
    NORMAL_FORCE,
    RADIUS,
    ROUNDING,
    STEEL,
    SUBSTRATE,
    UNLIKE,
    Problem,
    Reference,
    ReferenceKind,
    paraboloid,
    pressed,
    pressing,
    rigid_ball,
    square_grid,
)

if TYPE_CHECKING:
    from semi_analytical import Result


ROWS = (
    Within(PEAK_PRESSURE, {128: 1.5e-4, 256: 4e-5}, ASKED),
    Within(APPROACH, {128: 5e-5, 256: 5e-5}, ASKED, name="required_approach"),
    Refined(
        APPROACH,
        2.0,
        5e-5,
        "order 2: the pressure's error has zero mean; the cap is the figure required of the "
        "coarser grids",
    ),
    Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
    Falls(
        PRESSURE_L2,
        1.0,
        "at the edge the pressure rises as a square root: an error of O(√h) on a ring one cell "
        "wide leaves O(h) in L2",
    ),
    Falls(
        PEAK_PRESSURE,
        2.0,
        "even counts of cells put the centre h/√2 from the next cell centre, where the exact "
        "pressure is lower by p0 h²/4a²",
    ),
    Falls(
        CONTACT_RADIUS,
        1.0,
        "pressures that are constant on cells and collocated at their centres extend the contact "
        "by the same fraction of a cell, 0.06, on every grid",
        NotYetAsymptotic(
            0.15, "a second term counts on coarse grids: 1.12 up to 256 cells, 1.08 up to 512"
        ),
    ),
)
# One grid of each size scatters too much, because circles divide the cells in different ways.
MEAN = (
    Falls(
        APPROACH,
        2.0,
        "a weighted mean of the displacement: the errors at the edge alternate and cancel",
    ),
)


def hertz_point(level: Level = Level.QUICK, cells: Sequence[int] = ()) -> Case:
    """Create the verification case of the Hertz contact of a ball on cells of several sizes.

    Approach, peak pressure, contact radius and pressure are compared with the closed form, and the
    orders of convergence are judged. Accuracy targets exist for 128 and 256 cells per side.

    level  amount of computation: quick, standard or full
    cells  numbers of cells per side; default: those of the level, with additional grids that are
           shifted relative to the contact
    """
    most = 256 * 2**level
    grids = on_cells(BALL, cells or refinement(32, most))
    shifted = () if cells else refinement(32, most // 2)
    return case(
        "hertz_point",
        "Hertz point contact",
        "The paper's ball (R = 18 mm, 420 GPa, ν = 0.3) is pressed by 1 kN without friction on a "
        "half-space of the same material, on a window of three contact radii. For a paraboloid "
        "Hertz's solution is exact.",
        judged(grids, ROWS),
        *(judged(on_cells(BALL, some, offsets=UNLIKE), MEAN) for some in (shifted,) if some),
        charts=(
            profile(
                grids,
                "hertz_profile",
                "Pressure next to y = 0",
                f"Computed pressure on {grids.judged.label} cells, Hertz's pressure, and "
                "their difference, which is confined to the cells at the edge of the contact.",
                "p / p₀",
                HERTZ.peak_pressure,
                PRESSURE,
            ),
            convergence(
                grids,
                ROWS,
                "hertz_convergence",
                "Convergence of the Hertz contact",
                "Relative errors against cell side. The pressure falls with the first power of h "
                "because of the square-root edge; approach and peak pressure fall with the second.",
                also=(APPROACH,),
            ),
        ),
        limits=("Pointwise errors at the edge fall as O(√h) only and are not judged.",),
        shows=("(1)", "(3)", "(5)", "(7)", "p_H", "known solutions"),
    )


ARC = SphereContact.under_load(NORMAL_FORCE, RADIUS, CONTACT_MODULUS)


def hertz_exact_sphere(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a ball with its exact circular arc instead of a paraboloid.

    Approach, peak pressure and contact radius on cells are compared with Sneddon's solution.
    """
    ball, load = Sphere(radius=RADIUS, material=STEEL), pressing()
    problem = Problem(
        pressed("Ball with its exact arc on a half-space", ball, STEEL, load),
        (ARC,),
        HERTZ.contact_radius,
        "Sneddon 1965, arc of a circle, by Gauss quadrature",
        ReferenceKind.SEMI_CLOSED,
        100 * ROUNDING,
        equations=(
            r"W = \tfrac{1}{2} E^* \left[(R^2 + a^2) \ln\frac{R + a}{R - a} - 2 a R\right],\quad "
            r"\delta = \tfrac{a}{2} \ln\frac{R + a}{R - a}",
        ),
    )
    rows = (
        Refined(
            APPROACH,
            2.0,
            1e-5,
            "order 2 as for the paraboloid; the cap is a third of the difference from Hertz's "
            "approach, so that the two can be distinguished",
        ),
        Refined(
            PEAK_PRESSURE,
            2.0,
            4e-5,
            "order 2: distance of the centre from the next cell centre; the cap is the figure "
            "required of the paraboloid at 256 x 256",
        ),
        Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), "as for the paraboloid"),
    )
    return case(
        "hertz_exact_sphere",
        "Ball with its exact arc",
        "The ball of hertz_point as a circular arc on the same half-space. The exact solution is "
        f"an integral. It differs from Hertz's by {ARC.approach / HERTZ.approach - 1:.1e} in the "
        f"approach and by {ARC.peak_pressure / HERTZ.peak_pressure - 1:.1e} in the peak pressure, "
        "which is far below the accuracy of measurements but above the error of the solver.",
        judged(on_cells(problem, refinement(64, 256 if level is Level.QUICK else 512)), rows),
        limits=("The theory is linear elasticity of a half-space; large strains are not covered.",),
        no_order=DERIVED,
        shows=("shapes",),
    )


def hertz_approach_control(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the Hertz contact with prescribed approach instead of force.

    The resulting normal force is judged. All levels are equal.
    """
    rows = (
        Refined(
            FORCE,
            2.0,
            7.5e-5,
            "order 2, as the approach under force; the cap is its 5e-5 times 3/2, the exponent of "
            "Hertz's law",
        ),
    )
    return case(
        "hertz_approach_control",
        "Hertz point contact, approach prescribed",
        "The contact of hertz_point with Hertz's approach for 1 kN prescribed. The resulting "
        "force is the measured quantity.",
        judged(on_cells(LED_BALL, refinement(32, 128)), rows),
        no_order=DERIVED,
        shows=("prescribed motion",),
    )


def hertz_elliptical(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the Hertz contact of a barrel, whose contact area is an
    ellipse.

    Approach, peak pressure, mean contact radius and pressure on rectangular cells are compared with
    the closed form.
    """
    mean_radius = replace(
        CONTACT_RADIUS,
        name="mean_contact_radius",
        meaning="√(contact area / π) = √(ab)",
        value=lambda exact: float(sqrt(exact.semi_axes[0] * exact.semi_axes[1])),
    )
    rows = (
        Refined(
            PEAK_PRESSURE,
            2.0,
            1.5e-4,
            "order 2; the cap is the figure required of hertz_point at 128 x 128",
        ),
        Refined(APPROACH, 2.0, 5e-5, "order 2; the cap is the figure required of hertz_point"),
        Refined(mean_radius, 1.0, part_of_side(0.1), f"{EDGE} along the longer axis"),
        Falls(PRESSURE_L2, 1.0, "square-root edge, as for the circle"),
    )
    grids = on_cells(BARREL, refinement(32, 256 if level is Level.QUICK else 512))
    return case(
        "hertz_elliptical",
        "Elliptical Hertz contact",
        "A barrel with principal radii of 90 mm and 18 mm: the contact is an ellipse with b/a = "
        f"{EXACT.axis_ratio:.4f}. Cells are rectangular like the window, which has three "
        "semi-axes along each side.",
        judged(grids, rows),
        charts=(
            profile(
                grids,
                "elliptical_profile",
                "Pressure along the long axis of the ellipse",
                "Computed pressure on the row of cells next to y = 0, the exact pressure, and "
                "their difference.",
                "p / p₀",
                EXACT.peak_pressure,
            ),
        ),
        shows=("(3)", "known solutions", "shapes"),
    )


ON_MESHES = (
    Within(PEAK_PRESSURE, scaled_tolerance(1e-4, 2), because(2)),
    Within(APPROACH, scaled_tolerance(1e-4, 2), because(2)),
    Within(
        CONTACT_RADIUS,
        scaled_tolerance(2e-4, 1),
        "the edge is known to 1/70 of an element; the accuracy target is 2e-3 at 64 per radius",
    ),
    Within(PRESSURE_WITHIN, scaled_tolerance(2e-3, 2), because(2)),
    Falls(
        PRESSURE_L2,
        1.0,
        "at the edge hat functions do not represent a square root: an error of O(√h) on a ring "
        "one element wide leaves O(h) in L2",
    ),
    Falls(
        PEAK_PRESSURE,
        2.0,
        "the error of hat functions at the square-root edge is O(h²) of the load",
    ),
    Falls(
        APPROACH,
        2.0,
        "the energy is stationary with respect to the edge of the contact, which is known to O(h)",
    ),
)


def _penalty_parts(elements: int) -> tuple[Judged, Judged, Quantity]:
    """Return the judged runs of the Hertz contact with a penalty, and the law of its error.

    The penalty allows the surfaces to overlap. One augmentation removes the overlap.
    """
    factor = 10.0
    mesh = with_edge_at(BALL, (elements,))
    springs, improved = (
        on_springs(mesh, f"c = {factor:g}, {words}", penalty=factor, augmentations=n, overlap=1.0)
        for n, words in enumerate(("springs alone", "one augmentation"))
    )
    k = factor * elements * BALL.radius / meshed(BALL.radius, elements)
    error = APPROACH.error(BALL)
    law = Quantity(
        "error_law",
        "error of the approach without augmentation, times k = c a/h",
        "",
        springs.judged.label,
        lambda result: error(result) * k,
        Reference(
            1 / pi,
            ReferenceKind.THEORY,
            "springs of stiffness ε in series with Hertz's contact, to first order: the approach "
            "grows by d/dW of their energy ∫p²/2ε dA, which is p₀/2ε; the next order is 1/k of it",
            1 / (pi * k),
        ),
        Required(0.05, "set by hand: the next order in 1/k and the error of the mesh"),
    )
    rows = (
        Within(PEAK_PRESSURE, 2e-3, PENALTY),
        Within(
            APPROACH,
            scaled_tolerance(1e-4, 2),
            "as without a penalty: an augmentation removes the contribution 1/πk of the springs; "
            f"{because(2)}",
        ),
        Within(CONTACT_RADIUS, part_of_side(0.1), "a tenth of an element: the last points ripple"),
        Within(PRESSURE_WITHIN, scaled_tolerance(2e-3, 2), because(2)),
    )
    of_springs = (
        Within(PEAK_PRESSURE, 2e-3, PENALTY, name="peak_pressure_of_springs"),
        Within(APPROACH, 2e-3, PENALTY, name="approach_of_springs"),
    )
    return judged(improved, rows), judged(springs, of_springs), law


def fem_hertz(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the Hertz contact of a ball by finite elements on many
    meshes, and with a penalty on one.

    Approach, peak pressure, contact radius and pressure are compared with the closed form, and the
    orders of convergence are judged.
    """
    meshes = with_edge_at(BALL, levels(level), order_levels(level))
    improved, springs, law = _penalty_parts(finest(level))
    return case(
        "fem_hertz",
        "Finite elements: Hertz point contact",
        "The contact of hertz_point by axisymmetric finite elements that share only the scene "
        "with the semi-analytical solver: quadratic elements on a section of a hundred contact "
        "radii, pressure linear between its rings, contact as a linear complementarity problem. "
        "Other runs have springs of stiffness ε = c E*/h between the surfaces at the Gauss points "
        "of the contact edges, h being the length of an edge. The overlap of the surfaces is "
        "governed by k = c a/h. One augmentation, in which the pressures of the springs become "
        "forces that need no overlap, removes the overlap.",
        judged(meshes, ON_MESHES),
        improved,
        springs,
        Judged(quantities=(law,)),
        charts=(
            profile(
                meshes,
                "fem_hertz_profile",
                "Pressure over the radius",
                "Pressure by finite elements, Hertz's pressure, and their difference: a ripple "
                "of the last elements at the edge.",
                "p / p₀",
                HERTZ.peak_pressure,
                PRESSURE,
            ),
            convergence(
                meshes,
                ON_MESHES,
                "fem_hertz_convergence",
                "Convergence of the finite elements",
                "Relative errors, root mean square over the positions of the edge in its "
                "element, against the element side over the contact radius.",
                also=(CONTACT_RADIUS,),
            ),
        ),
        limits=(
            "Away from the contact elements grow by the same ratio on every mesh, which leaves "
            "errors of 2e-6 of the peak pressure and 6e-6 of the approach on the finest mesh.",
            "The error of the radius is A h + B h². The term A, up to 0.003, stems from the "
            "extrapolation of the edge from the last two pressures, the term B, about 0.1, from "
            "the pressures. Neither term dominates on these meshes, so that there is no constant "
            "order.",
            "With a penalty the measured error of the peak pressure is −0.54/k; there is no theory "
            "for that number.",
        ),
        equations=(r"\Delta\delta = \frac{p_0}{2\varepsilon},\quad \varepsilon = \frac{c E^*}{h}",),
        shows=("finite elements", "known solutions", "penalty"),
    )


def cone_contact(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cone on a half-space, whose pressure is infinite at the
    apex.

    Approach, contact radius and pressure on cells are compared with the closed form.
    """
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    grids = on_cells(CONE, cells)
    rows = (
        Refined(
            APPROACH,
            2.0,
            1e-4,
            "order 2: the apex lies between cells and shifts the load of a few of them; the cap "
            "is twice the target of the ball",
        ),
        Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
    )
    order = Falls(
        PRESSURE_L1,
        1.5,
        "at the edge O(√h) on a ring one cell wide; the logarithm at the apex is O(1) in a few "
        "cells, O(h²)",
    )
    return case(
        "cone_contact",
        "Cone on a half-space",
        "A cone with flanks of 1° under 1 kN. The pressure is infinite below the apex, as a "
        "logarithm, and falls to zero at the edge.",
        judged(grids, rows),
        judged(on_cells(CONE, cells, offsets=UNLIKE), (order,)),
        charts=(
            profile(
                grids,
                "cone_profile",
                "Pressure next to y = 0",
                "Computed pressure, exact pressure, and their difference, in units of the mean "
                "pressure.",
                "p / mean p",
                mean_pressure(CONE),
            ),
        ),
        limits=("The pressure of the cells at the apex is an average of an infinite peak.",),
        shows=("known solutions", "shapes"),
    )


# Oblique to the grid, and a little less than the third of the radius at which the punch lifts off.
ECCENTRICITY = (0.18 * PUNCH_RADIUS, 0.24 * PUNCH_RADIUS)
TILTED = FlatPunchContact(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE, ECCENTRICITY)


def _stiffness_difference(one: Any, other: Any) -> float:
    """Compute the largest relative difference of the stiffnesses of two flat punches [1].

    The stiffnesses are normal force over approach and moments over tilts, at the end of the last
    step.
    """

    def of(result: Any) -> np.ndarray:
        end = result.steps[-1]
        return np.array([end.normal_force / end.approach, *(end.moment / end.tilt)])

    return max_norm(of(one) / of(other) - 1)


def _slope(along: int, axis: str, other: str) -> Observable:
    """Create the observable of the slope along an axis, which is a rotation about the other one."""
    tilt = number(f"tilt_{axis}", f"slope along {axis}", quantity=f"tilt_{other}")
    return replace(tilt, value=lambda exact: float(exact.tilt[along]))


SLOPES = (_slope(0, "x", "y"), _slope(1, "y", "x"))


def tilted_punch(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a flat punch that is tilted by an eccentric normal force, on
    cells.

    Tilt, approach and pressure are compared with the closed form. Prescribed moment and prescribed
    tilt must give equal stiffnesses.
    """
    punch = FlatPunch(radius=PUNCH_RADIUS, material=STEEL)
    forced, tilted = (
        pressed(title, punch, STEEL, step)
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
        across=PUNCH_RADIUS,
        equations=(
            r"W = 2 E^* a \delta,\quad M = \tfrac{4}{3} E^* a^3 \varphi,\quad "
            r"p = \frac{W}{2 \pi a^2} \frac{1 + 3 \mathbf{e} \cdot \mathbf{r} / a^2}"
            r"{\sqrt{1 - r^2/a^2}}",
        ),
    )
    rows = (
        *(
            Within(
                slope,
                part_of_side(1.5),
                "one and a half cells over the radius, because the tilt depends on its third "
                f"power: {STAIRCASE}",
            )
            for slope in SLOPES
        ),
        Within(APPROACH, part_of_side(0.5), f"half a cell over the radius: {STAIRCASE}"),
        Within(
            error_norm(
                "inner_pressure",
                "largest |p - p_exact| / p_exact within half the radius",
                relative_pressure_error(0.0, 0.5),
                "p_exact",
            ),
            part_of_side(1.5),
            "as the tilt",
        ),
    )
    grids = on_cells(problem, (128 if level is Level.QUICK else 256,), PUNCH_WINDOW)
    finest = grids.judged
    assert isinstance(finest, Run)
    return case(
        "tilted_punch",
        "Flat punch with an eccentric force",
        "A flat punch of 0.4 mm radius with its force of 1 kN 0.3 radii from the axis in a "
        "direction oblique to the grid. For eccentricities up to a third of the radius the whole "
        "face is in contact, and the solution for a plane of displacements has a closed form.",
        judged(grids, rows),
        compared(
            "both_controls",
            "prescribed moment against prescribed tilt, by the stiffnesses: "
            "load over approach and moment over tilt",
            finest,
            Run("given tilt", tilted, finest.grid),
            _stiffness_difference,
            1e-6,
            "the whole face is in contact: the response is linear to the tolerance of the solver",
            "linearity of a contact that does not change",
        ),
        no_order="first order in the cell side with scatter: the division of cells by the circle "
        "differs from grid to grid",
        shows=("(1)", "(3)", "known solutions", "shapes", "tilt and torsion"),
    )


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
    worst = max_norm(one.pressure - pressure) / other.peak_pressure
    if one.shear is None or other.shear is None:
        return float(worst)
    shear = np.roll(other.shear, MOVED, axis=(1, 2))
    limit = FRICTION * other.peak_pressure
    return float(np.maximum(worst, max_norm(one.shear - shear) / limit))


def eccentric_ball(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a ball under an eccentric normal force, on cells.

    The ball rolls until the contact lies below the force. Motion and tractions must be those of a
    central contact that is shifted by whole cells.
    """
    cells, increments = 64 if level is Level.QUICK else 128, 5
    source = "x²/2R - φx = (x - Rφ)²/2R - Rφ²/2: a tilted paraboloid is a shifted paraboloid"
    grid = square_grid(cells, 2 * HERTZ.contact_radius)
    e = tuple(number * side for number, side in zip(MOVED, grid.spacing, strict=True))
    roll = tuple(length / RADIUS for length in e)
    drop = 0.5 * RADIUS * (roll[0] ** 2 + roll[1] ** 2)
    forced = LoadStep(
        normal_force=NORMAL_FORCE,
        moment=(NORMAL_FORCE * e[1], NORMAL_FORCE * e[0]),
        increments=increments,
    )
    pairs = {
        suffix: [
            Run(f"{label}{suffix}", pressed(title, *bodies, step, friction=FRICTION), grid)
            for label, title, step in (
                ("beside", f"{ball} beside its tip", forced),
                ("centred", f"{ball} at its tip", pressing(increments)),
            )
        ]
        for suffix, ball, bodies in (
            ("", "Ball pressed", (paraboloid(STEEL), STEEL)),
            (", unlike bodies", "Rigid ball", (rigid_ball(), SUBSTRATE)),
        )
    }

    beside = pairs[""][0]
    problem = Problem(
        beside.scene,
        (SimpleNamespace(tilt=roll),),
        HERTZ.contact_radius,
        source,
        ReferenceKind.IDENTITY,
    )
    return case(
        "eccentric_ball",
        "Ball with an eccentric force",
        "The paper's ball with its force of 1 kN a whole number of cells from the tip. The ball "
        "rolls until the contact is below the force. The contact then equals the centred "
        "contact, shifted by whole cells, so that the fields agree to the tolerance of the "
        "solver, also for coupled pressure and shear.",
        judged(ladder(problem, [beside]), [Within(slope, 1e-6, ROLLED) for slope in SLOPES]),
        *(
            compared(
                f"fields{suffix}",
                "largest difference of pressure and shear, shifted, over "
                "the largest pressure and the largest friction limit",
                pair[0],
                pair[1],
                _shifted_field_difference,
                1e-5,
                ROLLED,
                source,
            )
            for suffix, pair in pairs.items()
        ),
        compared(
            "approach",
            "approach at the origin plus the rise of the tip by rolling, against "
            "the approach of the centred ball",
            beside,
            pairs[""][1],
            lambda beside, centred: abs(
                (beside.steps[-1].approach + drop) / centred.steps[-1].approach - 1
            ),
            1e-6,
            ROLLED,
            source,
        ),
        equations=(
            r"\frac{x^2}{2R} - \varphi x = \frac{(x - R\varphi)^2}{2R} - \frac{R\varphi^2}{2}",
        ),
        no_order=IDENTITY,
        shows=("(1)", "tilt and torsion"),
    )


def fem_classical(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cone and a flat punch by finite elements.

    Approach, contact radius and pressure are compared with closed forms. The order of convergence
    of the central pressure of the punch is judged above the quick level.
    """
    why = "set by hand at 64 elements per radius, on other meshes scaled by the order"
    rim = "the error of hat functions at the infinite pressure of the rim has an energy of O(h)"
    cones = with_edge_at(CONE, (finest(level),), of="cone")
    # Orders below a rim need the finest meshes.
    meshes = levels(level if level is Level.QUICK else Level.FULL)
    punches = on_elements(PUNCH, meshes, of="punch")
    between = error_norm(
        "pressure_of_cone",
        "largest error of the pressure over its exact value, from 0.2 to 0.8 of the radius",
        relative_pressure_error(0.2, 0.8),
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
    fine = replace(punches, followed=tuple(run for run in punches.runs if run.count >= 22))
    of_fine = Falls(
        CENTRAL_PRESSURE,
        1.0,
        rim,
        NotYetAsymptotic(
            0.15,
            "the error is A h - B h² with B = 3.5 A / a: neighbouring meshes from 22 elements "
            "per radius on have the orders 0.86, 0.90, 0.93",
        ),
    )
    caption = "Relative errors against the side of an element over the contact radius."
    return case(
        "fem_classical",
        "Finite elements: cone and flat punch",
        "The cone of cone_contact and a flat punch by finite elements. Below the punch the "
        "outermost hat function of the pressure is half a hat that ends at the rim.",
        judged(cones, of_cone),
        judged(punches, of_punch),
        judged(fine, () if level is Level.QUICK else (of_fine,)),
        charts=(
            convergence(
                punches,
                (*of_punch, of_fine),
                "fem_classical_convergence",
                "Convergence of the punch",
                caption,
            ),
        ),
        shows=("finite elements", "known solutions"),
    )
