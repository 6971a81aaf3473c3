"""Verification cases of load histories without a closed form.

A history is judged by comparison with an equivalent one: rotated, mirrored or exchanged scenes, or
other descriptions of one contact, must give equal results. The laws of contact and friction are
evaluated as well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import cos, radians, sin
from typing import Any

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FlatPunch,
    FrictionMap,
    HeightMap,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.array_types import Field
from contact_scene.loading import CONTROLS
from contact_scene.quantities.residuals import worst
from semi_analytical import SurfaceGrid, all_effects
from verification.judging.case import (
    SOLVER_TOLERANCE,
    AnyRun,
    Case,
    Level,
    Quantity,
    RadiiRun,
    Required,
    Run,
    SectionRun,
    per_radius,
)
from verification.judging.declared_case import IDENTITY, Judged, case, compared
from verification.norms import max_norm
from verification.problems.cattaneo_mindlin import (
    LARGEST,
    PUNCH_RADIUS,
    SLIDING_SHIFT,
    SLIDING_TORQUE,
    STUCK,
)
from verification.problems.problem import (
    FRICTION,
    HERTZ,
    NORMAL_FORCE,
    NU_ZERO,
    RADIUS,
    ROUNDING,
    STEEL,
    SUBSTRATE,
    Reference,
    ReferenceKind,
    coated,
    film,
    frictional,
    identity,
    paraboloid,
    pressed,
    pressing,
    rigid_ball,
    square_grid,
    tangential_step,
)
from verification.quantities import relative_difference, shear_of

Difference = Callable[[Any, Any], float]

ANSWERED = "residuals of two solves, amplified a few times in the tractions"
ISOTROPIC = "isotropy of bodies and friction"
ROTATION = r"\mathbf{q}(\mathbf{R}\mathbf{x}) = \mathbf{R}\,\mathbf{q}(\mathbf{x})"
EXACT = 10 * SOLVER_TOLERANCE
FILMED = coated(film(2.0, 1.0))


def turned(loading: tuple[LoadStep, ...], degrees: float) -> tuple[LoadStep, ...]:
    """Rotate the tangential forces of load steps about z by an angle [degrees], from x towards y.

    Used to test that results do not depend on the direction of the load.
    """
    c, s = cos(radians(degrees)), sin(radians(degrees))

    def one(step: LoadStep) -> LoadStep:
        if step.tangential_force is None:
            return step
        x, y = step.tangential_force
        return step.model_copy(update={"tangential_force": (c * x - s * y, s * x + c * y)})

    return tuple(one(step) for step in loading)


def _shift_of(end: Any) -> Field:
    """Return the tangential shift (2,) of an increment [length], or zeros if the increment has no
    tangential shift.
    """
    shift = end.tangential_shift
    return np.zeros(2) if shift is None else np.asarray(shift)


def same_fields(
    field: Callable[[Field], Field],
    vector: Callable[[Field], Field],
    turn: Callable[[Field], Field],
    one: Any,
    other: Any,
) -> float:
    """Compute the largest difference of two results over all increments, after a change of axes.

    The second result is that of a rotated or otherwise equivalent scene. Compared are Σ|Δp|/Σp,
    Σ|Δq|/Σp, the relative difference of the approach, and the difference of the tangential shift
    over the approach.

    field       function that maps a scalar field (nx, ny) of the second result to the axes of the
                first
    vector      function that maps a shear field (2, nx, ny)
    turn        function that maps a tangential shift (2,)
    one, other  first and second result on cells
    """

    def apart(a: Any, b: Any) -> float:
        total = np.sum(b.pressure)
        return worst(
            float(np.sum(np.abs(a.pressure - field(b.pressure))) / total),
            float(np.sum(np.abs(shear_of(a) - vector(shear_of(b)))) / total),
            abs(a.approach / b.approach - 1),
            max_norm(_shift_of(a) - turn(_shift_of(b))) / b.approach,
        )

    return worst(*map(apart, one.increments, other.increments))


def _rotate_field_quarter(field: Field) -> Field:
    """Return a scalar field (n, n) on square cells rotated about z by a right angle, from x towards
    y.
    """
    return np.asarray(field.T[::-1])


as_it_is = partial(same_fields, np.asarray, np.asarray, np.asarray)
after_quarter = partial(
    same_fields,
    _rotate_field_quarter,
    lambda q: np.stack([-_rotate_field_quarter(q[1]), _rotate_field_quarter(q[0])]),
    lambda shift: np.array([-shift[1], shift[0]]),
)
in_mirror = partial(  # at the plane x = 0
    same_fields,
    lambda field: field[::-1],
    lambda q: np.stack([-q[0][::-1], q[1][::-1]]),
    lambda shift: np.array([-shift[0], shift[1]]),
)


# loading steps
PUSHED = 2
BACK = 3


@dataclass(frozen=True)
class CoupledContact:
    """Hold a rigid ball on a body with coupled pressure and shear, and its load history.

    The ball is pressed. A tangential force of 2/3 µW is applied along x, reversed, and turned. Then
    the normal force is reduced.

    name      description of the body and the friction
    body      elastic lower body
    friction  coefficient of friction µ
    """

    name: str
    body: Body
    friction: float

    @property
    def history(self) -> tuple[LoadStep, ...]:
        """Load steps of the contact: pressing, tangential loop along x, turn of the force,
        unloading.
        """
        push = 2 / 3 * self.friction * NORMAL_FORCE
        return _loop_and_turn(
            "normal_force", "tangential_force", NORMAL_FORCE, push, 0.7 * NORMAL_FORCE
        )

    def scene(self, loading: tuple[LoadStep, ...], way: str) -> Scene:
        """Create the scene of the rigid ball on the body with the given load steps.

        loading  load steps
        way      addition to the title of the scene
        """
        title = f"Rigid ball on a body: {self.name}{way}"
        return pressed(title, rigid_ball(), self.body, *loading, friction=self.friction)

    def run(self, cells: int) -> Run:
        """Create the run of the contact on cells.

        cells  number of cells per side of the window
        """
        grid = square_grid(cells, 1.2 * HERTZ.contact_radius)
        # Finite elements have no edge correction.
        return Run(self.name, self.scene(self.history, ""), grid, edge="off")

    def led_run(self, cells: int) -> Run:
        """Create the run of the contact on cells with prescribed motions in place of the forces.

        cells  number of cells per side of the window
        """
        depth, way = HERTZ.approach, ", led by motion"
        shift = 0.5 * self.friction * depth  # about half of that at gross slip
        loading = _loop_and_turn("approach", "tangential_shift", depth, shift, 0.8 * depth)
        return replace(self.run(cells), label=f"{self.name}{way}", scene=self.scene(loading, way))

    def section(self, elements: int, harmonics: int) -> SectionRun:
        """Create the finite element run of the first load steps, whose tangential force acts along
        x.

        elements   number of elements per contact radius
        harmonics  highest angular harmonic
        """
        mesh = per_radius(elements, HERTZ.contact_radius).model_copy(
            update={"harmonics": harmonics}
        )
        label = f"{self.name}, {elements} elements per radius"
        return SectionRun(label, self.scene(self.history[:BACK], ", to and fro"), mesh)


def _loop_and_turn(
    normal: str, tangential: str, press: float, push: float, release: float
) -> tuple[LoadStep, ...]:
    """Create load steps that press, push to and fro along x, turn, and unload.

    normal, tangential    names of the prescribed forces or motions
    press, push, release  values at the end of pressing, of the push and of unloading
    """
    ends = (
        (normal, press, 6),
        (tangential, (push, 0.0), 2),
        (tangential, (-push, 0.0), 3),
        (tangential, (-0.3 * push, 0.7 * push), 2),
        (normal, release, 2),
    )
    return tuple(
        LoadStep.model_validate({name: end, "increments": count}) for name, end, count in ends
    )


def coupled_history(level: Level = Level.QUICK) -> Case:
    """Create the verification case of tangential loops, turns and unloading with coupled pressure
    and shear.

    No closed form exists. A history on cells is compared with finite elements. The laws of contact
    and friction are judged in all histories; in some of them motions are prescribed.
    """
    cells, elements, harmonics = {
        Level.QUICK: (32, 16, 4),
        Level.STANDARD: (64, 32, 8),
        Level.FULL: (128, 64, 12),
    }[level]
    bare = CoupledContact("homogeneous, µ = 0.3", Body(material=SUBSTRATE), 0.3)
    filmed = CoupledContact("coated, µ = 0.1", FILMED, 0.1)
    # Allowed difference and scalar, by name of the verdict.
    read = {
        "shift": (5e-3, "tangential_shift"),
        "energy": (1.5e-2, "dissipated_energy"),
        "approach": (1e-3, "approach"),
    }
    return case(
        "coupled_history",
        "Tangential loop, turn and unloading with coupling",
        "A rigid ball is pressed on bodies that couple pressure and shear. A tangential force of "
        "two thirds of µW is applied, reversed and turned; then the contact is unloaded under "
        "that force. The effects of reversal, turn and unloading on the surface have no closed "
        "form here. Its first steps are therefore also solved by finite elements. A history of the "
        "same kind prescribes approach and shift; its laws are judged as those of all runs.",
        *(
            compared(
                f"{name}_{'pushed' if step == PUSHED else 'back'}",
                f"difference of the {scalar.replace('_', ' ')} after the "
                f"{'push' if step == PUSHED else 'reversal'}, relative",
                bare.section(elements, harmonics),
                bare.run(cells),
                partial(relative_difference, scalar, step - 1),
                allowed * 32 / cells,
                "set by hand: about three times the error of both on the quick "
                "discretisations, proportional to the cell side on others; a loop without "
                "memory of its first half has an error of 0.2",
                "the other solver, on the same increments",
                ReferenceKind.OTHER_SOLVER,
            )
            for step in (PUSHED, BACK)
            for name, (allowed, scalar) in read.items()
        ),
        Judged(runs=(filmed.run(cells), bare.led_run(cells), filmed.led_run(cells))),
        limits=("All solves take equal increments, so that the increment error is not visible.",),
        equations=(ROTATION,),
        no_order=IDENTITY,
        shows=("load history",),
    )


MU = 0.2  # coefficient of friction
PART = 0.6  # tangential force over µW
PUSH = LoadStep(tangential_force=(PART * MU * NORMAL_FORCE, 0.0), increments=2)


def _patchy_friction(grid: SurfaceGrid) -> Field:
    """Return a friction coefficient for each cell that varies along x and y and is zero in patches.

    The field has no symmetry, so that exchanged axes or mirror errors become visible.
    """
    x, y = (c / HERTZ.contact_radius for c in grid.coordinates())
    waves = np.sin(3 * x + 0.4) + 0.6 * np.sin(5 * y - 1.1 * x)
    return np.asarray(np.maximum(MU * (1.2 + 0.9 * waves), 0.0))


def scalars_apart(one: Any, other: Any) -> float:
    """Compute the largest relative difference of approach, shift and dissipated energy at the end
    of two results [1].
    """
    names = ("approach", "tangential_shift", "dissipated_energy")
    return worst(*(relative_difference(name, -1, one, other) for name in names))


def same_surface(level: Level = Level.QUICK) -> Case:
    """Create the verification case of different inputs that describe one contact, on cells.

    The inputs are height maps, friction maps and rectangular cells. All must give equal results.
    """
    # An odd number of cells has a central cell, in which the height of the ball is zero.
    cells = 32 * 2**level + 1
    width, longer = 2 * 1.2 * HERTZ.contact_radius, 4 / 3
    square = SurfaceGrid((cells, cells), (width, width))
    patches = _patchy_friction(square)
    heights: Any = np.asarray(rigid_ball().initial_gap(*square.coordinates()))

    def run(label: str, what: str, grid: SurfaceGrid = square, **other: Any) -> Run:
        """Create a run of the rigid ball on the coated body, with one change of the input.

        label  label of the run
        what   description of the changed input
        grid   grid of cells
        other  changed indenter, friction, or rotation of the load in degrees
        """
        chosen: dict[str, Any] = {
            "indenter": rigid_ball(),
            "friction": MU,
            "degrees": 0.0,
        } | other
        scene = Scene(
            title=f"Rigid ball on a coated body, pressed and pushed: {what}",
            indenter=chosen["indenter"],
            body=FILMED,
            friction=CoulombFriction(coefficient=chosen["friction"]),
            loading=turned((pressing(3), PUSH), chosen["degrees"]),
        )
        return Run(label, scene, grid)

    def mapped(coefficients: Field) -> FrictionMap:
        return FrictionMap.model_validate({"map": coefficients, "spacing": square.spacing})

    by_numbers = run("told by numbers", "numbers")
    by_heights = run(
        "ball as a map of heights",
        "heights",
        indenter=HeightMap(file=heights, spacing=square.spacing, material=RIGID),
    )
    everywhere = run(
        "the same friction in every cell",
        "friction",
        friction=mapped(np.full(square.cells, MU)),
    )
    patchy = run("patchy friction", "patches", friction=mapped(patches))
    mirrored = run(
        "patchy friction mirrored",
        "mirrored patches",
        friction=mapped(patches[::-1]),
        degrees=180.0,
    )
    narrow = run(
        "cells longer along y", "long cells", SurfaceGrid((cells, cells), (width, longer * width))
    )
    wide = run(
        "cells longer along x",
        "wide cells",
        SurfaceGrid((cells, cells), (longer * width, width)),
        degrees=90.0,
    )
    same, all_fields = "the same surface", "difference of all fields"
    return case(
        "same_surface",
        "Equivalent descriptions of one surface",
        "The rigid ball on a coated body is pressed with friction and loaded by a tangential "
        "force of 0.6 µW. Variants describe the ball as a map of heights and the friction as a "
        "constant map, use patches of friction and their mirror image, and take rectangular "
        "cells. Each variant is equivalent to another run, directly or after a reflection or "
        "rotation.",
        compared(
            "heights",
            f"ball as a map of heights: {all_fields}",
            by_heights,
            by_numbers,
            as_it_is,
            ROUNDING,
            "heights at cell centres equal the gap there, bit for bit",
            same,
        ),
        compared(
            "friction",
            f"constant map of friction: {all_fields}",
            everywhere,
            by_numbers,
            as_it_is,
            EXACT,
            ANSWERED,
            same,
        ),
        compared(
            "mirror",
            f"mirrored patches of friction: {all_fields}",
            mirrored,
            patchy,
            in_mirror,
            EXACT,
            ANSWERED,
            "a reflection at x = 0 maps one to the other",
        ),
        compared(
            "turned_by_90",
            "rectangular cells, rotated with the load: difference of pressure, shear and shift",
            wide,
            narrow,
            after_quarter,
            EXACT,
            ANSWERED,
            ISOTROPIC,
        ),
        compared(
            "square_cells",
            "rectangular cells: difference of approach, shift and energy "
            "from those of square cells, relative",
            narrow,
            by_numbers,
            scalars_apart,
            1.5e-3 * 33 / cells,
            "set by hand: about three times the error of cells longer by a third on a 33 x "
            "33 grid, proportional to the cell side on others",
            # At first order the error of the square cells is three times the difference.
            "the same contact",
            ReferenceKind.OWN_REFINEMENT,
            0.75e-3 * 33 / cells,
        ),
        equations=(ROTATION,),
        no_order=IDENTITY,
        shows=("effects",),
    )


def forced_effects(level: Level = Level.QUICK) -> Case:
    """Create the verification case of physical effects that are computed although they vanish.

    The solver omits effects that a scene does not need, such as the coupling of pressure and shear
    for equal bodies. Each scene is solved with and without the omission; the results must be equal.
    """
    cells = 48 if level is Level.QUICK else 96
    grid = square_grid(cells, 1.3 * HERTZ.contact_radius)
    one_film = film(2.0, 1.0)
    coated_ball = Paraboloid(radius=RADIUS, material=SUBSTRATE, layers=(one_film,))
    way = (pressing(), *(tangential_step(part, increments=2) for part in (0.9, -0.9)))
    scenes = {
        "frictionless": pressed("The paper's ball without friction", rigid_ball(), SUBSTRATE),
        "frictionless coated": pressed(
            "The paper's ball on a coating, without friction", rigid_ball(), FILMED
        ),
        **{
            f"{name} sheared": pressed(title, ball, body, *way, friction=FRICTION)
            for name, title, ball, body in (
                ("alike bodies", "Two alike bodies", paraboloid(STEEL), STEEL),
                ("alike coated bodies", "Two alike coated bodies", coated_ball, FILMED),
                ("rigid ball on coating", "The paper's ball on a coating", rigid_ball(), FILMED),
            )
        },
    }
    return case(
        "forced_effects",
        "Only the effects that a scene needs",
        "Scenes whose plan omits effects because they vanish: shear without friction, tilt and "
        "torsion without a moment or torque, the coupling of pressure and shear for equal "
        "bodies, and the mirror images of tractions. Each scene is solved again with all effects "
        "on. The results must be equal.",
        *(
            compared(
                name.replace(" ", "_"),
                f"{name}: largest difference of pressure, shear, approach and shift",
                Run(f"{name}, as planned", scene, grid),
                Run(f"{name}, all effects on", scene, grid, effects=all_effects),
                as_it_is,
                EXACT,
                "both solves leave residuals up to the solver's tolerance, amplified a few times "
                "in the tractions",
                "effects that vanish change nothing",
            )
            for name, scene in scenes.items()
        ),
        equations=(r"\mathbf{C}_{xz} = 0 \Rightarrow p\ \text{and}\ \mathbf{q}\ \text{uncoupled}",),
        no_order=IDENTITY,
        shows=("effects",),
    )


@dataclass(frozen=True)
class BodyPair:
    """Hold the materials and layers of two bodies in contact, of which the upper body is a ball.

    name   description of the pair
    lower  material and layers of the lower body
    upper  material and layers of the ball
    """

    name: str
    lower: Body
    upper: Body

    @property
    def exchanged(self) -> BodyPair:
        """Pair in which the materials and layers of ball and lower body are exchanged."""
        return replace(self, name=f"{self.name}, exchanged", lower=self.upper, upper=self.lower)

    def scene(self, *loading: LoadStep) -> Scene:
        """Create the scene of the ball on the lower body, with friction, under the given load
        steps.
        """
        ball = Paraboloid(radius=RADIUS, material=self.upper.material, layers=self.upper.layers)
        return pressed(self.name, ball, self.lower, *loading, friction=MU)


after_half = partial(same_fields, lambda p: p[::-1, ::-1], lambda q: q[:, ::-1, ::-1], np.asarray)


def on_rings_apart(one: Any, other: Any) -> float:
    """Compute the difference of two axisymmetric results after an exchange of the bodies [1].

    The exchange reverses the sign of the radial shear. The result is the largest difference of
    pressure, approach and radial shear over all increments, from the radial solver or finite
    elements.
    """

    def outward(increment: Any) -> Any:
        shear = increment.shear_radial
        return np.zeros_like(increment.radii) if shear is None else shear

    def apart(a: Any, b: Any) -> float:
        r = b.radii
        total = np.trapezoid(b.pressure * r, r)
        return worst(
            float(np.trapezoid(np.abs(a.pressure - b.pressure) * r, r) / total),
            float(np.trapezoid(np.abs(outward(a) + outward(b)) * r, r) / total),
            abs(a.approach / b.approach - 1),
        )

    return worst(*map(apart, one.increments, other.increments))


def exchanged_bodies(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a ball and a lower body that exchange their materials.

    A reflection maps one contact to the other, so that the results must be equal. Cells, finite
    elements and the radial solver are judged.
    """
    source = (
        "a reflection in the contact plane exchanges the bodies and reverses the tangential "
        "force, and half a turn about z reverses it back; the gap does not depend on which body "
        "is curved"
    )
    same = "largest difference of pressure, shear, approach and shift, after half a turn"
    cells = 32 * 2**level
    grid = square_grid(cells, 1.3 * HERTZ.contact_radius)
    elements = per_radius(12 * 2**level, 1.3 * HERTZ.contact_radius)
    pairs = (
        BodyPair("rigid ball on a body", Body(material=SUBSTRATE), Body(material=RIGID)),
        BodyPair(
            "ball on its own material, coated", coated(film(2.0, 0.5)), Body(material=SUBSTRATE)
        ),
    )
    contacts: list[tuple[str, AnyRun, AnyRun, Difference]] = []
    for pair in pairs:
        both = (pair.exchanged, pair)
        one, other = (Run(p.name, p.scene(pressing(3), PUSH), grid) for p in both)
        contacts.append((pair.name, one, other, after_half))
        ring, beside = (
            SectionRun(f"{p.name}, elements", p.scene(pressing(3)), elements) for p in both
        )
        contacts.append((pair.name, ring, beside, on_rings_apart))
    by_radii = [
        RadiiRun(f"{p.name}, rings", p.scene(pressing(3)), rings=128)
        for p in (pairs[0].exchanged, pairs[0])
    ]
    contacts.append((pairs[0].name, by_radii[0], by_radii[1], on_rings_apart))

    return case(
        "exchanged_bodies",
        "Bodies exchanged",
        "A rigid ball on an elastic body, and an elastic ball on a rigid body, are pressed with "
        "friction and loaded tangentially; likewise a ball on its own material under a coating, "
        "and a coated ball on the bare material. Finite elements and the ring solver have the "
        "normal load only. A reflection maps one pair to the other.",
        *(
            compared(
                "exchanged",
                f"{name}: {same}",
                one,
                other,
                difference,
                EXACT,
                ANSWERED,
                source,
            )
            for name, one, other, difference in contacts
        ),
        limits=(
            "Both results of a pair could have the same error; frictional_indentation judges "
            "one of them.",
        ),
        equations=(
            r"p(\mathbf{x}) \to p(-\mathbf{x}),\quad \mathbf{q}(\mathbf{x}) \to "
            r"\mathbf{q}(-\mathbf{x})",
        ),
        no_order=IDENTITY,
        shows=("unlike bodies",),
    )


