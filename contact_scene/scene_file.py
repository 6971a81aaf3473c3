"""Reading a scene file."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Any, TypeVar, cast

from pydantic import TypeAdapter, ValidationError

from contact_scene.accuracy import AccuracyRequest, accuracy_texts, of_option
from contact_scene.consistency import Parts, inconsistencies
from contact_scene.description import Description
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.document import SceneDocument
from contact_scene.mistakes import mistakes
from contact_scene.override import assign, override
from contact_scene.problem import Problem, SceneError
from contact_scene.scene import Scene
from contact_scene.source import read_source


@dataclass(frozen=True)
class SceneFile:
    """What a scene file says: the scene, and beside it how fine each solver shall be, or how
    accurate the answer."""

    scene: Scene
    semi_analytical: SurfaceDiscretisation
    fem_reference: FiniteElementDiscretisation
    radial: RadialDiscretisation
    accuracy: AccuracyRequest | None = None


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
    source = read_source(path, overrides)
    with source.placing():
        return _checked(source.document, {"folder": source.file.parent})


def read_accuracy(text: str, option: str) -> AccuracyRequest:
    """The accuracy that a text asks for: "0.1%", "peak_pressure 0.1%, dissipated_energy 1%".

    option  how messages name where the text comes from
    Raises `SceneError` with every mistake.
    """
    document = {"accuracy": accuracy_texts(text, option)}
    try:
        asked = _Asked.model_validate(document)
    except ValidationError as error:
        raise of_option(SceneError(mistakes(document, error, {})), option) from None
    return asked.accuracy


class _Asked(Description):
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
    if beside := (document.keys() & SceneDocument.model_fields.keys()) - Scene.model_fields.keys():
        hint = "pass a discretisation to plan and solve"
        raise SceneError(Problem((key,), "the key is not of the scene", "", hint) for key in beside)
    return _valid(Scene, document, {})


D = TypeVar("D", bound=Scene)


def _valid(kind: type[D], document: dict[str, Any], context: dict[str, Any]) -> D:
    """The document as a scene; raises `SceneError` with every mistake in it."""
    try:
        return kind.model_validate(document, context=context)
    except ValidationError as error:
        found = mistakes(document, error, context)
        found += inconsistencies(_valid_parts(document, error, context))
        raise SceneError(found) from None


def _checked(document: dict[str, Any], context: dict[str, Any]) -> SceneFile:
    valid = _valid(SceneDocument, document, context)
    scene = Scene.model_construct(**{name: getattr(valid, name) for name in Scene.model_fields})
    return SceneFile(
        scene, valid.semi_analytical, valid.fem_reference, valid.radial, valid.accuracy
    )


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
    for name, field in SceneDocument.model_fields.items():
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
