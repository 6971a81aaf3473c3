"""A drawn scene whose answer is known: what is solved, how finely, and numbers with sources."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from contact_scene import FiniteElementDiscretisation, Scene, SurfaceDiscretisation
from verification.problems.reference import ROUNDING, Reference, ReferenceKind

CELLS, ELEMENTS = "semi-analytical", "fem-complementarity"
APPROACH, PEAK, RADIUS = "approach", "peak_pressure", "contact_radius"
STICK, SHIFT, TWIST = "stick_radius", "tangential_shift", "twist"
ENERGY, CYCLE = "dissipated_energy", "energy_per_cycle"
TENSION, MISES = "max_principal", "von_mises"
STRESSES = (TENSION, MISES)
# What is judged, and of which quantities.
KINDS = {
    APPROACH: (APPROACH,),
    PEAK: (PEAK,),
    RADIUS: (RADIUS,),
    STICK: (STICK,),
    SHIFT: (SHIFT,),
    TWIST: (TWIST,),
    ENERGY: (ENERGY, CYCLE),
    TENSION: (TENSION,),
    MISES: (MISES,),
}


@dataclass(frozen=True)
class Truth:
    """One number of the answer.

    step       loading step at whose end it holds, from 1
    since      of a difference of two ends, the step of the first
    reference  in SI, with its standard uncertainty
    """

    step: int
    quantity: str
    reference: Reference
    since: int | None = None

    @property
    def kind(self) -> str:
        """By which it is counted."""
        return next(kind for kind, names in KINDS.items() if self.quantity in names)

    def read(self, steps: Sequence[Any]) -> float | None:
        """The same number of a result, by the ends of its steps; None where it has none.

        Stresses are not of a result, see `stress_maxima.py`.
        """
        end = steps[self.step - 1]
        if self.quantity == SHIFT:
            return None if end.tangential_shift is None else float(end.tangential_shift[0])
        if self.quantity != CYCLE:
            value = getattr(end, self.quantity)
            return None if value is None else float(value)
        assert self.since is not None
        energies = end.dissipated_energy, steps[self.since - 1].dissipated_energy
        return None if None in energies else float(energies[0] - energies[1])


class Fineness(NamedTuple):
    """How finely a solver shall solve.

    solver      by its name on the command line
    per_radius  cells or elements per contact radius
    """

    solver: str
    asked: SurfaceDiscretisation | FiniteElementDiscretisation
    per_radius: float


@dataclass(frozen=True)
class KnownScene:
    """A scene, what is known of its answer, and how finely it shall be solved."""

    scene: Scene
    truths: tuple[Truth, ...]
    fineness: Fineness

    @property
    def homogeneous(self) -> bool:
        """Whether neither body is coated."""
        return not (self.scene.body.layers or self.scene.indenter.layers)

    @property
    def loops(self) -> bool:
        """Whether a cycle of loads is closed."""
        return any(truth.quantity == CYCLE for truth in self.truths)


def known(
    step: int,
    source: str,
    values: dict[str, float],
    uncertainty: float = ROUNDING,
    kind: ReferenceKind = ReferenceKind.CLOSED_FORM,
) -> Iterator[Truth]:
    """What is known at the end of a step, by quantity.

    uncertainty  relative, of all of them
    """
    for quantity, value in values.items():
        yield Truth(step, quantity, Reference(value, kind, source, uncertainty * abs(value)))
