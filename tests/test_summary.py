"""Tests of the summary of a run: all keys, SI units, and equal bytes for equal results."""

import json
import math

import pytest
from jsonschema import Draft202012Validator
from pydantic import ValidationError

from contact_scene.quantities.summary import (
    SUMMARY_VERSION,
    ContactStatus,
    EffectSummary,
    Residuals,
    RunSummary,
    StepSummary,
    dump_summary,
    load_summary,
    summary_schema,
)


def step(**changes):
    values = {
        "normal_force": 1000.0,
        "approach": 2.6e-6,
        "contact_area": 1e-7,
        "contact_radius": math.sqrt(1e-7 / math.pi),
        "peak_pressure": 4e9,
        "residuals": Residuals(complementarity=1e-9, penetration=0.0, normal_equilibrium=1e-16),
        "status": ContactStatus.FRICTIONLESS,
    }
    return StepSummary(**(values | changes))


def run(*steps: StepSummary) -> RunSummary:
    return RunSummary(
        title="Füße",
        solver="semi_analytical",
        tolerance=1e-8,
        cells=(128, 64),
        window=(1e-3, 5e-4),
        effects=(EffectSummary(name="friction", on=False, why="the scene has no [friction]"),),
        steps=steps or (step(),),
    )


FRETTING = step(
    tangential_force=(90.0, 0.0),
    tangential_shift=(1e-6, 0.0),
    stick_area=0.0,
    stick_radius=0.0,
    dissipated_energy=1e-6,
    status=ContactStatus.PARTIAL_SLIP,
)


@pytest.mark.parametrize("bad", [math.nan, math.inf, "x", None])
def test_nothing_but_finite_numbers_gets_into_a_summary(bad):
    with pytest.raises(ValidationError):
        step(peak_pressure=bad)
    with pytest.raises(ValidationError):
        step(tangential_force=(0.0, bad))
    with pytest.raises(ValidationError):
        Residuals(complementarity=bad, penetration=0.0, normal_equilibrium=0.0)


def test_the_schema_admits_summaries_and_nothing_less():
    validator = Draft202012Validator(summary_schema())
    record = json.loads(dump_summary(run(step(), FRETTING)))
    validator.validate(record)
    for key in summary_schema()["$defs"]["StepSummary"]["required"]:
        less = json.loads(dump_summary(run()))
        del less["steps"][0][key]
        assert not validator.is_valid(less), key
    assert not validator.is_valid(record | {"extra": 1})


@pytest.mark.parametrize(("other", "age"), [(-1, "an earlier"), (1, "a newer")])
def test_a_summary_of_another_version_is_refused(other, age):
    record = json.loads(dump_summary(run()))
    record["schema_version"] = SUMMARY_VERSION + other
    told = f"^schema_version: version {SUMMARY_VERSION + other} is of {age} slipstick"
    with pytest.raises(ValueError, match=told):
        load_summary(json.dumps(record))
