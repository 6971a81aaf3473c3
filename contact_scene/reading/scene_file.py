"""Reading a scene file: what it and the overrides on top of it say, and where."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar, cast

from pydantic import TypeAdapter, ValidationError

from contact_scene.accuracy import AccuracyRequest, accuracy_texts, of_option
from contact_scene.checks.consistency import (
    Parts,
    inconsistencies,
)
from contact_scene.reading.description import Description
from contact_scene.reading.document import SceneFile
from contact_scene.reading.override import (
    assign,
    origin,
    override,
)
from contact_scene.reading.scene_error import Path as Key
from contact_scene.reading.scene_error import (
    Problem,
    SceneError,
)
from contact_scene.reading.toml_file import read_toml
from contact_scene.reading.validation_errors import mistakes
from contact_scene.scene import Scene


def load_scene(path: str | PathLike[str]) -> Scene:
    """The scene of a scene file; raises `SceneError` with every mistake in it."""
    return read_scene_file(path).scene


def read_scene_file(path: str | PathLike[str], overrides: Iterable[str] = ()) -> SceneFile:
    """Read and check a scene file.

    path       a TOML file; the files it names lie in or below its folder
    overrides  `dotted.key=value` each, applied in order before anything is checked; entries of
               arrays count from 1: `loading[2].increments=5`
    Raises `SceneError` with every mistake, each with file, line and key.
    """
    source = _read(path, overrides)
    with source.placing():
        return _valid(SceneFile, source.document, {"folder": source.file.parent})


def read_accuracy(text: str, option: str) -> AccuracyRequest:
    """The accuracy that a text asks for: "0.1%", "peak_pressure 0.1%, dissipated_energy 1%".

    option  how messages name where the text comes from
    Raises `SceneError` with every mistake.
    """
    try:
        return _valid(_Accuracy, {"accuracy": accuracy_texts(text, option)}, {}).accuracy
    except SceneError as error:
        raise of_option(error, option) from None


class _Accuracy(Description):
    """The part of a document that an option stands for."""

    accuracy: AccuracyRequest


def changed_scene(
    scene: Scene, changes: Iterable[str | Mapping[str, Any]], keys: Mapping[str, Any]
) -> Scene:
    """See `Scene.replace`."""
    document = dict(scene)
    for change in (*changes, keys):
        if isinstance(change, str):
            override(document, change)
        elif isinstance(change, Mapping):
            for key, value in change.items():
                assign(document, str(key), value)
        else:
            raise TypeError(
                f"got a {type(change).__name__}, expected key=value as a text, or a mapping of "
                'keys to values such as {"indenter.radius": "12 mm"}'
            )
    if (
        beside := (document.keys() & SceneFile.model_fields.keys())
        - type(scene).model_fields.keys()
    ):
        hint = "pass a discretisation to plan and solve"
        raise SceneError(Problem((key,), "the key is not of the scene", "", hint) for key in beside)
    return _valid(type(scene), document, {})


D = TypeVar("D", bound=Description)


def _valid(kind: type[D], document: dict[str, Any], context: dict[str, Any]) -> D:
    """Check a document; raises `SceneError` with every mistake in it."""
    try:
        return kind.model_validate(document, context=context)
    except ValidationError as error:
        found = mistakes(document, error, context)
        if issubclass(kind, Scene):
            found += inconsistencies(_valid_parts(document, error, context))
        raise SceneError(found) from None


def _valid_parts(
    document: Mapping[str, Any], error: ValidationError, context: dict[str, Any]
) -> Parts:
    """The parts pydantic has found nothing wrong with; of the loading, the steps before that."""
    bad = [detail["loc"] for detail in error.errors(include_url=False)]
    bad_steps = [where[1] for where in bad if where[0] == "loading" and len(where) > 1]
    given = dict(document)
    if bad_steps and ("loading",) not in bad:
        given["loading"] = document["loading"][: min(int(step) for step in bad_steps)]
        bad = [where for where in bad if where[0] != "loading"]
    parts: dict[str, Any] = {}
    for name, field in SceneFile.model_fields.items():
        if any(where[0] == name for where in bad):
            continue
        if name == "loading" and not given[name]:
            continue  # already the first step is invalid
        if name in given:
            adapter: TypeAdapter[Any] = TypeAdapter(field.rebuild_annotation())
            parts[name] = adapter.validate_python(given[name], context=context)
        elif not field.is_required():
            parts[name] = field.get_default()
    return cast(Parts, parts)


@dataclass(frozen=True)
class _Source:
    """A document that is not checked yet.

    file        where it was read
    document    its contents, overrides applied
    lines       line of every key in the file
    overridden  the options that set a key
    refused     what is wrong with options that set none
    """

    file: Path
    document: dict[str, Any]
    lines: Mapping[Key, int]
    overridden: Mapping[Key, str]
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


def _read(path: str | PathLike[str], overrides: Iterable[str]) -> _Source:
    """Read a file and apply overrides in order; raises `SceneError` for what is no document."""
    file = Path(path)
    document, lines = read_toml(file)
    overridden: dict[Key, str] = {}
    refused: list[Problem] = []
    for assignment in overrides:
        try:
            overridden[override(document, assignment)] = origin(assignment)
        except SceneError as error:
            refused += error.problems
    return _Source(file, document, lines, overridden, tuple(refused))
