"""Load cycles of torsion under a constant normal load.

After a reversal of the twist, the change of the shear is that of a first twist with 2µ instead of
µ. With the torque M = f(φ) of the first twist and the values M_r, φ_r at the reversal, M - M_r = ±
2 f(|φ - φ_r|/2) (Mindlin and Deresiewicz 1953; for torsion Deresiewicz 1954). A branch that reaches
the length of the preceding one closes a loop with it, and the branch before the two continues.
Layers change f only.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import copysign
from typing import Literal

from scipy.optimize import brentq

from contact_scene.friction_limit import reaches_limit, refuse_above_limit
from contact_scene.solver_errors import motion_undefined
from radial.torsion.torsion import (
    NO_STICK,
    PartialSlip,
    Torsion,
)

Named = Literal["twist", "torque"]


@dataclass(frozen=True)
class Branch:
    """Change of torsion in one direction of twist, since a load reversal or since the first twist.

    Shear, slip, twist and torque of the change are `sense` times `weight` times those of the
    equivalent first twist: a state of monotonic torsion of the virgin contact.

    sense   direction of the twist, +1 or -1
    weight  1 for the first twist, 2 after a load reversal
    state   equivalent first twist; None at the start of the branch
    """

    sense: float
    weight: float
    state: PartialSlip | None = None

    def quantity(self, of: str) -> float:
        """Return twist, torque, work or dissipated energy of the branch's equivalent first twist.

        The equivalent first twist is a state of monotonic torsion of the virgin contact. The
        changes in the branch are multiples of the values of this state. The value is 0 at the start
        of the branch.

        of  name of the quantity: "twist" [radian], "torque", "work" or "dissipated" [force length]
        """
        return 0.0 if self.state is None else float(getattr(self.state, of))


@dataclass(frozen=True)
class TwistPath:
    """State of torsion after a history of twists with load reversals, at constant normal load.

    A branch is a change of the twist in one direction. Shear, slip, twist and torque are sums over
    the branches.

    of          contact under torsion
    branches    branches that are not part of a closed load cycle, the current branch last; empty
                before the first twist
    dissipated  energy dissipated since the start of the history [force length]
    work        work of the torque since the start of the history [force length]
    slides      true at the friction limit under a prescribed torque: the twist is undefined
    """

    of: Torsion
    branches: tuple[Branch, ...] = ()
    dissipated: float = 0.0
    work: float = 0.0
    slides: bool = False

    @property
    def twist(self) -> float:
        """Twist φ of the indenter at the end of the history of torsion [radian].

        The twist is the sum of the changes between load reversals.
        """
        return _sum_branches(self.branches, "twist")

    @property
    def torque(self) -> float:
        """Torque M on the indenter at the end of the history of torsion [force length].

        The torque is the sum of the changes between load reversals.
        """
        return _sum_branches(self.branches, "torque")

    @property
    def stick(self) -> float:
        """Stick radius of the current branch of the twist, over the contact radius.

        The stick radius is 1 (full stick) before the first twist and at a load reversal. 0 is gross
        slip.
        """
        last = self.branches[-1].state if self.branches else None
        return 1.0 if last is None else last.stick

    def continue_to_twist(self, twist: float) -> TwistPath:
        """Continue the torsion to a prescribed twist, and return the new state.

        A change of direction is a load reversal.

        twist  prescribed twist of the indenter at the end [radian]
        """
        return self._continue_to("twist", twist)

    def continue_to_torque(self, torque: float) -> TwistPath:
        """Continue the torsion to a prescribed torque, and return the new state.

        A change of direction is a load reversal. At the friction limit the contact slides. Raises
        GrossSliding if the torque exceeds the limit.

        torque  prescribed torque at the end [force length]
        """
        limit = self.of.gross_slip_torque
        if torque:
            refuse_above_limit(0.0, abs(torque), limit / abs(torque))
        if torque and reaches_limit(abs(torque), limit):
            share = min(1.0, abs(torque) / limit) if limit else 0.0
            sliding = Branch(copysign(1.0, torque), share, self.of.partial_slip(0.0))
            return TwistPath(self.of, (sliding,), slides=True)
        return self._continue_to("torque", torque)

    def _continue_to(self, of: Named, target: float) -> TwistPath:
        """Continue the torsion until the twist or the torque has a prescribed value.

        The method returns the new state. A load reversal begins a new branch. A branch that reaches
        the length of the preceding branch closes a load cycle with it, and the branch before the
        two continues.

        of      "twist" or "torque", the prescribed quantity
        target  value of this quantity [radian or force length]
        """
        if self.slides:
            raise motion_undefined()
        if target == getattr(self, of):
            return self
        sense = 1.0 if target > getattr(self, of) else -1.0
        branches, dissipated, work = list(self.branches), self.dissipated, self.work
        if not branches or branches[-1].sense != sense:
            branches.append(Branch(sense, 2.0 if branches else 1.0))
        while True:
            *others, last = branches
            needed = sense * (target - _sum_branches(others, of)) / last.weight
            closes = bool(others) and needed >= others[-1].quantity(of)
            state = others[-1].state if closes else monotonic_state(self.of, of, needed, last.state)
            assert state is not None
            ended = replace(last, state=state)
            dissipated += last.weight * (state.dissipated - last.quantity("dissipated"))
            work += _branch_work(others, ended) - _branch_work(others, last)
            if not closes:
                return TwistPath(self.of, (*others, ended), dissipated, work)
            left = others.pop()
            branches = [replace(ended, weight=1.0)] if left.weight == 1 else others


def _sum_branches(branches: list[Branch] | tuple[Branch, ...], of: str) -> float:
    """Sum the changes of "twist" [radian] or "torque" [force length] (`of`) of all branches."""
    return sum((branch.sense * branch.weight * branch.quantity(of) for branch in branches), 0.0)


def _branch_work(others: list[Branch], branch: Branch) -> float:
    """Compute the work ∫ M dφ along a branch [force length]; the torque of the others is
    constant."""
    linear = (
        branch.sense * branch.weight * branch.quantity("twist") * _sum_branches(others, "torque")
    )
    return linear + branch.weight**2 * branch.quantity("work")


def monotonic_state(
    torsion: Torsion, of: Named, needed: float, since: PartialSlip | None = None
) -> PartialSlip:
    """Find the state of monotonic torsion of the virgin contact that has a given twist or torque.

    Up to incipient slip, the state is proportional to the twist. Beyond, a root search finds the
    stick radius. A twist or torque of at least that of the smallest stick radius `NO_STICK` gives
    gross slip.

    torsion  contact under torsion
    of       "twist" or "torque", the prescribed quantity
    needed   value of this quantity, above 0 [radian or force length]
    since    earlier state with less twist, whose stick radius is an upper bound; None if there is
             none
    """
    whole, none = torsion.incipient_slip, torsion.least_stick
    if needed <= getattr(whole, of):
        part = needed / getattr(whole, of)
        return replace(whole, twist=part * whole.twist, layers=part * whole.layers)
    if needed >= getattr(none, of):
        return replace(torsion.partial_slip(0.0), twist=needed if of == "twist" else none.twist)
    most = 1.0 if since is None or since.stick == 0 else min(1.0, since.stick * (1 + NO_STICK))

    def excess(stick: float) -> float:
        """Return the twist or torque at a trial stick radius, minus the prescribed value.

        The root search for the stick radius finds the zero of this function.

        stick  trial stick radius over the contact radius, 0 to 1
        """
        return float(getattr(torsion.partial_slip(stick), of)) - needed

    return torsion.partial_slip(float(brentq(excess, NO_STICK, most, xtol=1e-15, rtol=1e-15)))
