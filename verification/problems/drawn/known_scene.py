"""A drawn scene whose answer is known: what is solved, how finely, and numbers with sources."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from contact_errors.values import Values
from contact_scene import FiniteElementDiscretisation, Scene, SurfaceDiscretisation
from verification.problems.reference import ROUNDING, Reference, ReferenceKind

CELLS, ELEMENTS = "semi-analytical", "fem-complementarity"
APPROACH, PEAK, RADIUS = "approach", "peak_pressure", "contact_radius"
STICK, SHIFT, TWIST, TILT = "stick_radius", "tangential_shift", "twist", "tilt"
NORMAL, TANGENTIAL, TORQUE, MOMENT = "normal_force", "tangential_force", "torque", "moment"
ENERGY, CYCLE, ELASTIC, WORK = (
    "dissipated_energy", "energy_per_cycle", "elastic_energy", "input_work"
)  # fmt: skip
AMPLITUDE, F1, F2 = "slip_amplitude", "ruiz_f1", "ruiz_f2"
TENSION, MISES = "max_principal", "von_mises"
STRESSES = (TENSION, MISES)
# What is judged, and of which quantities.
KINDS = {
    APPROACH: (APPROACH, NORMAL),
    PEAK: (PEAK,),
    RADIUS: (RADIUS,),
    STICK: (STICK,),
    SHIFT: (SHIFT, TANGENTIAL),
    TWIST: (TWIST, TORQUE),
    TILT: (TILT, MOMENT),
    ENERGY: (ENERGY, CYCLE),
    ELASTIC: (ELASTIC,),
    WORK: (WORK,),
    "largest_of_a_cycle": (AMPLITUDE, F1, F2),
    TENSION: (TENSION,),
    MISES: (MISES,),
}


@dataclass(frozen=True)
class Truth:
    """One number of the answer, of a vector the component along x.

    step       loading step at whose end it holds, from 1
    reference  in SI, with its standard uncertainty
    """

    step: int
    quantity: str
    reference: Reference

    @property
    def kind(self) -> str:
        """By which it is counted."""
        return next(kind for kind, names in KINDS.items() if self.quantity in names)

    def read(self, steps: Sequence[Values]) -> float | None:
        """The same number of a result, by what its steps have; None where it has none.

        Stresses are not of a result, see `stress_maxima.py`.
        """
        value = steps[self.step - 1].get(self.quantity)
        return None if value is None else float(value[0])


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
