"""A study: cases that are computed one by one, and what is concluded from all of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

from contact_scene.reading.description import Description
from verification.exhibits.chart import Chart
from verification.exhibits.table import Table
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.row import CaseRecord, Row

STUDY_VERSION = 1


class StudyCase(Protocol):
    """A frozen dataclass of plain values that says what to compute; it is sent to a worker."""

    @property
    def name(self) -> str:
        """Names the case within its study: letters, digits and hyphens."""

    def compute(self) -> Description:
        """Do the work; raises what the solvers raise. Cases of a study give a `CaseRecord`."""


@dataclass(frozen=True)
class Settings:
    """How much is computed.

    level   decides what is left open
    cells   of the finest grid along each side; None leaves it to the level
    levels  of refinement, for studies that refine; None leaves it to the level
    """

    level: Level
    cells: int | None = None
    levels: int | None = None


class Statement(Description):
    """One line of the verdict: a claim, how it was judged, and the numbers behind it."""

    claim: str
    outcome: Status | None
    """None for a finding: a number that is reported and not judged."""

    measured: str
    because: str = ""
    about: Row | None = None
    """The same as fields: what it is about, and the numbers behind it; null in older records."""


class LostCase(Description):
    """A case without a record."""

    name: str
    reason: str


class Conclusion(Description):
    """What a study shows. Texts are for people; the numbers behind them are in the records."""

    statements: tuple[Statement, ...]
    answer: str = ""
    """To the question of the study, in a sentence; empty where only the statements answer it."""

    tables: tuple[Table, ...] = ()
    charts: tuple[Chart, ...] = ()
    rows: tuple[Row, ...] = ()
    """Numbers that are read on: tables and pages are made of them."""

    remarks: tuple[str, ...] = ()
    """What is assumed, and what the study does not show."""

    @property
    def failed(self) -> bool:
        """Whether a statement failed."""
        return any(statement.outcome is Status.FAIL for statement in self.statements)


Records = Mapping[str, CaseRecord]


@dataclass(frozen=True)
class Study:
    """A study of the catalogue.

    title     a line for lists and the head of the page
    question  what it is about, for a reader
    cases     what has to be computed
    conclude  from the records that there are, by name of the case: some may be missing
    """

    name: str
    title: str
    question: str
    cases: Callable[[Settings], tuple[StudyCase, ...]]
    conclude: Callable[[Settings, Records], Conclusion]
