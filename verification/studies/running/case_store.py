"""Records of finished cases, one file each, named by what was asked and by which code.

A file appears whole or not at all, so a study that was killed goes on where it stopped; a file that
cannot be read is computed again.
"""

from __future__ import annotations

import hashlib
import inspect
import json
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

import contact_scene
import semi_analytical
from contact_scene.description import Description
from verification.run_output.atomic_file import atomic_file
from verification.studies.running.study import StudyCase

DIGITS = 16


@dataclass(frozen=True)
class CaseStore:
    """A directory of records."""

    directory: Path

    def path(self, case: StudyCase) -> Path:
        """Where the record of a case is or will be."""
        return self.directory / f"{case.name}-{content_hash(case)}.json"

    def load(self, case: StudyCase) -> Description | None:
        """The record; None if there is none, or none that this version can read."""
        try:
            return case.record_type.model_validate_json(self.path(case).read_bytes())
        except (OSError, ValueError):
            return None

    def save(self, case: StudyCase, record: Description) -> None:
        """Write the record, whole or not at all."""
        with atomic_file(self.path(case)) as temporary:
            temporary.write_text(record.model_dump_json(indent=1) + "\n", encoding="utf-8")


def content_hash(case: StudyCase) -> str:
    """Digest of the case's kind and values, and of the code that would compute it."""
    kind = type(case)
    asked: Any = asdict(case)  # type: ignore[call-overload]
    text = json.dumps([kind.__module__, kind.__qualname__, asked], sort_keys=True)
    digest = hashlib.sha256(text.encode() + _code_digest(inspect.getfile(kind)))
    return digest.hexdigest()[:DIGITS]


@cache
def _code_digest(file: str) -> bytes:
    """Of the scene, of the solver, and of the package that holds the case."""
    places = (contact_scene.__file__, semi_analytical.__file__, file)
    digest = hashlib.sha256()
    for place in places:
        for source in sorted(Path(place).parent.rglob("*.py")):
            digest.update(source.read_bytes())
    return digest.digest()
