"""Load cycles of torsion under a constant normal load.

After a reversal the change of the shear is that of a first twist with 2µ instead of µ. With the
torque f of the first twist, M - M_r = ± 2 f(|φ - φ_r|/2) (Mindlin and Deresiewicz 1953; for torsion
Deresiewicz 1954). A branch as long as the preceding one closes a loop with it, and the branch
before both continues. Layers change f only.
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

# Distance from the largest torque, over this torque, in which the twist is undetermined.
AT_LIMIT = 1e-12

Named = Literal["twist", "torque"]


@dataclass(frozen=True)
class Branch:
    """Change of the twist since a load reversal, or since the first twist.

    sense   +1 or -1
    weight  1 for the first twist, 2 after a reversal
    state   of the equivalent first twist; None at the start of the branch
    """

    sense: float
    weight: float
    state: PartialSlip | None = None

    def size(self, of: str) -> float:
        """Return twist, torque, work or dissipated energy of the equivalent first twist."""
        return 0.0 if self.state is None else float(getattr(self.state, of))


@dataclass(frozen=True)
class TwistPath:
    """State of torsion after a history of twists.

    of          the contact
    branches    that are not closed, the current one last; empty before the first twist
    dissipated  energy since the start [force length]
    work        of the torque since the start [force length]
    """

    of: Torsion
    branches: tuple[Branch, ...] = ()
    dissipated: float = 0.0
    work: float = 0.0

    @property
    def twist(self) -> float:
        """Twist φ [radian]."""
        return _sum(self.branches, "twist")

    @property
    def torque(self) -> float:
        """Torque M [force length]."""
        return _sum(self.branches, "torque")

    @property
    def stick(self) -> float:
        """Stick radius of the current branch over the contact radius."""
        last = self.branches[-1].state if self.branches else None
        return 1.0 if last is None else last.stick

    def to_twist(self, twist: float) -> TwistPath:
        """Continue to a twist [radian]."""
        return self._on("twist", twist)

    def to_torque(self, torque: float) -> TwistPath:
        """Continue to a torque [force length]; raise GrossSliding above the friction limit."""
        if abs(torque) >= self.of.largest * (1 - AT_LIMIT):
            raise GrossSliding(
                f"torque {torque:.6g} N m, but friction carries less than {self.of.largest:.6g} "
                "N m. Reduce it, or prescribe the twist"
            )
        return self._on("torque", torque)

    def _on(self, of: Named, target: float) -> TwistPath:
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
    return sum((branch.sense * branch.weight * branch.size(of) for branch in branches), 0.0)


def _work(others: list[Branch], branch: Branch) -> float:
    """Return ∫ M dφ along a branch [force length]."""
    linear = branch.sense * branch.weight * branch.size("twist") * _sum(others, "torque")
    return linear + branch.weight**2 * branch.size("work")


def reached(
    torsion: Torsion, of: Named, needed: float, since: PartialSlip | None = None
) -> PartialSlip:
    """Return the state of the first twist whose twist [radian] or torque [force length] is
    `needed`.

    needed  > 0
    since   an earlier state as a bound of the stick radius; None if there is none
    """
    whole, none = torsion.whole, torsion.none
    if needed <= getattr(whole, of):
        part = needed / getattr(whole, of)
        return replace(whole, twist=part * whole.twist, layers=part * whole.layers)
    if needed >= getattr(none, of):
        return replace(torsion.partial_slip(0.0), twist=needed if of == "twist" else none.twist)
    most = 1.0 if since is None or since.stick == 0 else min(1.0, since.stick * (1 + NO_STICK))

    def missing(stick: float) -> float:
        return float(getattr(torsion.partial_slip(stick), of)) - needed

    return torsion.partial_slip(float(brentq(missing, NO_STICK, most, xtol=1e-15, rtol=1e-15)))
