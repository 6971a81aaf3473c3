"""Directories above an output: made where they are missing, gone again where nothing came of it."""

from collections.abc import Sequence
from pathlib import Path

from contact_results.directory.refusal import OutputRefused


def create_parents(target: Path) -> list[Path]:
    """Create what is missing above `target`; return it, innermost first.

    Raises OutputRefused where that cannot be.
    """
    missing = [parent for parent in target.parents if not parent.exists()]
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputRefused(f"cannot create {target.parent}: {error.strerror}") from error
    return missing


def remove_empty(directories: Sequence[Path]) -> None:
    """Remove these directories, innermost first, as far as nothing is in them."""
    for directory in directories:
        try:
            directory.rmdir()
        except OSError:
            return
