"""The scene file of a study, up to the loading step at whose end quantities are read."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_scene import Scene, SceneFile, read_scene_file


class CannotRefine(ValueError):
    """The scene has no such step, or nothing that could be refined as asked."""


@dataclass(frozen=True)
class StudiedScene:
    """A scene file with overrides, and the loading step at whose end quantities are read.

    content  digest of what the file says, so that a record of another content is not taken
    step     number of the loading step, from 1
    """

    file: str
    overrides: tuple[str, ...]
    content: str
    step: int

    @classmethod
    def of(cls, path: Path, overrides: Sequence[str], step: int | None) -> StudiedScene:
        """The scene of a file; the last step if none is named.

        Raises SceneError for mistakes in the file and CannotRefine for a step that is not there.
        """
        contents = read_scene_file(path, overrides)
        steps = len(contents.scene.loading)
        if step is not None and not 1 <= step <= steps:
            raise CannotRefine(f"step {step} was asked for, and the scene has {steps}")
        digest = hashlib.sha256(repr(contents).encode()).hexdigest()[:16]
        return cls(str(path.resolve()), tuple(overrides), digest, step or steps)

    @property
    def title(self) -> str:
        """Of the scene, or its file's name."""
        return self.read().scene.title or Path(self.file).name

    def read(self) -> SceneFile:
        """What the file says, without the steps after the studied one."""
        contents = read_scene_file(self.file, self.overrides)
        return contents.model_copy(update={"loading": contents.loading[: self.step]})


def cut_into(scene: Scene, increments: Sequence[int | None]) -> Scene:
    """The scene with these many increments in each loading step."""
    loading = tuple(
        step.model_copy(update={"increments": count})
        for step, count in zip(scene.loading, increments, strict=True)
    )
    return scene.model_copy(update={"loading": loading})
