"""Problems of a ball under a constant normal force and a changing tangential force or torque.

The answers are the closed forms of Cattaneo, Mindlin and Lubkin. In a fretting loop the tangential
force goes from 0 to T*, to -T* and to T* again, with T* = 0.9 µW. A stuck flat punch is twisted as
well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.integrate import quad

from contact_scene import FlatPunch, IsotropicMaterial, LoadStep
from contact_scene.array_types import Field
from verification.closed_forms.cattaneo_mindlin import (
    CycledContact,
    GrownContact,
    TangentialHistory,
)
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.torsion import StuckTorsion, TorsionalPartialSlip
from verification.problems.problem import (
    CONTACT_MODULUS,
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    NU_ZERO,
    RADIUS,
    ROUNDING,
    STEEL,
    Problem,
    frictional,
    paraboloid,
    partial_slip,
    pressed,
    pressing,
    tangential_step,
)
from verification.quantities import energy_between, force_along_x

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from semi_analytical import Increment, Result


SOURCE = "Cattaneo 1938; Mindlin 1949"
LOOP_SOURCE = "Mindlin and Deresiewicz 1953"
OVER_SLIDING_SHIFT = "the shift at gross sliding"
OVER_SLIDING_WORK = "the work of µW over the shift at gross sliding"
OVER_LIMIT = "µp_H"
OVER_FRICTION = "µW"
SLIDING_SHIFT = partial_slip(NU_ZERO, 0.0).sliding_shift
SLIDING_SHIFT_STEEL = partial_slip(STEEL, 0.0).sliding_shift
# Error of the closed form for ν = 0.3 by neglected slip across the load, over the shift at gross
# slip: solutions of the vector law on 36 and 48 rings have this limit at 0.9 µW. It is a fifth of
# the bound ½ (ν/(4 - 2ν))² (Johnson 1985, section 7.2).
NEGLECTED_ACROSS = 7e-4


def sheared(
    title: str,
    parts: tuple[float, ...],
    material: IsotropicMaterial = NU_ZERO,
    increments: int = 1,
) -> Problem:
    """Create the problem of a pressed ball under a tangential force that changes in several load
    steps.

    title       title of the scene
    parts       tangential force at the end of each step, as a fraction of the friction limit µW
    material    material of both bodies
    increments  number of increments of each tangential step
    """
    steps = (tangential_step(part, increments) for part in parts)
    stops = tuple(partial_slip(material, part * FRICTION_LIMIT) for part in parts)
    sliding = stops[0].sliding_shift
    return Problem(
        frictional(title, paraboloid(material), material, *steps),
        (HERTZ, *stops),
        HERTZ.contact_radius,
        SOURCE,
        uncertainty=NEGLECTED_ACROSS if material.poisson_ratio else ROUNDING,
        scales={
            OVER_SLIDING_SHIFT: sliding,
            OVER_SLIDING_WORK: FRICTION_LIMIT * sliding,
            OVER_LIMIT: FRICTION * HERTZ.peak_pressure,
        },
        equations=(
            r"c = a (1 - T/\mu W)^{1/3},\quad q = \mu p_0 \left[\sqrt{1 - r^2/a^2} - "
            r"\tfrac{c}{a} \sqrt{1 - r^2/c^2}\right],\quad "
            r"\Delta = \frac{3 \mu W}{4 a G^*} \left[1 - (1 - T/\mu W)^{2/3}\right]",
        ),
    )


# Rates dT/dW over µ of two load steps, to half of the normal force and to all of it.
GROWING = (0.6, -0.4)


def growing(title: str, *, by_force: bool) -> Problem:
    """Create the problem of a ball whose normal and tangential load grow together from nothing.

    The tangential load grows in the first step and falls in the second one, by less than µ times
    the normal load. Nothing slips. The answer is exact for every Poisson's ratio.

    title     title of the scene
    by_force  True to prescribe forces, False to prescribe approach and shift
    """
    contacts = (PointContact.under_load(0.5 * NORMAL_FORCE, RADIUS, CONTACT_MODULUS), HERTZ)
    rates = tuple(FRICTION * part for part in GROWING)
    ratio = SLIDING_SHIFT_STEEL / (FRICTION * HERTZ.approach)
    ends = tuple(GrownContact(contacts[:n], rates[:n], ratio) for n in (1, 2))
    steps = (
        LoadStep(normal_force=at.load, tangential_force=(end.tangential_force, 0.0))
        if by_force
        else LoadStep(approach=at.approach, tangential_shift=(end.shift, 0.0))
        for at, end in zip(contacts, ends, strict=True)
    )
    scene = frictional(title, paraboloid(STEEL), STEEL).model_copy(update={"loading": tuple(steps)})
    return Problem(
        scene,
        ends,
        HERTZ.contact_radius,
        f"{LOOP_SOURCE}; Jäger 1998",
        scales={
            OVER_SLIDING_SHIFT: SLIDING_SHIFT_STEEL,
            OVER_SLIDING_WORK: FRICTION_LIMIT * SLIDING_SHIFT_STEEL,
            OVER_FRICTION: FRICTION_LIMIT,
            OVER_LIMIT: FRICTION * HERTZ.peak_pressure,
        },
        equations=(
            r"q = \sum_i k_i \left[p(r; W_i) - p(r; W_{i-1})\right],\quad k_i = "
            r"\frac{\Delta T_i}{\Delta W_i},\quad |k_i| \le \mu,\quad "
            r"\Delta = \tfrac{E^*}{G^*} \sum_i k_i (\delta_i - \delta_{i-1})",
        ),
    )


OVER_LARGEST_SHIFT = "the largest shift of the loop"
OVER_LARGEST_SLIP = "the largest slip amplitude"
OVER_LARGEST_WAY = "the largest way"
AMPLITUDE = 0.9  # largest tangential force T* over µW, and torque over that of gross slip
# loading steps that end at T*, -T*, T*
LOADED = 2
RELOADED = 4
PRESSED = 1
FRETTING_WINDOW = 2.2  # side of the window over the contact radius


def loop_steps(quarter: int) -> tuple[LoadStep, ...]:
    """Create the load steps of a fretting loop, from 0 to T*, to -T* and to T*, with T* = 0.9 µW.

    quarter  number of increments per change of the force by T*
    """
    return (
        tangential_step(AMPLITUDE, quarter),
        tangential_step(-AMPLITUDE, 2 * quarter),
        tangential_step(AMPLITUDE, 2 * quarter),
    )


@dataclass(frozen=True)
class ExactLoop:
    """Hold the exact fretting loop of two identical bodies (Mindlin and Deresiewicz 1953).

    The tangential force goes from 0 to T*, to -T* and to T* again, with T* = 0.9 µW.

    material  material of both bodies; the closed form is exact for ν = 0
    """

    material: IsotropicMaterial

    @cached_property
    def virgin(self) -> TangentialHistory:
        """State of the pressed contact before any tangential force, from which the history
        starts.
        """
        return TangentialHistory(partial_slip(self.material, 0.0))

    @property
    def sliding_shift(self) -> float:
        """Tangential shift of the ball at the onset of gross slip [length]."""
        return self.virgin.virgin.sliding_shift

    @property
    def end(self) -> TangentialHistory:
        """State of the contact at the end of the first loading, where the tangential force is 0.9
        µW.
        """
        return self.virgin.loaded_to(AMPLITUDE * FRICTION_LIMIT)

    @property
    def energy_per_cycle(self) -> float:
        """Energy that friction dissipates in one closed cycle between T* and -T* [force*length].

        The energy is four times the energy dissipated in the first loading.
        """
        return 4 * self.end.dissipated_energy

    def along(self, result: Result) -> Iterator[tuple[Increment, TangentialHistory]]:
        """Yield every increment after the normal loading together with the exact state.

        The exact state is that at the tangential force of the increment, after the same history.

        result  result on cells of the fretting loop
        """
        state = self.virgin
        for increment in result.increments:
            if increment.step > PRESSED:
                state = state.loaded_to(force_along_x(increment))
                yield increment, state

    @property
    def cycled(self) -> CycledContact:
        """Steady fretting cycle between the tangential forces 0.9 µW and -0.9 µW, exact
        for ν = 0.
        """
        force = AMPLITUDE * FRICTION_LIMIT
        return CycledContact(partial_slip(self.material, force), HERTZ.peak_pressure)

    def largest_slip_error(self, result: Result, slip: Field, cycles: float) -> float:
        """Compute the largest error of a slip amplitude or distance in the contact area [length].

        The slip amplitude is half the range of slip in a cycle. The slip distance at the end of the
        loop is 5 times as long, because slip reverses only where the force does.

        result  result on cells of the fretting loop
        slip    computed slip amplitude or distance (nx, ny) [length]
        cycles  exact value over the slip amplitude
        """
        a = HERTZ.contact_radius
        r = np.hypot(*result.grid.coordinates())
        error = np.abs(slip - cycles * self.cycled.slip_amplitude(np.minimum(r, a)))
        return float(np.max(error[r < a]))


def in_any_increment(
    error: Callable[[Result, Increment, TangentialHistory], float],
) -> Callable[[Result, int, Problem], float]:
    """Return the measure of the largest error of any increment after the pressing of a loop.

    error  function of the result, the increment and its exact state
    """

    def measure(result: Result, _: int, problem: Problem) -> float:
        along = problem.ends[-1].along(result)
        return float(np.max([error(result, increment, exact) for increment, exact in along]))

    return measure


def fretting_loop_problem(title: str, material: IsotropicMaterial, quarter: int) -> Problem:
    """Create the problem of the fretting loop of the standard ball (radius 18 mm, 1 kN).

    The tangential force goes from 0 to T*, to -T* and to T* again, with T* = 0.9 µW. The answer
    describes the whole loop and is exact for ν = 0.

    title     title of the scene
    material  material of both bodies
    quarter   number of increments per change of the tangential force by T*
    """
    exact = ExactLoop(material)
    slip = float(exact.cycled.slip_amplitude(HERTZ.contact_radius))
    return Problem(
        frictional(title, paraboloid(material), material, *loop_steps(quarter)),
        (exact,),
        HERTZ.contact_radius,
        LOOP_SOURCE,
        scales={
            OVER_LARGEST_SHIFT: exact.end.shift,
            OVER_SLIDING_SHIFT: exact.sliding_shift,
            OVER_LARGEST_SLIP: slip,
            OVER_LARGEST_WAY: 5 * slip,
            OVER_LIMIT: FRICTION * HERTZ.peak_pressure,
        },
        equations=(
            r"\Delta(T) = \Delta^* - 2 \Delta_1\left(\tfrac{T^* - T}{2}\right),\quad "
            r"\Delta_1(T) = \frac{3 \mu W}{4 a G^*} \left[1 - (1 - T/\mu W)^{2/3}\right]",
        ),
    )


def loop_energy(result: Result) -> float:
    """Compute the energy that a result of the fretting loop dissipates in its closed cycle
    [force*length].

    The cycle goes from the largest tangential force T* to -T* and back to T*.
    """
    return energy_between(result, LOADED, RELOADED)


def loop_cycle(result: Result) -> FrettingCycle:
    """Return the fretting cycle of a result of the fretting loop: slip amplitude and Ruiz's
    parameters.

    The loop has only one closed cycle.
    """
    from contact_results.cycles import fretting_cycles

    (cycle,) = fretting_cycles(result)
    return cycle


def largest_f2(result: Result) -> float:
    """Return the largest value of Ruiz's second parameter in a fretting loop [force²/length³].

    The parameter is shear times slip amplitude times tensile stress of the surface.
    """
    largest = loop_cycle(result).largest_f2
    assert largest is not None
    return largest


LUBKIN = "Lubkin 1951"
MODULUS = STEEL.shear_modulus / 2
OVER_TWIST = "the largest twist"


def virgin(torque: float) -> TorsionalPartialSlip:
    """Compute the partial slip of the standard ball under a torque that has grown from zero.

    The ball has a radius of 18 mm, a normal force of 1 kN and µ = 0.1.

    torque  torque >= 0 [force*length]
    """
    return TorsionalPartialSlip.under_moment(
        torque, HERTZ.contact_radius, HERTZ.peak_pressure, FRICTION, MODULUS
    )


SLIDING_TORQUE = virgin(0.0).sliding_moment
LARGEST = virgin(AMPLITUDE * SLIDING_TORQUE)


def torque_step(part: float) -> LoadStep:
    """Create a load step to a fraction of the torque at gross slip of the standard ball.

    One increment is exact, because the load path is linear.

    part  torque at the end of the step over the torque at gross slip
    """
    return LoadStep(torque=part * SLIDING_TORQUE, increments=1)


@dataclass(frozen=True)
class Twisted:
    """Hold the exact answer at the end of a load step of a torsion loop.

    twist             rotation of the ball about z [radian]
    energy_per_cycle  energy dissipated between the first and the second maximum of the torque
                      [force*length]; 0 for other steps
    """

    twist: float
    energy_per_cycle: float = 0.0


def _torsion_problem(title: str, ends: tuple[object, ...], *steps: LoadStep) -> Problem:
    return Problem(
        frictional(title, paraboloid(STEEL), STEEL, *steps),
        (HERTZ, *ends),
        HERTZ.contact_radius,
        LUBKIN,
        scales={OVER_LIMIT: FRICTION * HERTZ.peak_pressure, OVER_TWIST: LARGEST.twist},
        equations=(
            r"\varphi = \frac{\mu p_0}{2 G^*} \left[\mathbf{K}(k') - \mathbf{E}(k')\right],\quad "
            r"k'^2 = 1 - c^2/a^2,\quad M = \tfrac{8}{3} \mu p_0 \int_c^a s^2 "
            r"\mathbf{E}\left(\sqrt{1 - s^2/a^2}\right) ds",
        ),
    )


TORQUE_PARTS = {1: 0.5, 2: 0.9, 3: 0.99}  # torque over that at gross slip, by load step
TWISTED = _torsion_problem(
    "Ball in torsion",
    tuple(virgin(part * SLIDING_TORQUE) for part in TORQUE_PARTS.values()),
    *map(torque_step, TORQUE_PARTS.values()),
)
LED = _torsion_problem(
    "Ball in torsion by a given twist", (LARGEST,), LoadStep(twist=LARGEST.twist, increments=1)
)


def _torsion_loop() -> tuple[Twisted, ...]:
    """Compute the exact states at the ends of the four load steps of a torsion loop.

    The torque goes from 0 to its largest value, to 0, to the opposite value and back. The states
    follow from the first loading by Masing's rule: after a reversal, the change of the twist is
    twice the first-loading twist at half the change of the torque.
    """
    reached = LARGEST.twist
    back = reached - 2 * virgin(0.5 * AMPLITUDE * SLIDING_TORQUE).twist
    # Area of the loop: 4 φ* M* - 8 ∫ φ dM along the virgin curve.
    area = quad(
        lambda torque: virgin(torque).twist, 0, AMPLITUDE * SLIDING_TORQUE, epsrel=1e-10, epsabs=0
    )[0]
    energy = 4 * reached * AMPLITUDE * SLIDING_TORQUE - 8 * area
    return Twisted(reached), Twisted(back), Twisted(-reached), Twisted(reached, energy)


TORSION_LOOP = _torsion_problem(
    "Ball in torsion to and fro",
    _torsion_loop(),
    *map(torque_step, (AMPLITUDE, 0.0, -AMPLITUDE, AMPLITUDE)),
)

PUNCH_RADIUS = 0.4e-3
# q/p is largest at the rim, 3M/(2Wa) = 0.45: nothing slips.
STUCK_TORQUE = 0.3 * NORMAL_FORCE * PUNCH_RADIUS
STUCK = Problem(
    pressed(
        "Flat punch in torsion without slip",
        FlatPunch(radius=PUNCH_RADIUS, material=STEEL),
        STEEL,
        pressing(1),
        LoadStep(torque=STUCK_TORQUE, increments=1),
        friction=1.0,
    ),
    (None, StuckTorsion(PUNCH_RADIUS, MODULUS, STUCK_TORQUE)),
    PUNCH_RADIUS,
    "Reissner and Sagoci 1944",
    equations=(
        r"\varphi = \frac{3 M}{16 a^3 G^*},\quad "
        r"q = \frac{3 M r}{4 \pi a^3 \sqrt{a^2 - r^2}}",
    ),
)
