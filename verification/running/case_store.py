"""Records of finished cases, one file each, named by what was asked and by which code.

A file appears whole or not at all, so what was killed goes on where it stopped. A file says what it
is the record of and holds the hash of its own numbers; one that is not such a file, whole and
unchanged, is named and computed again.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.code_digest import code_digest
from contact_scene.reading.description import Description
from verification.running.row import CaseRecord
from verification.running.study import StudyCase

DIGITS = 16
LARGEST_RECORD = 100_000_000  # bytes; those of full verifications have a few hundred thousand


class DamagedRecord(Exception):
    """A file stands in a record's place and is not that record."""


@dataclass(frozen=True)
class CaseStore:
    """A directory of records of one type."""

    directory: Path
    record_type: type[Description] = CaseRecord

    def path(self, case: StudyCase, code: bytes | None = None) -> Path:
        """Where the record of a case is or will be, by the code of this digest or by ours."""
        return self.directory / f"{case.name}-{content_hash(case, code)}.json"

    def load(self, case: StudyCase) -> Description | None:
        """The record; None if there is none. Raises DamagedRecord, which names the file."""
        path = self.path(case)
        try:
            if path.stat().st_size > LARGEST_RECORD:
                raise DamagedRecord(f"{path} is damaged: larger than any record")
            content = path.read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            raise DamagedRecord(f"{path} cannot be read: {error.strerror}") from error
        try:
            document = json.loads(content)
            values = document["record"]
            if document["of"] != path.stem:
                raise DamagedRecord(f"{path} is the record of {document['of']}")
            if document["sha256"] != _digest(values):
                raise DamagedRecord(f"{path} is damaged: its numbers have changed")
            return self.record_type.model_validate_json(json.dumps(values))
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise DamagedRecord(f"{path} is damaged: no whole record of this version") from error

    def save(self, case: StudyCase, record: Description, code: bytes | None = None) -> None:
        """Write the record that code of this digest has made, or ours; whole or not at all."""
        path, values = self.path(case, code), record.model_dump(mode="json")
        document = {"of": path.stem, "sha256": _digest(values), "record": values}
        with atomic_file(path) as temporary:
            temporary.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def content_hash(case: StudyCase, code: bytes | None = None) -> str:
    """Digest of the case's kind and values, and of the code that computes it, if not ours."""
    kind = type(case)
    asked: Any = asdict(case)  # type: ignore[call-overload]
    text = json.dumps([kind.__module__, kind.__qualname__, asked], sort_keys=True)
    return hashlib.sha256(text.encode() + (code or code_digest())).hexdigest()[:DIGITS]


def _digest(values: Any) -> str:
    return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()
