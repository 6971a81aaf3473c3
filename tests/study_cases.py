"""Cases that do nothing of interest, for tests of how studies run; workers import this file."""

import os
import signal
import time
from dataclasses import dataclass

from contact_scene.description import Description
from verification.running.row import CaseRecord


class Number(Description):
    value: float
    process: int


@dataclass(frozen=True)
class Square:
    of: float

    @property
    def name(self) -> str:
        return f"square-{self.of:g}"

    def compute(self) -> Number:
        return Number(value=self.of**2, process=os.getpid())


@dataclass(frozen=True)
class Refusing(Square):
    def compute(self) -> Number:
        raise ArithmeticError("no square today")


@dataclass(frozen=True)
class Dying(Square):
    def compute(self) -> Number:
        os._exit(9)


@dataclass(frozen=True)
class Killed(Square):
    def compute(self) -> Number:
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError


@dataclass(frozen=True)
class Timed(Square):
    """Works for so many seconds, and says of so many that it measured them."""

    said: float

    def compute(self) -> CaseRecord:  # type: ignore[override]
        started = time.process_time()
        while time.process_time() - started < self.of:
            pass
        return CaseRecord(seconds=self.said)
