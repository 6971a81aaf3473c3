"""Provenance of a stored record: versions, command, date, machine, times, and source digest.

Only the provenance differs between repeated runs of the same code. The digest includes the modules
that made the record and all project modules that they import; it shows if a record is older than
the code.
"""

from __future__ import annotations

import hashlib
import io
import re
import subprocess
import tokenize
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from contact_results.directory.machine import library_versions, machine, program_version
from contact_scene.reading.description import Description

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = (
    *("contact_scene", "contact_solver", "semi_analytical", "fem_reference", "radial"),
    *("contact_errors", "contact_results", "verification", "slipstick"),
)
# They export the challenges and the commands' functions, on which other modules do not depend.
EXPORTS = ("verification/__init__.py", "slipstick/__init__.py")
# Objects that `pkgutil.resolve_name` imports, such as the solvers in `contact_results.solvers`.
RESOLVED = re.compile(r'"([\w.]+):\w+"')
# A catalogue imports the modules of its package by name.
BY_NAME = re.compile(r'import_module\(f"([\w.]+)\.\{')
# Import statements as the formatter writes them, without comments. Other lines that look like one
# name no modules of the project.
IMPORT = re.compile(r"^ *(?:from ([\w.]+) import (\([^)]*\)|.*)|import (.*))", re.MULTILINE)

UNREAD = (tokenize.ENCODING, tokenize.COMMENT, tokenize.NL)
STATEMENT_ENDS = (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)


@cache
def source_digest(*modules: str) -> str:
    """Compute a digest of the source files of modules and of all project modules that they import.

    A stored record of a study or report is current if this digest equals the one stored with it. A
    package stands for all its modules. The stored reference solutions are included if they are
    imported.

    modules  dotted names of modules or packages
    """
    digest = hashlib.sha256()
    paths = closure(modules)
    if "verification/references/__init__.py" in paths:
        found = (ROOT / "verification/references").glob("*.json")
        paths |= {path.relative_to(ROOT).as_posix() for path in found}
    for path in sorted(paths):
        digest.update(f"{path} {_file_digest(path)}\n".encode())
    return digest.hexdigest()[:16]


def is_current(made: Provenance) -> bool:
    """Return True if a stored record was computed by the present source code.

    The result is False if the record does not name its source code.

    made  provenance of the record
    """
    return bool(made.modules) and made.sources == source_digest(*made.modules)


def age_text(made: Provenance) -> str:
    """Return the note "older than the code" for a record of older source code; empty for a current
    record.

    made  provenance of the record
    """
    return "" if is_current(made) else "older than the code"


def closure(modules: Iterable[str]) -> set[str]:
    """Return the paths of the source files of modules and of all project modules that they import.

    Indirect imports are included. The paths are relative to the repository.

    modules  dotted names of modules or packages
    """
    found: set[str] = set()
    left = [path for module in modules for path in _module_files(module, whole=True)]
    while left:
        path = left.pop()
        if path not in found:
            found.add(path)
            left += () if path in EXPORTS else _imported_files(path)
    return found


@cache
def _imported_files(path: str) -> tuple[str, ...]:
    text = (ROOT / path).read_text(encoding="utf-8")
    names = {f for name in BY_NAME.findall(text) for f in _module_files(name, whole=True)}
    names |= {f for name in RESOLVED.findall(text) for f in _module_files(name)}
    for package, objects, modules in IMPORT.findall(re.sub("#.*", "", text)):
        prefix = f"{package}." if package else ""
        for name in re.findall(r"(?<! as )\b[\w.]+", objects or modules):
            names |= {*_module_files(prefix + name)}
    return tuple(names)


@cache
def _module_files(module: str, *, whole: bool = False) -> tuple[str, ...]:
    """Return the source files that importing a module executes: its own file and its packages'
    files.

    The paths are relative to the repository. A module of another project has none.

    module  dotted name
    whole   if True, also return all files of a package
    """
    parts = module.split(".")
    if parts[0] not in PACKAGES:
        return ()
    bases = ["/".join(parts[:depth]) for depth in range(1, len(parts) + 1)]
    paths = [path for base in bases for path in (f"{base}/__init__.py", f"{base}.py")]
    found = [path for path in paths if (ROOT / path).is_file()]
    if whole:
        inside = (ROOT / bases[-1]).rglob("*.py")
        found += [path.relative_to(ROOT).as_posix() for path in inside]
    return tuple(found)


@cache
def _file_digest(path: str) -> str:
    """Compute a digest of a source file that does not depend on comments, docstrings and spaces.

    Other files than Python modules are read as they are. Repeated braces count as one, because
    Python 3.12 and later split an f-string into tokens.

    path  path relative to the repository
    """
    data = (ROOT / path).read_bytes()
    if path.endswith(".py"):
        kept, before = [], tokenize.NEWLINE
        for token in tokenize.tokenize(io.BytesIO(data).readline):
            if token.type in UNREAD:
                continue
            if token.type != tokenize.STRING or before not in STATEMENT_ENDS:
                kept.append(token.string)
            before = token.type
        data = re.sub(r"([{}])\1+", r"\1", "".join("".join(kept).split())).encode()
    return hashlib.sha256(data).hexdigest()


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
    if not (ROOT / ".git").exists():
        return None
    try:
        answer = subprocess.run(
            ["git", "-C", str(ROOT), *arguments],
            capture_output=True,
            text=True,
            timeout=SECONDS_FOR_GIT,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return answer.stdout.strip()
