"""Files that a run keeps for the next one, damaged; and workers that die."""

from __future__ import annotations

import logging
import os
import signal
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from contact_results.directory.checkpoint_file import Unusable, pack, unpacked
from contact_scene.kept_arrays import log, remembered
from verification.running.case_pool import run_cases
from verification.running.case_store import CaseStore, DamagedRecord
from verification.running.local_workers import LocalWorkers
from verification.running.row import CaseRecord
from verification.studies.promises.promise import Attempt

VALUE = 4.0


@dataclass(frozen=True)
class Doing:
    """A case that ends, or kills its worker."""

    number: int
    dies: bool

    @property
    def name(self) -> str:
        """Of its record."""
        return f"doing-{self.number}"

    def compute(self) -> CaseRecord:
        """Its number."""
        if self.dies:
            os.kill(os.getpid(), signal.SIGKILL)
        return CaseRecord(measures={"number": float(self.number)})


def damages(content: bytes) -> Iterator[bytes]:
    """What may become of a file: cut off or flipped anywhere, grown, emptied, another's, dotted
    names of a pickle in the place of its values."""
    for part in range(1, 8):
        yield content[: part * len(content) // 8]
        at = part * len(content) // 8
        yield content[:at] + bytes([content[at] ^ 4]) + content[at + 1 :]
    yield content + b"\0"
    yield b""
    yield b"something else entirely"
    head = content[: content.rfind(b"\n", 0, 300) + 1]
    yield head + b"cposix\nsystem\n."
    yield head + b"ccontact_scene.kept_arrays\nos.system\n."


def damaged(count: int) -> Iterator[Attempt]:
    """Every damage to an array of the cache, a part of a checkpoint and a record of a case."""
    with TemporaryDirectory() as folder:
        tries = [
            (store, damage)
            for store in (_array, _checkpoint, _record)
            for damage in damages(store(Path(folder)).read_bytes())
        ]
        for store, damage in tries[:: max(1, len(tries) // count)][:count]:
            path = store(Path(folder))
            path.write_bytes(damage)
            named = NAMED[store](Path(folder))
            yield Attempt(
                str(path) in named, f"{path.name} with {damage[:40]!r}: {named or 'used'}"
            )


Store = Callable[[Path], Path]


def _array(folder: Path) -> Path:
    _remember(folder)
    (path,) = folder.glob("*.array")
    return path


def _remember(folder: Path) -> None:
    before = os.environ.get("SLIPSTICK_CACHE_DIR")
    os.environ["SLIPSTICK_CACHE_DIR"] = str(folder)
    try:
        assert remembered("a promise", (3,), lambda: np.full(3, VALUE))[0] == VALUE
    finally:
        if before is None:
            del os.environ["SLIPSTICK_CACHE_DIR"]
        else:
            os.environ["SLIPSTICK_CACHE_DIR"] = before


def _checkpoint(folder: Path) -> Path:
    path = folder / "part-000000"
    pack(VALUE, "this solve", path)
    return path


def _record(folder: Path) -> Path:
    store, case = CaseStore(folder), Doing(1, dies=False)
    store.save(case, case.compute())
    return store.path(case)


def _array_named(folder: Path) -> str:
    said: list[str] = []
    handler = logging.Handler()
    handler.emit = lambda record: said.append(record.getMessage())  # type: ignore[method-assign]
    log.addHandler(handler)
    log.propagate = False
    try:
        _remember(folder)
    finally:
        log.propagate = True
        log.removeHandler(handler)
    return "".join(said)


def _checkpoint_named(folder: Path) -> str:
    try:
        unpacked(folder / "part-000000", "this solve")
    except Unusable as error:
        return str(error)
    return ""


def _record_named(folder: Path) -> str:
    try:
        CaseStore(folder).load(Doing(1, dies=False))
    except DamagedRecord as error:
        return str(error)
    return ""


NAMED: dict[Store, Callable[[Path], str]] = {
    _array: _array_named, _checkpoint: _checkpoint_named, _record: _record_named,
}  # fmt: skip


def worker_killed(count: int) -> Iterator[Attempt]:
    """Sweeps of four cases of which one kills its worker."""
    for number in range(count):
        cases = tuple(Doing(n, dies=n == number % 4) for n in range(4))
        with TemporaryDirectory() as folder:
            ends = run_cases(cases, CaseStore(Path(folder)), LocalWorkers(2), lambda end: None)
        lost = {end.case.name for end in ends if end.lost is not None}
        done = {end.case.name for end in ends if end.record is not None}
        told = f"lost {sorted(lost)}, done {sorted(done)}"
        yield Attempt(lost == {f"doing-{number % 4}"} and len(done) == 3, told)
