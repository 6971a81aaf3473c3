"""Number of increments of each load step, by measured error rules.

An increment has one slip direction, and sticking cells keep the slip of the end of the preceding
increment. Both cause an error where the state depends on the load path. The increment error is Σ|q
- q_fine| / Σµp at the end of a step of n equal increments (in first loading: uniform in contact
radius). Measured on 64 x 64 and 128 x 128 cells against 64 to 160 increments:

    first loading, normal, dissimilar half-spaces        min(0.9 (m²/n)^(3/2), 1.3/n), m = µ/|β|
        rigid paraboloid, ν = 0 to 0.45, µ = 0.05 to 4
        other shapes: at least 0.25 m/n; cone, ellipsoid of 1 : 3, ν = 0 and 0.3, µ = 0.05 to 0.5
    first loading with layers                            as above with m² = 9µ, and 2/n
        one layer of 0.1 to 3 contact radii, E1/E2 = 1/4 to 4, ν = 0.3, µ = 0.05 to 1
    first loading, normal and tangential together        2/n, an upper bound
        T/µW = 0.1 to 0.9; exact for n = 1 where nothing slips (`grows_without_slip`)
    tangential load at constant normal load              0.4 x min(x, Δx)/n
        coupled bodies, and changes of direction of uncoupled ones; x the largest T/µW of the
        step, 0.3 to 0.99, Δx its change; with layers as above
    several changes of direction, w = Σ Δx/x             min(0.25 w, 0.9) x Δx/n
        the error of a step decays over half a turn: polygons of 4 to 16 steps, T/µW = 0.3 to
        0.9; at the end of any step
    later change ΔW of the normal load                   0.15 ΔW/W/n, and as above for T;
        0.6 ΔW/W/n for coupled bodies. W down to 1/5 or up to fivefold, with and without T

Outside of these ranges the rules are extrapolated. `slipstick convergence` measures the
error of the increments of a scene.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot, sqrt

from contact_scene import ControlKind, CoulombFriction, LoadRamp, Scene
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.cycles import loop_increments
from contact_scene.stepping.growing_contact import grows_without_slip

# Largest sine of the angle between successive loads of constant direction (round-off).
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
# Least number of increments of a step with bulk strain, in which slip may reverse.
STRAINED = 16

Vector = tuple[float, float]


@dataclass(frozen=True)
class StepIncrements:
    """Number of increments into which one load step is divided, with the reason for this number.

    count         number of increments
    path_matters  True if the state at the end of the load step depends on the number of increments
    why           reason in one sentence
    """

    count: int
    path_matters: bool
    why: str


@dataclass(frozen=True)
class Bodies:
    """Properties of the two bodies that determine the number of increments for a given error.

    coupled   True if the normal and tangential problems are coupled
    beta      Dundurs' second constant β of the two materials; None if a body has layers
    friction  friction law
    """

    coupled: bool
    beta: float | None
    friction: CoulombFriction


def path_increments(
    scene: Scene, shear: bool, bodies: Bodies, accuracy: float
) -> tuple[StepIncrements, ...]:
    """Choose the number of increments of each load step for an allowed increment error.

    The number is the largest of: 1; for path-dependent steps the number by the error rules; the
    number for bulk strain; the number for the work of closed cycles. A number prescribed by the
    scene replaces all these numbers.

    scene     scene with its load steps
    shear     True if shear is solved for
    bodies    properties of the bodies
    accuracy  allowed increment error of the shear q: Σ|error of q| / Σµp over the cells
    """
    found = []
    sheared = bodies.coupled
    steps: list[_LoadStep] = []
    for ramp in scene.load_path():
        # Force and shift are nearly parallel: the end of one is the start of the other.
        last = steps[-1].ramp.tangential.end if steps else (0.0, 0.0)
        steps.append(_LoadStep(ramp, ramp.tangential.start or last, scene.indenter))
    changes = [change for step in steps if (change := step.change_of_direction(bodies))]
    total = sum(changes) if len(changes) > 1 else 0.0
    for step, of_loop in zip(steps, loop_increments(scene.load_path()), strict=True):
        sheared = sheared or step.ends_sheared or step.ramp.strains
        matters, why = step.matters(bodies.coupled) if shear and sheared else (False, NO_SHEAR)
        if matters and grows_without_slip(scene, step.ramp):
            matters, why = False, WITHOUT_SLIP
        count = 1
        if matters:
            count, why = step.count(bodies, accuracy, total)
        if shear and step.ramp.strains and count < STRAINED:
            count, why = STRAINED, "the lower body has a bulk strain"
        if shear and of_loop > count:
            count, why = of_loop, "the work of a closed cycle"
        if step.ramp.increments is not None:
            count, why = step.ramp.increments, "prescribed by the scene"
        found.append(StepIncrements(count, matters, why))
    return tuple(found)


NO_SHEAR = "no shear: the state does not depend on the load path"
WITHOUT_SLIP = "the tangential load grows by less than µ times the normal load: nothing slips"


@dataclass(frozen=True)
class _LoadStep:
    """Load step, with functions that choose its number of increments for a given increment error.

    ramp   linear change of the prescribed loads
    start  tangential force or shift at the start of the step (x, y)
    shape  shape of the indenter
    """

    ramp: LoadRamp
    start: Vector
    shape: ShapedBody

    @property
    def ends_sheared(self) -> bool:
        """True if a tangential load or torsion acts at the end of the load step."""
        return any(self.ramp.tangential.end) or self.ramp.twisting.end != 0

    @property
    def _is_first_loading(self) -> bool:
        return self.ramp.normal.start == 0

    @property
    def _changes_normal_load(self) -> bool:
        ramp = self.ramp
        return ramp.normal.start != ramp.normal.end or ramp.tilting.start != ramp.tilting.end

    @property
    def _only_normal_load_grows(self) -> bool:
        """True if only the normal load changes, and does not decrease.
        Uncoupled bodies then do not slip."""
        normal, tilting = self.ramp.normal, self.ramp.tilting
        grows = normal.start is not None and normal.start <= normal.end
        return grows and tilting.start == tilting.end and not self._changes_tangential_load

    @property
    def _changes_tangential_load(self) -> bool:
        """True if the tangential load, the torsion or the bulk strain changes in the load step."""
        twisting = self.ramp.twisting
        if self.ramp.strains:
            return True
        return self.start != self.ramp.tangential.end or twisting.start != twisting.end

    @property
    def _changes_direction(self) -> bool:
        """True if the tangential load changes its direction in the load step, not by reversal.

        Torsion together with a tangential load counts as a change of direction if either of them
        changes. The state then depends on the load path also for uncoupled bodies.
        """
        start, end = self.start, self.ramp.tangential.end
        cross = start[0] * end[1] - start[1] * end[0]
        twists = self.ramp.twisting.start != 0 or self.ramp.twisting.end != 0
        pushes = any(start) or any(end)
        if twists and pushes:
            return self._changes_tangential_load
        return abs(cross) > STRAIGHT * hypot(*start) * hypot(*end)

    def matters(self, coupled: bool) -> tuple[bool, str]:
        """Determine if the state at the end of the load step depends on the path of the loads.

        If not, one increment suffices. Return True or False, and the reason if False.

        coupled  True if the normal and tangential problems are coupled
        """
        if self._is_first_loading and self.shape.rim is not None:
            return False, "all tractions below a flat punch grow in proportion"
        if self._only_normal_load_grows and not coupled:
            return False, "the normal load grows without slip"
        if (
            self._changes_normal_load
            or self._changes_direction
            or (coupled and self._changes_tangential_load)
        ):
            return True, ""
        return False, "the load has a constant direction and the bodies are uncoupled"

    def change_of_direction(self, bodies: Bodies) -> float:
        """Compute the measure Δx/x of a change of direction of the tangential load in the step.

        x is the largest ratio T/µW of tangential force to friction limit in the load step, and Δx
        its change. The result is 0 if the direction does not change. The error rule for several
        changes of direction sums these measures.

        bodies  properties of the bodies, with the friction law
        """
        x, change = self._parts_of_limit(bodies)
        return change / x if self._changes_direction and x else 0.0

    def count(self, bodies: Bodies, accuracy: float, changes: float) -> tuple[int, str]:
        """Compute the number of increments of a path-dependent load step for an increment error.

        Return the number, and the name of the error rule as a reason.

        bodies    properties of the bodies
        accuracy  allowed increment error of the shear q: Σ|error of q| / Σµp over the cells
        changes   Σ Δx/x of all steps that change direction (see `change_of_direction`); 0 for fewer
                  than two
        """
        if self._is_first_loading and not self._changes_tangential_load:
            return _first_loading_count(bodies, accuracy, self.shape)
        if self._is_first_loading:
            return _round_up(BOTH_AT_ONCE / accuracy), "normal and tangential first loading"
        x, change = self._parts_of_limit(bodies)
        coefficient = SIDEWAYS * x * min(x, change)
        if self._changes_direction:
            again = min(TURNING * changes, TURNED_ROUND)
            coefficient = max(coefficient, again * x * change)
        if self._changes_normal_load:
            rate = PRESSING_UNLIKE if bodies.coupled else PRESSING_LATER
            coefficient += rate * self._pressing_change
            return _round_up(coefficient / accuracy), "the normal load changes under shear"
        why = "pressure and shear are coupled"
        if self._changes_direction:
            why = "the tangential load changes its direction"
        return _round_up(coefficient / accuracy), why

    @property
    def _pressing_change(self) -> float:
        """Change of the normal load over its larger value,
        to which the increment error is proportional; 1 if unknown."""
        normal, tilting = self.ramp.normal, self.ramp.tilting
        if normal.start is None or tilting.start != tilting.end:
            return 1.0
        return abs(normal.end - normal.start) / max(normal.start, normal.end)

    def _parts_of_limit(self, bodies: Bodies) -> tuple[float, float]:
        """Compute the largest ratio T/µW of a load step and its change, for the error rules.

        T is the tangential force and µW the friction limit under the smaller normal load of the
        step. Each result is 1 if it is unknown before the solution, and 0 if the tangential load
        does not change. No state exceeds T = µW, so that the ratio is at most 1 and its change at
        most 2, however small the normal load becomes.

        bodies  properties of the bodies, with the friction law
        """
        if not self._changes_tangential_load:
            return 0.0, 0.0
        normal, tangential = self.ramp.normal, self.ramp.tangential
        by_force = normal.kind is tangential.kind is ControlKind.FORCE
        known = (
            by_force
            and not self.ramp.strains
            and normal.start is not None
            and tangential.start is not None
        )
        limit = bodies.friction.largest_tangential_force(
            min(normal.start or normal.end, normal.end)
        )
        if not known or not limit or self.ramp.twisting.end != 0:
            return 1.0, 1.0
        start, end = self.start, tangential.end
        change = hypot(end[0] - start[0], end[1] - start[1])
        return min(1.0, max(hypot(*start), hypot(*end)) / limit), min(2.0, change / limit)


def _first_loading_count(bodies: Bodies, accuracy: float, shape: ShapedBody) -> tuple[int, str]:
    """Compute the number of increments of first normal loading of coupled bodies, and the reason.

    The shear is caused by the pressure alone. The error depends on the relative size of the stick
    zone, whose edge moves with that of the contact.

    bodies    properties of the bodies
    accuracy  allowed increment error of the shear q: Σ|error of q| / Σµp over the cells
    shape     shape of the indenter
    """
    layered = bodies.beta is None
    most = (FULL_STICK_LAYERS if layered else FULL_STICK) / accuracy
    mu = bodies.friction.uniform
    if mu is None:
        return _round_up(most), "first loading of coupled bodies, with friction other than µp"
    if layered:
        m_squared = LAYERS * mu
        why = f"first loading of coated bodies, µ = {mu:.2g}"
    else:
        m_squared = (mu / abs(bodies.beta or 1.0)) ** 2
        why = f"first loading of dissimilar bodies, µ/|β| = {m_squared**0.5:.2g}"
    count = (PRESSING_FIRST / accuracy) ** (2 / 3) * m_squared
    if shape.gap_exponent != 2 or not shape.is_of_revolution:
        count = max(count, OTHER_SHAPES * sqrt(m_squared) / accuracy)
    return _round_up(min(count, most)), why


def _round_up(count: float) -> int:
    """Return a number of increments rounded up to an integer, at least 1 and at most `MOST`."""
    return min(MOST, max(1, ceil(count - ROUND_OFF)))
