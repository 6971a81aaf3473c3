"""Families of randomly drawn scenes, and functions that compute the answers of the scenes.

A family consists of distributions of bodies, shapes and load histories. The answers come from the
radial solver, closed forms, and solutions with more cells and increments. A function may replace
prescribed forces by displacements. No function uses an error estimate, because error estimates are
judged by these numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, sqrt
from typing import Any, NamedTuple, TypeVar
from zlib import crc32

import numpy as np

import radial
import semi_analytical
from contact_errors.error_formula import Values, prescribed_scalars, values_of
from contact_errors.stress_errors import stress_errors
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.stress_maxima import extremes
from contact_scene import (
    RIGID,
    CoulombFriction,
    Ellipsoid,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.array_types import Array
from contact_scene.body_pair import contact_modulus, coupling
from contact_scene.contact_features import AT_EDGES
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.stated_error import (
    StatedError,
    StatedErrors,
)
from contact_scene.solver_errors import ContactAtWindowEdge, UnsupportedScene
from contact_scene.stepping.increment_error import has_increment_error
from verification.closed_forms.cattaneo_mindlin import CycledContact, PartialSlip
from verification.closed_forms.hertz import EllipticalContact
from verification.closed_forms.huber_stress import (
    stress_by_hertz_pressure,
    stress_by_partial_slip,
)
from verification.problems.drawn import drawing as of
from verification.problems.drawn.drawing import (
    AMPLITUDE,
    APPROACH,
    CELLS,
    CYCLE,
    ELASTIC,
    ELEMENTS,
    ENERGY,
    F1,
    F2,
    KIND_OF,
    MOMENT,
    NORMAL,
    PEAK,
    RADIUS,
    SHIFT,
    STICK,
    STRESSES,
    TANGENTIAL,
    TENSION,
    TILT,
    TORQUE,
    TWIST,
    WORK,
    Bodies,
    Fineness,
    KnownScene,
    Profile,
    Rng,
    Truth,
    closes,
    known,
    logarithmic,
)
from verification.problems.problem import ROUNDING

WHOLE = "body"  # name of the region of the whole body


def stress_maxima(
    result: Any, step: int, errors: StatedErrors | None = None
) -> dict[str, tuple[float, StatedError]]:
    """Compute the largest stresses in the lower body at the end of a load step, with stated errors.

    Returns value and error by stress measure, such as "von_mises" [force/length²].

    result  result of any solver
    step    number of the load step, from 1
    errors  stated errors of the result, if they are known
    """
    state = state_of_result(result, step, errors)
    field = body_response(state).stress()
    found = extremes(field)
    of_stress = stress_errors(state, field, found)
    return {
        e.measure: (e.value, error)
        for e, error in zip(found, of_stress, strict=True)
        if e.region == WHOLE
    }


BY_MOTION = 0.3  # fraction of the scenes with prescribed motions
ROOM = 1.5  # smallest distance of an eccentric contact from the window edge, in cells
FAR = 50.0  # prescribed shift over the shift at the onset of gross slip
TURNED = 1e-3  # relative error caused by slip across such a shift
# Factor on rings, orders, points and increments of the radial solver for the finer solution.
DOUBLED = 2
# Factors on the numbers of judged cells per side for the references. The error of the finer solve
# is 2.5 times the difference of both solves at order 1, and about the difference at order 2.
FINER = (3.5, 2.5)
ORDER_ONE = 2.5
# Smallest numbers of increments per step; steps with more increments are scaled in proportion. The
# limit of many increments is extrapolated from the first two numbers. Its error is the difference
# from the extrapolation of the last two. The effect of increments on the judged cells differs by
# the fraction `OTHER_CELLS` from that on fine cells.
MANY = (32, 16, 8)
OTHER_CELLS = 0.07
SIMILAR_ERROR = 1e-9
# Quantities that do not repeat by symmetry at the reversals of a loop.
PER_CYCLE = (ENERGY, CYCLE, AMPLITUDE, F1, F2)
# Quantities that are zero before the first tangential force or torque.
LED = (SHIFT, TANGENTIAL, TWIST, TORQUE)


@dataclass(frozen=True)
class Posed:
    """Hold a randomly drawn scene for which the answer is still to be computed.

    scene     bodies and loads
    fineness  discretisation that is judged
    forces    tangential forces or torques at the ends of the load steps after the normal loading
    stressed  True if the largest stresses are judged
    """

    scene: Scene
    fineness: Fineness
    forces: tuple[float, ...] = ()
    stressed: bool = False

    @property
    def load(self) -> float:
        """Normal force of the first load step [force]."""
        load = self.scene.loading[0].normal_force
        assert load is not None
        return load

    def followed_by(self, steps: Iterable[LoadStep]) -> Scene:
        """Return the scene with other load steps after the normal loading."""
        loading = self.scene.loading[0], *steps
        return self.scene.model_copy(update={"loading": loading})

    def known(self, truths: Iterable[Truth], scene: Scene | None = None) -> KnownScene:
        """Combine the scene with those of its known numbers that are judged.

        Infinite, zero and prescribed numbers are left out. So are numbers that repeat an earlier
        number by symmetry, or agree with a selected number in unit and two digits, because their
        errors are equal.

        truths  known numbers
        scene   scene to judge; default: the drawn scene
        """
        scene, sizes, seen = scene or self.scene, [0.0, *map(abs, self.forces)], set()
        infinite = scene.indenter.rim is not None or scene.indenter.gap_exponent == 1
        path, kept = scene.load_path(), []
        for truth in truths:
            name, step = truth.quantity, truth.step
            value = f"{abs(truth.value):.2g}", getattr(SCALARS.get(name), "unit", name)
            repeated = step > 2 and sizes[step - 1] == sizes[1] and name not in PER_CYCLE
            shared = name == ENERGY and closes(self.forces)
            endless = name == PEAK and infinite
            still = name in LED and not any(sizes[:step])
            given = name in prescribed_scalars(path[step - 1], None)
            absent = truth.value == 0
            if not (absent or repeated or shared or endless or still or given or value in seen):
                kept.append(truth)
                seen.add(value)
        return KnownScene(scene, tuple(kept), self.fineness)


class Pressed(NamedTuple):
    """Hold the numbers of a frictionless contact under a normal force.

    load      normal force [force]
    approach  approach of the bodies [length]
    radius    contact radius, or √(ab) of an ellipse with semi-axes a and b [length]
    peak      largest pressure [force/length²]
    elastic   elastic energy [force*length]
    """

    load: float
    approach: float
    radius: float
    peak: float
    elastic: float

    @property
    def values(self) -> dict[str, float]:
        return {
            APPROACH: self.approach,
            RADIUS: self.radius,
            PEAK: self.peak,
            ELASTIC: self.elastic,
            WORK: self.elastic,
        }


def pressed(scene: Scene, load: float) -> Pressed:
    """Solve the frictionless contact of a scene under a normal force, as reference.

    An ellipsoid is solved in closed form, other shapes by the radial solver.

    scene  bodies of the contact; friction and loads are ignored
    load   normal force [force]
    """
    if isinstance(tip := scene.indenter, Ellipsoid):
        contact = EllipticalContact.under_load(load, tip.radii, contact_modulus(scene))
        radius = sqrt(contact.semi_axes[0] * contact.semi_axes[1])
        elastic = 0.4 * load * contact.approach
        return Pressed(load, contact.approach, radius, contact.peak_pressure, elastic)
    end = rings(scene, load)
    return Pressed(load, end.approach, end.contact_radius, end.peak_pressure, end.elastic_energy)


def rings(scene: Scene, load: float) -> Any:
    """Solve the frictionless contact of a scene by the radial solver, and return its last
    increment.

    scene  bodies of the contact; friction and loads are ignored
    load   normal force [force]
    """
    alone = {"friction": None, "loading": (LoadStep(normal_force=load),)}
    return radial.solve(scene.model_copy(update=alone)).steps[-1]


# ---- rules --------------------------------------------------------------------------------------


def by_rings(rng: Rng, posed: Posed) -> KnownScene:
    """Compute the known numbers of a randomly drawn scene by the radial solver.

    The difference from a solution with half the rings and increments is the uncertainty. In some
    scenes with one load step the prescribed force is replaced by the resulting approach.

    rng    random generator, for this choice
    posed  scene without answer
    """
    once = radial.solve(posed.scene)
    counts = tuple(DOUBLED * n if n > 1 else n for n in once.plan.increments)
    finer = replace(once.plan, increments=counts, fineness=DOUBLED)
    twice = radial.solve(posed.scene, plan=finer)
    truths = posed.known(_compared_truths(once, twice, posed.stressed)).truths
    if rng.random() >= BY_MOTION or len(posed.scene.loading) > 1:
        return KnownScene(posed.scene, truths, posed.fineness)
    end, step = twice.steps[0], Truth(1, NORMAL, posed.load, ROUNDING * posed.load)
    led = posed.scene.model_copy(update={"loading": (LoadStep(approach=end.approach),)})
    return posed.known((*truths, step), led)


def _compared_truths(once: Any, twice: Any, stressed: bool) -> Iterator[Truth]:
    both = [values_of(result) for result in (once, twice)]
    for step, (less, more) in enumerate(zip(*both, strict=True), start=1):
        for name in (name for name in KIND_OF if name in less and name in more):
            yield _ring_truth(
                step, name, float(more[name][0]), abs(float((more[name] - less[name])[0]))
            )
    if stressed:
        for name, (value, error) in stress_maxima(twice, 1).items():
            if isinstance(error.error, float) and name in STRESSES:
                yield _ring_truth(1, name, value, error.error)


def _ring_truth(step: int, name: str, value: float, apart: float) -> Truth:
    return Truth(step, name, value, max(apart, ROUNDING * abs(value)))


def beside_the_centre(rng: Rng, posed: Posed) -> KnownScene:
    """Apply a tilt or a moment to a paraboloid, and compute the known numbers of the tilted
    contact.

    By x²/2R - φx = (x - Rφ)²/2R - Rφ²/2, a tilt φ only shifts a paraboloid of radius R.

    rng    random generator, for the position of the contact
    posed  scene without answer, with one load step
    """
    tip, grid = posed.scene.indenter, posed.fineness.asked
    load = posed.load
    assert isinstance(tip, Paraboloid)
    assert isinstance(grid, SurfaceDiscretisation)
    upright = pressed(posed.scene, load)
    side = np.divide(grid.window or 0.0, grid.cells or 1)
    room = np.array(grid.window) / 2 - upright.radius - ROOM * side
    x, y = (float(place) for place in rng.uniform(-1, 1, 2) * np.maximum(room, side / 2))
    both = {TILT: (y / tip.radius, x / tip.radius), MOMENT: (load * y, load * x)}
    named = (TILT, MOMENT)[int(rng.integers(2))]
    values = upright.values | {name: value[0] for name, value in both.items()}
    values[APPROACH] -= (x**2 + y**2) / (2 * tip.radius)
    del values[WORK]
    tilted = LoadStep(normal_force=load, **{named: both[named]})  # type: ignore[arg-type]
    scene = posed.scene.model_copy(update={"loading": (tilted,)})
    return posed.known(known(1, values, ROUNDING), scene)


@dataclass(frozen=True)
class Similar:
    """Compute partial slip of uncoated bodies as the difference of two frictionless contacts.

    The bodies have one material with ν = 0 (Jäger 1998, Ciavarella 1998). The shear is µ times the
    difference of two pressures. After a reversal the curve of the first loading is doubled
    (Masing). With S = ∫ shift dT, a first loading dissipates T shift - 2 S, a quarter of the energy
    of a closed loop.

    scene  scene with the two bodies
    load   normal force [force]
    mu     coefficient of friction
    """

    scene: Scene
    load: float
    mu: float

    @cached_property
    def full(self) -> Pressed:
        return pressed(self.scene, self.load)

    def first(self, force: float) -> Array:
        """Compute the state after the tangential force has grown from zero.

        Returns shift, stick radius, dissipated energy, and elastic energy stored by the shear, as
        an array (4,) in SI units.

        force  tangential force at the end [force]
        """
        stick = pressed(self.scene, self.load - force / self.mu)
        shift = self.mu * (self.full.approach - stick.approach)
        full, part = (p.load * p.approach - p.elastic for p in (self.full, stick))
        area = self.mu**2 * (self.full.approach * (self.load - stick.load) - full + part)
        lost = force * shift - 2 * area
        return np.array([shift, stick.radius, lost, (force * shift - lost) / 2])

    def along(self, forces: Sequence[float]) -> Iterator[Array]:
        """Yield the states at the ends of several tangential load steps, by Masing's rule.

        Each state is an array (4,) of shift, stick radius, dissipated energy, and elastic energy
        stored by the shear, in SI units.

        forces  tangential forces at the ends of the load steps [force]
        """
        last = 0.0
        direction = 1.0
        turn = 0.0
        reached, base = np.zeros(4), None
        for force in forces:
            if np.sign(force - last) != direction:
                direction, base, turn = -direction, reached, last
            if base is None:
                reached = self.first(force)
            else:
                half = self.first(abs(turn - force) / 2)
                slid, stored = 2 * direction * half[0], direction * (turn + force) * half[0]
                reached = base + np.array([slid, half[1] - base[1], 2 * half[2], stored])
            last = force
            yield reached

    def truths(self, forces: Sequence[float]) -> Iterator[Truth]:
        """Yield the known numbers at the ends of all load steps, including the normal loading.

        forces  tangential forces at the ends of the load steps after the normal loading [force]
        """
        states = list(self.along(forces))
        values = [self.full.values]
        for force, (shift, stick, lost, stored) in zip(forces, states, strict=True):
            elastic = self.full.elastic + stored
            values.append(
                {
                    SHIFT: shift,
                    TANGENTIAL: force,
                    STICK: stick,
                    ENERGY: lost,
                    ELASTIC: elastic,
                    WORK: elastic + lost,
                }
            )
        if closes(forces):
            values[-1] |= {CYCLE: states[-1][2] - states[0][2]}
        for step, found in enumerate(values, start=1):
            yield from known(step, found, SIMILAR_ERROR)


def similar(rng: Rng, posed: Posed) -> KnownScene:
    """Compute the known numbers of uncoated bodies under tangential forces, in closed form.

    In some scenes the tangential forces are replaced by the corresponding shifts.

    rng    random generator, for this choice
    posed  scene without answer
    """
    made, scene = _similar_of(posed), posed.scene
    if rng.random() < BY_MOTION:
        shifts = (LoadStep(tangential_shift=(s[0], 0.0)) for s in made.along(posed.forces))
        scene = posed.followed_by(shifts)
    truths = [*made.truths(posed.forces)]
    if isinstance(scene.indenter, Paraboloid):
        truths += _ball_truths(made, posed)
    return posed.known(truths, scene)


def slid(rng: Rng, posed: Posed) -> KnownScene:
    """Shift a pressed ball far beyond the onset of gross slip, and compute its known numbers.

    The numbers are those of the normal contact, the tangential force µW, and the tensile stress.

    rng    random generator, which is not used
    posed  scene without answer, with a ball
    """
    made, tip = _similar_of(posed), posed.scene.indenter
    assert isinstance(tip, Paraboloid)
    far = FAR * made.mu * made.full.radius**2 / tip.radius
    scene = posed.followed_by([LoadStep(tangential_shift=(far, 0.0))])
    # Hertz 1882 and Hamilton 1966.
    tension = {TENSION: _edge_tension(made, 0.0), TANGENTIAL: made.mu * made.load}
    return posed.known((*known(1, made.full.values, ROUNDING), *known(2, tension, TURNED)), scene)


def loops_in_gross_slip(rng: Rng, posed: Posed) -> KnownScene:
    """Shift a pressed ball to and fro beyond the onset of gross slip, in closed form for ν = 0.

    With the approach δ, the shift at the onset is µδ. The first loading to a shift D dissipates the
    energy e = µ² (W δ - 2 E) up to the onset and µW (D - µδ) beyond, with the elastic energy E of
    the pressing. A reversal has twice the onset and twice e (Masing). While all points slide, the
    elastic displacement of the surfaces is µ (δ - r²/2R), the rest of the shift is slip.

    rng    random generator, which is not used
    posed  scene without answer, whose forces over µW are the shifts over the onset
    """
    made, tip = _similar_of(posed), posed.scene.indenter
    assert isinstance(tip, Paraboloid)
    mu, full = made.mu, made.full
    onset, limit = mu * full.approach, mu * full.load
    shifts = [force / limit * onset for force in posed.forces]
    at_onset = mu**2 * (full.load * full.approach - 2 * full.elastic)
    lost, last, values = 0.0, 0.0, list[dict[str, float]]()
    for shift in shifts:
        reversals = 2 if last else 1
        lost += reversals * at_onset + limit * (abs(shift - last) - reversals * onset)
        values.append({ENERGY: lost})
        last = shift
    r = np.linspace(0.0, full.radius, 4001)
    slip = shifts[0] - mu * (full.approach - r**2 / (2 * tip.radius))
    pressure = full.peak * np.sqrt(1 - (r / full.radius) ** 2)
    values[-1] |= {
        CYCLE: values[-1][ENERGY] - values[0][ENERGY],
        AMPLITUDE: float(slip[-1]),
        F1: float(np.max(mu * pressure * slip)),
    }
    scene = posed.followed_by(LoadStep(tangential_shift=(shift, 0.0)) for shift in shifts)
    truths = [*known(1, full.values, ROUNDING)]
    for step, found in enumerate(values, start=2):
        truths += known(step, found, SIMILAR_ERROR)
    return posed.known(truths, scene)


def oblique(rng: Rng, posed: Posed) -> KnownScene:
    """Turn the tangential forces on a ball with ν = 0, in closed form.

    rng    random generator, for the angle between the forces and the x axis
    posed  scene without answer
    """
    made, angle = _similar_of(posed), float(rng.uniform(0.2, 1.4))
    along = np.array([np.cos(angle), np.sin(angle)])
    steps = (LoadStep(tangential_force=tuple(force * along)) for force in posed.forces)
    scene = posed.followed_by(steps)
    truths = [
        replace(truth, value=truth.value * along[0]) if truth.quantity in LED else truth
        for truth in (*made.truths(posed.forces), *_ball_truths(made, posed))
    ]
    return posed.known(truths, scene)


def _similar_of(posed: Posed) -> Similar:
    friction = posed.scene.friction
    assert friction is not None
    assert friction.uniform is not None
    return Similar(posed.scene, posed.load, friction.uniform)


def _edge_tension(made: Similar, stick_radius: float) -> float:
    """Compute the tensile stress at the trailing edge of a ball under a tangential force
    [force/length²].

    made          contact of the ball
    stick_radius  radius of the stick disc; 0 for gross slip [length]
    """
    material = made.scene.body.elastic_materials[0]
    a, nu, q0 = made.full.radius, material.poisson_ratio, made.mu * made.full.peak
    stress = stress_by_hertz_pressure(-a, a, made.full.peak, nu)
    return float(stress + stress_by_partial_slip(-a, a, stick_radius, q0, nu))


def _ball_truths(made: Similar, posed: Posed) -> Iterator[Truth]:
    """Yield known stresses and fretting parameters of a ball under tangential forces.

    These are the tensile stress at the end of the first tangential step, and the largest slip
    amplitude and Ruiz parameters of a closed cycle.

    made   contact of the ball
    posed  scene without answer
    """
    force, a, full = posed.forces[0], made.full.radius, made.full
    values = {TENSION: _edge_tension(made, float(made.first(force)[1]))}
    if posed.fineness.solver == CELLS:
        yield from known(2, values, SIMILAR_ERROR)
    if closes(posed.forces):
        modulus = contact_modulus(made.scene)
        cycled = CycledContact(PartialSlip(full.load, a, made.mu, modulus, force), full.peak)
        values = {AMPLITUDE: float(cycled.slip_amplitude(a)), F1: cycled.largest_f1}
        if posed.fineness.solver == CELLS and cycled.largest_f2 > 0:
            values[F2] = cycled.largest_f2
        last = len(posed.forces) + 1
        yield from known(last, values, SIMILAR_ERROR)


def refined(rng: Rng, posed: Posed) -> KnownScene:
    """Compute the known numbers of a randomly drawn scene with the judged solver on finer cells.

    The effect of more increments is added, computed on the cells that are judged.

    rng    random generator, which is not used
    posed  scene without answer
    """
    matters = has_increment_error(posed.scene)
    counts = semi_analytical.plan(posed.scene).increments
    fine, less = (_SolvedLevel.of(posed, times, counts) for times in FINER)
    base, cut = less, [less] * len(MANY)
    if any(matters):
        base = _SolvedLevel.of(posed, 1.0, counts)
        cut = [
            _SolvedLevel.of(
                posed,
                1.0,
                tuple(
                    max(least, n * least // MANY[-1]) if m else n
                    for n, m in zip(counts, matters, strict=True)
                ),
            )
            for least in MANY
        ]
    return posed.known(_with_known_pressing(posed, _refined_truths(fine, less, base, *cut)))


def _with_known_pressing(posed: Posed, truths: Iterable[Truth]) -> Iterator[Truth]:
    """Replace the numbers of a pressing that shear does not change by those without friction.

    Finer cells do not decide errors as small as these.

    posed   scene without answer
    truths  known numbers of the scene by finer cells
    """
    by_pressing: dict[str, float] = {}
    if not coupling(posed.scene)[0]:
        with suppress(UnsupportedScene):
            by_pressing = pressed(posed.scene, posed.load).values
    for truth in truths:
        value = by_pressing.get(truth.quantity)
        if value is None or (truth.quantity in (ELASTIC, WORK) and truth.step > 1):
            yield truth
        else:
            yield from known(truth.step, {truth.quantity: value}, ROUNDING)


class _SolvedLevel(NamedTuple):
    """Hold the numbers of one solve at the ends of all load steps, with one number of cells.

    steps  numbers by name for each step; the last step includes the largest stresses if required
    cell   side of a cell over the final contact radius
    """

    steps: Sequence[Values]
    cell: float

    @classmethod
    def of(cls, posed: Posed, times: float, counts: tuple[int, ...]) -> _SolvedLevel:
        asked = posed.fineness.asked
        assert isinstance(asked, SurfaceDiscretisation)
        drawn = asked.cells if isinstance(asked.cells, tuple) else ()
        cells = tuple(2 * round(times * n / 2) if times > 1 else n for n in drawn)
        plan = semi_analytical.plan(posed.scene, edge=asked.edge).cut_into(counts)
        finer = asked.model_copy(update={"cells": cells})
        result = semi_analytical.solve_discretised(posed.scene, finer, plan=plan)
        steps = list(values_of(result))
        if posed.stressed:
            found = stress_maxima(result, len(steps))
            steps[-1] = {**steps[-1], **{n: np.atleast_1d(found[n][0]) for n in STRESSES}}
        return cls(steps, max(result.grid.spacing) / result.steps[-1].contact_radius)


def _refined_truths(
    fine: _SolvedLevel, less: _SolvedLevel, base: _SolvedLevel, *cut: _SolvedLevel
) -> Iterator[Truth]:
    every = [level.steps for level in (fine, less, base, *cut)]
    for step, values in enumerate(zip(*every, strict=True), start=1):
        for name in (name for name in KIND_OF if all(name in level for level in values)):
            best, other, at, much, some, few = (float(v[name][0]) for v in values)
            effect, open_path = 2 * much - some - at, abs(2 * much - 3 * some + few)
            value = best + effect
            apart = ORDER_ONE * abs(best - other) + open_path + OTHER_CELLS * abs(effect)
            if name in AT_EDGES:  # the edge may lie anywhere in a cell
                apart = max(apart, fine.cell * abs(best))
            yield Truth(step, name, value, apart)


# Seeds of the random numbers. The believed fraction 0.6 of the convergence orders was chosen with
# the first seeds. Rules, families and the limits of resolution were tested with the second seeds.
# The third seed is that of the judged scenes.
CHOOSING = (11, 12, 34, 71993)
TRIED = (
    *(5001, 5002, 5003, 5004, 7013, 9029, 31607, 40213, 55011, 55012, 55013, 55014, 55015),
    *(55271, 77031, 86243, 91733),
)
JUDGING = 604417

T = TypeVar("T")


@dataclass(frozen=True)
class Family:
    """Hold the distributions of one kind of random scenes, and the function for their answers.

    shapes    distributions of the indenter shape; each scene draws one
    pairs     distributions of the materials of both bodies; each scene draws one
    rule      function that computes the known numbers of a scene
    count     number of scenes in a verification above the quick level, which takes one scene
    forces    distribution of the forces after the normal loading, over the friction limit; None: no
              such forces
    twists    True if these are torques, False if tangential forces
    friction  True if there is friction without these forces, too
    coarsest  smallest number of cells per contact radius
    finest    largest number of cells per contact radius
    stressed  True if the largest stresses are judged
    solver    name of the solver that is judged
    few       True if each load step after the normal loading prescribes a number of increments
    mapped    True if the coefficient of friction varies over the surface
    """

    shapes: Sequence[Callable[[Rng, float, float], ShapedBody]]
    pairs: Sequence[Callable[[Rng, float], Bodies]]
    rule: Callable[[Rng, Posed], KnownScene]
    count: int
    forces: Callable[[Rng], tuple[float, ...]] | None = None
    twists: bool = False
    friction: bool = False
    coarsest: float = 4.0
    finest: float = 40.0
    stressed: bool = False
    solver: str = CELLS
    few: bool = False
    mapped: bool = False

    def posed(self, rng: Rng) -> Posed:
        """Draw a random scene of the family and the discretisation to be judged, without the
        answer.

        rng  random generator
        """
        radius = logarithmic(rng, 1e-3, 0.1)
        a = radius * logarithmic(rng, *of.STRAINS)
        lower, upper = _draw_one(rng, self.pairs)(rng, a)
        shape = _draw_one(rng, self.shapes)(rng, radius, a)
        outer = {"material": upper.material, "layers": upper.layers}
        bases = [body.material for body in (lower, upper) if body.material != RIGID]
        modulus = 1 / sum(1 / base.plane_strain_modulus for base in bases)
        height = (
            float(shape.initial_gap(a, 0.0)) if isinstance(shape, Profile) else a**2 / 2 / radius
        )
        load, mu = 2 * modulus * a * height, logarithmic(rng, 0.05, 0.8)
        scene = Scene(
            title=type(shape).__name__,
            indenter=Paraboloid(radius=radius, material=RIGID),
            body=lower,
            friction=CoulombFriction(coefficient=mu) if self.friction or self.forces else None,
            loading=(LoadStep(normal_force=load),),
        ).model_copy(update={"indenter": shape.model_copy(update=outer)})
        forces = () if self.forces is None else self.forces(rng)
        if self.twists:
            end = rings(scene, load)
            limit = 2 * pi * mu * float(np.trapezoid(end.pressure * end.radii**2, end.radii))
            forces = tuple(part * limit for part in forces)
            steps = [LoadStep(torque=torque) for torque in forces]
        else:
            forces = tuple(part * mu * load for part in forces)
            steps = [LoadStep(tangential_force=(force, 0.0)) for force in forces]
        if self.few:
            counts = (round(logarithmic(rng, *of.FEW_INCREMENTS)) for _ in steps)
            steps = [
                step.model_copy(update={"increments": count})
                for step, count in zip(steps, counts, strict=True)
            ]
        if self.mapped:
            scene = scene.model_copy(update={"friction": of.friction_map(rng, a, mu)})
        scene = scene.model_copy(update={"loading": (*scene.loading, *steps)})
        limits = self.coarsest, self.finest
        fineness = of.fineness(rng, _contact_semi_axes(scene, load, a), self.solver, limits)
        return Posed(scene, fineness, forces, self.stressed)

    def known(self, rng: Rng) -> KnownScene:
        """Draw a random scene of the family together with its answer.

        If the contact reaches the edge of the window, another scene is drawn.

        rng  random generator
        """
        while True:
            try:
                return self.rule(rng, self.posed(rng))
            except ContactAtWindowEdge:
                continue


def _draw_one(rng: Rng, ways: Sequence[T]) -> T:
    return ways[int(rng.integers(len(ways)))]


def _contact_semi_axes(scene: Scene, load: float, a: float) -> tuple[float, float]:
    """Estimate the semi-axes of the frictionless contact of a scene, to choose the window [length].

    For shapes without reference solution both are the nominal contact radius a.

    scene  bodies of the contact
    load   normal force [force]
    a      nominal contact radius [length]
    """
    shape = scene.indenter
    if isinstance(shape, Ellipsoid):
        return EllipticalContact.under_load(load, shape.radii, contact_modulus(scene)).semi_axes
    if not shape.is_of_revolution or (isinstance(shape, Profile) and shape.flat + shape.ring > 0):
        return a, a
    return (pressed(scene, load).radius,) * 2


RIGID_ON_BARE, RIGID_ON_COATED, RIGID_ON_FILM = (
    of.below_rigid(body) for body in (of.bare, of.coated, of.film)
)
UNLIKE = of.unlike(of.bare)
UNLIKE_COATED = of.unlike(of.coated)
ALIKE, ALIKE_COATED, NO_POISSON = (
    of.alike(body) for body in (of.bare, of.coated, of.without_poisson)
)
# Largest numbers of cells per contact radius for which the reference on finer cells is affordable.
PUSHED = 10.0
COUPLED = 7.0

FAMILIES = {
    "balls": Family((of.ball, of.sphere), (RIGID_ON_BARE, UNLIKE), by_rings, 46, stressed=True),
    "shapes": Family((of.cone, of.punch, of.power_law), (RIGID_ON_BARE, UNLIKE), by_rings, 32),
    "coated": Family(
        (of.ball,), (RIGID_ON_COATED, UNLIKE_COATED), by_rings, 22, finest=24.0, stressed=True
    ),
    "films": Family(
        (of.ball, of.sphere), (RIGID_ON_FILM,), by_rings, 38, finest=24.0, stressed=True
    ),
    "tilted": Family((of.ball,), (RIGID_ON_BARE, UNLIKE_COATED), beside_the_centre, 100),
    "pushed": Family((of.ball,), (NO_POISSON,), similar, 84, of.pushes, coarsest=8.0, finest=24.0),
    "pushed-shapes": Family(
        (of.cone, of.power_law, of.sphere, of.ellipsoid), (NO_POISSON,), similar, 20, of.pushes
    ),
    "near-sliding": Family((of.ball,), (NO_POISSON,), similar, 24, of.near_gross_slip),
    "sliding": Family((of.ball,), (ALIKE,), slid, 26, of.near_gross_slip),
    "twisted": Family(
        (of.ball, of.cone, of.power_law),
        (ALIKE, ALIKE_COATED),
        by_rings,
        72,
        of.pushes,
        twists=True,
    ),
    "indented": Family(
        (of.ball, of.cone),
        (RIGID_ON_BARE, RIGID_ON_COATED),
        by_rings,
        28,
        friction=True,
        finest=24.0,
    ),
    "similar": Family(
        (of.ball, of.cone, of.ellipsoid), (ALIKE,), refined, 18, of.pushes, finest=PUSHED
    ),
    "gross-slip": Family((of.ball,), (NO_POISSON,), loops_in_gross_slip, 30, of.loops_beyond_onset),
    "oblique": Family((of.ball,), (NO_POISSON,), oblique, 30, of.pushes, coarsest=8.0, finest=24.0),
    "few-increments": Family(
        (of.ball, of.ellipsoid), (ALIKE,), refined, 24, of.pushes, finest=PUSHED, few=True
    ),
    "friction-maps": Family(
        (of.ball,), (ALIKE,), refined, 24, of.pushes, finest=PUSHED, mapped=True
    ),
    "coated-pushed": Family((of.ball,), (ALIKE_COATED,), refined, 16, of.pushes, finest=PUSHED),
    "coupled": Family(
        (of.ball,), (RIGID_ON_BARE, RIGID_ON_COATED), refined, 18, of.pushes, finest=COUPLED
    ),
    "films-pushed": Family(
        (of.ball,), (RIGID_ON_FILM,), refined, 24, of.pushes, finest=COUPLED, stressed=True
    ),
    "ridges": Family((of.rounded_flat, of.ring), (ALIKE,), refined, 18, of.pushes, finest=PUSHED),
    "smooth-maps": Family((of.smooth_map,), (ALIKE,), refined, 18, of.pushes, finest=PUSHED),
    "rough-maps": Family((of.rough_map,), (ALIKE,), refined, 40, of.pushes, finest=PUSHED),
    "elements": Family(
        (of.ball, of.cone), (RIGID_ON_BARE, RIGID_ON_COATED), by_rings, 34, solver=ELEMENTS
    ),
    "elements-pushed": Family((of.ball,), (NO_POISSON,), similar, 12, of.pushes, solver=ELEMENTS),
    "elements-twisted": Family(
        (of.ball,), (ALIKE, ALIKE_COATED), by_rings, 24, of.pushes, twists=True, solver=ELEMENTS
    ),
    "elements-indented": Family(
        (of.ball,), (RIGID_ON_BARE, RIGID_ON_COATED), by_rings, 32, friction=True, solver=ELEMENTS
    ),
}


def drawn(family: str, seed: int, number: int) -> KnownScene:
    """Create one random scene of a family with its answer.

    Equal arguments give equal scenes.

    family  name of the family
    seed    seed of the random numbers
    number  number of the scene within the family
    """
    return FAMILIES[family].known(np.random.default_rng([seed, crc32(family.encode()), number]))
