"""Cases of the gross-sliding study that the solver computes."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import ClassVar

import numpy as np

from contact_scene import LoadStep
from contact_scene.description import Description
from semi_analytical import Coupling, Result, plan, solve
from verification.judging.run import SOLVER_TOLERANCE
from verification.problems.paper_scene import FRICTION_LIMIT, NORMAL_FORCE
from verification.studies.sliding_runs.contacts import Contact
from verification.studies.sliding_runs.path import SlidingPath, joined, path_of, point_of

# Fine increments reach this far past the shift at which the stick area is expected to vanish.
FINE_REACH = 1.4
# Slip that opposes its total lets go later.
SHORT_REACH = 2.2


@dataclass(frozen=True)
class Steps:
    """Increments of the normal loading, of the approach to sliding, and of the way beyond it."""

    normal: int
    tangential: int
    beyond: int

    def halved_tangential(self) -> Steps:
        """Steps half as large in shift."""
        return Steps(self.normal, 2 * self.tangential, 2 * self.beyond)

    def halved_normal(self) -> Steps:
        """Steps half as large in contact radius."""
        return Steps(2 * self.normal, self.tangential, self.beyond)

    @property
    def text(self) -> str:
        """For file names."""
        return f"{self.normal}-{self.tangential}"


@dataclass(frozen=True)
class ShiftRun:
    """Press, then shift the indenter until all slides, and on.

    coupling  None: as the bodies have it
    """

    record_type: ClassVar[type[Description]] = SlidingPath
    contact: Contact
    cells: int
    steps: Steps
    coupling: Coupling | None = None

    @property
    def name(self) -> str:
        other = "" if self.coupling is None else f"-{self.coupling.name.lower()}-coupling"
        other = other.replace("_", "-")
        return f"{self.contact.name}-shift-{self.cells}-{self.steps.text}{other}"

    def compute(self) -> SlidingPath:
        contact, steps = self.contact, self.steps
        started = time.perf_counter()
        scene = contact.scene(
            LoadStep(normal_force=NORMAL_FORCE, increments=steps.normal),
            LoadStep(
                tangential_shift=(FINE_REACH * contact.sliding_scale, 0.0),
                increments=steps.tangential,
            ),
            LoadStep(tangential_shift=(contact.beyond_sliding, 0.0), increments=steps.beyond),
        )
        decided = plan(scene)
        if self.coupling is not None:
            decided = replace(decided, coupling=self.coupling)
        result = solve(scene, contact.grid(self.cells), SOLVER_TOLERANCE, plan=decided)
        return path_of(result, 2, time.perf_counter() - started)


@dataclass(frozen=True)
class ForceRun:
    """Press, then push up to a part of the friction limit, as the paper does."""

    record_type: ClassVar[type[Description]] = SlidingPath
    contact: Contact
    cells: int
    normal: int
    tangential: int
    largest_force: float

    @property
    def name(self) -> str:
        return f"{self.contact.name}-force-{self.cells}-{self.normal}-{self.tangential}"

    def compute(self) -> SlidingPath:
        started = time.perf_counter()
        force = (self.largest_force * FRICTION_LIMIT, 0.0)
        scene = self.contact.scene(
            LoadStep(normal_force=NORMAL_FORCE, increments=self.normal),
            LoadStep(tangential_force=force, increments=self.tangential),
        )
        result = solve(scene, self.contact.grid(self.cells), SOLVER_TOLERANCE)
        return path_of(result, 2, time.perf_counter() - started)


def shifts_to(contact: Contact, steps: Steps, reach: float = FINE_REACH) -> list[float]:
    """Shifts at the ends of the increments: fine ones to full slip, others beyond."""
    fine = reach * contact.sliding_scale
    near = np.linspace(0, fine, steps.tangential + 1)[1:]
    return [
        *near.tolist(),
        *np.linspace(fine, contact.beyond_sliding, steps.beyond + 1)[1:].tolist(),
    ]


class ShortPath(StrEnum):
    """Ways to each shift that skip the history."""

    ONE_STEP = "one-step"  # press in one increment, shift in another
    TOTAL = "total"  # both at once: slip opposes its total, not its increment


@dataclass(frozen=True)
class ShortPathRun:
    """Every shift reached anew from untouched bodies by a short path."""

    record_type: ClassVar[type[Description]] = SlidingPath
    contact: Contact
    cells: int
    path: ShortPath
    steps: Steps

    @property
    def name(self) -> str:
        return f"{self.contact.name}-{self.path}-{self.cells}-{self.steps.text}"

    def compute(self) -> SlidingPath:
        started = time.perf_counter()
        results = [
            self._solved(shift) for shift in shifts_to(self.contact, self.steps, SHORT_REACH)
        ]
        before = [r.increments[-2] if len(r.increments) > 1 else None for r in results]
        points = [point_of(r.increments[-1], b) for r, b in zip(results, before, strict=True)]
        increments = [i for r in results for i in r.increments]
        return joined(results[-1], points, increments, time.perf_counter() - started)

    def _solved(self, shift: float) -> Result:
        if self.path is ShortPath.TOTAL:
            loading = [
                LoadStep(normal_force=NORMAL_FORCE, tangential_shift=(shift, 0.0), increments=1)
            ]
        else:
            loading = [
                LoadStep(normal_force=NORMAL_FORCE, increments=1),
                LoadStep(tangential_shift=(shift, 0.0), increments=1),
            ]
        return solve(self.contact.scene(*loading), self.contact.grid(self.cells), SOLVER_TOLERANCE)
