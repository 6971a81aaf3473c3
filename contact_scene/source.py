"""What a scene file and the overrides on top of it say, and where each key was written."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path as FilePath
from typing import Any

from contact_scene.override import origin, override
from contact_scene.problem import Path, Problem, SceneError
from contact_scene.toml_file import read_toml


@dataclass(frozen=True)
class Source:
    """A document that is not checked yet.

    file        where it was read
    document    its contents, overrides applied
    lines       line of every key in the file
    overridden  the options that set a key
    refused     what is wrong with options that set none
    """

    file: FilePath
    document: dict[str, Any]
    lines: Mapping[Path, int]
    overridden: Mapping[Path, str]
    refused: tuple[Problem, ...]

    @contextmanager
    def placing(self) -> Iterator[None]:
        """Raise a `SceneError` of the block again with the file and line of every mistake.

        Mistakes of refused options are among them; they are raised too where the block raises none.
        """
        placed: list[Problem] = []
        try:
            yield
        except SceneError as error:
            placed = [self._placed(problem) for problem in error.problems]
        if found := (*self.refused, *placed):
            raise SceneError(sorted(found, key=lambda problem: problem.line or 0))

    def _placed(self, problem: Problem) -> Problem:
        """The problem with the file and line it belongs to, or with the override."""
        path, made = problem.path, self.overridden
        prefixes = [path[:length] for length in range(len(path), -1, -1)]
        source = next((made[prefix] for prefix in prefixes if prefix in made), None)
        if source is None and path not in self.lines:  # a table that only an override has made
            inside = (key for key in made if key[: len(path)] == path and path)
            source = next((made[key] for key in inside), None)
        if source is not None:
            return replace(problem, file=source)
        line = next((self.lines[prefix] for prefix in prefixes if prefix in self.lines), 1)
        return replace(problem, file=str(self.file), line=line)


def read_source(path: str | PathLike[str], overrides: Iterable[str]) -> Source:
    """Read a file and apply overrides in order; raises `SceneError` for what is no document."""
    file = FilePath(path)
    document, lines = read_toml(file)
    overridden: dict[Path, str] = {}
    refused: list[Problem] = []
    for assignment in overrides:
        try:
            overridden[override(document, assignment)] = origin(assignment)
        except SceneError as error:
            refused += error.problems
    return Source(file, document, lines, overridden, tuple(refused))
