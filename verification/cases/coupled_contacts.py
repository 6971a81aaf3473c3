"""Contacts that couple pressure and shear, and a history that turns aside and unloads."""

from __future__ import annotations

from dataclasses import dataclass

from contact_scene import Body, FiniteElementDiscretisation, LoadStep, Scene
from verification.cases.turned import turned
from verification.judging.run import SOLVER_TOLERANCE, Run, SectionRun
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import SUBSTRATE, coated, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, NORMAL_FORCE, pressing

MARGIN = 1.2  # half the window over Hertz's radius
PRESSED, PUSHED, BACK = 1, 2, 3  # loading steps
PRESSING = 6  # increments


@dataclass(frozen=True)
class CoupledContact:
    """A rigid ball on a body that couples pressure and shear.

    part  of µW that pushes it to and fro
    """

    name: str
    body: Body
    friction: float
    part: float

    @property
    def loop(self) -> tuple[LoadStep, ...]:
        """Pressed, pushed and pulled back."""
        limit = self.friction * NORMAL_FORCE
        return (
            pressing(PRESSING),
            LoadStep(tangential_force=(self.part * limit, 0.0), increments=2),
            LoadStep(tangential_force=(-self.part * limit, 0.0), increments=3),
        )

    @property
    def history(self) -> tuple[LoadStep, ...]:
        """The loop, then pushed aside, and unloaded under that force."""
        limit = self.friction * NORMAL_FORCE
        aside = (-0.3 * self.part * limit, 0.7 * self.part * limit)
        return (
            *self.loop,
            LoadStep(tangential_force=aside, increments=2),
            LoadStep(normal_force=0.7 * NORMAL_FORCE, increments=2),
        )

    def run(self, cells: int, degrees: float = 0.0) -> Run:
        """The history, turned."""
        way = "" if degrees == 0 else f", turned by {degrees:g}°"
        grid = paper.square_grid(cells, MARGIN * HERTZ.contact_radius)
        return Run(f"{self.name}{way}", self.scene(turned(self.history, degrees), way), grid)

    def section(self, elements: int, harmonics: int) -> SectionRun:
        """The loop by finite elements: loads along a line."""
        mesh = FiniteElementDiscretisation(
            elements_per_radius=elements,
            contact_radius=HERTZ.contact_radius,
            harmonics=harmonics,
            tolerance=SOLVER_TOLERANCE,
        )
        label = f"{self.name}, {elements} elements per radius"
        return SectionRun(label, self.scene(self.loop, ", to and fro"), mesh)

    def scene(self, loading: tuple[LoadStep, ...], way: str) -> Scene:
        """Under a history."""
        title = f"Rigid ball on a body: {self.name}{way}"
        return pressed(title, rigid_ball(), self.body, *loading, friction=self.friction)


BARE = CoupledContact("homogeneous, µ = 0.3", Body(material=SUBSTRATE), 0.3, 2 / 3)
FILM = CoupledContact("coated, µ = 0.1", coated(film(2.0, 1.0)), 0.1, 2 / 3)
