"""Torsion problems with known answers: the standard ball in partial slip, and a stuck flat
punch.
"""

from __future__ import annotations

from dataclasses import dataclass

from scipy.integrate import quad

from contact_scene import Body, CoulombFriction, FlatPunch, LoadStep, Scene
from verification.closed_forms.torsion import StuckTorsion, TorsionalPartialSlip
from verification.problems import paper_scene as paper
from verification.problems.cattaneo_mindlin import OVER_LIMIT
from verification.problems.paper_scene import FRICTION, HERTZ, STEEL
from verification.problems.problem import Problem

SOURCE = "Lubkin 1951"
MODULUS = STEEL.shear_modulus / 2
OVER_TWIST = "the largest twist"
AMPLITUDE = 0.9  # largest torque of the loop over the torque at gross slip


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
        paper.frictional(title, paper.paraboloid(STEEL), STEEL, *steps),
        (HERTZ, *ends),
        HERTZ.contact_radius,
        SOURCE,
        scales={OVER_LIMIT: FRICTION * HERTZ.peak_pressure, OVER_TWIST: LARGEST.twist},
        equations=(
            r"\varphi = \frac{\mu p_0}{2 G^*} \left[\mathbf{K}(k') - \mathbf{E}(k')\right],\quad "
            r"k'^2 = 1 - c^2/a^2,\quad M = \tfrac{8}{3} \mu p_0 \int_c^a s^2 "
            r"\mathbf{E}\left(\sqrt{1 - s^2/a^2}\right) ds",
        ),
    )


PARTS = {1: 0.5, 2: 0.9, 3: 0.99}  # torque over that at gross slip, by load step
TWISTED = _torsion_problem(
    "Ball in torsion",
    tuple(virgin(part * SLIDING_TORQUE) for part in PARTS.values()),
    *map(torque_step, PARTS.values()),
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
STUCK_TORQUE = 0.3 * paper.NORMAL_FORCE * PUNCH_RADIUS
STUCK = Problem(
    Scene(
        title="Flat punch in torsion without slip",
        indenter=FlatPunch(radius=PUNCH_RADIUS, material=STEEL),
        body=Body(material=STEEL),
        friction=CoulombFriction(coefficient=1.0),
        loading=(
            paper.pressing(1),
            LoadStep(torque=STUCK_TORQUE, increments=1),
        ),
    ),
    (None, StuckTorsion(PUNCH_RADIUS, MODULUS, STUCK_TORQUE)),
    PUNCH_RADIUS,
    "Reissner and Sagoci 1944",
    equations=(
        r"\varphi = \frac{3 M}{16 a^3 G^*},\quad "
        r"q = \frac{3 M r}{4 \pi a^3 \sqrt{a^2 - r^2}}",
    ),
)
