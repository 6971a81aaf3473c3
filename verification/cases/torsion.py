"""Verification cases of torsion by all solvers, and of tangential forces that turn.

The contacts are a ball in partial slip with load reversal, a flat punch in full stick, and coated
balls.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from contact_errors.coarse_solves import stated_errors
from contact_scene import (
    Body,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.array_types import Field
from contact_scene.quantities.residuals import worst
from semi_analytical import solve_discretised
from verification.closed_forms.coated_indentation import LayeredSurface
from verification.closed_forms.torsion import CoatedTorsion, one_layer
from verification.judging.case import (
    OVER_ANGLES,
    Case,
    Level,
)
from verification.judging.declared_case import (
    PENALTY,
    SHEAR_AROUND,
    SQUARE_ROOTS,
    STICK_RADIUS,
    TWIST,
    Falls,
    Observable,
    Refined,
    Within,
    at_stops,
    case,
    error_norm,
    finest,
    judged,
    levels,
    named,
    number,
    on_cells,
    on_elements,
    on_radii,
    on_springs,
    part_of_side,
    refinement,
    scaled_tolerance,
    with_edge_at,
)
from verification.judging.drawings import Drawn, convergence, profile
from verification.norms import max_norm, shear_error
from verification.problems.cattaneo_mindlin import (
    LED,
    OVER_LIMIT,
    OVER_TWIST,
    SLIDING_TORQUE,
    STUCK,
    TORQUE_PARTS,
    TORSION_LOOP,
    TWISTED,
)
from verification.problems.problem import (
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    RADIUS,
    ROUNDING,
    Problem,
    ReferenceKind,
    coated,
    exact_contact,
    film,
    pressed,
    pressing,
    rigid_ball,
)
from verification.quantities import energy_between, shear_of

SLIDING = "of the sliding torque"
HALF_A_PER_CENT = "the accuracy target is 0.5 % of the twist at 128 x 128"
QUARTER = "order 1: the border is known to a fraction of a cell; the cap is a quarter"
MASING = "Lubkin 1951, with Masing's rule for the reversal"
WITHIN = 0.995  # radii up to which shear is compared: at the edge it has no finite slope
LOOP_TWISTS = tuple(
    replace(
        TWIST,
        name=f"twist_{name}",
        meaning=f"twist after step {step + 1} of the loop",
        step=step,
        over=OVER_TWIST,
        source=MASING,
    )
    for step, name in {1: "loaded", 2: "unloaded", 3: "reversed", 4: "closed"}.items()
)
ENERGY_PER_CYCLE = Observable(
    "energy_per_cycle",
    "energy dissipated from the first to the second torque of + 0.9",
    "J",
    lambda result, *_: energy_between(result, 2, 5),
    lambda end: float(end.energy_per_cycle),
    source=MASING,
    scalar=("energy_per_cycle", 0),
)
TORQUE = number("torque", "torque at the twist of 0.9 of the limit", exact="moment")


def _shear_on_cells(result: Any, step: int, problem: Problem) -> float:
    """Compute the shear error Σ|q - q_exact| / Σµp of a ball in torsion on cells [1].

    result   result on cells
    step     index of the load step
    problem  problem with the exact circumferential shear
    """
    end, a = result.steps[step], problem.radius
    x, y = result.grid.coordinates()
    r = np.hypot(x, y)
    exact = np.where(r < a, problem.ends[step].shear(np.minimum(r, a)), 0.0)
    across = np.stack([-y, x]) / np.where(r > 0, r, 1.0)
    return shear_error(shear_of(end), exact * across, FRICTION * end.pressure)


def _largest_shear_error(result: Any, step: int, problem: Problem) -> float:
    """Compute the largest error of the circumferential shear by the radial solver inside the
    contact [1].

    The error is relative to the friction limit µp_H (p_H: Hertz peak pressure), or for the punch to
    the exact shear at half its radius.

    result   result of the radial solver
    step     index of the load step
    problem  problem with the exact shear
    """
    end, known = result.steps[step], problem.ends[step]
    scale = problem.scales.get(OVER_LIMIT) or float(known.shear(problem.radius / 2))
    inside = end.radii < WITHIN * problem.radius
    off = end.shear_circumferential[inside] - known.shear(end.radii[inside])
    return max_norm(off) / scale


def _mean_shear_error(result: Any, step: int, problem: Problem) -> float:
    end, known = result.steps[step], problem.ends[step]
    inside = end.radii < problem.radius
    r = end.radii[inside]
    off = np.abs(end.shear_circumferential[inside] - known.shear(r))
    return float(np.trapezoid(off * r, r) / np.trapezoid(r, r) / problem.scale(OVER_LIMIT))


def torsion(level: Level = Level.QUICK) -> Case:
    """Create the verification case of torsion on cells: a ball in partial slip, and a punch in full
    stick.

    Twist, stick radius, shear and, for a closed torque loop, the dissipated energy are compared
    with closed forms. Two coated balls are compared with the solution of an integral equation.
    """
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    balls, finest = on_cells(TWISTED, cells), cells[-1:]
    punches = on_cells(STUCK, finest, 2.2, of="stuck punch")
    shear = error_norm("shear", "Σ|q - q_exact| / Σµp{when}", _shear_on_cells, "Σµp", of="shear")
    shears = {step: shear.at(step, part, SLIDING) for step, part in TORQUE_PARTS.items()}
    of_ball = (
        *at_stops(
            TORQUE_PARTS,
            SLIDING,
            Refined(TWIST, 1.5, 5e-3, f"order 1.5 as the shear; the cap: {HALF_A_PER_CENT}"),
            Refined(STICK_RADIUS, 1.0, part_of_side(0.25), QUARTER),
            Within(shear, 2e-3, "as required of the Cattaneo-Mindlin shear on these grids"),
        ),
        Falls(shears[2], 1.5, f"{SQUARE_ROOTS}, as in the Cattaneo-Mindlin case"),
    )
    of_loop = (
        *(
            Within(twist, 1e-4, f"four times the error of 128 cells; {HALF_A_PER_CENT}")
            for twist in LOOP_TWISTS[1:]
        ),
        Within(ENERGY_PER_CYCLE, 2e-4, f"four times the error of 128 cells; {HALF_A_PER_CENT}"),
    )
    of_given_twist = Within(
        TORQUE,
        3e-5,
        "a quarter of the tolerance of a twist: near the limit the torque hardly depends on the "
        "twist",
        name="torque_of_given_twist",
    )
    of_punch = (
        Within(
            TWIST,
            part_of_side(1.5),
            "the twist is proportional to 1/radius³, and the staircase of cells at the rim "
            "changes the effective radius by up to half a cell",
            name="stuck_twist",
        ),
    )
    of_coated = at_stops(
        COATED_PARTS,
        SLIDING,
        Refined(TWIST, 1.5, 5e-3, f"order 1.5 as without layers; the cap: {HALF_A_PER_CENT}"),
        Refined(STICK_RADIUS, 1.0, part_of_side(0.25), QUARTER),
    )
    return case(
        "torsion",
        "Torsion with partial slip",
        "The paper's ball under 1 kN is loaded by 0.5, 0.9 and 0.99 of the torque at gross slip, "
        "by a loop of 0.9 of this torque, and by a prescribed twist; a flat punch sticks "
        "completely. Torsion moves the surfaces in circles and is uncoupled from the pressure, "
        "so that the closed form holds for any pair of equal bodies. A ball and a half-space with "
        "the same coating, twice as stiff as the material below and as thick as the contact radius "
        "without coating, do not couple either: torsion makes only shear waves, and the layer "
        "reflects these with one coefficient. The problem is a Fredholm equation, solved to ten "
        "digits.",
        judged(balls, of_ball),
        judged(named("to and fro", on_cells(TORSION_LOOP, finest)), of_loop),
        judged(named("given twist", on_cells(LED, finest)), (of_given_twist,)),
        judged(named("stuck punch", punches), of_punch),
        judged(on_cells(twisted_coated(), cells, of="coated"), of_coated),
        charts=(
            convergence(
                balls,
                of_ball,
                "torsion_convergence",
                "Convergence of torsion",
                "Σ|q - q_exact| / Σµp against cell side for three torques, with a line of the "
                "expected slope 3/2.",
                also=(shears[1], shears[3]),
            ),
        ),
        limits=(
            "The pressure of the coated reference uses the solver's frequency response of layers, "
            "which other cases judge; the torsion of the reference does not.",
        ),
        shows=("(2)", "(4)", "known solutions", "tilt and torsion", "coatings"),
    )


# Relative error of the semi-closed solution: its difference from the closed form for thick layers
# and for layers of the base material.
SEMI_CLOSED_ERROR = 1e-10
ERROR_OF_CELLS = 3e-4  # of motions on 64 cells along a side, over the largest of a history
COATED_PARTS = {1: 0.5, 2: 0.9}  # of the torque at gross slip, by load step
# Two equal bodies of twice the moduli have the compliance of one under a rigid ball (E1/E2 = 2).
BASE = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)
COATING = IsotropicMaterial(young_modulus=840e9, poisson_ratio=0.3)
LAYERS = (Layer(thickness=HERTZ.contact_radius, material=COATING),)
BODY = Body(material=BASE, layers=LAYERS)
BALL = Paraboloid(radius=RADIUS, material=BASE, layers=LAYERS)


def _friction_limit(r: Field) -> Field:
    """Compute the friction limit µp of two coated balls at radii r from the exact pressure
    [force/length²].
    """
    return FRICTION * exact_contact(BODY, BALL).pressure(r)


@cache
def twisted_coated() -> Problem:
    """Create the problem of two coated balls under a normal force and a torque that grows in two
    steps.

    The answer is the solution of a Fredholm integral equation for each torque.
    """
    normal = exact_contact(BODY, BALL)
    surface = LayeredSurface(
        lambda k: 2 * one_layer(k, LAYERS[0].thickness, COATING.shear_modulus, BASE.shear_modulus),
        COATING.shear_modulus,
        LAYERS[0].thickness,
    )
    a = normal.contact_radius
    sliding = CoatedTorsion(surface, a, _friction_limit, 0.5 * a).sliding_torque
    ends = [
        CoatedTorsion.under_torque(part * sliding, surface, a, _friction_limit)
        for part in COATED_PARTS.values()
    ]
    turning = (LoadStep(torque=end.torque, increments=1) for end in ends)
    return Problem(
        pressed("Coated balls in torsion", BALL, BODY, pressing(1), *turning, friction=FRICTION),
        (normal, *ends),
        a,
        "Fredholm equation for Abel's transform of the shear (Lubkin 1951 without layers)",
        ReferenceKind.SEMI_CLOSED,
        SEMI_CLOSED_ERROR,
        equations=(
            r"h(s) + \int_0^a K(s, t) h(t) \, dt = \tfrac{4}{\pi} G \varphi s,\quad s < c,\quad "
            r"K = \tfrac{2}{\pi} \int_0^\infty (k G F(k) - 1) \sin ks \sin kt \, dk",
        ),
    )


def shear_around(step: int) -> Drawn:
    """Describe the chart curve of the computed and the exact circumferential shear of a torsion
    problem.

    step  index of the load step, at whose end the shear is drawn
    """
    return Drawn(lambda end: end.shear_circumferential, lambda exact: exact.shear, step=step)


def fem_torsion(level: Level = Level.QUICK) -> Case:
    """Create the verification case of torsion by finite elements: a ball in partial slip, a stuck
    punch.

    Twist, stick radius and shear are compared with closed forms.
    """
    cusp = (
        "set by hand: at 64 elements per radius 2e-3 of the twist and 5e-3 of µp_H, on other "
        "meshes scaled by the order 3/2 of the cusps at both edges"
    )
    rim = "the error of hat functions at the infinite shear of the rim has an energy of O(h)"
    balls = with_edge_at(TWISTED, (finest(level),), of="ball")
    of_ball = at_stops(
        TORQUE_PARTS,
        SLIDING,
        Within(TWIST, scaled_tolerance(2e-3, 1.5), cusp),
        Within(
            STICK_RADIUS,
            part_of_side(0.1),
            "a tenth of an element: the edge is extrapolated from the last values",
        ),
        Within(SHEAR_AROUND, scaled_tolerance(5e-3, 1.5), cusp),
    )
    of_springs = at_stops(
        TORQUE_PARTS,
        SLIDING,
        Within(TWIST, scaled_tolerance(1e-3, 1.5), PENALTY),
        Within(SHEAR_AROUND, scaled_tolerance(1e-2, 1.5), PENALTY),
    )
    n = finest(level)
    springs = on_springs(
        on_elements(TWISTED, (n,), 0.97, "torsion"), f"torsion, {n} elements per radius, penalty"
    )
    of_punch = (
        Within(
            TWIST,
            scaled_tolerance(1e-3, 1),
            f"set by hand: 1e-3 at 64 elements per radius; {rim}",
            name="stuck_twist",
        ),
        Falls(TWIST, 1.0, rim),
    )
    return case(
        "fem_torsion",
        "Finite elements: torsion",
        "The paper's ball under 1 kN is loaded by 0.5, 0.9 and 0.99 of the torque at gross slip, "
        "and a flat punch sticks completely, as in torsion. The only unknown is the "
        "circumferential displacement; the pressure enters only through the friction limit. The "
        "ball is also solved with a penalty and Coulomb's law by return mapping.",
        judged(balls, of_ball),
        judged(springs, of_springs),
        judged(on_elements(STUCK, levels(level), of="stuck punch"), of_punch),
        charts=tuple(
            profile(
                balls,
                f"fem_torsion_{step}",
                f"Shear over the radius at {part:g} {SLIDING}",
                "Circumferential shear by finite elements, the closed form, and their "
                "difference: a cusp at the stick edge.",
                "q / µp₀",
                TWISTED.scale(OVER_LIMIT),
                shear_around(step),
            )
            for step, part in TORQUE_PARTS.items()
        ),
        shows=("finite elements", "tilt and torsion"),
    )


def _exact_rows(*observables: Observable, error: float = ROUNDING) -> Iterator[Within]:
    return (Within(w, 2 * error, "twice the uncertainty of the reference") for w in observables)


def radial_torsion(level: Level = Level.QUICK) -> Case:
    """Create the verification case of torsion by the radial solver.

    Twist, stick radius and shear are compared with closed forms, reversals with Masing's rule, and
    coated balls with a Fredholm integral equation. All levels are equal.
    """
    shear = error_norm(
        "shear",
        f"largest error of the shear up to {WITHIN:g} a{{when}}",
        _largest_shear_error,
        "µp_H, or the shear at half the radius of the punch",
    )
    stick = replace(STICK_RADIUS, over="")
    of_coated = _exact_rows(TWIST, stick, error=SEMI_CLOSED_ERROR)
    # The area under the virgin curve has a relative uncertainty of 1e-10, the energy twice that.
    of_loop = (*_exact_rows(*LOOP_TWISTS), *_exact_rows(ENERGY_PER_CYCLE, error=2e-10))
    parts = ", ".join(f"{part:g}" for part in TORQUE_PARTS.values())
    return case(
        "radial_torsion",
        "Radial solver: torsion",
        f"The paper's ball under 1 kN is loaded by {parts} of the torque at gross slip, by a "
        "prescribed twist, and by a loop; a flat punch sticks completely; coated balls are those "
        "of torsion. The radial solver follows reversals by Masing's rule and computes "
        "energies without increments.",
        judged(
            on_radii(TWISTED, "ball"),
            at_stops(TORQUE_PARTS, SLIDING, *_exact_rows(TWIST, stick, shear)),
        ),
        judged(on_radii(LED, "given twist"), [*_exact_rows(TORQUE)]),
        judged(on_radii(STUCK, "stuck punch"), [*_exact_rows(TWIST, shear)]),
        judged(on_radii(TORSION_LOOP, "to and fro"), of_loop),
        judged(on_radii(twisted_coated(), "coated"), at_stops(COATED_PARTS, SLIDING, *of_coated)),
        limits=(
            "The friction limit of the coated reference uses the response of layers to pressure "
            "that the solver uses as well; the torsion of the reference does not.",
        ),
        no_order="the solution is exact to rounding: no error falls with the rings",
        shows=("radial solver", "tilt and torsion"),
    )


SCALARS = ("approach", "contact_radius", "stick_radius", "dissipated_energy", "elastic_energy")
MOTIONS = ("tangential_shift", "twist")
TURNING = ((0.6, 0.0), (0.0, 0.6))


def _torque_step(share: float, increments: int, **more: Any) -> LoadStep:
    return LoadStep(torque=share * SLIDING_TORQUE, increments=increments, **more)


def _force_step(x: float, y: float, increments: int) -> LoadStep:
    return LoadStep(
        tangential_force=(x * FRICTION_LIMIT, y * FRICTION_LIMIT), increments=increments
    )


def _coated_ball_scene(title: str, *steps: LoadStep) -> Scene:
    """Create the scene of a rigid ball that is pressed on a coating with friction, then loaded by
    torques and tangential forces.

    The coating is twice as stiff as its base and as thick as the Hertz contact radius.

    title  title of the scene
    steps  load steps after the normal loading
    """
    body = coated(film(2.0, 1.0))
    return pressed(title, rigid_ball(), body, pressing(8), *steps, friction=FRICTION)


@cache
def _solve_on_cells(scene: Scene, cells: int) -> Any:
    """Solve a scene by the semi-analytical solver on cells × cells cells, as reference for the
    radial solver and the finite elements.

    The result is stored in memory, because several quantities use it.
    """
    return solve_discretised(scene, SurfaceDiscretisation(cells=(cells, cells)))


def _motion_apart(ours: Any, _: int, problem: Problem) -> float:
    """Compute the largest difference of tangential shift and twist between two solvers [1].

    The differences at the ends of all load steps are divided by the largest value of the history.

    ours     result of the radial solver or of the finite elements
    problem  problem whose answer is the solve on cells
    """
    theirs, errors = problem.ends[-1](), []
    for of in MOTIONS:
        both = [
            (np.asarray(getattr(one, of)), np.asarray(getattr(other, of)))
            for one, other in zip(ours.steps, theirs.steps, strict=True)
            if getattr(one, of) is not None and getattr(other, of) is not None
        ]
        size = max((np.linalg.norm(one) for one, _ in both), default=0.0)
        if size:
            errors += [float(np.linalg.norm(one - other) / size) for one, other in both]
    return worst(*errors)


def _apart_of_stated(ours: Any, _: int, problem: Problem) -> float:
    """Compute the largest ratio of the difference of two solvers to the sum of their stated errors
    [1].

    A ratio up to 1 means that the stated errors of radial solver and cells explain the difference.
    Motions, radii and energies at the ends of all load steps are compared.

    ours     result of the radial solver
    problem  problem whose answer is the solve on cells
    """

    def size(value: Any) -> float:
        return 0.0 if value is None else float(np.linalg.norm(value))

    theirs, shares = problem.ends[-1](), []
    both_errors = (
        stated_errors(ours),
        stated_errors(theirs),
    )
    for one, other, *stated in zip(
        ours.steps, theirs.steps, *(errors.steps for errors in both_errors), strict=True
    ):
        for of in (*SCALARS, *MOTIONS):
            values = getattr(one, of), getattr(other, of)
            if any(value is None for value in values):
                continue
            allowed = sum(size(errors[of].error) for errors in stated)
            if allowed:
                shares.append(size(np.subtract(*values)) / allowed)
    return worst(*shares)


def radial_turning(level: Level = Level.QUICK) -> Case:
    """Create the verification case of torsion of coupled bodies and of turning forces by the radial
    solver and by finite elements.

    Histories of torque and tangential force on a coated body are compared with a solve on cells. A
    ball of uncoupled bodies in torsion is compared with closed forms.
    """
    cells = (64, 96, 192)[level]
    elements = (16, 24, 32)[level]
    scenes = {
        "torsion": _coated_ball_scene(
            "Ball twisted on a coating",
            _torque_step(0.5, 6),
            _torque_step(-0.2, 6),
            _torque_step(0.2, 4, normal_force=1.2 * NORMAL_FORCE),
        ),
        "beside": _coated_ball_scene(
            "Ball twisted and pushed on a coating",
            _torque_step(0.4, 4),
            _force_step(0.5, 0.0, 4),
            _torque_step(-0.1, 4),
        ),
        "turning": _coated_ball_scene(
            "Ball on a coating pushed along x, then y",
            _force_step(*TURNING[0], 4),
            _force_step(*TURNING[1], 6),
        ),
    }
    of_twist = "accuracy target of the rings at any number of increments"
    mean_shear = error_norm(
        "mean_shear", "mean error of q_θ over the contact{when}", _mean_shear_error, OVER_LIMIT
    )
    of_ball = at_stops(
        TORQUE_PARTS,
        SLIDING,
        Within(replace(TWIST, over=OVER_TWIST), 5e-4, of_twist),
        Within(mean_shear, 5e-3, "accuracy target of the radial solver, for the mean"),
    )
    of_loop = (
        *(Within(twist, 5e-4, of_twist) for twist in LOOP_TWISTS),
        Within(
            ENERGY_PER_CYCLE, 2e-3, "set by hand: four times the error of the rings for a cycle"
        ),
    )
    motion = error_norm(
        "motion",
        "largest difference of shift and twist",
        _motion_apart,
        "the largest of the history",
    )
    of_elements = Within(
        motion,
        scaled_tolerance(9e-4, 1.5),
        "set by hand: at 64 elements per radius twice the difference from cells, on other meshes "
        "scaled by the order 3/2 of the cusps at both edges",
    )
    of_coated = (
        Within(
            motion,
            7e-4,
            f"set by hand: errors of about {ERROR_OF_CELLS:g} each of 64 cells along a side "
            "and of the rings",
        ),
        Within(
            error_norm(
                "stated",
                "largest difference of motions, radii and energies",
                _apart_of_stated,
                "the sum of both stated errors",
            ),
            1.0,
            "both solvers state their errors",
        ),
    )

    def beside_cells(scene: Scene, uncertainty: float) -> Problem:
        return Problem(
            scene,
            (lambda: _solve_on_cells(scene, cells),),
            HERTZ.contact_radius,
            f"{cells}² cells",
            ReferenceKind.OTHER_SOLVER,
            uncertainty,
        )

    return case(
        "radial_turning",
        "Torsion and turning tangential forces on rings and angles",
        "The paper's steel ball under the torques of radial_torsion, by points on rings, where "
        "the exact shear needs no increments. A rigid ball on a coating twice as stiff as its "
        "base: under a torsional loop with a rise of the normal force, under torque, tangential "
        "force and reversed torque, and under a tangential force along x, then y. All histories "
        "of the coated body are solved by the radial solver and by finite elements, and compared "
        "with cells in equal increments.",
        judged(on_radii(TWISTED, "ball", at_points=True), of_ball),
        judged(on_radii(TORSION_LOOP, "to and fro", at_points=True), of_loop),
        *(
            judged(on_radii(beside_cells(scene, known), name, laws=OVER_ANGLES), (row,))
            for name, scene in scenes.items()
            # A stated error is two standard uncertainties, and at most the sum of both.
            for row, known in zip(of_coated, (64 / cells * ERROR_OF_CELLS, 0.5), strict=True)
        ),
        *(
            judged(
                on_elements(
                    beside_cells(scene, 64 / cells * ERROR_OF_CELLS),
                    (elements,),
                    of=f"{name} on elements",
                ),
                (of_elements,),
            )
            for name, scene in scenes.items()
        ),
        limits=(
            "The histories of coupled bodies have no closed form: the three solvers are compared "
            "with each other.",
        ),
        no_order="judged on the rings that the solver chooses, not on several numbers of rings",
        shows=("(6)", "radial solver", "tilt and torsion"),
    )
