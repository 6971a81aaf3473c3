"""Verification cases of a growing tangential force: partial slip and gross slip.

Ball and cone are solved on cells, and the ball and a bonded disc by finite elements with angular
harmonics.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import hypot
from typing import Any

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    Cone,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    LoadStep,
    Scene,
)
from fem_reference import Path, Plan, Result, plan
from fem_reference.compliance.angular_grid import (
    end_grid,
    mid_grid,
)
from fem_reference.contact.method import ContactMethod
from fem_reference.expected_radius import meshed_radius
from fem_reference.fields import Increment
from fem_reference.history import solved_increments
from fem_reference.model import ContactModel
from verification.closed_forms.cattaneo_mindlin import superpose
from verification.closed_forms.flat_punch import ConeContact
from verification.judging.case import Case, Level, SectionRun, per_radius
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
    RefinementLevels,
    Reported,
    Row,
    SizedRun,
    Within,
    at_stops,
    because,
    case,
    error_norm,
    finest,
    judged,
    ladder,
    mesh_label,
    named,
    on_cells,
    part_of_side,
    refinement,
    scaled_tolerance,
)
from verification.judging.drawings import Drawn, convergence, profile
from verification.observed.ring_errors import tractions_at
from verification.problems.cattaneo_mindlin import (
    OVER_LIMIT,
    OVER_SLIDING_SHIFT,
    sheared,
)
from verification.problems.indentation import CONE, SLOPE, UNDER_CONE, mean_pressure
from verification.problems.problem import (
    CONTACT_MODULUS,
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    NU_ZERO,
    OFFSETS,
    STEEL,
    UNLIKE,
    Problem,
    ReferenceKind,
    frictional,
    paraboloid,
    partial_slip,
    tangential_step,
)
from verification.quantities import force_along_x, shear_of, shift_along_x

ACROSS = "slip across the load"


@dataclass(frozen=True)
class PointsRun(SectionRun):
    """Finite element run that applies Coulomb's law as a vector law at points on the rings.

    The contact is solved for two sets of points: one with points on the line of the load, one
    halfway between. The result is that of the first set. Its stick area is the mean of both sets,
    because the errors of the stick area have opposite signs.
    """

    def solve(self) -> Result:
        """Solve the scene for both sets of points and return the result with the mean stick area.

        Raises the exceptions of `fem_reference.solve`.
        """
        scene, discretisation = self.scene, self.discretisation
        decided = _with_vector_law(plan(scene))
        radius = meshed_radius(scene, discretisation.contact_radius)
        model = ContactModel.of(scene, discretisation, radius)
        own, between = (
            solved_increments(
                ContactMethod(model, decided, around=grid(discretisation.harmonics)),
                self.tolerance,
            )
            for grid in (end_grid, mid_grid)
        )
        means = (_with_mean_stick(*pair) for pair in zip(own, between, strict=True))
        increments = tuple(_count_factorizations(model, means))
        return Result(scene, discretisation, model.sections, radius, decided, increments)


def _with_vector_law(decided: Plan) -> Plan:
    if decided.path is Path.HARMONICS:
        return decided
    effects = tuple(
        replace(effect, on=True, why="required by this case") if effect.name == ACROSS else effect
        for effect in decided.effects
    )
    return replace(decided, path=Path.HARMONICS, effects=effects)


def _count_factorizations(
    model: ContactModel, increments: Iterator[Increment]
) -> Iterator[Increment]:
    """Yield the increments of a run, each with its number of sparse matrix factorisations.

    Both sets of points are counted. The number does not depend on matrices in the cache.

    model       finite element contact model, which counts the factorisations
    increments  increments, which are solved when they are requested
    """
    counted = 0
    for increment in increments:
        spent, counted = model.factorizations - counted, model.factorizations
        yield replace(increment, factorizations=spent)


def _with_mean_stick(own: Increment, between: Increment) -> Increment:
    if own.stick_radius is None or between.stick_radius is None:
        return own
    return replace(own, stick_radius=hypot(own.stick_radius, between.stick_radius) / 2**0.5)


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
                f"Computed shear on {grids.judged.run.label} cells at four tangential forces, "
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


def _under_cone(*parts: float) -> Problem:
    """Create the problem of a cone under growing tangential forces, with ν = 0.

    The exact shear is µ times the difference of two cone pressures.

    parts  tangential forces at the ends of the load steps, over the friction limit µW
    """

    def pressed(load: float) -> ConeContact:
        return ConeContact.under_load(load, SLOPE, CONTACT_MODULUS)

    ratio = 1.0  # E*/G* of two identical bodies with ν = 0
    ends = (
        superpose(pressed, NORMAL_FORCE, part * FRICTION_LIMIT, FRICTION, ratio) for part in parts
    )
    scene = frictional(
        "Cone on a half-space, sheared, ν = 0",
        Cone(slope_angle=SLOPE, material=NU_ZERO),
        NU_ZERO,
        *(tangential_step(part, increments=1) for part in parts),
    )
    return Problem(
        scene,
        (UNDER_CONE, *ends),
        CONE.radius,
        "Ciavarella 1998; Jäger 1998, with Love's cone",
        scales={OVER_SLIDING_SHIFT: FRICTION * ratio * UNDER_CONE.approach},
        equations=(
            r"\mathbf{q} = \mu \left[p(r; W) - p(r; W - T/\mu)\right],\quad "
            r"c = a \sqrt{1 - T / \mu W}",
        ),
    )


def sheared_cone(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a cone under growing tangential force, on cells.

    Shear, stick radius and shift in partial slip are compared with the closed form. At the quick
    level the order of convergence is computed from coarse grids that are shifted relative to the
    contact.

    level  amount of computation: quick, standard or full
    """
    cells, stops = refinement(32, 128 if level is Level.QUICK else 256), {1: 0.4, 2: 0.8}
    followed = grids = on_cells(_under_cone(*stops.values()), cells)
    if level is Level.QUICK:
        followed = on_cells(_under_cone(stops[1]), cells, offsets=UNLIKE, of="sheared less")
    stick = replace(STICK_RADIUS, value=lambda exact: exact.stick.contact_radius)
    rows = at_stops(
        stops,
        "µW",
        Within(
            SHEAR,
            4e-3,
            "twice the accuracy target of the ball at 128 x 128: cells average the infinite peak "
            "at the apex",
        ),
        Refined(stick, 1.0, part_of_side(0.2), STICK_BORDER),
        Refined(
            SHIFT,
            2.0,
            1e-4,
            "order 2 and cap as for the approach of the frictionless cone, to which the shift is "
            "proportional",
        ),
    )
    return case(
        "sheared_cone",
        "Partial slip under a cone",
        "The cone of cone_contact with ν = 0 and friction, under tangential forces of 0.4 and "
        "0.8 of µW. For any profile the shear is µ times the difference of two pressures; the "
        "stick radius is a √(1 - T/µW), instead of the cube root for a ball.",
        judged(grids, rows),
        judged(followed, (Falls(SHEAR.at(1, stops[1], "µW"), 1.5, SQUARE_ROOTS),)),
        charts=(
            profile(
                grids,
                "sheared_cone_profiles",
                "Shear next to y = 0",
                "Computed shear under the cone, the superposition of two pressures, and their "
                "difference, in units of µ times the mean pressure. The infinite peaks at the "
                "apex cancel.",
                "qₓ / (µ mean p)",
                FRICTION * mean_pressure(CONE),
                *shears_along_x(stops),
            ),
        ),
        shows=("known solutions", "shapes"),
    )


