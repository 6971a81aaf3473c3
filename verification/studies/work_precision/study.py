"""The study of what accuracy costs.

Its conclusion is of errors and counted work, which every run repeats. What follows from seconds
stands apart, in the provenance of its record.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence

from verification.judging.outcome import Status
from verification.running.rules import solved
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.work_precision.charts import SERIES, time_chart, work_chart
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.families import all_cases
from verification.studies.work_precision.points import Found, points_of, setting_text
from verification.studies.work_precision.price import (
    CLOCK,
    WORK,
    Everything,
    answer_in,
    percent,
    price_rows,
    quantity_title,
    reached,
    statements_in,
    tables_in,
)
from verification.studies.work_precision.recorded_peers import (
    peer_answer,
    peer_charts,
    peer_points,
    peer_remarks,
    peer_table,
    recorded_peers,
)
from verification.studies.work_precision.setting import Measured, PrecisionCase

REACHED = 0.01  # what some setting must reach at every level, for every quantity
MEASURED = ("seconds", "repeats")  # of a record: all else is the same at every run
SHARED = (
    "A setting counts as accurate to what the finer ones of its curve keep: an error that happens "
    "to change sign earns nothing. The finest of a curve has none above it.",
    "Operations are those of an idealised algorithm with the counted convolutions (on the whole "
    "window), factorisations (nested dissection) and dense systems.",
    "The usual route samples the frequency response at and between the cells, with the period a "
    "multiple of the window. With frozen directions it is shifted in equal increments, and judged "
    "under the force that comes with them; without a tangential load there is nothing to freeze, "
    "and the pressing with friction was not run so.",
    "Extrapolation takes two grids with cells of ratio two and the order two, for peak pressure "
    "and approach.",
    "An error norm of a field means the edge, where pressure is a square root; a finite element "
    "there is compared ring by ring.",
)
BY_THE_CLOCK = (
    "Seconds are CPU seconds of one thread, the median of up to five runs, each with an empty "
    "cache: influence coefficients and condensed sections are made anew. Imports do not count.",
    "They are of the machine and the moment that the provenance names, differ from run to run, and "
    "judge nothing.",
)


def cases(settings: Settings) -> tuple[PrecisionCase, ...]:
    """All that has to be solved."""
    return all_cases(settings.level)


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Statements, tables and diagrams by counted work."""
    found = _found_of(settings, records)
    everything = _everything(found)
    rows, peers = price_rows(WORK, everything), recorded_peers()
    leading = [(c.name, next(iter(c.errors))) for c in CONTACTS.values()]
    return Conclusion(
        statements=(
            solved("every setting is solved", len(found), len(all_cases(settings.level))),
            _reached(everything),
            *statements_in(rows),
        ),
        answer=answer_in(WORK, rows),
        tables=(*tables_in(WORK, rows), peer_table(peers)),
        charts=(
            *(
                work_chart(CONTACTS[c], q, everything[c, q])
                for c, q in leading
                if (c, q) in everything
            ),
            *peer_charts(peers),
        ),
        rows=rows,
        remarks=(
            *SHARED,
            *peer_remarks(peers),
            *(f"Reference, {c.title}: {c.source}." for c in CONTACTS.values()),
        ),
    )


def timed(settings: Settings, records: Records) -> Conclusion:
    """The same by CPU seconds, beside other codes: findings, no verdicts."""
    ours, peers = _everything(_found_of(settings, records)), recorded_peers()
    others = peer_points(peers)
    beside = {key: (*points, *others.get(key, ())) for key, points in ours.items()}
    rows = price_rows(CLOCK, beside)
    own = [row for row in rows if row.parameters["method"] in SERIES]
    return Conclusion(
        statements=statements_in(own),
        answer=" ".join(filter(None, (answer_in(CLOCK, own), peer_answer(peers)))),
        tables=tables_in(CLOCK, rows),
        rows=rows,
        charts=tuple(time_chart(CONTACTS[c], q, points) for (c, q), points in beside.items()),
        remarks=BY_THE_CLOCK,
    )


def exports(settings: Settings, records: Records) -> Mapping[str, str]:
    """`settings.csv`: one line for every setting and quantity; `seconds.csv`: one for every
    setting, with what was measured."""
    found = _found_of(settings, records)
    counters = [name for name in Measured.model_fields if name not in ("errors", *MEASURED)]
    rows = [
        (*_words(case), quantity, error, *(getattr(record, name) for name in counters))
        for case, record in found.items()
        for quantity, error in record.errors.items()
    ]
    clock = [
        (*_words(case), *(getattr(record, name) for name in MEASURED))
        for case, record in found.items()
    ]
    setting = ("contact", "method", "setting")
    return {
        "settings.csv": _csv((*setting, "quantity", "error", *counters), rows),
        "seconds.csv": _csv((*setting, *MEASURED), clock),
    }


def _found_of(settings: Settings, records: Records) -> Found:
    """The records that there are, by case."""
    found = {case: records.get(case.name) for case in all_cases(settings.level)}
    return {case: record for case, record in found.items() if isinstance(record, Measured)}


def _everything(found: Found) -> Everything:
    everything = {
        (contact.name, quantity): points_of(found, contact.name, quantity)
        for contact in CONTACTS.values()
        for quantity in contact.errors
    }
    return {key: points for key, points in everything.items() if points}


def _reached(everything: Everything) -> Statement:
    missed = [quantity_title(*key) for key, p in everything.items() if not reached(p, REACHED)]
    return Statement(
        claim=f"every quantity is had to {percent(REACHED)}",
        outcome=Status.FAIL if missed or not everything else Status.PASS,
        measured=f"{len(everything) - len(missed)} of {len(everything)}"
        + (f"; not {'; '.join(missed)}" if missed else ""),
        because="some setting of some method of ours, and all finer ones of its curve",
    )


def _words(case: PrecisionCase) -> tuple[str, str, str]:
    return case.contact, case.method.value, setting_text(case)


def _csv(head: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerows([head, *rows])
    return text.getvalue()


STUDY = Study(
    name="work-precision",
    title="What accuracy costs",
    question="Which method and which setting reach an accuracy with the least work, and what does "
    "0.1 % cost with each of them?",
    cases=cases,
    conclude=conclude,
    exports=exports,
    timed=timed,
)
