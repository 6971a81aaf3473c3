"""Into how many increments the loading steps are cut, by error laws that were measured.

An increment fixes the direction of slip for all of it, and what sticks keeps what it had at the
end of the increment; both cost accuracy where the state depends on the path. The error is
Σ|q - q_fine| / Σµp at the end of a step that is cut into n equal increments (a first loading:
uniform in contact radius). Measured on 64 x 64 and 128 x 128 cells against 64 to 160 increments:

    pressing for the first time, unlike half-spaces      min(0.9 (m²/n)^(3/2), 1.3/n), m = µ/|β|
        rigid paraboloid, ν = 0 to 0.45, µ = 0.05 to 4
        other shapes: not below 0.25 m/n; cone, ellipsoid of 1 : 3, ν = 0 and 0.3, µ = 0.05 to 0.5
    the same with layers                                 as above with m² = 9µ, and 2/n
        one layer of 0.1 to 3 contact radii, E1/E2 = 1/4 to 4, ν = 0.3, µ = 0.05 to 1
    pressing and pushing at once, for the first time     2/n
        bodies that do not couple, T/µW = 0.1 to 0.9
    pushing sideways under constant normal load          0.4 x min(x, Δx)/n
        unlike bodies, and turning ones that do not couple; x the largest T/µW of the step,
        0.3 to 0.99, Δx its change; with layers as above
    turning again and again, by w = Σ Δx/x in all        min(0.25 w, 0.9) x Δx/n
        errors of a step last for half a turn: polygons of 4 to 16 steps, T/µW = 0.3 to 0.9; at
        the end of any step
    changing the normal load by ΔW later                 0.15 ΔW/W/n, and as above for T;
        0.6 ΔW/W/n for unlike bodies. W down to 1/5 or up to fivefold, with and without T

Beyond what is named here the laws are guesses; `slipstick maintain study increments` measures.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot, sqrt

from contact_scene import ControlKind, CoulombFriction, LoadRamp, Scene
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.cycles import loop_increments

# The sine of an angle below this is round-off of a load that goes straight.
STRAIGHT = 1e-9
ROUND_OFF = 1e-9
MOST = 100_000

PRESSING_FIRST = 0.9
FULL_STICK = 1.3
FULL_STICK_LAYERS = 2.0
LAYERS = 9.0
BOTH_AT_ONCE = 2.0
OTHER_SHAPES = 0.25
SIDEWAYS = 0.4
TURNING = 0.25
TURNED_ROUND = 0.9
PRESSING_LATER = 0.15
PRESSING_UNLIKE = 0.6
# Of a step that strains bodies that do not couple: slip may turn back within it.
STRAINED = 16

Vector = tuple[float, float]


@dataclass(frozen=True)
class StepIncrements:
    """How many increments one loading step takes.

    path_matters  whether the state at its end depends on how finely it is cut
    why           the reason in one sentence
    """

    count: int
    path_matters: bool
    why: str


@dataclass(frozen=True)
class Bodies:
    """What the error laws need of a scene.

    coupled  whether pressure and shear act on each other
    beta     Dundurs' constant; None if a body has layers
    friction between them
    """

    coupled: bool
    beta: float | None
    friction: CoulombFriction


def path_increments(
    scene: Scene, shear: bool, bodies: Bodies, accuracy: float
) -> tuple[StepIncrements, ...]:
    """As the scene asks; else one where the path does not matter, enough for the accuracy where it
    does, and enough for the work of closed cycles.

    shear     whether shear is solved for at all
    accuracy  error of the shear that increments may leave, Σ|error of q| / Σµp
    """
    steps = []
    sheared = bodies.coupled
    ways = _ways(scene)
    turning = [turn for way in ways if (turn := way.turned(bodies))]
    turned = sum(turning) if len(turning) > 1 else 0.0
    for way, of_loop in zip(ways, loop_increments(scene.load_path()), strict=True):
        sheared = sheared or way.ends_sheared or way.ramp.strains
        matters, why = way.matters(bodies.coupled) if shear and sheared else (False, NO_SHEAR)
        count = 1
        if matters:
            count, why = way.count(bodies, accuracy, turned)
        if shear and way.ramp.strains and count < STRAINED:
            count, why = STRAINED, "the lower body is strained"
        if shear and of_loop > count:
            count, why = of_loop, "the work of a closed cycle"
        if way.ramp.increments is not None:
            count, why = way.ramp.increments, "as the scene asks"
        steps.append(StepIncrements(count, matters, why))
    return tuple(steps)


def _ways(scene: Scene) -> list[_Way]:
    # Force and shift are nearly parallel, so that either tells where the other starts.
    ways: list[_Way] = []
    for ramp in scene.load_path():
        last = ways[-1].ramp.tangential.end if ways else (0.0, 0.0)
        ways.append(_Way(ramp, ramp.tangential.start or last, scene.indenter))
    return ways


NO_SHEAR = "nothing is sheared: the state does not depend on the path"


@dataclass(frozen=True)
class _Way:
    """One loading step.

    start  tangential force or shift at its start
    shape  of the indenter
    """

    ramp: LoadRamp
    start: Vector
    shape: ShapedBody

    @property
    def ends_sheared(self) -> bool:
        """Whether the step names a sideways load."""
        return any(self.ramp.tangential.end) or self.ramp.twisting.end != 0

    @property
    def _first(self) -> bool:
        return self.ramp.normal.start == 0

    @property
    def _pressing(self) -> bool:
        ramp = self.ramp
        return ramp.normal.start != ramp.normal.end or ramp.tilting.start != ramp.tilting.end

    @property
    def _growing(self) -> bool:
        """Whether all that the step does is to press harder."""
        normal, tilting = self.ramp.normal, self.ramp.tilting
        grows = normal.start is not None and normal.start <= normal.end
        return grows and tilting.start == tilting.end and not self._moving

    @property
    def _moving(self) -> bool:
        """Whether the sideways load changes."""
        twisting = self.ramp.twisting
        if self.ramp.strains:
            return True
        return self.start != self.ramp.tangential.end or twisting.start != twisting.end

    @property
    def _turning(self) -> bool:
        """Whether the sideways load changes its direction, reversal and round-off apart."""
        start, end = self.start, self.ramp.tangential.end
        cross = start[0] * end[1] - start[1] * end[0]
        twists = self.ramp.twisting.start != 0 or self.ramp.twisting.end != 0
        pushes = any(start) or any(end)
        if twists and pushes:
            return self._moving
        return abs(cross) > STRAIGHT * hypot(*start) * hypot(*end)

    def matters(self, coupled: bool) -> tuple[bool, str]:
        """Whether the end of the step depends on the path to it, and why not."""
        if self._first and self.shape.rim is not None:
            return False, "below a flat punch all tractions grow in proportion"
        if self._growing and not coupled:
            return False, "the normal load grows, and nothing slips"
        if self._pressing or self._turning or (coupled and self._moving):
            return True, ""
        return False, "the load goes straight and the bodies do not couple"

    def turned(self, bodies: Bodies) -> float:
        """Change of the sideways load relative to its largest, where it turns."""
        x, change = self._parts_of_limit(bodies)
        return change / x if self._turning and x else 0.0

    def count(self, bodies: Bodies, accuracy: float, turned: float) -> tuple[int, str]:
        """Enough for the accuracy, and by which law.

        turned  Σ Δx/x of all steps that turn; zero where fewer than two do
        """
        if self._first and not self._moving:
            return _pressed_first(bodies, accuracy, self.shape)
        if self._first:
            return _first_order(BOTH_AT_ONCE, accuracy, "pressing and pushing at once")
        x, change = self._parts_of_limit(bodies)
        coefficient = SIDEWAYS * x * min(x, change)
        if self._turning:
            again = min(TURNING * turned, TURNED_ROUND)
            coefficient = max(coefficient, again * x * change)
        if self._pressing:
            rate = PRESSING_UNLIKE if bodies.coupled else PRESSING_LATER
            coefficient += rate * self._pressing_change
            return _first_order(coefficient, accuracy, "the normal load changes under shear")
        why = "the sideways load turns" if self._turning else "pressure and shear are coupled"
        return _first_order(coefficient, accuracy, why)

    @property
    def _pressing_change(self) -> float:
        """Change of the normal load relative to the larger; 1 where that is not known."""
        normal, tilting = self.ramp.normal, self.ramp.tilting
        if normal.start is None or tilting.start != tilting.end:
            return 1.0
        return abs(normal.end - normal.start) / max(normal.start, normal.end)

    def _parts_of_limit(self, bodies: Bodies) -> tuple[float, float]:
        """Largest T/µW of the step, and its change; 1 where that is not known before the solve."""
        if not self._moving:
            return 0.0, 0.0
        normal, tangential = self.ramp.normal, self.ramp.tangential
        by_force = normal.kind is tangential.kind is ControlKind.FORCE
        known = (
            by_force
            and not self.ramp.strains
            and normal.start is not None
            and tangential.start is not None
        )
        limit = bodies.friction.carried(min(normal.start or normal.end, normal.end))
        if not known or not limit or self.ramp.twisting.end != 0:
            return 1.0, 1.0
        start, end = self.start, tangential.end
        change = hypot(end[0] - start[0], end[1] - start[1])
        return max(hypot(*start), hypot(*end)) / limit, change / limit


def _pressed_first(bodies: Bodies, accuracy: float, shape: ShapedBody) -> tuple[int, str]:
    """The stick edge runs outwards with the contact: what matters is how much of it sticks."""
    layered = bodies.beta is None
    most = (FULL_STICK_LAYERS if layered else FULL_STICK) / accuracy
    mu = bodies.friction.uniform
    if mu is None:
        return _rounded(most), "pressing bodies that couple, with friction that is not µp"
    if layered:
        m_squared = LAYERS * mu
        why = f"pressing coated bodies, µ = {mu:.2g}"
    else:
        m_squared = (mu / abs(bodies.beta or 1.0)) ** 2
        why = f"pressing unlike bodies, µ/|β| = {m_squared**0.5:.2g}"
    count = (PRESSING_FIRST / accuracy) ** (2 / 3) * m_squared
    if shape.gap_exponent != 2 or not shape.is_of_revolution:
        count = max(count, OTHER_SHAPES * sqrt(m_squared) / accuracy)
    return _rounded(min(count, most)), why


def _first_order(coefficient: float, accuracy: float, why: str) -> tuple[int, str]:
    return _rounded(coefficient / accuracy), why


def _rounded(count: float) -> int:
    return min(MOST, max(1, ceil(count - ROUND_OFF)))
