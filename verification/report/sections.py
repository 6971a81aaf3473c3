"""Sections of the report page on studies, and the main claims about the program."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from verification.exhibits.chart import plain
from verification.judging.outcome import Status
from verification.running.report_record import Report
from verification.running.sources import is_current
from verification.running.study import StudyRecord

# By the name of its study. A study gets its place on the page in `templates/page.html`.
TITLES = {
    "coated-tractions": "Coated contacts: the paper's figures 3 and 4",
    "work-precision": "What accuracy costs",
    "error-coverage": "Coverage of stated errors",
    "stability": "The stability map",
    "seeded-defects": "Seeded defects",
    "scoreboard": "Other codes on the same problems",
}
PROMISES = {
    "work-precision": "Know what accuracy costs",
    "stability": "Stay stable in hard cases",
    "error-coverage": "State an error for every number, and keep it",
}
FORCED = "forced_effects"  # the case that judges the plan
LEVELS = ("quick", "standard", "full")
PLACES = (Path("reports/studies"), Path("out"))  # where records are looked for


@dataclass(frozen=True)
class StudySection:
    """Section of the report page for one study.

    name     name of the study
    title    heading of the section
    record   record of the study; None if none was found
    command  command that makes the record
    """

    name: str
    title: str
    record: StudyRecord | None
    command: str


@dataclass(frozen=True)
class Feature:
    """One of the main claims about the program on the report page, with measured figures.

    promise  text of the claim
    status   outcome of the case or study that judges the claim; None if the report lacks it
    figures  measured figures in words
    address  link to the case or study
    """

    promise: str
    status: Status | None
    figures: str
    address: str


def study_section(report: Report, name: str) -> StudySection:
    """Return the section of a study for the report page; raises KeyError if the page has no such
    section.

    name  name of the study
    """
    command = f"slipstick maintain study {name} --level {report.level}"
    record = next((record for record in report.studies if record.name == name), None)
    return StudySection(name, TITLES[name], record, command)


def features(report: Report, sheets: str) -> tuple[Feature, ...]:
    """Return the main claims about the program for the report page, each with measured figures.

    sheets  address of the page with one section per case
    """
    return (
        _plan_feature(report, sheets),
        *(_study_feature(study_section(report, name), text) for name, text in PROMISES.items()),
    )


def _plan_feature(report: Report, sheets: str) -> Feature:
    promise = "Simulate only the effects that a scene calls for"
    case = next((case for case in report.cases if case.name == FORCED), None)
    if case is None:
        command = f"slipstick verify {FORCED} --level {report.level}"
        return Feature(promise, None, f"not in this report; {command} measures it", "#cases")
    runs = {run.label: run for run in case.runs}
    ratios = [
        run.convolutions / max(runs[run.planned].convolutions, 1)
        for run in case.runs
        if run.planned is not None
    ]
    told = f"{min(ratios):.2g} to {max(ratios):.2g} times the" if ratios else "as many"
    worst = max((v.error or 0.0 for v in case.verdicts if len(v.runs) > 1), default=0.0)
    figures = (
        f"with every effect forced on, {len(ratios)} scenes give the same answer within "
        f"{plain(worst, 2)} and take {told} convolutions"
    )
    return Feature(promise, case.status, figures, f"{sheets}#{FORCED}")


def _study_feature(section: StudySection, promise: str) -> Feature:
    address, record = f"#study-{section.name}", section.record
    if record is None:
        return Feature(promise, None, f"not in this report; {section.command} finds it", address)
    answer = record.conclusion.answer
    told = f"{answer} (level {record.level})" if answer else claims_line(record)
    return Feature(promise, record.status, told, address)


def claims_line(record: StudyRecord) -> str:
    """Return a text such as "5 of its 6 judged claims hold (level full)" on the claims of a
    study."""
    judged = [s.outcome for s in record.conclusion.statements if s.outcome is not None]
    good = judged.count(Status.PASS)
    return f"{good} of its {len(judged)} judged claims hold (level {record.level})"


def stored_records(
    places: Iterable[Path] = PLACES, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """Return one stored record of every study that has a section on the report page, sorted by
    name.

    Records of the current source code have priority, then the higher level, then the later date.
    Records with a number of cells that the user chose are left out.

    places    directories that are searched
    left_out  function called with a message for each record that is damaged or of another version;
              None raises ValueError instead
    """
    from verification.running.study import stored_studies

    best: dict[str, StudyRecord] = {}
    for place in places:
        for record in stored_studies(place, left_out):
            if record.own_cells or record.name not in TITLES:
                continue
            if record.name not in best or _record_preference(record) >= _record_preference(
                best[record.name]
            ):
                best[record.name] = record
    return tuple(best[name] for name in sorted(best))


def _record_preference(record: StudyRecord) -> tuple[bool, int, str]:
    level = LEVELS.index(record.level) if record.level in LEVELS else -1
    return is_current(record.provenance), level, record.provenance.date


OMISSIONS = (
    "Tilt and torsion are judged by problems of their own: torsion of balls up to sliding, with a "
    "coating and without, a punch and a ball pressed beside their axes. No case and no reference "
    "has them together with a tangential push.",
    "Tangential loads on coated bodies with friction have no closed form: they are judged by the "
    "other solvers, by an external code and by the study coated-tractions.",
    "Where both solvers are compared they take the same increments: what finite increments cost is "
    "judged apart, by refining them.",
    "The finite elements are axisymmetric: neither tilt nor a load that turns, no height map and "
    "no friction map is solved by a second solver.",
    "The paper's own numbers are known from its figures and two printed values only; figure 2 is "
    "compared with the closed form that the paper compares with.",
    "Line contact is not solved: the surface grid is finite in both directions.",
    "For ν > 0 no exact solution of partial slip is known; there the closed form is a companion "
    "within a stated band.",
)
