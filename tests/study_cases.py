"""Trivial cases of a study for tests of its execution: some compute, fail, or end their process."""

import os
import signal
import time
from dataclasses import dataclass

from contact_scene.reading.description import Description
from verification.running.study import CaseRecord


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

    def compute(self) -> CaseRecord:
        started = time.process_time()
        while time.process_time() - started < self.of:
            pass
        return CaseRecord(seconds=self.said)


@dataclass(frozen=True)
class Loop:
    """A fretting contact by some solver; the digest of all its fields is a word of the record."""

    solver: str
    push: float

    @property
    def name(self) -> str:
        return f"loop-{self.solver}-{self.push:g}"

    def compute(self) -> CaseRecord:
        import hashlib

        import numpy as np
        from contact_scenes import LIMIT, PRESS, push, scene

        import slipstick

        part = self.push / LIMIT
        steps = PRESS, push(part, increments=2), push(-part, increments=2)
        fineness = (
            slipstick.SurfaceDiscretisation(cells=(20, 20))
            if self.solver == "semi-analytical"
            else slipstick.FiniteElementDiscretisation(elements_per_radius=4)
        )
        result = slipstick.solve(scene(*steps), self.solver, fineness)
        digest = hashlib.sha256()
        for increment in result.increments:
            for name, field in sorted(vars(increment).items()):
                if isinstance(field, np.ndarray):
                    digest.update(name.encode() + field.tobytes())
        return CaseRecord(
            measures={"dissipated_energy": result.increments[-1].dissipated_energy},
            words={"fields": digest.hexdigest()},
            seconds=1.0,
        )


@dataclass(frozen=True)
class Endless:
    """Says who computes it, and never ends by itself."""

    pid_file: str
    name: str = "endless"

    def compute(self) -> CaseRecord:
        with open(self.pid_file, "w", encoding="ascii") as file:
            file.write(str(os.getpid()))
        while True:
            time.sleep(0.05)
