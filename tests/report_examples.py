"""Example records of verification reports for tests of pages, without a solve."""

from contact_scene.quantities.summary import EffectSummary
from verification.exhibits.chart import Chart, Look, Panel, Table, curve
from verification.judging.outcome import CaseOutcome, RunRecord, SceneRecord, Status, Verdict
from verification.report.summary_text import OMISSIONS
from verification.running.provenance import Provenance, source_digest
from verification.running.report_record import Report, count
from verification.running.study import Conclusion, LostCase, Statement, StudyRecord


def made_by() -> Provenance:
    """Somebody."""
    return Provenance(
        program_version="0.0",
        commit=None,
        changed=False,
        modules=("verification.norms",),
        sources=source_digest("verification.norms"),
        command="slipstick verify",
        date="2000-01-01T00:00:00+00:00",
        machine={},
        libraries={},
        seconds={},
    )


def verdict(name: str, value: float, reference: float, run: str = "run") -> Verdict:
    """A verdict that allows 1 %."""
    error = abs(value - reference) / abs(reference)
    return Verdict(
        name=name,
        run=run,
        runs=(run,),
        meaning="what it is",
        unit="m",
        value=value,
        reference=reference,
        reference_kind="closed form",
        source="somebody",
        reference_uncertainty=reference * 1e-6,
        error=error,
        allowed=0.01,
        scale=abs(reference),
        scale_name="the reference",
        tolerance_kind="required",
        because="asked for",
        status=Status.PASS if error <= 0.01 else Status.FAIL,
    )


def run_record(cells: int | None, elements: int | None) -> RunRecord:
    """A run of either solver."""
    return RunRecord(
        label="run",
        cells=None if cells is None else (cells, cells),
        window=None if cells is None else (1e-3, 1e-3),
        elements_per_radius=elements,
        tolerance=1e-8,
        increments=1,
        iterations=9,
        convolutions=18,
        largest_residual=1e-9,
    )


def chart(name: str, text: str = "A chart") -> Chart:
    """A line and marks."""
    line = curve(text, [0, 1, 2], [1, 3, 2])
    marks = curve("marks", [1], [3], Look.MARKS)
    return Chart(
        name=name,
        title=text,
        caption=text,
        rows=(
            (Panel(x_label=text, y_label="y", curves=(line, marks), notes=((1.0, 1.5, text),)),),
        ),
    )


def case(
    name: str,
    values: dict[str, tuple[float, float]],
    run: RunRecord,
    text: str = "A case",
    *,
    drawn: bool = True,
) -> CaseOutcome:
    """A case of verdicts (value, reference)."""
    effects = (EffectSummary(name="friction", on=True, why=text),)
    return CaseOutcome(
        name=name,
        title=text,
        problem=text,
        scenes=(SceneRecord(title=text, lines=(("body", text),), effects=effects),),
        runs=(run,),
        limits=(text,),
        charts=(chart(f"{name}_chart", text),) if drawn else (),
        verdicts=tuple(verdict(n, *pair, run.label) for n, pair in values.items()),
    )


def study(name: str, answer: str = "", level: str = "quick", text: str = "A study") -> StudyRecord:
    """A study with one statement, a chart and a table."""
    return StudyRecord(
        name=name,
        title=text,
        question=text,
        level=level,
        conclusion=Conclusion(
            statements=(Statement(claim=text, outcome=Status.PASS, measured=text, because=text),),
            answer=answer,
            charts=(chart("force_against_shift", text),),
            tables=(Table(title=text, columns=("a", "b"), rows=((text, text),)),),
            remarks=(text,),
        ),
        lost=(LostCase(name="lost-one", reason=text),) if level == "full" else (),
        provenance=made_by(),
    )


def report_of(cases: tuple[CaseOutcome, ...], studies: tuple[StudyRecord, ...] = ()) -> Report:
    """A report of these."""
    return Report(
        level="quick",
        counts=count(cases),
        cases=cases,
        omissions=OMISSIONS,
        provenance=made_by(),
        studies=studies,
    )


def report_by(*cases, level="quick", **made):
    """A report of a commit on these, with these values of its provenance."""
    report = report_of(cases)
    provenance = report.provenance.model_copy(update={"commit": 40 * "a", **made})
    return report.model_copy(update={"level": level, "provenance": provenance})


def a_case(name: str, error: float = 0.002) -> CaseOutcome:
    """A case of two quantities, of which one has this error; 0.01 is allowed."""
    values = {"approach": (1.0 + error, 1.0), "radius": (2.0, 2.0)}
    return case(name, values, run_record(32, None), drawn=False)


def three_cases() -> Report:
    """A report of three cases."""
    return report_of(tuple(a_case(name) for name in ("one", "three", "two")))
