"""Summary of a run, stored as `summary.json`, with equal keys for all solvers."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Any, TypeAlias

from pydantic import ConfigDict, Field, ValidationError, field_validator
from pydantic.dataclasses import dataclass as pydantic_dataclass

from contact_scene.quantities import residuals
from contact_scene.quantities.field_metadata import CONVENTION, Kind, Reported, reported
from contact_scene.quantities.increment import (
    SCALARS,
    Quality,
    State,
)
from contact_scene.quantities.per_length import (
    ATTRIBUTES,
    SHOWN_NAMES,
    rename_keys,
    shown_mark,
    shown_name,
)
from contact_scene.quantities.stated_error import (
    AccuracyReached,
    CoarseSolveRecord,
    StatedError,
)
from contact_scene.reading.description import (
    MAX_TITLE,
    DescribedSchema,
    Description,
)

SUMMARY_VERSION = 6

Ratio: TypeAlias = Annotated[float, Field(json_schema_extra={"unit": "1"})]
Metre: TypeAlias = Annotated[float, Field(json_schema_extra={"unit": "m"})]


class ContactStatus(StrEnum):
    """State of stick and slip at the end of a step."""

    FRICTIONLESS = "frictionless"
    FULL_STICK = "full stick"
    PARTIAL_SLIP = "partial slip"
    NO_STICK_AREA_LEFT = "no stick area left"
    GROSS_SLIDING = "gross sliding"
    SEPARATED = "separated"


class Regime(StrEnum):
    """Slip regime of one cycle."""

    STICK = "stick"
    PARTIAL_SLIP = "partial slip"
    GROSS_SLIP = "gross slip"


STRICT = ConfigDict(
    extra="forbid",
    allow_inf_nan=False,
    defer_build=True,
    json_schema_serialization_defaults_required=True,
)


@pydantic_dataclass(frozen=True, config=STRICT)
class Residuals(residuals.Residuals):
    """Dimensionless residuals of the fields at the end of a step; null where not applicable."""


@dataclass(frozen=True, kw_only=True)
class ClosedCycle:
    """Measures of the load cycle that the end of a load step closes, and the residuals of that
    state."""

    cycle_start: Annotated[
        int | None,
        Field(ge=1),
        Reported(
            "",
            "Number of the earlier step, from 1, that ended with equal loads. The cycle extends "
            "from its end to the end of this step. Null, with the other values of a cycle, "
            "without a closed cycle or without shear.",
        ),
    ] = None
    energy_per_cycle: Annotated[
        float | None, Reported("J", "Energy dissipated by slip in the cycle.")
    ] = None
    slip_amplitude: Annotated[
        float | None,
        Reported(
            "m",
            "Half the range of slip in the cycle, at the point where it is largest: at the edge of "
            "the contact within its cell or element.",
        ),
    ] = None
    ruiz_f1: Annotated[
        float | None,
        Reported(
            "Pa m",
            "First Ruiz parameter: largest shear times slip amplitude, at the point where the "
            "product is largest (Ruiz, Boddington and Chen 1984).",
        ),
    ] = None
    ruiz_f2: Annotated[
        float | None,
        Reported(
            "Pa^2 m",
            "Second Ruiz parameter: largest shear times slip amplitude times the largest tensile "
            "stress along the surface in the direction of the tangential force, at the point where "
            "the product is largest; null for solvers that do not compute the surface stress.",
        ),
    ] = None
    force_amplitude: Annotated[
        float | None,
        Reported("N", "Q*, half the range of the tangential force along its largest change."),
    ] = None
    shift_amplitude: Annotated[
        float | None,
        Reported("m", "delta, half the range of the tangential shift in that direction."),
    ] = None
    actuator_amplitude: Annotated[
        float | None,
        Reported("m", "delta*, half the range of the actuator's shift; null without a rig."),
    ] = None
    loop_opening: Annotated[
        float | None,
        Reported("m", "delta_g, half the difference of the two shifts at the mid-range force."),
    ] = None
    energy_ratio: Annotated[
        float | None,
        Reported("", "A = E_d/(4 Q* delta*), the energy relative to a rectangular loop."),
    ] = None
    energy_friction: Annotated[
        float | None,
        Reported("", "mu_e = E_d/(4 W delta_g), the energetic coefficient of friction."),
    ] = None
    limit_share: Annotated[
        float | None,
        Reported("", "Q*/(mu W); null if the friction limit is not mu times the force."),
    ] = None
    gross_slip_share: Annotated[
        float | None,
        Reported(
            "",
            "Distance to gross slip, 5 E_d/(4 Q* delta): 0 for small and 1 at the onset of gross "
            "slip in Mindlin's loop (nu = 0).",
        ),
    ] = None
    stick_centre: Annotated[
        tuple[float, float] | None,
        Reported("m", "Centre of the stick zone at the end of the cycle.", Kind.VECTOR),
    ] = None
    regime: Annotated[
        Regime | None,
        Reported(
            "", "Slip regime: full stick, partial slip, or gross slip at some time of the cycle."
        ),
    ] = None
    from_virgin: Annotated[
        bool | None,
        Reported("", "True for the first cycle, which starts from the virgin state."),
    ] = None
    residuals: Residuals


# The numbers of a cycle, which have errors.
OF_CYCLES = {
    name: annotation
    for name, annotation in reported(ClosedCycle).items()
    if name not in ("cycle_start", "regime", "from_virgin")
}


@pydantic_dataclass(frozen=True, kw_only=True, config=STRICT)
class StepSummary(Quality, ClosedCycle, State):
    """State at the end of one `[[loading]]` table.

    Vectors are (x, y), of the indenter relative to the body: a positive force causes a positive
    shift.
    """

    status: ContactStatus
    """State of stick and slip."""

    errors: dict[str, StatedError] | None = None
    """Error estimate of each scalar, by its name; null for a run without error estimates. Numerical
    measures have none."""

    shear_error: Ratio | None = None
    """Error of the shear traction by the increments: its root mean square over the surface,
    relative to that of the shear; null for a run without error estimates, and if it is unknown. It
    may exceed 1 where all sticks and increments are few."""


class EffectSummary(Description):
    """Physical effect that a solver includes or omits."""

    name: str
    """Name of the effect."""

    on: bool
    """True if the effect acts in the scene."""

    why: str
    """Reason in one sentence."""


class RunSummary(Description):
    """Results of one run in SI units. Equal inputs give equal summaries, byte for byte."""

    schema_version: Annotated[int, Field(ge=1)] = SUMMARY_VERSION
    """Version of this record, which increases if a key is added or changes its name or meaning."""

    convention: str = CONVENTION
    """Units, axes and signs."""

    title: str = Field(max_length=MAX_TITLE)
    """Title of the scene."""

    solver: str
    """Name of the solver."""

    tolerance: Ratio
    """Limit of every residual at the end of every increment."""

    cells: tuple[int, int] | None = None
    """Number of cells along x and y; null for a solver without a surface grid."""

    window: tuple[Metre, Metre] | None = None
    """Side lengths of the surface grid along x and y; null for a solver without one."""

    effects: tuple[EffectSummary, ...]
    """Plan of the solver: its effects, with reasons."""

    steps: tuple[StepSummary, ...]
    """One entry for every `[[loading]]` table, in order."""

    warnings: tuple[str, ...] = ()
    """Warnings: implausible input, strains beyond linear theory, unresolved roughness."""

    coarse_solves: tuple[CoarseSolveRecord, ...] | None = None
    """Coarse solves of the error estimate; null if errors were left out."""

    accuracy: AccuracyReached | None = None
    """Requested and reached accuracy; null if no accuracy was requested."""

    fields_digest: str | None = None
    """SHA-256 of the file of fields, `result.h5`."""

    @field_validator("schema_version")
    @classmethod
    def _refuse_other_versions(cls, version: int) -> int:
        if version != SUMMARY_VERSION:
            other = "a newer" if version > SUMMARY_VERSION else "an earlier"
            raise ValueError(
                f"version {version} is of {other} slipstick, this one reads {SUMMARY_VERSION}; run "
                "the scene again"
            )
        return version


def _rename_steps(record: dict[str, Any], names: Mapping[str, str]) -> None:
    """Rename the scalars of the load steps in the record of a line contact, and their errors,
    in place."""
    for number, step in enumerate(record["steps"]):
        renamed = rename_keys(step, names)
        if step.get("errors"):
            renamed["errors"] = rename_keys(step["errors"], names)
        record["steps"][number] = renamed


def dump_summary(summary: RunSummary, *, line: bool = False) -> str:
    """Convert the summary of a run to JSON text, the content of `summary.json`.

    A key without a value is null. The steps of a line contact have the names of `per_length`.

    line  True for a line contact
    """
    record = summary.model_dump(mode="json")
    if line:
        _rename_steps(record, SHOWN_NAMES)
    return json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def load_summary(text: str) -> RunSummary:
    """Read the summary of a run from its JSON text, the content of `summary.json`.

    Raises ValueError with the first mistake in the text.
    """
    try:
        if '"half_width"' not in text:
            return RunSummary.model_validate_json(text)
        record = json.loads(text)
        _rename_steps(record, ATTRIBUTES)
        return RunSummary.model_validate_json(json.dumps(record))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key, message = ".".join(map(str, first["loc"])), first["msg"].removeprefix("Value error, ")
        raise ValueError(": ".join(filter(None, (key, message)))) from None


def _line_texts(mark: Reported | None, name: str) -> dict[str, str]:
    """Return meaning and unit of a scalar of a line contact for the JSON Schema;
    empty for other keys."""
    if mark is None:
        return {}
    mark = shown_mark(name, mark, line=True)
    return {"description": mark.meaning, "unit": mark.unit or "1"}


def summary_schema() -> dict[str, Any]:
    """Create the JSON Schema of `summary.json`, with the meaning and unit of every key."""
    schema = RunSummary.model_json_schema(mode="serialization", schema_generator=DescribedSchema)
    step = schema["$defs"]["StepSummary"]
    marks = {**SCALARS, **OF_CYCLES}
    properties = {
        shown_name(name, line=True): {**shape, **_line_texts(marks.get(name), name)}
        for name, shape in step["properties"].items()
    }
    schema["$defs"]["LineStepSummary"] = {
        **step,
        "title": "LineStepSummary",
        "properties": properties,
        "required": [shown_name(name, line=True) for name in step["required"]],
    }
    either = [{"$ref": f"#/$defs/{name}"} for name in ("StepSummary", "LineStepSummary")]
    schema["properties"]["steps"]["items"] = {"anyOf": either}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
