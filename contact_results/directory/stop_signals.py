"""Signals that end a process: it cleans up first, and not while files are moved into place."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

Handler = Callable[[int, FrameType | None], Any]

# Windows has no hangup.
STOPS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
STDERR = 2
NOTHING_KEPT = "nothing is kept yet: the same command begins anew"
SHOW_CURSOR = b"\x1b[?25h"  # a progress bar hides it

_begun: list[tuple[Callable[[], None], Callable[[], str]]] = []  # blocks, outermost first


@contextmanager
def cleaned_up_when_stopped(
    clean: Callable[[], None] = lambda: None, kept: Callable[[], str] = lambda: ""
) -> Iterator[None]:
    """End the process with 128 + number on a signal, but clean up before and say how to go on.

    clean  called before the process ends; of blocks within each other the inner one's first
    kept   what is kept of the work and how to go on, if the block knows; one line on stderr

    The handler leaves by itself: an exception raised from it would be lost wherever Python or a
    library swallows exceptions, as in the callbacks of the garbage collector.
    """
    block = (clean, kept)
    _begun.append(block)
    try:
        with _handled_by(_leave):
            yield
    finally:
        _begun.remove(block)


def _leave(number: int, frame: FrameType | None) -> None:
    told = ""
    for clean, kept in reversed(_begun):
        with suppress(Exception):  # the process ends in any case
            clean()
        with suppress(Exception):
            told = told or kept()
    line = f"interrupted{'; ' if told else ''}{told}\n".encode()
    with suppress(OSError):  # past sys.stderr, which a progress bar may have replaced
        os.write(STDERR, (SHOW_CURSOR + b"\n" if os.isatty(STDERR) else b"") + line)
    os._exit(128 + number)


@contextmanager
def stop_signals_held() -> Iterator[None]:
    """Let signals take effect only when the block is done.

    A handler that takes notes, not a signal mask: a mask holds for one thread, and the threads of
    a numerical library would receive the signal instead.
    """
    received: list[int] = []
    try:
        with _handled_by(lambda number, frame: received.append(number)):
            yield
    finally:
        if received:
            signal.raise_signal(received[0])


@contextmanager
def _handled_by(handler: Handler) -> Iterator[None]:
    """Replace the handlers, except where the parent told us to ignore the signal (nohup, `&`)."""
    before: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():  # others must not change handlers
        before = {number: signal.getsignal(number) for number in STOPS}
    before = {number: old for number, old in before.items() if old is not signal.SIG_IGN}
    for number in before:
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)
