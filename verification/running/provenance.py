"""Provenance of a stored record: versions, command, date, machine, and times of its run.

Only these values differ between repeated runs of the same code.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from contact_results.directory.machine import library_versions, machine, program_version
from contact_scene.reading.description import Description
from verification.running.sources import source_digest


class Provenance(Description):
    """Version, command, date, machine, libraries and times of the run that computed a report."""

    program_version: str
    commit: str | None
    """Commit of the source; null outside a repository."""

    changed: bool
    """True if the source differed from that commit."""

    modules: tuple[str, ...] = ()
    """Modules that made the numbers; none in older records."""

    sources: str | None = None
    """Digest of these modules and of all that they import from the project."""

    command: str
    date: str
    """Coordinated universal time, ISO 8601."""

    machine: dict[str, str | int | None]
    libraries: dict[str, str | None]
    seconds: dict[str, float]
    """Wall seconds by case."""


SOURCE = Path(__file__).resolve().parents[2]
SECONDS_FOR_GIT = 10


def provenance(
    command: str,
    seconds: dict[str, float],
    modules: Sequence[str] = (),
) -> Provenance:
    """Collect the versions, machine, commit and date of this process, to be stored with a record.

    command  command that makes the same record again
    seconds  wall seconds by case
    modules  modules that compute the numbers; the digest includes all modules that these import
    """
    # Changes of the source only: a stored report that this command replaces does not count.
    commit, changes = _git("rev-parse", "HEAD"), _git("status", "--porcelain", ".", ":!reports")
    return Provenance(
        program_version=program_version(),
        commit=commit,
        changed=commit is not None and changes != "",  # without an answer of git, they may differ
        modules=tuple(modules),
        sources=source_digest(*modules) if modules else None,
        command=command,
        date=datetime.now(UTC).isoformat(timespec="seconds"),
        machine=machine(),
        libraries=library_versions(),
        seconds={name: round(value, 2) for name, value in seconds.items()},
    )


def _git(*arguments: str) -> str | None:
    """Run git in the source folder and return its output; None without a repository or without git.

    arguments  command of git with its options
    """
    if not (SOURCE / ".git").exists():
        return None
    try:
        answer = subprocess.run(
            ["git", "-C", str(SOURCE), *arguments],
            capture_output=True, text=True, timeout=SECONDS_FOR_GIT, check=True,
        )  # fmt: skip
    except (OSError, subprocess.SubprocessError):
        return None
    return answer.stdout.strip()
