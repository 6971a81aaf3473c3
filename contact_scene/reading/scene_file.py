"""Reading of scene files, with overrides of single keys, and checked changes of scenes."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from contact_scene.accuracy import AccuracyRequest, accuracy_texts
from contact_scene.checks.consistency import inconsistencies
from contact_scene.checks.line_contact import names_of_accuracy
from contact_scene.geometry import Indenter
from contact_scene.reading.description import Description
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
from contact_scene.reading.validation_errors import problems_of
from contact_scene.scene import Scene, SceneFile

D = TypeVar("D", bound=Description)


def load_scene(path: str | PathLike[str]) -> Scene:
    """Read the scene (bodies, friction and load steps) of a scene file in TOML.

    Raises `SceneError` with every mistake.

    path  path of the scene file
    """
    return read_scene_file(path).scene


def read_scene_file(
    path: str | PathLike[str],
    overrides: Iterable[str] = (),
    of_options: Mapping[str, Iterable[str]] | None = None,
) -> SceneFile:
    """Read and check a scene file, after overrides of its keys.

    Parameters
    ----------
    path : path-like
        A TOML file. Files that it names are in or below its folder.
    overrides : iterable of str
        Assignments `dotted.key=value`, applied in order before the check. Array entries count from
        1: `loading[2].increments=5`.
    of_options : mapping of str to iterables of str
        Further assignments by the name of the option that they follow from, such as `--inputs`,
        which messages then name instead of `--set`.

    Raises
    ------
    SceneError
        With every mistake, each with file, line and key.
    """
    given = {"--set": overrides, **(of_options or {})}
    file, options, found = Path(path), dict[Key, str](), list[Problem]()
    document, lines = read_toml(file)
    for option, assignment in ((name, one) for name, each in given.items() for one in each):
        try:
            options[override(document, assignment, option)] = origin(assignment, option)
        except SceneError as error:
            found += error.problems
    try:
        scene = _validate_tables(SceneFile, document, {"folder": file.parent})
    except SceneError as error:
        found += [_add_place(problem, str(file), lines, options) for problem in error.problems]
    if found:
        raise SceneError(sorted(found, key=lambda problem: problem.line or 0))
    return scene


def _add_place(
    problem: Problem, file: str, lines: Mapping[Key, int], options: Mapping[Key, str]
) -> Problem:
    """Add the place of the mistake to a problem of a scene, for the error message.

    The place is the file and the line of its key, or the command-line option that set the key.

    problem  mistake in the scene, without a place
    file     name of the scene file
    lines    line of each key in the scene file
    options  command-line options by the keys that they set
    """
    path = problem.path
    prefixes = [path[:length] for length in range(len(path), -1, -1)]
    source = next((options[prefix] for prefix in prefixes if prefix in options), None)
    if source is None and path and path not in lines:  # a table that only an option creates
        source = next((options[key] for key in options if key[: len(path)] == path), None)
    if source is not None:
        return replace(problem, file=source)
    line = next((lines[prefix] for prefix in prefixes if prefix in lines), 1)
    return replace(problem, file=file, line=line)


def read_accuracy(text: str, option: str, indenter: Indenter) -> AccuracyRequest:
    """Parse and check the requested accuracy in the text of a command-line option.

    Examples of the text are "0.1%" and "peak_pressure 0.1%, approach 1%".

    text      text of the command-line option
    option    name of the option, for messages
    indenter  indenter of the scene, which determines the names of results

    Raises `SceneError` with every mistake.
    """
    try:
        found = _validate_tables(_Accuracy, {"accuracy": accuracy_texts(text)}, {}).accuracy
        if problems := [*names_of_accuracy(indenter, found)]:
            raise SceneError(problems)
        return found
    except SceneError as error:
        raise SceneError(replace(problem, file=option) for problem in error.problems) from None


class _Accuracy(Description):
    """Document that contains a requested accuracy alone, for the validation of a text."""

    accuracy: AccuracyRequest


def replace_keys(scene: Scene, changes: Mapping[str, Any]) -> Scene:
    """Return a scene with other values of some keys, checked like a scene file.

    scene    scene that is not changed
    changes  values by dotted keys, such as "loading[2].increments"

    Raises `SceneError` with every mistake.
    """
    document = dict(scene)
    for key, value in changes.items():
        assign(document, key, value)
    others = SceneFile.model_fields.keys() - type(scene).model_fields.keys()
    if foreign := document.keys() & others:
        hint = "pass a discretisation to plan and solve"
        raise SceneError(
            Problem((key,), "the key is not of the scene", "", hint) for key in foreign
        )
    return _validate_tables(type(scene), document, {})


def _validate_tables(kind: type[D], document: dict[str, Any], context: dict[str, Any]) -> D:
    """Validate the tables of a scene file, and check their consistency with each other.

    context  context of pydantic's validators: folder of the scene file

    Raises `SceneError` with every mistake.
    """
    try:
        return kind.model_validate(document, context=context)
    except ValidationError as error:
        found = problems_of(document, error)
        if issubclass(kind, Scene):
            found += inconsistencies(_valid_tables(document, error, context))
        raise SceneError(found) from None


def _valid_tables(
    document: Mapping[str, Any], error: ValidationError, context: dict[str, Any]
) -> dict[str, Any]:
    """Return the valid tables of an invalid scene document, as models.

    The document is the nested tables of a scene file. The valid tables are checked for consistency
    in spite of errors in other tables. Of the load steps, those before the first invalid one are
    returned. Absent tables have their default values.

    document  tables by their keys
    error     validation errors of the document
    context   context of pydantic's validators, with the folder of the scene file
    """
    places = [detail["loc"] for detail in error.errors(include_url=False)]
    bad = {place[0] for place in places if place[0] != "loading" or len(place) == 1}
    given = dict(document)
    if "loading" not in bad:
        first = min((int(place[1]) for place in places if place[0] == "loading"), default=None)
        given["loading"] = document["loading"][:first]
    found: dict[str, Any] = {}
    for name, field in SceneFile.model_fields.items():
        if name in bad or given.get(name) == []:
            continue
        found[name] = field.get_default()
        if name in given:
            adapter: TypeAdapter[Any] = TypeAdapter(field.rebuild_annotation())
            found[name] = adapter.validate_python(given[name], context=context)
    return found
