"""What a study of the semi-analytical method starts from: the grid and the plan of a scene."""

from __future__ import annotations

from dataclasses import dataclass

from contact_scene import Scene, SceneFile
from semi_analytical import Plan, SurfaceGrid, UnsupportedScene, discretise, plan
from verification.studies.refinement.studied_scene import StudiedScene
from verification.studies.refinement.surface_level import SurfaceLevel


@dataclass(frozen=True)
class SurfaceStart:
    """A scene, and how `slipstick run` would solve it."""

    scene: StudiedScene
    contents: SceneFile
    grid: SurfaceGrid
    plan: Plan

    @classmethod
    def of(cls, scene: StudiedScene) -> SurfaceStart:
        """As `slipstick run` would choose it."""
        contents = scene.read()
        grid = discretise(contents.scene, contents.semi_analytical)
        decided = plan(contents.scene, contents.semi_analytical.path_accuracy)
        return cls(scene, contents, grid, decided)

    @property
    def tolerance(self) -> float:
        """Of the solver."""
        return self.contents.semi_analytical.tolerance

    @property
    def couples(self) -> bool:
        """Whether pressure and shear act on each other."""
        return self.plan.coupling is not type(self.plan.coupling).NONE

    @property
    def increments(self) -> tuple[int, ...]:
        """Of each step, as asked for or chosen."""
        return self.plan.increments

    @property
    def path_matters(self) -> tuple[bool, ...]:
        """Of each step: whether increments are needed for accuracy."""
        return tuple(step.path_matters for step in self.plan.path)

    def grid_of(self, cells: int | None) -> SurfaceGrid:
        """As many cells along each side, or those of the scene, on its window."""
        return self.grid if cells is None else SurfaceGrid((cells, cells), self.grid.window)

    def level(
        self,
        size: float,
        level: str,
        *,
        grid: SurfaceGrid | None = None,
        fineness: int | None = None,
        increments: tuple[int, ...] | None = None,
        kept: tuple[int, int] | None = None,
    ) -> SurfaceLevel:
        """A level: what is not given is as `slipstick run` would have it.

        fineness  cells along each side, where no grid is given
        """
        on, counts = grid or self.grid_of(fineness), increments or self.increments
        return SurfaceLevel(self.scene, on.cells, on.window, counts, size, level, kept)


def refuse_fixed_window(scene: Scene) -> None:
    """Raises UnsupportedScene where a height map or a friction map bounds the window."""
    if scene.indenter.extent is not None:
        raise UnsupportedScene(
            "the height map says where the indenter ends, which fixes the window: beyond it there "
            "is no gap that could be computed"
        )
    if scene.friction is not None and scene.friction.extent is not None:
        raise UnsupportedScene("the friction map bounds the window: it says nothing beyond")
