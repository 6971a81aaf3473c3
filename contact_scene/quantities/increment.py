"""Scalars of an increment for all solvers: forces, areas, energies, with unit and meaning.

A scalar is None if the solver does not compute it or its effect is off. This module alone lists the
scalars; solvers pass their values where they create an increment.
"""

from collections.abc import Iterable, Mapping
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
    """Scalars of the contact at the end of an increment: loads, displacements, areas and energies.

    Vectors are (x, y), of the indenter relative to the body: a positive force causes a positive
    shift.
    """

    normal_force: Annotated[float, Reported("N", "Normal force.", key=True)]
    approach: Annotated[
        float | None,
        Reported("m", "Approach of the bodies, measured from first contact.", key=True),
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
            "Largest pressure of any cell (finite elements: of any node; with edge correction: at "
            "any point).",
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
            "Tangential shift; null without friction and where it is undefined, at the friction "
            "limit under force control.",
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
            "tangential spring and where tangential_shift is null.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    torque: Annotated[
        float | None, Reported("N m", "Torque about z; null without torsion.", key=True)
    ] = None
    twist: Annotated[
        float | None,
        Reported(
            "rad", "Twist, the rotation about z; null without torsion or if undefined.", key=True
        ),
    ] = None
    moment: Annotated[
        Vector | None,
        Reported(
            "N m",
            "Moments (Mx, My) of the pressure, the sums of p y and p x; null without tilt.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    tilt: Annotated[
        Vector | None,
        Reported(
            "rad",
            "Tilt (x, y): slopes that close the gap at positive y and x; null without tilt.",
            Kind.VECTOR,
            key=True,
        ),
    ] = None
    bulk_strain: Annotated[
        Vector | None,
        Reported(
            "",
            "Normal strains of the lower body along x and y; null without bulk strain.",
            Kind.VECTOR,
        ),
    ] = None
    bulk_shear: Annotated[
        float | None,
        Reported("", "Shear strain exy of the lower body; null without bulk strain."),
    ] = None
    stick_area: Annotated[
        float | None,
        Reported(
            "m^2",
            "Area of the stick zone, with sub-cell accuracy; null without friction and where the "
            "contact is too small for its rings to resolve it.",
        ),
    ] = None
    stick_radius: Annotated[
        float | None,
        Reported(
            "m",
            "Radius of the circle of the stick area, sqrt(area / pi); null if the area is null.",
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
            "Increment error of the dissipated energy: sum of the changes of friction along the "
            "slip, in steps with an increment error; null where it is undefined.",
            physical=False,
        ),
    ] = None
    normal_stiffness: Annotated[
        float | None,
        Reported(
            "N/m",
            "Normal contact stiffness dW/dδ at the end of a step, without springs of a rig: of "
            "continued loading if the step changes the normal load, else of full stick. Null if "
            "not requested, without contact, and if its linear solve does not converge.",
            key=True,
        ),
    ] = None
    tangential_stiffness: Annotated[
        float | None,
        Reported(
            "N/m",
            "Tangential contact stiffness dT/dδ at the end of a step, along the change of the "
            "tangential load: of continued slip if the step changes this load, else of full stick, "
            "as after a load reversal. Null as normal_stiffness, and without a tangential load.",
            key=True,
        ),
    ] = None
    torsional_stiffness: Annotated[
        float | None,
        Reported(
            "N m",
            "Torsional contact stiffness dM/dφ at the end of a step, per radian: of continued slip "
            "if the step changes the torsion, else of full stick. Null as normal_stiffness, and "
            "without torsion.",
            key=True,
        ),
    ] = None
    elastic_energy: Annotated[
        float | None,
        Reported(
            "J",
            "Elastic energy of both bodies, without springs of a rig; null for solvers without an "
            "energy balance.",
        ),
    ] = None
    input_work: Annotated[
        float | None,
        Reported(
            "J",
            "Work of forces and moments on the bodies since the start of the history: "
            "elastic_energy + dissipated_energy (finite elements without an elastic energy: the "
            "trapezoidal sum); null where a displacement is undefined, at the friction limit under "
            "force control.",
        ),
    ] = None
    unresolved_work: Annotated[
        float | None,
        Reported(
            "J",
            "Trapezoidal sum of force times displacement over the increments, minus input_work. "
            "Tends to 0 with the length of the increments.",
            physical=False,
        ),
    ] = None
    energy_imbalance: Annotated[
        float | None,
        Reported(
            "",
            "Part of the trapezoidal sum of force times displacement that is neither stored, "
            "dissipated nor explained by the length of the increment, relative to the largest "
            "energy so far; the largest value of a step.",
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
            "m", "Largest overlap in the penalty method; null without a penalty.", physical=False
        ),
    ] = None

    @property
    def is_line(self) -> bool:
        """True for a line contact, whose forces, areas and energies are per unit length."""
        return False

    @property
    def trapezoidal_work(self) -> float | None:
        """Work of all loads since the start of the history, by the trapezoidal rule [force length].

        The work is the sum of ½(f₀ + f₁) Δω over all forces f, their displacements ω and all
        increments. f₀ and f₁ are the forces at the start and the end of an increment. The value is
        None without an input work.
        """
        return None if self.input_work is None else self.input_work + (self.unresolved_work or 0.0)


@dataclass(frozen=True, kw_only=True)
class Quality:
    """Numerical quality of an increment: largest residual, and last change by the edge
    correction."""

    edge_change: Annotated[
        float | None,
        Reported(
            "",
            "Change of pressure or shear in the last iteration of the edge correction, relative to "
            "its total; null without edge correction.",
            physical=False,
        ),
    ] = None
    worst_residual: Annotated[
        float | None,
        Reported("", "Largest residual of any kind at the end of any increment.", Kind.LARGEST),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Counters:
    """Counters of the solver for an increment; `timing.json` has their sums over each load step."""

    iterations: Annotated[Count, Reported("", "Iterations of the solver.", Kind.COUNTER)]
    convolutions: Annotated[
        Count | None,
        Reported(
            "", "Convolutions (pairs of transforms); null for a solver without them.", Kind.COUNTER
        ),
    ] = None
    factorizations: Annotated[
        Count | None,
        Reported("", "Factorisations of a matrix; null for a solver without them.", Kind.COUNTER),
    ] = None
    rounds: Annotated[
        Count | None,
        Reported(
            "",
            "Outer iterations of coupled pressure and shear on cells: Newton steps, and "
            "alternating iterations where Newton's method stalls; 0 if one pass suffices.",
            Kind.COUNTER,
        ),
    ] = None
    sweeps: Annotated[
        Count | None,
        Reported("", "Outer iterations of pressure and shear on elements.", Kind.COUNTER),
    ] = None
    augmentations: Annotated[
        Count | None,
        Reported(
            "",
            "Updates of the multipliers of a penalty; null without a penalty.",
            Kind.COUNTER,
        ),
    ] = None
    halvings: Annotated[
        Count, Reported("", "Bisections of an increment that did not converge.", Kind.COUNTER)
    ] = 0


@dataclass(frozen=True, kw_only=True)
class ReportedIncrement(Counters, Quality, State, WithFields):
    """Results of one load increment: scalars, residuals, counters, and position in the history.

    step, index     load step, and increment within the load step, counted from 1
    increments_in_step
                    number of increments of the load step
    residuals       residual of each equation of the contact problem
    worst_residual  largest of the residuals
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
            values[name] = _remove_sign_of_zero(values[name])


STIFFNESSES = "normal_stiffness", "tangential_stiffness", "torsional_stiffness"
SCALARS: Mapping[str, Reported] = {**reported(State), **reported(Quality)}
COUNTERS: Mapping[str, Reported] = reported(Counters)


def columns(
    increments: Iterable[State | Quality | Counters], names: Iterable[str]
) -> dict[str, tuple[Any, ...]]:
    """Return the values of reported scalars by name, one value for each increment.

    The increments are read one after the other, since each may be stored in a file.

    increments  results of at least one increment
    names       names of the scalars, such as "tangential_force"
    """
    names = list(names)
    rows = [[getattr(increment, name) for name in names] for increment in increments]
    return dict(zip(names, zip(*rows, strict=True), strict=True))


def _remove_sign_of_zero(value: Any) -> Any:
    """Replace -0.0 by 0.0, whose sign has no meaning in a result."""
    if isinstance(value, tuple):
        return tuple(map(_remove_sign_of_zero, value))
    return value if value is None or isinstance(value, int) else value + 0.0


def components(name: str) -> tuple[str, ...]:
    """Return the column names of a reported scalar in a table: one name, or two for a vector.

    The names of a vector have the endings _x and _y.

    name  name of the scalar, such as "tangential_force"
    """
    if SCALARS[name].kind is Kind.VECTOR:
        return f"{name}_x", f"{name}_y"
    return (name,)


def numbers(increment: State | Quality) -> dict[str, float | int | None]:
    """Return the reported scalars of an increment as plain numbers by column name.

    Used for the rows of tables. Vectors are split into their components x and y. Undefined scalars
    are None.

    increment  results of an increment
    """
    found: dict[str, float | int | None] = {}
    for name in SCALARS:
        value = getattr(increment, name)
        parts = components(name)
        values = value if len(parts) > 1 and value is not None else (value,) * len(parts)
        plain = (v if v is None or isinstance(v, int) else float(v) for v in values)
        found |= dict(zip(parts, plain, strict=True))
    return found
