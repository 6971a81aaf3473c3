"""Effects that a scene does not call for, forced on: they change nothing and cost much."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from contact_scene import Body, Paraboloid, Scene
from semi_analytical import SurfaceGrid, all_effects
from verification.exhibits.table import NONE, Table
from verification.judging.case import Case, Comparison, Level
from verification.judging.run import SOLVER_TOLERANCE, Run
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import SUBSTRATE, coated, film, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, STEEL, pressing
from verification.problems.reference import ReferenceKind
from verification.quantities import largest_difference

if TYPE_CHECKING:
    from semi_analytical import Result

CELLS = {Level.QUICK: 48, Level.STANDARD: 96, Level.FULL: 96}
MARGIN = 1.3  # half the window over the Hertz radius


@dataclass(frozen=True)
class _Pair:
    """A scene, solved as planned and with everything forced on."""

    name: str
    scene: Scene

    def planned(self, cells: int) -> Run:
        return Run(f"{self.name}, as planned", self.scene, self._grid(cells))

    def forced(self, cells: int) -> Run:
        label = f"{self.name}, all effects on"
        return Run(label, self.scene, self._grid(cells), effects=all_effects)

    def _grid(self, cells: int) -> SurfaceGrid:
        return paper.square_grid(cells, MARGIN * HERTZ.contact_radius)


def forced_effects(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return forced_effects_on(CELLS[level])


def forced_effects_on(cells: int) -> Case:
    """The case on square grids of this many cells per side."""
    pairs = {pair.name: (pair.planned(cells), pair.forced(cells)) for pair in _PAIRS}
    return Case(
        name="forced_effects",
        title="Only the effects that a scene calls for",
        problem=(
            "Scenes whose plan leaves effects out, because they vanish: shear without friction, "
            "tilt and torsion where nothing turns the indenter, the coupling of pressure and shear "
            "where the bodies are alike, and the mirror images of tractions. Each is "
            "solved again with every effect forced on. The answer must be the same; what the plan "
            "saves is the ratio of the convolutions."
        ),
        runs=tuple(run for pair in pairs.values() for run in pair),
        quantities=(),
        comparisons=tuple(
            Comparison(
                name.replace(" ", "_"),
                f"{name}: largest difference of pressure, shear, approach and shift",
                (planned.label, forced.label), largest_difference, 10 * SOLVER_TOLERANCE,
                "both solves leave residuals up to the solver's tolerance, and tractions answer "
                "these a few times over",
                "effects that vanish change nothing", ReferenceKind.IDENTITY,
            )
            for name, (planned, forced) in pairs.items()
        ),
        tables=lambda results: (_savings(results, pairs),),
    )  # fmt: skip


def _savings(results: Mapping[str, Result], pairs: Mapping[str, tuple[Run, Run]]) -> Table:
    rows = []
    for name, runs in pairs.items():
        few, many = (sum(i.convolutions for i in results[r.label].increments) for r in runs)
        rows.append((name, str(few), str(many), f"{many / few:.1f}"))
    return Table(
        title="What the plan saves",
        columns=("scene", "convolutions, as planned", "all effects on", "ratio"),
        rows=tuple(rows),
        note="Increments are the same on both sides; that plans also need fewer of them where "
        "nothing depends on the path comes on top.",
        units=NONE,
    )


def _pushed(title: str, indenter: Paraboloid, body: Body) -> Scene:
    """Pressed, pushed to 0.9 µW, and back to -0.9 µW."""
    way = (paper.tangential_step(part, increments=2) for part in (0.9, -0.9))
    return pressed(title, indenter, body, pressing(), *way, friction=paper.FRICTION)


_FILM = film(2.0, 1.0)
_COATED_BALL = Paraboloid(radius=paper.RADIUS, material=SUBSTRATE, layers=(_FILM,))
_PAIRS = (
    _Pair(
        "frictionless",
        pressed("The paper's ball without friction", rigid_ball(), Body(material=SUBSTRATE)),
    ),
    _Pair(
        "frictionless coated",
        pressed("The paper's ball on a coating, without friction", rigid_ball(), coated(_FILM)),
    ),
    _Pair(
        "alike bodies sheared",
        _pushed("Two alike bodies", paper.paraboloid(STEEL), Body(material=STEEL)),
    ),
    _Pair(
        "alike coated bodies sheared",
        _pushed("Two alike coated bodies", _COATED_BALL, coated(_FILM)),
    ),
    _Pair(
        "rigid ball on coating sheared",
        _pushed("The paper's ball on a coating", rigid_ball(), coated(_FILM)),
    ),
)