def near_sliding(level: Level = Level.QUICK, cells: int = 0) -> Case:
    """Create the verification case of tangential forces just below the friction limit, and of gross
    slip.

    For ν = 0 the shift is compared with the closed form. In gross slip under a prescribed shift the
    tangential force must equal the friction limit µW.

    level  amount of computation: quick, standard or full
    cells  number of cells per side; 0: that of the level
    """
    cells = cells or (64 if level is Level.QUICK else 128)
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


# The body is incompressible, so that pressing causes no shear, and the disc sticks completely.
RUBBER = IsotropicMaterial(young_modulus=3e6, poisson_ratio=0.5)
PUNCH = 5e-3
PUNCH_FORCE = 10.0


@dataclass(frozen=True)
class StuckDisc:
    """Hold the exact answer of a bonded disc under a tangential force on an incompressible
    half-space.

    shift  tangential shift of the disc [length]
    """

    shift: float = (2 - 0.5) * PUNCH_FORCE / (8 * RUBBER.shear_modulus * PUNCH)


def shear_at_points(end: Any) -> tuple[Any, Any]:
    """Compute the shear components q_x and q_y of a finite element increment at all points on the
    rings.

    The tangential force acts along x. Each result has the shape (rings, angles).
    """
    r, theta = np.meshgrid(end.radii, end.angles, indexing="ij")
    q, _ = tractions_at(end, r * np.cos(theta), r * np.sin(theta))
    return q[0], q[1]


