"""Cases of the gross-sliding study under other readings of the law of friction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.summary import ContactStatus
from semi_analytical import solve
from semi_analytical.model import ContactModel
from verification.judging.run import SOLVER_TOLERANCE
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, pressing
from verification.quantities import shear_of
from verification.running.row import CaseRecord, Row
from verification.studies.sliding.contacts import Contact
from verification.studies.sliding.friction_laws import (
    FixedPressure,
    FrictionLaw,
    Held,
    at_rest,
    shifted,
)
from verification.studies.sliding.path import (
    PRESSING,
    SlidingPoint,
    mean_cosine,
    record_of,
)
from verification.studies.sliding.runs import Steps, shifts_to

SLIDING = 1e-6


@dataclass(frozen=True)
class LawRun:
    """Press with the product's solver, then shift at that pressure under one reading."""

    contact: Contact
    cells: int
    steps: Steps
    law: FrictionLaw

    @property
    def name(self) -> str:
        return f"{self.contact.name}-{self.law}-{self.cells}-{self.steps.text}"

    def compute(self) -> CaseRecord:
        grid = self.contact.grid(self.cells)
        scene = self.contact.scene(pressing(self.steps.normal))
        pressed = solve(scene, grid, SOLVER_TOLERANCE).increments[-1]
        model = ContactModel.of(scene, grid)
        problem = FixedPressure.of(
            model.operator(grid.cells).tangential,
            FRICTION * pressed.pressure,
            model.self_compliance,
        )
        state, shift = at_rest(problem, shear_of(pressed)), 0.0
        rows = [_point(problem, state, shift, grid.cell_area, PRESSING)]
        for next_shift in shifts_to(self.contact, self.steps):
            state = shifted(problem, self.law, state, next_shift - shift)
            shift = next_shift
            rows.append(_point(problem, state, shift, grid.cell_area, PRESSING + 1))
        return record_of(
            self,
            rows,
            grid.spacing[0] / pressed.contact_radius,
            {"increments": len(rows), "convolutions": int(model.convolutions.count)},
        )


def _point(problem: FixedPressure, state: Held, shift: float, cell_area: float, step: int) -> Row:
    contact = np.count_nonzero(problem.bound)
    force = float(np.sum(state.shear[0])) * cell_area / FRICTION_LIMIT
    sticking = int(np.count_nonzero(state.in_stick))
    return SlidingPoint(
        step=step,
        shift=shift,
        force=force,
        stick_fraction=sticking / contact,
        stick_cells=sticking,
        mean_cosine=mean_cosine(problem.bound, state.shear),
        full_slip=sticking == 0,
        status=_status(sticking, force),
        largest_residual=state.residual,
    ).row()


def _status(sticking: int, force: float) -> ContactStatus:
    if sticking:
        return ContactStatus.PARTIAL_SLIP
    sliding = force >= 1 - SLIDING
    return ContactStatus.GROSS_SLIDING if sliding else ContactStatus.NO_STICK_AREA_LEFT
