"""A drawn scene and its known numbers, with the discretisation that is judged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from contact_errors.values import Values
from contact_scene import FiniteElementDiscretisation, Scene, SurfaceDiscretisation
from verification.problems.reference import Reference, ReferenceKind

CELLS, ELEMENTS = "semi-analytical", "fem-complementarity"
APPROACH, PEAK, RADIUS, STICK = "approach", "peak_pressure", "contact_radius", "stick_radius"
SHIFT, TWIST, TILT = "tangential_shift", "twist", "tilt"
NORMAL, TANGENTIAL, TORQUE, MOMENT = "normal_force", "tangential_force", "torque", "moment"
ENERGY, CYCLE, ELASTIC, WORK = (
    "dissipated_energy", "energy_per_cycle", "elastic_energy", "input_work"
)  # fmt: skip
AMPLITUDE, F1, F2 = "slip_amplitude", "ruiz_f1", "ruiz_f2"
TENSION, MISES = "max_principal", "von_mises"
STRESSES = (TENSION, MISES)
# Kinds of numbers that are judged, each with its quantities.
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
KIND_OF = {quantity: kind for kind, names in KINDS.items() for quantity in names}


@dataclass(frozen=True)
class Truth:
    """A known number; of a vector, its component along x.

    step       load step at whose end it holds, from 1
    reference  in SI, with its uncertainty
    """

    step: int
    quantity: str
    reference: Reference

    @property
    def kind(self) -> str:
        """Kind of number that it counts for."""
        return KIND_OF[self.quantity]

    def read(self, steps: Sequence[Values]) -> float | None:
        """Return the same number of a result; None for an absent number."""
        value = steps[self.step - 1].get(self.quantity)
        return None if value is None else float(value[0])


class Fineness(NamedTuple):
    """Discretisation that is judged.

    solver      name on the command line
    per_radius  cells or elements per contact radius
    """

    solver: str
    asked: SurfaceDiscretisation | FiniteElementDiscretisation
    per_radius: float


@dataclass(frozen=True)
class KnownScene:
    """A scene, its known numbers, and the discretisation that is judged."""

    scene: Scene
    truths: tuple[Truth, ...]
    fineness: Fineness


def known(
    step: int, source: str, values: Mapping[str, float], uncertainty: float, kind: ReferenceKind
) -> Iterator[Truth]:
    """Yield known numbers at the end of a step, with one relative uncertainty."""
    for quantity, value in values.items():
        yield Truth(step, quantity, Reference(value, kind, source, uncertainty * abs(value)))
