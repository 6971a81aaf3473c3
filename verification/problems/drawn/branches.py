"""Loading to and fro from the curve of first loading (Masing's rule), and the energy of it.

At constant pressure of uncoupled bodies a branch after a reversal is the curve of first loading
with force and motion doubled, where slip keeps its direction up to its sign (Mindlin and
Deresiewicz 1953; Jäger 1998).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev
from scipy.optimize import brentq

from contact_scene import Body, CoulombFriction, LoadStep, Scene
from contact_scene.geometry import Indenter
from verification.problems.drawn import drawing
from verification.problems.drawn.known_scene import (
    CYCLE,
    ELASTIC,
    ENERGY,
    SHIFT,
    STICK,
    TANGENTIAL,
    TORQUE,
    TWIST,
    WORK,
    Truth,
    known,
)

NODES = 20
INTERPOLATED = 1e-5  # relative error of what goes through `Twisting`


class Reached(NamedTuple):
    """State at a force: motion that goes with it, stick radius, and of the energy since zero what
    is lost and what is stored."""

    motion: float
    stick_radius: float
    energy: float
    stored: float

    @classmethod
    def first(cls, force: float, motion: float, stick_radius: float, energy: float) -> Reached:
        """By first loading: a quarter of a loop is lost, 2 ∫ force d(motion) - force motion."""
        return cls(motion, stick_radius, energy, (force * motion - energy) / 2)


FirstLoading = Callable[[float], Reached]


def along(virgin: FirstLoading, forces: Sequence[float]) -> Iterator[Reached]:
    """States at these forces: they rise, fall at most to the negative of the largest, and may then
    rise to it again."""
    last, turned, rising = 0.0, 0.0, True
    base = reached = Reached(0.0, 0.0, 0.0, 0.0)
    for force in forces:
        if (force > last) != rising:
            turned, rising = last, not rising
            base = reached
        if turned == 0.0:
            reached = virgin(force)
        elif rising:  # the loop is closed where it began
            half = virgin(force)
            reached = half._replace(energy=base.energy + 2 * half.energy)
        else:
            half = virgin((turned - force) / 2)
            reached = Reached(
                base.motion - 2 * half.motion,
                half.stick_radius,
                base.energy + 2 * half.energy,
                base.stored - (turned + force) * half.motion,
            )
        last = force
        yield reached


@dataclass(frozen=True)
class Twisting:
    """First loading by a torque, by the radius of the stick disc.

    torque, twist   as functions of it, falling to zero at the contact radius
    energy          lost, M φ - 2 ∫ φ dM: a quarter of the loop between M and -M
    """

    torque: Chebyshev
    twist: Chebyshev
    energy: Chebyshev

    @classmethod
    def of(
        cls, state: Callable[[float], tuple[float, float]], smallest: float, contact_radius: float
    ) -> Twisting:
        """Interpolated between states (torque, twist) at stick radii from the smallest on."""
        domain = [smallest, contact_radius]
        stops = Chebyshev.basis(NODES, domain=domain).roots()
        torque, twist = (
            Chebyshev.fit(stops, values, NODES - 1, domain=domain)
            for values in np.transpose([state(float(c)) for c in stops])
        )
        # from the contact radius, where all is zero, inwards
        area = (twist * torque.deriv()).integ(lbnd=contact_radius)
        return cls(torque, twist, torque * twist - 2 * area)

    def __call__(self, torque: float) -> Reached:
        ends = self.torque.domain
        c = float(brentq(lambda c: self.torque(c) - torque, *ends, xtol=1e-14 * ends[1]))
        return Reached.first(torque, float(self.twist(c)), c, float(self.energy(c)))


@dataclass(frozen=True, kw_only=True)
class Led:
    """Pressed with friction, and led through forces along x or torques, or the motions that go with
    them.

    virgin       first loading
    forces       at the ends of the steps
    load         that presses before [force]
    stored       energy by that
    by_motion    which of the two is prescribed
    twists       torques, not forces
    source       of the numbers
    uncertainty  relative, of all of them
    """

    virgin: FirstLoading
    forces: Sequence[float]
    load: float
    stored: float
    by_motion: bool
    twists: bool = False
    source: str
    uncertainty: float

    def scene(self, indenter: Indenter, body: Body, mu: float) -> Scene:
        """Between these bodies."""
        loads = [s.motion for s in self._states] if self.by_motion else self.forces
        return led(indenter, body, mu, self.load, self._names[self.by_motion], loads)

    def truths(self) -> Iterator[Truth]:
        """What is known at the ends of the steps."""
        closed, free = drawing.closes(self.forces), self._names[not self.by_motion]
        for step, (force, state) in enumerate(zip(self.forces, self._states, strict=True), start=2):
            if step > 2 and abs(force) == self.forces[0]:
                continue  # by symmetry the numbers of the first loading once more
            elastic = self.stored + state.stored
            values = {
                free: force if self.by_motion else state.motion,
                STICK: state.stick_radius,
                ELASTIC: elastic,
                WORK: elastic + state.energy,
            }
            if step > 2 or not closed:  # the energy of a closed loop is four times this one
                values[ENERGY] = state.energy
            finite = {name: value for name, value in values.items() if value == value}
            yield from known(step, self.source, finite, self.uncertainty)
        lost = self._states[-1].energy - self._states[0].energy
        if closed and lost == lost:
            yield from known(len(self.forces) + 1, self.source, {CYCLE: lost}, self.uncertainty)

    @property
    def _names(self) -> tuple[str, str]:
        return (TORQUE, TWIST) if self.twists else (TANGENTIAL, SHIFT)

    @cached_property
    def _states(self) -> Sequence[Reached]:
        return list(along(self.virgin, self.forces))


def led(
    indenter: Indenter, body: Body, mu: float, load: float, name: str, loads: Sequence[float]
) -> Scene:
    """Pressed with friction, and led through forces or shifts along x, or torques or twists: the
    key of a step."""
    steps: list[dict[str, Any]] = [
        {name: (value, 0.0) if name in (TANGENTIAL, SHIFT) else value} for value in loads
    ]
    return Scene(
        title=f"{type(indenter).__name__} led by {name}",
        indenter=indenter,
        body=body,
        friction=CoulombFriction(coefficient=mu),
        loading=(LoadStep(normal_force=load), *(LoadStep(**step) for step in steps)),
    )
