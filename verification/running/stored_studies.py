"""The records of studies, read back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from verification.running.record import StudyRecord

RECORD = "study.json"


def stored_studies(
    directory: Path, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """The records of all studies that have left theirs in a folder of this directory, by name.

    left_out  is told of a record that is broken or of another version; without it that raises
              ValueError, naming the file
    """
    records = []
    for path in sorted(directory.glob(f"*/{RECORD}")):
        try:
            records.append(StudyRecord.model_validate_json(path.read_bytes()))
        except ValueError as error:
            problem = f"{path} is no record of a study that can be read"
            if left_out is None:
                raise ValueError(problem) from error
            left_out(problem)
    return tuple(sorted(records, key=lambda record: record.name))
