"""Cases of the studies that the product's solver computes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from contact_results.surface import surface_of
from contact_scene import LoadStep
from semi_analytical import Coupling, Plan, Result, plan, solve
from verification.judging.run import SOLVER_TOLERANCE
from verification.problems.paper_scene import (
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    NORMAL_FORCE,
    pressing,
)
from verification.quantities import force_along_x, shear_of
from verification.running.row import CaseRecord, Row
from verification.studies.sliding.contacts import Contact
from verification.studies.sliding.path import counted, record_of, row_of

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

    contact: Contact
    cells: int
    steps: Steps
    coupling: Coupling | None = None

    @property
    def name(self) -> str:
        other = "" if self.coupling is None else f"-{self.coupling.name.lower()}-coupling"
        other = other.replace("_", "-")
        return f"{self.contact.name}-shift-{self.cells}-{self.steps.text}{other}"

    def compute(self) -> CaseRecord:
        contact, steps = self.contact, self.steps
        ends = (FINE_REACH * contact.sliding_scale, contact.beyond_sliding)
        return _history(
            self,
            pressing(steps.normal),
            *(
                LoadStep(tangential_shift=(end, 0.0), increments=count)
                for end, count in zip(ends, (steps.tangential, steps.beyond), strict=True)
            ),
        )

    def planned(self, decided: Plan) -> Plan:
        """With the coupling that was asked for."""
        return decided if self.coupling is None else replace(decided, coupling=self.coupling)


@dataclass(frozen=True)
class ForceRun:
    """Press, then push to parts of the friction limit, as the paper does.

    normal  increments of the pressing
    parts   T/µW, one loading step each
    pushes  increments of each of these
    """

    contact: Contact
    cells: int
    normal: int
    parts: tuple[float, ...]
    pushes: tuple[int, ...]

    @property
    def name(self) -> str:
        counts = "-".join(map(str, self.pushes))
        return f"{self.contact.name}-force-{self.cells}-{self.normal}-{counts}".replace(".", "p")

    def compute(self) -> CaseRecord:
        return _history(
            self,
            pressing(self.normal),
            *(
                LoadStep(tangential_force=(part * FRICTION_LIMIT, 0.0), increments=count)
                for part, count in zip(self.parts, self.pushes, strict=True)
            ),
        )

    def planned(self, decided: Plan) -> Plan:
        """As it is."""
        return decided


def _history(run: ShiftRun | ForceRun, *loading: LoadStep) -> CaseRecord:
    """All increments, and the tractions along y = 0 at the end of each loading step.

    self_equilibrium  |Σq| / Σ|q| after the normal loading; zero without shear
    """
    scene, grid = run.contact.scene(*loading), run.contact.grid(run.cells)
    result = solve(scene, grid, SOLVER_TOLERANCE, plan=run.planned(plan(scene)))
    done = result.increments
    q = shear_of(result.steps[0])
    total = float(abs(q).sum())
    return record_of(
        run,
        [
            *(row_of(one, before) for one, before in zip(done, (None, *done[:-1]), strict=True)),
            *_profiles(result),
        ],
        grid.spacing[0] / done[-1].contact_radius,
        counted(done),
        self_equilibrium=float(abs(q.sum(axis=(1, 2))).max() / total) if total else 0.0,
    )


def _profiles(result: Result) -> list[Row]:
    """T/µW, p/p_H and q_x/µp_H at x/a_H, by number of the loading step that they end."""
    x, p_H = result.grid.x / HERTZ.contact_radius, HERTZ.peak_pressure
    surface = surface_of(result)
    return [
        Row(
            parameters={"profile": number, "x_over_aH": at},
            measures={
                "T_over_muW": force_along_x(step) / FRICTION_LIMIT,
                "p_over_pH": p,
                "qx_over_mu_pH": q,
            },
        )
        for number, step in enumerate(result.steps, 1)
        for at, p, q in zip(
            x.tolist(),
            (surface.along(step.pressure) / p_H).tolist(),
            (surface.along(shear_of(step)[0]) / (FRICTION * p_H)).tolist(),
            strict=True,
        )
    ]


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

    contact: Contact
    cells: int
    path: ShortPath
    steps: Steps

    @property
    def name(self) -> str:
        return f"{self.contact.name}-{self.path}-{self.cells}-{self.steps.text}"

    def compute(self) -> CaseRecord:
        results = [
            self._solved(shift) for shift in shifts_to(self.contact, self.steps, SHORT_REACH)
        ]
        ends = [(None, *result.increments)[-2:] for result in results]
        last = results[-1]
        return record_of(
            self,
            [row_of(end, before, step=2) for before, end in ends if end is not None],
            last.grid.spacing[0] / last.increments[-1].contact_radius,
            counted([one for result in results for one in result.increments]),
        )

    def _solved(self, shift: float) -> Result:
        if self.path is ShortPath.TOTAL:
            loading = [
                LoadStep(normal_force=NORMAL_FORCE, tangential_shift=(shift, 0.0), increments=1)
            ]
        else:
            loading = [
                pressing(1),
                LoadStep(tangential_shift=(shift, 0.0), increments=1),
            ]
        return solve(self.contact.scene(*loading), self.contact.grid(self.cells), SOLVER_TOLERANCE)
