"""Load cycles of torsion under a constant normal load.

After a reversal of the twist, the change of the shear is that of a first twist with 2µ instead of
µ. With the torque M = f(φ) of the first twist and the values M_r, φ_r at the reversal, M - M_r = ±
2 f(|φ - φ_r|/2) (Mindlin and Deresiewicz 1953; for torsion Deresiewicz 1954). A branch that reaches
the length of the preceding one closes a loop with it, and the branch before the two continues.
Layers change f only.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from scipy.optimize import brentq

from contact_scene.solver_errors import GrossSliding
from radial.torsion.torsion import (
    NO_STICK,
    PartialSlip,
    Torsion,
)

# Relative distance from the torque of gross slip within which the twist is undetermined.
AT_LIMIT = 1e-12

Named = Literal["twist", "torque"]


@dataclass(frozen=True)
class Branch:
    """Change of the twist since a load reversal, or since the first twist, in one direction.

    The equivalent first twist is a monotonic twist of the virgin contact. The change is `sense`
    times `weight` times that twist.

    sense   direction, +1 or -1
    weight  1 for the first twist, 2 after a reversal
    state   state of the equivalent first twist; None at the start of the branch
    """

    sense: float
    weight: float
    state: PartialSlip | None = None

    def size(self, of: str) -> float:
        """Return the twist, torque, work or dissipated energy of the equivalent first twist.

        It is 0 at the start of the branch. The equivalent first twist is a monotonic twist of the
        virgin contact.

        of  name of the quantity: "twist", "torque", "work" or "dissipated"
        """
        return 0.0 if self.state is None else float(getattr(self.state, of))


@dataclass(frozen=True)
class TwistPath:
    """State of torsion after a history of twists, as a path of branches.

    of          contact under torsion
    branches    branches of the path that are not closed load cycles, the current branch last; empty
                before the first twist
    dissipated  energy dissipated since the start [force length]
    work        work of the torque since the start [force length]
    """

    of: Torsion
    branches: tuple[Branch, ...] = ()
    dissipated: float = 0.0
    work: float = 0.0

    @property
    def twist(self) -> float:
        """Return the twist φ of the indenter [radian]."""
        return _sum(self.branches, "twist")

    @property
    def torque(self) -> float:
        """Return the torque M [force length]."""
        return _sum(self.branches, "torque")

    @property
    def stick(self) -> float:
        """Return the stick radius of the current branch over the contact radius."""
        last = self.branches[-1].state if self.branches else None
        return 1.0 if last is None else last.stick

    def to_twist(self, twist: float) -> TwistPath:
        """Continue the path of torsion to a given twist [radian], and return the new state."""
        return self._on("twist", twist)

    def to_torque(self, torque: float) -> TwistPath:
        """Continue the path of torsion to a given torque [force length], and return the new state.

        Raises GrossSliding if the torque is not below its friction limit.
        """
        if abs(torque) >= self.of.largest * (1 - AT_LIMIT):
            raise GrossSliding(
                f"torque {torque:.6g} N m, but friction carries less than {self.of.largest:.6g} "
                "N m. Reduce it, or prescribe the twist"
            )
        return self._on("torque", torque)

    def _on(self, of: Named, target: float) -> TwistPath:
        """Continue the path of torsion until the twist or the torque has a given value.

        A change of direction begins a new branch of the path. A branch that reaches the length of
        the preceding branch closes a load cycle with it.

        of      "twist" or "torque", the prescribed quantity
        target  value of this quantity [radian or force length]
        """
        if target == getattr(self, of):
            return self
        sense = 1.0 if target > getattr(self, of) else -1.0
        branches, dissipated, work = list(self.branches), self.dissipated, self.work
        if not branches or branches[-1].sense != sense:
            branches.append(Branch(sense, 2.0 if branches else 1.0))
        while True:
            *others, last = branches
            needed = sense * (target - _sum(others, of)) / last.weight
            closes = bool(others) and needed >= others[-1].size(of)
            state = others[-1].state if closes else reached(self.of, of, needed, last.state)
            assert state is not None
            ended = replace(last, state=state)
            dissipated += last.weight * (state.dissipated - last.size("dissipated"))
            work += _work(others, ended) - _work(others, last)
            if not closes:
                return TwistPath(self.of, (*others, ended), dissipated, work)
            left = others.pop()
            branches = [replace(ended, weight=1.0)] if left.weight == 1 else others


def _sum(branches: list[Branch] | tuple[Branch, ...], of: str) -> float:
    """Return the twist or torque of a path, the sum of the changes of its branches.

    of  "twist" or "torque"
    """
    return sum((branch.sense * branch.weight * branch.size(of) for branch in branches), 0.0)


def _work(others: list[Branch], branch: Branch) -> float:
    """Return the work ∫ M dφ of the torque along one branch of a path [force length].

    others  preceding branches; their torque is constant during the branch
    branch  the branch of the path
    """
    linear = branch.sense * branch.weight * branch.size("twist") * _sum(others, "torque")
    return linear + branch.weight**2 * branch.size("work")


def reached(
    torsion: Torsion, of: Named, needed: float, since: PartialSlip | None = None
) -> PartialSlip:
    """Find the state of a monotonic first twist that has a given twist or torque.

    The unknown is the stick radius.

    torsion  contact under torsion
    of       "twist" or "torque", the prescribed quantity
    needed   value of this quantity, above 0 [radian or force length]
    since    earlier state, whose stick radius is an upper bound; None if there is none
    """
    whole, none = torsion.whole, torsion.none
    if needed <= getattr(whole, of):
        part = needed / getattr(whole, of)
        return replace(whole, twist=part * whole.twist, layers=part * whole.layers)
    if needed >= getattr(none, of):
        return replace(torsion.partial_slip(0.0), twist=needed if of == "twist" else none.twist)
    most = 1.0 if since is None or since.stick == 0 else min(1.0, since.stick * (1 + NO_STICK))

    def missing(stick: float) -> float:
        """Return the twist or torque at a given stick radius, minus the prescribed value.

        stick  stick radius over the contact radius
        """
        return float(getattr(torsion.partial_slip(stick), of)) - needed

    return torsion.partial_slip(float(brentq(missing, NO_STICK, most, xtol=1e-15, rtol=1e-15)))
