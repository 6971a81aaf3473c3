"""What the nightly run computes is what the report has a place for."""

import re
from pathlib import Path

from verification.report.sections import TITLES
from verification.studies.catalogue import STUDIES

WORKFLOWS = Path(__file__).resolve().parents[1] / ".github" / "workflows"


def test_every_study_of_the_report_is_computed_at_night() -> None:
    text = (WORKFLOWS / "nightly.yml").read_text(encoding="utf-8")
    matrix = re.search(r"^ +name:\n((?: +- \S+\n)+)", text, re.MULTILINE)
    assert matrix is not None
    assert matrix[1].split()[1::2] == sorted(TITLES.keys() & STUDIES.keys())


def test_studies_that_the_report_shows_are_in_the_catalogue() -> None:
    assert TITLES.keys() <= STUDIES.keys()
