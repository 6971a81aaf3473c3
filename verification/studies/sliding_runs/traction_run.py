"""The paper's figures 3 and 4: tractions of one coated contact under an ascending force."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import ClassVar

from contact_results.quantities import force_along_x, shear_of, shift_along_x
from contact_results.surface import Surface, surface_of
from contact_scene import LoadStep
from contact_scene.description import Description
from semi_analytical import Increment, solve
from verification.judging.run import SOLVER_TOLERANCE
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, HERTZ, NORMAL_FORCE
from verification.studies.sliding_runs.contacts import CoatedContact

# Forces whose tractions are drawn, T / µW; the paper gives no numbers for its curves.
FORCES = (0.3, 0.6, 0.9)


class Profile(Description):
    """Tractions along y = 0."""

    force: float
    """T / µW."""

    pressure: tuple[float, ...]
    """p / p_H."""

    shear: tuple[float, ...]
    """q_x / µp_H."""


class HistoryPoint(Description):
    """The end of one increment, in SI but for the force."""

    step: int
    index: int
    normal_force: float
    force: float
    """T / µW."""

    approach: float
    contact_radius: float
    stick_area: float
    shift: float
    peak_pressure: float
    residual: float


class TractionRecord(Description):
    """Profiles at x / a_H, the history, and what it cost."""

    x: tuple[float, ...]
    profiles: tuple[Profile, ...]
    history: tuple[HistoryPoint, ...]
    self_equilibrium: float
    """|Σq| / Σ|q| after the normal loading."""

    halvings: int
    convolutions: int
    seconds: float

    @property
    def largest_residual(self) -> float:
        """Of all increments."""
        return max(point.residual for point in self.history)


@dataclass(frozen=True)
class TractionRun:
    """Press, then push: increments of the normal loading, and of each third of the force."""

    record_type: ClassVar[type[Description]] = TractionRecord
    contact: CoatedContact
    cells: int
    normal: int
    tangential: tuple[int, ...]

    @property
    def name(self) -> str:
        return f"{self.contact.name}-tractions-{self.cells}-{self.normal}-{sum(self.tangential)}"

    def compute(self) -> TractionRecord:
        started = time.perf_counter()
        pushes = [
            LoadStep(tangential_force=(part * FRICTION_LIMIT, 0.0), increments=count)
            for part, count in zip(FORCES, self.tangential, strict=True)
        ]
        press = LoadStep(normal_force=NORMAL_FORCE, increments=self.normal)
        grid = self.contact.grid(self.cells)
        result = solve(self.contact.scene(press, *pushes), grid, SOLVER_TOLERANCE)
        q = shear_of(result.steps[0])
        return TractionRecord(
            x=tuple((grid.x / HERTZ.contact_radius).tolist()),
            profiles=tuple(_profile(step, surface_of(result)) for step in result.steps),
            history=tuple(_point(increment) for increment in result.increments),
            self_equilibrium=float(abs(q.sum(axis=(1, 2))).max() / abs(q).sum()),
            halvings=sum(i.halvings for i in result.increments),
            convolutions=sum(i.convolutions for i in result.increments),
            seconds=time.perf_counter() - started,
        )


def _profile(step: Increment, surface: Surface) -> Profile:
    p_H = HERTZ.peak_pressure
    return Profile(
        force=force_along_x(step) / FRICTION_LIMIT,
        pressure=tuple((surface.along(step.pressure) / p_H).tolist()),
        shear=tuple((surface.along(shear_of(step)[0]) / (FRICTION * p_H)).tolist()),
    )


def _point(increment: Increment) -> HistoryPoint:
    assert increment.stick_area is not None
    return HistoryPoint(
        step=increment.step,
        index=increment.index,
        normal_force=increment.normal_force,
        force=force_along_x(increment) / FRICTION_LIMIT,
        approach=increment.approach,
        contact_radius=increment.contact_radius,
        stick_area=increment.stick_area,
        shift=shift_along_x(increment),
        peak_pressure=increment.peak_pressure,
        residual=increment.residuals.worst,
    )