def _load_vector(increment: Any, name: str) -> Field:
    value = getattr(increment, name)
    return np.atleast_1d(np.asarray(0.0 if value is None else value, dtype=float))


def off_the_way(scene: Scene, result: Any) -> float:
    """Compute by how much the prescribed quantity of the increments deviates from the linear ramp
    [1].

    The prescribed quantity of a load step is a force, moment or displacement. Its value at each
    increment must lie on the line from the start to the end of the step. In the first load step the
    normal force is that of a contact radius that grows linearly. The deviation is relative to the
    larger end value.

    scene   scene with the load steps
    result  result with all increments
    """
    off = 0.0
    for number, step in enumerate(scene.loading, start=1):
        (name,) = (n for pair in CONTROLS for n in pair if getattr(step, n) is not None)
        inside = [increment for increment in result.increments if increment.step == number]
        if not inside:
            return float("nan")
        values = np.array([_load_vector(increment, name) for increment in inside])
        named = np.atleast_1d(np.asarray(getattr(step, name), dtype=float))
        way = np.arange(1, len(inside) + 1) / len(inside)
        before = [increment for increment in result.increments if increment.step < number]
        start = _load_vector(before[-1], name) if before else 0.0 * named
        straight = start + (way if before else way**3)[:, None] * (named - start)
        scale = max_norm([start, named])
        off = worst(off, max_norm(values - straight) / scale)
    return off