def _shear_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the shear error ∫|q - q_exact| dA / µW of a finite element result at the end of a
    load step.

    The shear is symmetric about the x axis and integrated by the trapezium rule in r and θ.

    result   finite element result with angular harmonics
    step     index of the load step
    problem  problem with the exact shear
    """
    end = result.steps[step]
    q_x, q_y = shear_at_points(end)
    off = np.hypot(q_x - problem.ends[step].shear(end.radii)[:, None], q_y)
    around = 2 * np.trapezoid(off, end.angles, axis=1)
    return float(np.trapezoid(end.radii * around, end.radii)) / FRICTION_LIMIT


def _shear_across(result: Any, step: int, problem: Problem) -> float:
    _, q_y = shear_at_points(result.steps[step])
    return float(np.max(np.abs(q_y)) / problem.scale(OVER_LIMIT))


def _points_level(of: str, problem: Problem, elements: int, over: float) -> RefinementLevels:
    mesh = per_radius(elements, over * problem.radius).model_copy(update={"harmonics": 8})
    run = PointsRun(mesh_label(elements, of=of), problem.scene, mesh)
    return ladder(problem, [SizedRun(run, elements)])


def fem_harmonics(level: Level = Level.QUICK) -> Case:
    """Create the verification case of tangential loading by finite elements with 8 angular
    harmonics.

    Coulomb's law is applied as a vector law at points on the rings. Shift, shear and stick radius
    of a ball are compared with the solution of Cattaneo and Mindlin, and the shift of a bonded disc
    with its closed form.

    level  amount of computation: quick, standard or full
    """
    cusp, rim = 1.5, 1.0  # orders with which errors fall
    shear = error_norm("shear", "∫|q - q_exact| dA / µW{when}", _shear_error, "µW")
    across = error_norm("shear_across", "largest |q_y| / µp_H{when}", _shear_across, OVER_LIMIT)
    beyond = error_norm(
        "shift_over_mindlin",
        "shift{when} over Mindlin's, less one, ν = 0.3",
        lambda result, step, problem: (
            shift_along_x(result.steps[step]) / problem.ends[step].shift - 1
        ),
    )
    rows = at_stops(
        STOPS,
        "µW",
        Within(SHIFT, scaled_tolerance(3e-4, cusp), because(cusp)),
        Within(shear, scaled_tolerance(6e-3, cusp), because(cusp)),
        Within(across, scaled_tolerance(3e-3, 1.0), because(1.0)),
        Within(
            STICK_RADIUS,
            part_of_side(1.0),
            "an element: stick and slip are determined ring by ring",
        ),
    )
    beside_mindlin = tuple(
        row
        for stop in STOPS.items()
        for row in (
            Reported(
                across.at(*stop, "µW, ν = 0.3"),
                "zero in the closed form, which neglects slip across the load",
            ),
            Reported(
                beyond.at(*stop, "µW"),
                "the vector law makes the contact stiffer by fractions of 0.1 %",
            ),
        )
    )
    bonded = Problem(
        Scene(
            title="Disc that sticks to an incompressible body, sheared",
            indenter=FlatPunch(radius=PUNCH, material=RIGID),
            body=Body(material=RUBBER),
            friction=CoulombFriction(coefficient=100.0),
            loading=(
                LoadStep(normal_force=PUNCH_FORCE, increments=1),
                LoadStep(tangential_force=(PUNCH_FORCE, 0.0), increments=1),
            ),
        ),
        (None, StuckDisc()),
        PUNCH,
        "Mindlin 1949: (2 - ν) T / 8 G a",
        equations=(r"\Delta = \frac{(2 - \nu) T}{8 G a}",),
    )
    elements = min(finest(level), 64)
    alike = sheared("Two alike bodies of steel, sheared", PARTS, STEEL)
    exact, steel, disc = (
        _points_level(of, problem, elements, over)
        for of, problem, over in (
            ("ν = 0", CATTANEO, 0.99),
            ("ν = 0.3", alike, 0.99),
            ("disc", bonded, 1.0),
        )
    )
    of_disc = Within(
        replace(SHIFT, over=""), scaled_tolerance(5e-4, rim), because(rim), name="shift_of_disc"
    )
    return case(
        "fem_harmonics",
        "Finite elements: many harmonics",
        "Cattaneo and Mindlin's contact by harmonics 0 … 8 of the section, with Coulomb's law as "
        "a vector law at points (r, θ): for ν = 0, where the closed form is exact, and for ν = "
        "0.3, where it neglects slip across the load. Pressure and shear are uncoupled, so that "
        "each force is reached in one increment. A further scene is a disc with full stick.",
        judged(exact, rows),
        judged(steel, beside_mindlin),
        judged(disc, (of_disc,)),
        limits=("The resolution of the stick zone is one element in radius and 22.5° in angle.",),
        no_order="on one mesh: fem_partial_slip judges the orders of meshes of the same elements",
        shows=("finite elements",),
    )
