"""Tests of the table of validity: tested parameters and the largest errors in them."""

from types import SimpleNamespace
from typing import Any

import pytest
from report_examples import STEEL, case, report_of, run_record

from contact_scene import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from verification.judging.outcome import CaseOutcome
from verification.judging.tested_parameters import dimensionless_parameters
from verification.report.page import render_page
from verification.report.validity import validity_table

COATING = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.2)


def result_of(*rows: tuple[float, float, tuple[float, float] | None]) -> Any:
    """Increments of a contact radius, a normal force and a tangential force."""
    names = ("contact_radius", "normal_force", "tangential_force")
    increments = [SimpleNamespace(**dict(zip(names, row, strict=True))) for row in rows]
    return SimpleNamespace(increments=increments)


def coated(body: Body, friction: CoulombFriction | None) -> Scene:
    ball = Paraboloid(radius=18e-3, material=STEEL)
    return Scene(indenter=ball, body=body, friction=friction, loading=(LoadStep(normal_force=1e3),))


def test_parameters_are_those_of_the_largest_contact_and_the_largest_tangential_force() -> None:
    layers = (Layer(thickness=1e-4, material=COATING),)
    scene = coated(Body(material=STEEL, layers=layers), CoulombFriction(coefficient=0.2))
    rows = [(1e-4, 50.0, None), (4e-4, 1e3, (90.0, 120.0)), (2e-4, 500.0, (10.0, 0.0))]
    empty = (0.0, 0.0, (0.0, 0.0))  # separated
    result = result_of(*rows, empty)
    assert dimensionless_parameters(scene, result) == {
        "h/a": (0.25,),
        "E1/E2": (2.0,),
        "ν": (0.2, 0.3),
        "µ": (0.2,),
        "T/(µW)": (0.75,),
    }


def judged_at(
    name: str, values: dict[str, tuple[float, float]], parameters: dict[str, tuple[float, ...]]
) -> CaseOutcome:
    run = run_record(64, None).model_copy(update={"parameters": parameters})
    return case(name, values, run, drawn=False)


@pytest.fixture
def cases() -> tuple[CaseOutcome, ...]:
    """Errors of 1e-3, 4e-3 and 9e-3 with a tolerance of 1 %; the last run has no parameters."""
    soft = judged_at("soft", {"radius": (1.001, 1.0)}, {"ν": (0.3,), "µ": (0.05,)})
    thin = judged_at(
        "thin", {"radius": (1.004, 1.0), "peak": (1.0, 1.0)}, {"ν": (0.3, 0.45), "µ": (0.1,)}
    )
    old = judged_at("old", {"radius": (1.009, 1.0)}, {})
    return soft, thin, old


def test_a_row_has_the_tested_range_and_the_largest_error_in_it(
    cases: tuple[CaseOutcome, ...],
) -> None:
    table = validity_table(report_of(cases))
    assert table.rows == (
        ("ν", "0.3", "2", "0.004", "thin/radius", "40 %", "thin/radius"),
        ("ν", "0.45", "1", "0.004", "thin/radius", "40 %", "thin/radius"),
        ("µ", "0.05 to 0.1", "2", "0.004", "thin/radius", "40 %", "thin/radius"),
    )
    assert "Validity" in render_page(report_of(cases))


def test_errors_to_the_same_program_count_for_the_tolerance_only(
    cases: tuple[CaseOutcome, ...],
) -> None:
    """A refinement of the same solver is no reference from outside; an order is no number."""
    soft, thin, _ = cases
    own = [one.model_copy(update={"reference_kind": "own refinement"}) for one in thin.verdicts]
    orders = [one.model_copy(update={"tolerance_kind": "order"}) for one in thin.verdicts]

    def row(verdicts: object) -> tuple[str, ...]:
        changed = thin.model_copy(update={"verdicts": verdicts})
        rows = validity_table(report_of((soft, changed))).rows
        return next(row for row in rows if row[0] == "µ")

    assert row(own) == ("µ", "0.05 to 0.1", "2", "0.001", "soft/radius", "40 %", "thin/radius")
    assert row(orders) == ("µ", "0.05", "1", "0.001", "soft/radius", "10 %", "soft/radius")
    alone = thin.model_copy(update={"verdicts": tuple(own)})
    assert validity_table(report_of((alone,))).rows[0][3:5] == ("–", "no reference from outside")
