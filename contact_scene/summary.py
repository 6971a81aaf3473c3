"""The summary of a run, `summary.json`: what both solvers report, by the same names."""

import json
from enum import StrEnum
from typing import Annotated, Any

from pydantic import Field

from contact_scene.description import Description
from contact_scene.path_error import PathError

SUMMARY_VERSION = 1


def _unit(symbol: str) -> Any:
    return Field(json_schema_extra={"unit": symbol})


Newton = Annotated[float, _unit("N")]
Metre = Annotated[float, _unit("m")]
SquareMetre = Annotated[float, _unit("m^2")]
Pascal = Annotated[float, _unit("Pa")]
Joule = Annotated[float, _unit("J")]
PascalMetre = Annotated[float, _unit("Pa m")]
SquarePascalMetre = Annotated[float, _unit("Pa^2 m")]
NewtonMetre = Annotated[float, _unit("N m")]
Radian = Annotated[float, _unit("rad")]
Ratio = Annotated[float, _unit("1")]


class ContactStatus(StrEnum):
    """How the contact carries its tangential load at the end of a step."""

    FRICTIONLESS = "frictionless"
    FULL_STICK = "full stick"
    PARTIAL_SLIP = "partial slip"
    NO_STICK_AREA_LEFT = "no stick area left"
    GROSS_SLIDING = "gross sliding"


class Residuals(Description):
    """Dimensionless convergence measures, evaluated from the final fields; null where unused."""

    complementarity: Ratio
    """Pressure where there is a gap, relative to load and approach."""

    penetration: Ratio
    """Largest penetration relative to the approach."""

    normal_equilibrium: Ratio | None = None
    """Difference of the integrated pressure from the normal force, relative to it; null where
    the approach is prescribed."""

    friction_cone: Ratio | None = None
    """Largest excess of shear over the friction limit, relative to the largest limit."""

    slip_direction: Ratio | None = None
    """Work that slip would do along the shear instead of against it, relative to the limit's."""

    tangential_equilibrium: Ratio | None = None
    """Difference of the integrated shear from the tangential force, relative to the limit."""

    moment_equilibrium: Ratio | None = None
    """Difference of the moments of the pressure from the given ones, relative to the pressure times
    its distance from the origin; null where the tilt is prescribed."""

    torque_equilibrium: Ratio | None = None
    """Difference of the torque of the shear from the given one, relative to the friction limit
    times its distance from the origin; null where the twist is prescribed."""


