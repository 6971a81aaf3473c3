"""Handlers of signals that end a process: clean up first, and defer during file moves."""

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
NOTHING_KEPT = "nothing is stored yet: the same command starts from the beginning"
SHOW_CURSOR = b"\x1b[?25h"  # a progress bar hides it

_begun: list[tuple[Callable[[], None], Callable[[], str]]] = []  # blocks, outermost first


@contextmanager
def cleaned_up_when_stopped(
    clean: Callable[[], None] = lambda: None, kept: Callable[[], str] = lambda: ""
) -> Iterator[None]:
    """On a stop signal, clean up, print how to resume, and exit with 128 + signal number.

    The handler exits the process, because an exception raised in it could be suppressed by Python
    or a library, for example in a callback of the garbage collector.

    clean  called before the exit; inner blocks first
    kept   returns one line on the stored work and how to resume, or an empty text
    """
    block = (clean, kept)
    _begun.append(block)
    try:
        with _handled_by(_leave):
            yield
    finally:
        _begun.remove(block)


def _leave(number: int, frame: FrameType | None) -> None:
    hint = ""
    for clean, kept in reversed(_begun):
        with suppress(Exception):  # the process ends in any case
            clean()
        with suppress(Exception):
            hint = hint or kept()
    line = f"interrupted{'; ' if hint else ''}{hint}\n".encode()
    with suppress(OSError):  # not sys.stderr, which a progress bar may have replaced
        os.write(STDERR, (SHOW_CURSOR + b"\n" if os.isatty(STDERR) else b"") + line)
    os._exit(128 + number)


@contextmanager
def stop_signals_held() -> Iterator[None]:
    """Defer stop signals to the end of the block.

    A handler records the signals. A signal mask would apply to one thread only, and threads of a
    numerical library would receive the signal instead.
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
    """Replace the handlers, except those of ignored signals (nohup, `&`)."""
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
