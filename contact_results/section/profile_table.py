"""`profiles.csv` of a result on a section: tractions, gap and slip over the radius, in SI."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from contact_results.directory.file_names import PROFILES
from contact_results.section.field_quantities import FIELD_QUANTITIES
from fem_reference import Increment, Result

COLUMNS = ("step", "radius", "angle", *(quantity.name for quantity in FIELD_QUANTITIES))


def write_section_profiles(result: Result, directory: Path) -> None:
    """Write one row per ring, and per angle where there are several, at the end of every step.

    angle is counted from the tangential load and empty where one function of the radius says all;
    so is what the increment does not have, and a gap that is infinite.
    """
    with open(directory / PROFILES, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for step in result.steps:
            table.writerows(_rows(step))


def _rows(step: Increment) -> Iterator[tuple[object, ...]]:
    angles: list[object] = [None] if step.angles is None else list(step.angles.tolist())
    columns = [quantity.of(step) for quantity in FIELD_QUANTITIES]
    for ring, radius in enumerate(step.radii.tolist()):
        for number, angle in enumerate(angles):
            place = ring if step.angles is None else (ring, number)
            values = (None if column is None else column[place] for column in columns)
            yield (step.step, radius, angle, *(_shown(value) for value in values))


def _shown(value: np.generic | None) -> object:
    """A Python number; nothing for what is not there or not finite."""
    if value is None or not np.isfinite(value):
        return None
    return int(value) if isinstance(value, np.bool_) else value.item()