class StepSummary(Description):
    """State at the end of one `[[loading]]` table. Vectors are (x, y), of the indenter relative
    to the body: positive force gives positive shift."""

    normal_force: Newton
    """Normal force."""

    approach: Metre
    """Approach of the bodies, counted from first touch."""

    contact_area: SquareMetre
    """Area in contact, with sub-cell accuracy."""

    contact_radius: Metre
    """Radius of the circle of the contact area, sqrt(area / pi)."""

    peak_pressure: Pascal
    """Largest pressure of any cell (finite elements: of any node)."""

    tangential_force: tuple[Newton, Newton] | None = None
    """Tangential force; null without friction."""

    tangential_shift: tuple[Metre, Metre] | None = None
    """Tangential shift; null without friction."""

    torque: NewtonMetre | None = None
    """Torque about z; null where nothing twists."""

    twist: Radian | None = None
    """Twist, the rotation about z; null where nothing twists, or undefined."""

    moment: tuple[NewtonMetre, NewtonMetre] | None = None
    """Moments (Mx, My) of the pressure, the sums of p y and p x; null where nothing tilts."""

    tilt: tuple[Radian, Radian] | None = None
    """Tilt (x, y): slopes that close the gap at positive y and x; null where nothing tilts."""

    stick_area: SquareMetre | None = None
    """Area that sticks, with sub-cell accuracy; null without friction."""

    stick_radius: Metre | None = None
    """Radius of the circle of the stick area, sqrt(area / pi); null without friction."""

    dissipated_energy: Joule | None = None
    """Energy dissipated by slip since the start of the history; null without friction."""

    elastic_energy: Joule | None = None
    """Energy stored in both bodies; null for a solver that does not keep the account."""

    input_work: Joule | None = None
    """Work of forces and moments since the start of the history, by the trapezoidal rule over the
    increments; null where a motion is undefined, at the friction limit under force control."""

    unresolved_work: Joule | None = None
    """Part of the input work that is neither stored nor dissipated because increments are finite.
    It vanishes with them: input_work - unresolved_work is the better value of the work."""

    energy_imbalance: Ratio | None = None
    """What is missing of input_work = elastic_energy + dissipated_energy + unresolved_work over an
    increment, relative to the largest of them so far; the largest value in the step."""

    cycle_start: Annotated[int, Field(ge=1)] | None = None
    """The earlier step, from 1, that ended with the same loads: from its end to the end of this
    one is a cycle. Null, with the four that follow, where no cycle closes or nothing is sheared."""

    energy_per_cycle: Joule | None = None
    """Energy dissipated by slip in the cycle."""

    slip_amplitude: Metre | None = None
    """Half the range of slip in the cycle, at the place where it is largest."""

    ruiz_f1: PascalMetre | None = None
    """Ruiz's first parameter: largest shear times slip amplitude, at the place where that product
    is largest (Ruiz, Boddington and Chen 1984)."""

    ruiz_f2: SquarePascalMetre | None = None
    """Ruiz's second parameter: largest shear times slip amplitude times the largest tension along
    the surface in the direction of the tangential force, at the place where that product is
    largest; null unless the stress at the surface was asked for."""

    residuals: Residuals
    """How well the state fulfils its equations."""

    iterations: Annotated[int, Field(ge=0)]
    """Iterations of the solver over all increments of the step."""

    convolutions: Annotated[int, Field(ge=0)] | None = None
    """Convolutions (pairs of transforms) over all increments of the step; null for a solver that
    has none."""

    factorizations: Annotated[int, Field(ge=0)] | None = None
    """Factorisations of a matrix over all increments of the step; null for a solver that has
    none."""

    status: ContactStatus
    """How the contact carries its tangential load."""


class EffectSummary(Description):
    """One effect that a solver takes into account or not."""

    name: str
    """Name of the effect."""

    on: bool
    """Whether it acts in this scene."""

    why: str
    """Reason in one sentence."""


class RunSummary(Description):
    """Results of one run, in SI. The same input gives the same summary, byte for byte."""

    schema_version: Annotated[int, Field(ge=1)] = SUMMARY_VERSION
    """Version of this record; it grows when a key changes its name or meaning."""

    title: str
    """Title of the scene."""

    solver: str
    """Name of the solver."""

    tolerance: Ratio
    """Bound of every residual at the end of every increment."""

    cells: tuple[int, int] | None = None
    """Number of cells along x and y; null for a solver without a surface grid."""

    window: tuple[Metre, Metre] | None = None
    """Lengths of the surface grid along x and y; null for a solver without one."""

    effects: tuple[EffectSummary, ...]
    """The solver's plan: which effects act, and why."""

    steps: tuple[StepSummary, ...]
    """One entry for every `[[loading]]` table, in order."""

    remarks: tuple[str, ...] = ()
    """What to bear in mind of these results: a theory that has come to its end."""

    path_errors: tuple[PathError, ...] | None = None
    """What finite increments cost, one entry for every step; null where it was not asked for."""


def dump_summary(summary: RunSummary) -> str:
    """The summary as JSON text; every key is there, null where it does not apply."""
    record = summary.model_dump(mode="json")
    return json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def load_summary(text: str) -> RunSummary:
    """The summary back from its JSON text; ValueError for anything else."""
    return RunSummary.model_validate_json(text)


def summary_schema() -> dict[str, Any]:
    """JSON Schema of `summary.json`, with meaning and unit of every key."""
    schema = RunSummary.model_json_schema(mode="serialization")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
