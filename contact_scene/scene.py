"""The scene: two bodies, friction between them, and how they are loaded."""

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import Field, model_validator

from contact_scene.body import Body
from contact_scene.checks.consistency import (
    Parts,
    inconsistencies,
)
from contact_scene.friction import CoulombFriction
from contact_scene.geometry import Indenter
from contact_scene.loading import MAX_STEPS, LoadStep
from contact_scene.reading.array_file import ArrayFile
from contact_scene.reading.description import (
    MAX_TITLE,
    Description,
)
from contact_scene.reading.scene_error import SceneError
from contact_scene.rig import Rig
from contact_scene.stepping.load_path import (
    LoadRamp,
    load_path,
)


class Scene(Description):
    """What is solved. Says nothing about how: grids, meshes and tolerances stand beside it.

    Raises `SceneError` if its parts, each valid alone, do not make a problem that can be solved.
    """

    title: str = Field(default="", max_length=MAX_TITLE)
    """A name for people."""

    indenter: Indenter
    """The upper body, with its shape."""

    body: Body
    """The lower body, a half-space."""

    friction: CoulombFriction | None = None
    """Friction between the two; absent: frictionless."""

    rig: Rig | None = None
    """Springs between the actuator and the indenter; absent: none."""

    loading: tuple[LoadStep, ...] = Field(min_length=1, max_length=MAX_STEPS)
    """Loading steps in order, each ramping linearly from the state before."""

    @model_validator(mode="after")
    def _is_consistent(self) -> "Scene":
        problems = inconsistencies(self._parts())
        if problems:
            raise SceneError(problems)
        return self

    def _parts(self) -> Parts:
        return {
            "indenter": self.indenter,
            "body": self.body,
            "friction": self.friction,
            "loading": self.loading,
        }

    @property
    def array_files(self) -> dict[str, ArrayFile]:
        """Arrays of the scene, by the keys that name their files."""
        found = {"file": getattr(self.indenter, "file", None)}
        if self.friction is not None:
            found["map"] = getattr(self.friction.coefficient, "map", None)
        return {key: array for key, array in found.items() if array is not None}

    def replace(self, *changes: str | Mapping[str, Any], **keys: Any) -> "Scene":
        """Return the scene with other values of some keys, checked like a scene file.

        changes  keys and values: `{"indenter.radius": "12 mm", "loading[2].increments": 5}`, or a
                 text as for `--set`: `"indenter.radius=12 mm"`
        keys     the same of keys without dots: `friction=None`

        Keys have dots; entries of arrays count from 1. None leaves an optional key out. Raises
        `SceneError` with every mistake.
        """
        from contact_scene.reading.scene_file import changed_scene

        return changed_scene(self, changes, keys)

    def with_increments(self, increments: Sequence[int]) -> "Scene":
        """Return the scene with these increments of its load steps."""
        steps = zip(self.loading, increments, strict=True)
        loading = tuple(step.model_copy(update={"increments": count}) for step, count in steps)
        return self.model_copy(update={"loading": loading})

    def load_path(self) -> tuple[LoadRamp, ...]:
        """The loading with nothing left implicit, one ramp for every step."""
        return load_path(self.loading, self.body.material)