def led_histories(level: Level = Level.QUICK) -> Case:
    """Create the verification case of load steps that alternate between force and displacement
    control.

    Judged are the prescribed quantity in every increment and the number of increments.
    """
    ball, limit = paraboloid(NU_ZERO), FRICTION * NORMAL_FORCE
    punch = FlatPunch(radius=HERTZ.contact_radius, material=NU_ZERO)
    # The whole face is in contact for up to a third of the radius.
    moment = 0.1 * HERTZ.contact_radius * NORMAL_FORCE
    slope = 0.1 * HERTZ.approach / HERTZ.contact_radius

    def scene(
        title: str, indenter: Paraboloid | FlatPunch, force: str, motion: str, *ends: Any
    ) -> Scene:
        """Create a scene that prescribes a force, a motion and the force again at these ends."""
        led = (
            LoadStep.model_validate({name: end, "increments": count})
            for name, end, count in zip((force, motion, force), ends, (2, 4, 3), strict=True)
        )
        held = () if force == "normal_force" else (pressing(1),)
        return frictional(title, indenter, NU_ZERO).model_copy(update={"loading": (*held, *led)})

    scenes = {
        "pressed": scene(
            "Ball led by force, approach and force",
            ball,
            "normal_force",
            "approach",
            0.5 * NORMAL_FORCE,
            HERTZ.approach,
            0.7 * NORMAL_FORCE,
        ),
        "pushed": scene(
            "Ball led by push, shift and push",
            ball,
            "tangential_force",
            "tangential_shift",
            (0.4 * limit, 0.0),
            (0.5 * SLIDING_SHIFT, 0.0),
            (0.1 * limit, 0.0),
        ),
        "twisted": scene(
            "Ball led by torque, twist and torque",
            ball,
            "torque",
            "twist",
            0.4 * SLIDING_TORQUE,
            0.5 * LARGEST.twist,
            0.1 * SLIDING_TORQUE,
        ),
        "tilted": scene(
            "Punch led by moment, tilt and moment",
            punch,
            "moment",
            "tilt",
            (0.5 * moment, moment),
            (slope, 0.5 * slope),
            (-moment, 0.0),
        ),
    }
    grid = square_grid(48 * 2**level, 1.3 * HERTZ.contact_radius)
    mesh = per_radius(16 * 2**level, HERTZ.contact_radius)
    upright = ("pressed", "pushed", "twisted")  # finite elements keep the indenter upright
    runs: tuple[Run | SectionRun, ...] = (
        # A load step starts from the state of the preceding step before its edge correction.
        *(Run(name, one, grid, edge="off") for name, one in scenes.items()),
        *(SectionRun(f"{name}, elements", scenes[name], mesh) for name in upright),
    )
    linear = identity(0.0, "a step ramps linearly from the end of the preceding step")

    def named(run: Run | SectionRun) -> float:
        return float(sum(step.increments or 0 for step in run.scene.loading))

    return case(
        "led_histories",
        "Alternating force and displacement control",
        "A ball is loaded by a force, an approach and a force again, by tangential forces and a "
        "shift, by torques and a twist; a flat punch is loaded by moments and a tilt. A step "
        "with another kind of control starts at the end of the preceding step and is linear, in "
        "the number of increments of the scene.",
        Judged(
            runs=runs,
            quantities=(
                *(
                    Quantity(
                        "off_the_way",
                        "largest distance of the prescribed quantity from the linear "
                        "ramp of its step, over the larger of its ends",
                        "",
                        run.label,
                        partial(off_the_way, run.scene),
                        linear,
                        Required(
                            1e-6, "forces are met to the tolerance of the solver, motions exactly"
                        ),
                        1.0,
                        "1",
                    )
                    for run in runs
                ),
                *(
                    Quantity(
                        "increments",
                        "increments of all steps",
                        "",
                        run.label,
                        lambda result: float(len(result.increments)),
                        Reference(named(run), linear.kind, "the scene prescribes them"),
                        Required(1e-9, "a number of increments is met or not"),
                    )
                    for run in runs
                ),
            ),
        ),
        equations=(r"c(t) = c_0 + (c_1 - c_0)\, t,\quad 0 \le t \le 1",),
        no_order=IDENTITY,
        shows=("prescribed motion", "load history"),
    )


