"""Signals that end a run: they clean up first, and wait while files are moved into place."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

Handlers = dict[signal.Signals, Any]

STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def _stop(number: int, frame: FrameType | None) -> None:
    for each in STOPS:  # a second Ctrl-C must not interrupt the clean-up that the first one began
        signal.signal(each, signal.SIG_IGN)
    raise SystemExit(128 + number)


@contextmanager
def stop_signals_unwind() -> Iterator[None]:
    """Turn the signals into an exit with 128 + number that runs every clean-up on its way."""
    before = _handled()
    for number in before:
        signal.signal(number, _stop)
    try:
        yield
    finally:
        _restore(before)


@contextmanager
def stop_signals_held() -> Iterator[None]:
    """Let signals take effect only when the block is done.

    A handler that takes notes, not a signal mask: a mask holds for one thread, and the threads of
    a numerical library would receive the signal instead.
    """
    received: list[int] = []
    before = _handled()
    for number in before:
        signal.signal(number, lambda number, frame: received.append(number))
    try:
        yield
    finally:
        _restore(before)
        if received:
            signal.raise_signal(received[0])


def _handled() -> Handlers:
    """The handlers in force, without those that the parent told us to ignore (nohup, `&`)."""
    if threading.current_thread() is not threading.main_thread():
        return {}  # Python allows only the main thread to change handlers
    handlers = {number: signal.getsignal(number) for number in STOPS}
    return {n: handler for n, handler in handlers.items() if handler is not signal.SIG_IGN}


def _restore(handlers: Handlers) -> None:
    for number, handler in handlers.items():
        signal.signal(number, handler)
