"""Atomic publication of the directory of a run.

All files are first written into a hidden directory on the same file system. A new directory then
appears by one rename. In an existing directory, the old `summary.json` is removed first, the files
are replaced one by one, and the new `summary.json` is written last. Therefore a directory with a
summary is complete. Only files with the names of `file_names.RUN_FILES` are replaced or removed.
"""

import json
import os
import secrets
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from contact_results.directory.atomic_file import OutputRefused, create_parents, remove_empty
from contact_results.directory.file_names import RUN_FILES, SUMMARY, TIMING
from contact_results.directory.run_lock import in_sole_use
from contact_results.directory.stop_signals import cleaned_up_when_stopped, stop_signals_held


@contextmanager
def run_directory(target: Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield an empty directory for the files of a run; publish it as `target` on success.

    target     directory of the results; missing parents are created
    overwrite  also replace files of the same names that no run of slipstick has written; files of
               an earlier run of slipstick are always replaced

    Raises OutputRefused before the block is entered.
    """
    target = Path(os.path.realpath(target))
    _refuse_occupied(target, overwrite)
    with files_at_once(target, SUMMARY, RUN_FILES) as staging:
        yield staging


@contextmanager
def files_at_once(target: Path, summary: str, earlier: Sequence[str]) -> Iterator[Path]:
    """Yield an empty directory; move its files into `target` if the `with` block succeeds.

    Existing files of the same names are replaced. If the block fails, the existing files remain.
    The directory `target` is locked during the block, so that no other process can use it.

    target   directory of the results; missing parents are created
    summary  name of the file that is removed first and written last
    earlier  names of further files of an earlier run to remove

    Raises OutputRefused before the block is entered.
    """
    target = Path(os.path.realpath(target))
    refuse_files_above(target)
    created = create_parents(target)

    def remove_created() -> None:
        remove_empty(created)

    try:
        with (
            cleaned_up_when_stopped(remove_created),
            in_sole_use(target),
            _staging_directory(target) as staging,
        ):
            yield staging
            with stop_signals_held():
                _publish_files(staging, target, summary, earlier)
    finally:
        remove_created()


@contextmanager
def _staging_directory(target: Path) -> Iterator[Path]:
    """Provide a hidden directory for new files, and remove it after the `with` block.

    The hidden directory is inside `target` if `target` exists and is not empty, or if its parent is
    not writable: `target` may be a mount point or the only writable directory. Otherwise it is next
    to `target`. Hidden directories of killed runs are removed first.

    target  directory into which the files are moved later, in sole use of this process
    """
    prefix = f".{target.name}.partial-"
    for left in (*target.parent.glob(f"{prefix}*"), *target.glob(f"{prefix}*")):
        shutil.rmtree(left, ignore_errors=True)
    beside = os.access(target.parent, os.W_OK) and not (target.is_dir() and any(target.iterdir()))
    staging = (target.parent if beside else target) / (prefix + secrets.token_hex(4))
    try:
        staging.mkdir()
    except OSError as error:
        raise OutputRefused(f"cannot write into {staging.parent}: {error.strerror}") from error

    def clean() -> None:
        shutil.rmtree(staging, ignore_errors=True)

    try:
        with cleaned_up_when_stopped(clean):
            yield staging
    except OSError as error:
        name = error.filename  # None if the disk is full
        if name is None or Path(os.fsdecode(name)).parent == staging:
            error.filename, error.filename2 = str(target), None
        raise
    finally:
        clean()


def refuse_files_above(target: Path) -> None:
    """Raise OutputRefused if `target` or one of its parents exists and is not a directory."""
    for place in (target, *target.parents):
        if place.exists() and not place.is_dir():
            raise OutputRefused(f"{place} is a file; --output needs a directory")


def _refuse_occupied(target: Path, overwrite: bool) -> None:
    """Raise OutputRefused if a result file exists in `target` that must not be replaced.

    overwrite  allow to replace result files that no run of slipstick has written
    """
    refuse_files_above(target)
    if not target.is_dir():
        return
    ours = _is_earlier_run(target)
    for name in RUN_FILES:
        path = target / name
        if path.is_dir():
            raise OutputRefused(
                f"{path} is a directory, expected a result file or nothing; move it"
            )
        if os.path.lexists(path) and not (ours or overwrite):
            raise OutputRefused(
                f"{path} exists, but {target} is not the result of an earlier run; "
                "choose another directory, or replace it with --overwrite"
            )


def _is_earlier_run(directory: Path) -> bool:
    try:
        record = json.loads((directory / TIMING).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(record, dict) and record.get("program") == "slipstick"


def _publish_files(staging: Path, target: Path, summary: str, earlier: Sequence[str]) -> None:
    """Move the new files into `target`: by one rename if possible, else file by file.

    staging  hidden directory with the new files
    summary  name of the file that is removed first and written last
    earlier  names of further files of an earlier run to remove
    """
    for path in staging.iterdir():
        _flush_to_disk(path)
    _flush_to_disk(staging)
    if staging.parent != target:
        try:
            os.rename(staging, target)
            _flush_to_disk(target.parent)
            return
        except OSError:
            # Another program created the target, or the target is a mount point.
            if not target.is_dir():
                raise
    _replace_files(staging, target, summary, earlier)


def _replace_files(staging: Path, target: Path, summary: str, earlier: Sequence[str]) -> None:
    """Replace the files in an existing `target` one by one; write the summary last.

    The old summary is removed first, so that an incomplete directory has no summary.

    staging  hidden directory with the new files
    summary  name of the file that is removed first and written last
    earlier  names of files to remove if there is no new file of this name
    """
    new = {path.name for path in staging.iterdir()}
    ours = summary != SUMMARY or _is_earlier_run(target)
    if summary in new:
        (target / summary).unlink(missing_ok=True)
    for name in set(earlier) - new if ours else ():
        (target / name).unlink(missing_ok=True)
    for name in sorted(new, key=lambda name: (name == summary, name != TIMING, name)):
        os.replace(staging / name, target / name)
    _flush_to_disk(target)


def _flush_to_disk(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
