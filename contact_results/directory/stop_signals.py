"""Handlers of signals that stop a process: clean up first, and wait for the end of file moves."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

Handler = Callable[[int, FrameType | None], Any]

STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
STDERR = 2
NOTHING_KEPT = "nothing is stored yet: the same command starts from the beginning"
SHOW_CURSOR = b"\x1b[?25h"  # a progress bar hides it

_open_blocks: list[tuple[Callable[[], None], Callable[[], str]]] = []  # blocks, outermost first


@contextmanager
def cleaned_up_when_stopped(
    clean: Callable[[], None] = lambda: None, kept: Callable[[], str] = lambda: ""
) -> Iterator[None]:
    """On a stop signal in the `with` block, clean up, print how to resume, and exit the process.

    The exit code is 128 plus the signal number. The handler exits the process, because an exception
    raised in the handler could be suppressed by Python or a library, for example in a callback of
    the garbage collector.

    clean  function called before the exit; those of inner blocks are called first
    kept   function that returns one line on the stored work and how to resume, or an empty text
    """
    block = (clean, kept)
    _open_blocks.append(block)
    try:
        with _handle_stop_signals(_clean_up_and_exit):
            yield
    finally:
        _open_blocks.remove(block)


def _clean_up_and_exit(number: int, _frame: FrameType | None) -> None:
    """Handle a stop signal: clean up all blocks, print how to resume, and exit the process.

    number  number of the signal
    """
    hint = ""
    for clean, kept in reversed(_open_blocks):
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
    """Defer stop signals that arrive in the `with` block to its end.

    A handler records the signals. A signal mask would apply to one thread only, and threads of a
    numerical library would receive the signal instead.
    """
    received: list[int] = []
    try:
        with _handle_stop_signals(lambda number, frame: received.append(number)):
            yield
    finally:
        if received:
            signal.raise_signal(received[0])


@contextmanager
def _handle_stop_signals(handler: Handler) -> Iterator[None]:
    """Handle stop signals in the `with` block by the given function, then restore the old handlers.

    Ignored signals stay ignored (nohup, `&`). Outside the main thread nothing is changed.
    """
    before: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():  # other threads must not
        before = {number: signal.getsignal(number) for number in STOPS}
    before = {number: old for number, old in before.items() if old is not signal.SIG_IGN}
    for number in before:
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, old)
