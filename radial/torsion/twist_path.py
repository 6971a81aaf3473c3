"""Twisting to and fro under constant pressure: what has slipped back, and what not yet.

After a reversal the change of the shear is that of a first twist with 2µ in the place of µ, so that
with f of the first twist M - M_r = ± 2 f(|φ - φ_r|/2) (Mindlin and Deresiewicz 1953; for torsion
Deresiewicz 1954). A branch that has gone as far as the one before it closes a loop with that, and
the one before both goes on. Layers change f and nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from scipy.optimize import brentq

from contact_scene.solver_errors import GrossSliding
from radial.torsion.torsion import (
    NO_STICK,
    Slipped,
    Torsion,
)

# Of the largest torque: closer to it all slips, and the twist is undefined.
AT_LIMIT = 1e-12

Named = Literal["twist", "torque"]


@dataclass(frozen=True)
class Branch:
    """A way from a reversal, or from rest.

    sense   +1 or -1
    weight  1 from rest, 2 after a reversal
    state   of the first twist that it repeats; None at its beginning
    """

    sense: float
    weight: float
    state: Slipped | None = None

    def size(self, of: str) -> float:
        """Twist, torque or dissipated energy of the first twist that it repeats."""
        return 0.0 if self.state is None else float(getattr(self.state, of))


@dataclass(frozen=True)
class TwistPath:
    """Where a history of twists stands.

    of          the contact
    branches    that have not been closed, the current one last; none before the first twist
    dissipated  since the beginning [force length]
    work        of the torque since the beginning [force length]
    """

    of: Torsion
    branches: tuple[Branch, ...] = ()
    dissipated: float = 0.0
    work: float = 0.0

    @property
    def twist(self) -> float:
        """φ [radian]."""
        return _sum(self.branches, "twist")

    @property
    def torque(self) -> float:
        """M [force length]."""
        return _sum(self.branches, "torque")

    @property
    def stick(self) -> float:
        """Radius of what sticks while the current branch goes on, over that of the contact."""
        last = self.branches[-1].state if self.branches else None
        return 1.0 if last is None else last.stick

    def to_twist(self, twist: float) -> TwistPath:
        """On to a twist [radian]."""
        return self._on("twist", twist)

    def to_torque(self, torque: float) -> TwistPath:
        """On to a torque [force length]; raises GrossSliding where friction carries no more."""
        if abs(torque) >= self.of.largest * (1 - AT_LIMIT):
            raise GrossSliding(
                f"torque {torque:.6g} N m, but friction carries less than {self.of.largest:.6g} "
                "N m; reduce it, or prescribe the twist"
            )
        return self._on("torque", torque)

    def _on(self, of: Named, target: float) -> TwistPath:
        if target == getattr(self, of):
            return self
        sense = 1.0 if target > getattr(self, of) else -1.0
        branches, lost, work = list(self.branches), self.dissipated, self.work
        if not branches or branches[-1].sense != sense:
            branches.append(Branch(sense, 2.0 if branches else 1.0))
        while True:
            *others, last = branches
            needed = sense * (target - _sum(others, of)) / last.weight
            closes = bool(others) and needed >= others[-1].size(of)
            state = others[-1].state if closes else reached(self.of, of, needed, last.state)
            assert state is not None
            ended = replace(last, state=state)
            lost += last.weight * (state.dissipated - last.size("dissipated"))
            work += _work(others, ended) - _work(others, last)
            if not closes:
                return TwistPath(self.of, (*others, ended), lost, work)
            left = others.pop()
            branches = [replace(ended, weight=1.0)] if left.weight == 1 else others


def _sum(branches: list[Branch] | tuple[Branch, ...], of: str) -> float:
    return sum((branch.sense * branch.weight * branch.size(of) for branch in branches), 0.0)


def _work(others: list[Branch], branch: Branch) -> float:
    """∫ M dφ along a branch [force length]."""
    held = branch.sense * branch.weight * branch.size("twist") * _sum(others, "torque")
    return held + branch.weight**2 * branch.size("work")


def reached(torsion: Torsion, of: Named, needed: float, since: Slipped | None = None) -> Slipped:
    """The state of the first twist whose twist [radian] or torque [force length] is `needed` > 0.

    since  an earlier state, if one is known
    """
    whole, none = torsion.whole, torsion.none
    if needed <= getattr(whole, of):
        part = needed / getattr(whole, of)
        return replace(whole, twist=part * whole.twist, layers=part * whole.layers)
    if needed >= getattr(none, of):
        return replace(torsion.slipped(0.0), twist=needed if of == "twist" else none.twist)
    most = 1.0 if since is None or since.stick == 0 else min(1.0, since.stick * (1 + NO_STICK))

    def missing(stick: float) -> float:
        return float(getattr(torsion.slipped(stick), of)) - needed

    return torsion.slipped(float(brentq(missing, NO_STICK, most, xtol=1e-15, rtol=1e-15)))