def fem_far_field(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the boundary of the finite element mesh far from the contact.

    A flat punch under a torque is solved on a small and a large mesh. The twists must agree,
    because the boundary moves as a half-space under the resultant load.
    """
    near, far = 5.0, 100.0  # box over radius
    power = 5  # of radius over box: the error if the boundary moves by the exact resultant
    # Coarser elements differ between the boxes by more than the boundary.
    mesh = per_radius((32, 48, 64)[level], PUNCH_RADIUS)
    small, large = (
        SectionRun(
            f"twisted, box of {box:g} radii", STUCK.scene, mesh.model_copy(update={"box": box})
        )
        for box in (near, far)
    )
    return case(
        "fem_far_field",
        "Finite elements: the half-space beyond the box",
        f"A flat punch sticks in a box of {near:g} and of {far:g} of its radii. It is pressed, "
        "and then loaded by a torque. On the boundary of the box the displacement is that of a "
        "half-space under the resultant; a fixed boundary would reduce the motion of the punch. In "
        "the usual box the displacements by forces are visible, and other cases judge them.",
        compared(
            "twist",
            "twist of the punch: relative difference",
            small,
            large,
            partial(relative_difference, "twist", -1),
            near**-power,
            f"the resultant is known on the box; the next term falls with the power {power} "
            "of the radius over the box",
            "the same contact in a larger box",
            ReferenceKind.OWN_REFINEMENT,
            far**-power,
        ),
        equations=(r"\mathbf{u} = \mathbf{u}_\mathrm{Boussinesq-Cerruti}(W, T, M) + O(a^n/R^n)",),
        no_order="the allowed difference is itself the power law of the box",
        shows=("finite elements",),
    )
