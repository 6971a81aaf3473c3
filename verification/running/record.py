"""`study.json`: the conclusion of a study with what was lost and who made it."""

from __future__ import annotations

import json
import re
from typing import Any

from pydantic import model_validator

from contact_scene.reading.description import Description
from verification.judging.outcome import Status
from verification.running.provenance_record import Provenance
from verification.running.study import STUDY_VERSION, Conclusion, LostCase


class StudyRecord(Description):
    """All that the page of a study shows."""

    schema_version: int = STUDY_VERSION
    name: str
    title: str
    question: str
    level: str
    conclusion: Conclusion
    lost: tuple[LostCase, ...]
    """Cases that have no record: the conclusion does without them."""

    provenance: Provenance
    own_cells: bool = False
    """Whether somebody chose the cells: it is then of no level."""

    @model_validator(mode="after")
    def _is_of_this_version(self) -> StudyRecord:
        if self.schema_version != STUDY_VERSION:
            raise ValueError(f"it is of version {self.schema_version}, not {STUDY_VERSION}")
        return self

    @property
    def status(self) -> Status:
        """Fail if a statement failed or a case was lost."""
        outcomes = {statement.outcome for statement in self.conclusion.statements}
        if self.lost or Status.FAIL in outcomes:
            return Status.FAIL
        return Status.INCONCLUSIVE if Status.INCONCLUSIVE in outcomes else Status.PASS


def dump_study(record: StudyRecord) -> str:
    """The record as JSON text, without what is as it is where nothing is said of it."""
    said = record.model_dump(mode="json", exclude_defaults=True)
    return json_text({"schema_version": record.schema_version} | said)


def json_text(values: dict[str, Any]) -> str:
    """JSON, indented; what holds nothing but numbers and texts, such as the points of a curve or
    the measures of a row, takes one line."""
    text = json.dumps(values, indent=1, ensure_ascii=False, allow_nan=False)
    # No text of JSON has a line's end in it: only the space between values is changed.
    return re.sub(r"[\[{]\n[^\[\]{}]*[\]}]", lambda m: re.sub(r"\n *", " ", m[0]), text) + "\n"
