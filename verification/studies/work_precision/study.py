"""The study of what accuracy costs.

Its conclusion is of errors and counted work, which every run repeats. What follows from seconds
stands apart, in the provenance of its record.
"""

from __future__ import annotations

from verification.judging.outcome import Status
from verification.running.row import found
from verification.running.rules import solved
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.work_precision.charts import SERIES, time_chart, work_chart
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.families import all_cases
from verification.studies.work_precision.points import Found, points_of
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
    peer_tables,
    recorded_peers,
)
from verification.studies.work_precision.setting import PrecisionCase

REACHED = 0.01  # what some setting must reach at every level, for every quantity
SHARED = (
    "A setting counts as accurate to what the finer ones of its curve keep: an error that happens "
    "to change sign earns nothing. The finest of a curve has none above it.",
    "Operations are those of an idealised algorithm with the counted convolutions (on the whole "
    "window), factorisations (nested dissection) and dense systems.",
    "Edges are put inside the cells at the end of every step, or, where bodies couple, in every "
    "increment; energies and shifts stay those of cells, so that no loop was run so. The radial "
    "solver is asked for what it has no closed form of.",
    "Extrapolation takes two grids with cells of ratio two and the order two, for peak pressure "
    "and approach.",
    "An error norm of a field means the edge, where pressure is a square root. Every method is "
    "asked for what its values mean: cells for means over cells, with edges inside them or not, "
    "the radial solver for values at its rings, finite elements for what is linear between theirs.",
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
    known = found(cases(settings), records)
    everything = _everything(known)
    rows, peers = price_rows(WORK, everything), recorded_peers()
    leading = [(c.name, c.leading) for c in CONTACTS.values()]
    return Conclusion(
        statements=(
            solved("every setting is solved", len(known), len(cases(settings))),
            _reached(everything),
            *statements_in(rows),
        ),
        answer=answer_in(WORK, rows),
        tables=(*tables_in(WORK, rows), *peer_tables(peers)),
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
            *(f"Reference, {c.title}: {c.problem.source}." for c in CONTACTS.values()),
        ),
    )


def timed(settings: Settings, records: Records) -> Conclusion:
    """The same by CPU seconds, beside other codes: findings, no verdicts."""
    ours, peers = _everything(found(cases(settings), records)), recorded_peers()
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


def _everything(known: Found) -> Everything:
    everything = {
        (contact.name, quantity): points_of(known, contact.name, quantity)
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


STUDY = Study(
    name="work-precision",
    title="What accuracy costs",
    question="Which method and which setting reach an accuracy with the least work, and what does "
    "0.1 % cost with each of them?",
    cases=cases,
    conclude=conclude,
    timed=timed,
)
