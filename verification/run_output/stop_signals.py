"""Signals that end a process: it cleans up first, and not while files are moved into place."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

Handler = Callable[[int, FrameType | None], Any]

STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
STDERR = 2
SHOW_CURSOR = b"\x1b[?25h"  # a progress bar hides it


@contextmanager
def cleaned_up_when_stopped(clean: Callable[[], None] = lambda: None) -> Iterator[None]:
    """End the process with 128 + number on a signal, but call `clean` before.

    The handler leaves by itself: an exception raised from it would be lost wherever Python or a
    library swallows exceptions, as in the callbacks of the garbage collector.
    """

    def leave(number: int, frame: FrameType | None) -> None:
        clean()
        if os.isatty(STDERR):  # past sys.stderr, which a progress bar may have replaced
            os.write(STDERR, SHOW_CURSOR + b"\n")
        os._exit(128 + number)

    with _handled_by(leave):
        yield


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
