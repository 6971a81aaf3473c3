"""The scalars of an increment: name, unit and meaning of each, once for all solvers.

What a solver does not have, or an effect that is off does not define, is None. A new one is
declared here and given where an increment is made; no other place lists them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, GetPydanticSchema

from contact_scene.quantities.field_metadata import (
    Kind,
    Reported,
    reported,
)
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.stored_fields import WithFields

# Along x and y; two numbers in a file.
Vector: TypeAlias = Annotated[
    tuple[float, float] | NDArray[np.float64],
    GetPydanticSchema(lambda _, handler: handler(tuple[float, float])),
]
Count: TypeAlias = Annotated[int, Field(ge=0)]


@dataclass(frozen=True, kw_only=True)
class State:
    """What an increment has led to. Vectors are (x, y), of the indenter relative to the body:
    positive force gives positive shift."""

    normal_force: Annotated[float, Reported("N", "Normal force.", key=True)]
    approach: Annotated[
        float, Reported("m", "Approach of the bodies, counted from first touch.", key=True)
    ]
    contact_area: Annotated[float, Reported("m^2", "Area in contact, with sub-cell accuracy.")]
    contact_radius: Annotated[
        float,
        Reported("m", "Radius of the circle of the contact area, sqrt(area / pi).", key=True),
    ]
    peak_pressure: Annotated[
        float,
        Reported(
            "Pa",
            "Largest pressure of any cell (finite elements: of any node; with edges inside the "
            "cells: at any point).",
            key=True,
        ),
    ]
    tangential_force: Annotated[
        Vector | None,
        Reported("N", "Tangential force; null without friction.", Kind.VECTOR, key=True),
    ] = None
    tangential_shift: Annotated[
        Vector | None,
        Reported(
            "m",
            "Tangential shift; null without friction, or undefined, at the friction limit under "
            "force control.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    actuator_approach: Annotated[
        float | None,
        Reported("m", "Approach of the actuator; null without a normal spring.", key=True),
    ] = None
    actuator_shift: Annotated[
        Vector | None,
        Reported(
            "m",
            "Tangential shift of the actuator, tangential_shift + force/stiffness; null without a "
            "tangential spring and where tangential_shift is.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    torque: Annotated[
        float | None, Reported("N m", "Torque about z; null where nothing twists.", key=True)
    ] = None
    twist: Annotated[
        float | None,
        Reported(
            "rad", "Twist, the rotation about z; null where nothing twists, or undefined.", key=True
        ),
    ] = None
    moment: Annotated[
        Vector | None,
        Reported(
            "N m",
            "Moments (Mx, My) of the pressure, the sums of p y and p x; null where nothing tilts.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    tilt: Annotated[
        Vector | None,
        Reported(
            "rad",
            "Tilt (x, y): slopes that close the gap at positive y and x; null where nothing tilts.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    bulk_strain: Annotated[
        Vector | None,
        Reported(
            "",
            "Normal strains of the lower body along x and y; null where no step names a strain.",
            Kind.VECTOR,
        ),
    ] = None
    bulk_shear: Annotated[
        float | None,
        Reported("", "Shear strain exy of the lower body; null where no step names a strain."),
    ] = None
    stick_area: Annotated[
        float | None,
        Reported(
            "m^2",
            "Area that sticks, with sub-cell accuracy; null without friction, or of a contact too "
            "small for rings to tell it.",
        ),
    ] = None
    stick_radius: Annotated[
        float | None,
        Reported(
            "m",
            "Radius of the circle of the stick area, sqrt(area / pi); null as the area is.",
            key=True,
        ),
    ] = None
    dissipated_energy: Annotated[
        float | None,
        Reported(
            "J",
            "Energy dissipated by slip since the start of the history; null without friction.",
            key=True,
        ),
    ] = None
    dissipation_uncertainty: Annotated[
        float | None,
        Reported(
            "J",
            "By how much finite increments leave the dissipated energy uncertain: the changes of "
            "friction along all slip, in steps whose path matters; null where it is undefined.",
            physical=False,
        ),
    ] = None
    elastic_energy: Annotated[
        float | None,
        Reported(
            "J",
            "Energy stored in both bodies, without springs of a rig; null for a solver that does "
            "not keep the account.",
        ),
    ] = None
    input_work: Annotated[
        float | None,
        Reported(
            "J",
            "Work of forces and moments on the bodies since the start of the history: "
            "elastic_energy + dissipated_energy (finite elements that state no elastic energy: "
            "the trapezoidal sum); null where a motion is undefined, at the friction limit under "
            "force control.",
        ),
    ] = None
    unresolved_work: Annotated[
        float | None,
        Reported(
            "J",
            "Trapezoidal sum of forces over motions, increment by increment, minus input_work. It "
            "vanishes with the length of the increments.",
            physical=False,
        ),
    ] = None
    energy_imbalance: Annotated[
        float | None,
        Reported(
            "",
            "Part of the trapezoidal sum of forces over motions that is neither stored, dissipated "
            "nor explained by the length of the increment, relative to the largest energy so far; "
            "of a step the largest.",
            Kind.LARGEST,
            physical=False,
        ),
    ] = None
    largest_dissipation_increment: Annotated[
        float | None,
        Reported(
            "J/m^2",
            "Largest energy per area dissipated within an increment.",
            Kind.LARGEST,
            physical=False,
        ),
    ] = None
    largest_slip_increment: Annotated[
        float | None,
        Reported("m", "Largest slip within an increment.", Kind.LARGEST, physical=False),
    ] = None
    overlap: Annotated[
        float | None,
        Reported(
            "m", "Largest overlap that a penalty leaves; null without a penalty.", physical=False
        ),
    ] = None

    @property
    def trapezoidal_work(self) -> float | None:
        """Sum of ½(f₀ + f₁) Δω over forces, motions and increments [force length]."""
        return None if self.input_work is None else self.input_work + (self.unresolved_work or 0.0)


@dataclass(frozen=True, kw_only=True)
class Quality:
    """Residual and edge correction of an increment."""

    edge_change: Annotated[
        float | None,
        Reported(
            "",
            "Change of pressure or shear in the last round of the edge correction, relative to all "
            "of it; null where tractions are constant on cells up to their edges.",
            physical=False,
        ),
    ] = None
    worst_residual: Annotated[
        float | None,
        Reported("", "Largest residual of any kind at the end of any increment.", Kind.LARGEST),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Counters:
    """Work of the solver for an increment; `timing.json` has their sums over each load step."""

    iterations: Annotated[Count, Reported("", "Iterations of the solver.", Kind.COUNTER)]
    convolutions: Annotated[
        Count | None,
        Reported(
            "", "Convolutions (pairs of transforms); null for a solver that has none.", Kind.COUNTER
        ),
    ] = None
    factorizations: Annotated[
        Count | None,
        Reported("", "Factorisations of a matrix; null for a solver that has none.", Kind.COUNTER),
    ] = None
    rounds: Annotated[
        Count | None,
        Reported(
            "",
            "Steps for pressure and shear together on cells: of Newton's method, and rounds of "
            "alternation where that stalls; none where one pass does it.",
            Kind.COUNTER,
        ),
    ] = None
    sweeps: Annotated[
        Count | None,
        Reported("", "Passes through pressure and shear of finite elements.", Kind.COUNTER),
    ] = None
    augmentations: Annotated[
        Count | None,
        Reported(
            "",
            "Corrections of the tractions of a penalty; null without a penalty.",
            Kind.COUNTER,
        ),
    ] = None
    halvings: Annotated[
        Count, Reported("", "How often an increment was cut in two to converge.", Kind.COUNTER)
    ] = 0


@dataclass(frozen=True, kw_only=True)
class ReportedIncrement(Counters, Quality, State, WithFields):
    """The scalars of one increment, and its place in the history.

    step, index         loading step and increment within it, both counted from 1
    increments_in_step  how many increments the step has
    residuals           how well it fulfils each equation
    """

    step: int
    index: int
    increments_in_step: int
    residuals: Residuals
    worst_residual: float = field(init=False)

    def __post_init__(self) -> None:
        values = vars(self)
        values["worst_residual"] = self.residuals.worst
        for name in SCALARS:
            values[name] = _unsigned_zero(values[name])


SCALARS: Mapping[str, Reported] = {**reported(State), **reported(Quality)}
COUNTERS: Mapping[str, Reported] = reported(Counters)


def _unsigned_zero(value: Any) -> Any:
    """The number or vector; a zero has no sign, which says nothing here and would be printed."""
    if isinstance(value, tuple):
        return tuple(map(_unsigned_zero, value))
    return value if value is None or isinstance(value, int) else value + 0.0


def components(name: str) -> tuple[str, ...]:
    """The numbers that a scalar of this name consists of: itself, or x and y of a vector."""
    if SCALARS[name].kind is Kind.VECTOR:
        return f"{name}_x", f"{name}_y"
    return (name,)


def numbers(increment: State | Quality) -> dict[str, float | int | None]:
    """All scalars of a record, vectors by component; None where it has none."""
    found: dict[str, float | int | None] = {}
    for name in SCALARS:
        value = getattr(increment, name)
        parts = components(name)
        values = value if len(parts) > 1 and value is not None else (value,) * len(parts)
        found |= dict(zip(parts, map(_number, values), strict=True))
    return found


def _number(value: float | None) -> float | int | None:
    """A number of Python's own."""
    return value if value is None or isinstance(value, int) else float(value)
