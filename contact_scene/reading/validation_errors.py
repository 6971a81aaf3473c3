"""Conversion of pydantic's validation errors into problems of a scene, by its keys."""

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from contact_scene.friction import FrictionMap
from contact_scene.geometry import SHAPES, nearest_shape
from contact_scene.material import IsotropicMaterial
from contact_scene.reading.description import field_descriptions
from contact_scene.reading.quantity import Quantity
from contact_scene.reading.scene_error import (
    Path,
    Problem,
    shown,
)
from contact_scene.scene import SceneFile

_MISSING = "the key is missing"
_NO_TABLE = ("model_type", "model_attributes_type", "dict_type", "dict_attributes_type", "enum")
_NO_ARRAY = ("tuple_type", "list_type")
# Values of one kind, by the type of pydantic's error.
_EXPECTED = {
    "string_type": "a text of at most 500 characters",
    "string_too_long": "a text of at most 500 characters",
    "bool_type": "true or false",
}
# Keys of arrays of tables.
_TABLES = ("layers", "loading")


def problems_of(document: Mapping[str, Any], error: ValidationError) -> list[Problem]:
    """Convert pydantic's validation errors of a scene to problems (mistakes with their keys).

    Duplicates and consequences of another mistake are left out. Examples of consequences are an
    array of invalid entries that is therefore too short, and a missing key that is present under a
    misspelt name.

    document  nested tables of the scene file
    error     validation errors of the document
    """
    details = error.errors(include_url=False)
    found = [
        _convert_error(document, d) for d in details if d["type"] != "too_short" or not d["input"]
    ]
    meant = {(problem.path[:-1], problem.hint) for problem in found}
    return [
        problem
        for problem in dict.fromkeys(found)
        if problem.message != _MISSING
        or (problem.path[:-1], _did_you_mean(str(problem.path[-1]))) not in meant
    ]


def _convert_error(document: Mapping[str, Any], detail: ErrorDetails) -> Problem:
    kind, location, got = detail["type"], detail["loc"], f"got {shown(detail['input'])}"
    path = _document_path(document, detail)
    context: dict[str, Any] = detail.get("ctx", {})
    if kind == "refused":
        return Problem(path, context["message"], context["expected"], context["hint"])
    if kind == "missing":
        if isinstance(location[-1], str):
            return Problem(path, _MISSING, _expected_value(location))
        return Problem(path[:-1], got, _expected_components(location[-2]))
    if kind == "extra_forbidden":
        return _unknown_key(path, _model_at(location[:-1]))
    if kind.startswith("union_tag") and not isinstance(detail["input"], dict):
        hint = _bracket_hint(path, detail["input"])
        return Problem(path, got, "a table with shape and material", hint)
    if kind.startswith("union_tag") or (kind == "literal_error" and path[-1] == "shape"):
        path = path if path[-1] == "shape" else (*path, "shape")
        return _unknown_shape(path, detail["input"])
    if kind in _NO_TABLE:
        return Problem(path, got, _expected_table(location), _bracket_hint(path, detail["input"]))
    if kind in _NO_ARRAY:
        expected = "an array" if path[-1] in _TABLES else _expected_components(path[-1])
        return Problem(path, got, expected, _bracket_hint(path, detail["input"]))
    if kind in ("too_short", "too_long"):
        return _wrong_number(path, context)
    if kind in _EXPECTED:
        return Problem(path, got, _EXPECTED[kind])
    if kind == "literal_error":
        return Problem(path, got, context["expected"].replace("'", '"'))
    return Problem(path, f"{got}: {detail['msg']}")


def _unknown_key(path: Path, model: type[BaseModel] | None) -> Problem:
    """Create the problem for an unknown key, with the most similar key of its table as the hint."""
    known = list(model.model_fields) if model else []
    if path[-1] == "diameter" and "radius" in known:
        return Problem(path, "unknown key", "half of it", _did_you_mean("radius"))
    near = get_close_matches(str(path[-1])[:100].lower(), known, n=1, cutoff=0.65)
    hint = _did_you_mean(near[0]) if near else f"the keys here are {', '.join(known)}"
    return Problem(path, "unknown key", hint=hint)


def _wrong_number(path: Path, context: Mapping[str, Any]) -> Problem:
    """Create the problem for an array with too few or too many entries."""
    number = context["actual_length"]
    got = f"got {number or 'no'} {'entry' if number == 1 else 'entries'}"
    least, most = context.get("min_length"), context.get("max_length")
    return Problem(path, got, f"at most {most}" if least is None else f"at least {least}")


def _document_path(document: Mapping[str, Any], detail: ErrorDetails) -> Path:
    """Convert the location of a validation error to the path of the key in the scene document.

    The location contains names of union members (classes of the model), which are no keys of the
    document. The path ends at the deepest part that the document contains.

    document  nested tables of the scene file
    detail    one validation error of pydantic
    """
    path: list[str | int] = []
    value: Any = document
    location: tuple[Any, ...] = detail["loc"]
    unknown = location[-1:] if detail["type"] == "extra_forbidden" else ()
    for part in location[: len(location) - len(unknown)]:
        if _is_branch(part):
            continue
        if not isinstance(value, dict if isinstance(part, str) else list):
            break
        path.append(part)
        found = isinstance(value, dict) or part < len(value)
        value = value.get(part) if isinstance(value, dict) else value[part] if found else None
    return (*path, *unknown)


def _did_you_mean(key: str) -> str:
    return f"did you mean {key}?"


def _unknown_shape(path: Path, given: Any) -> Problem:
    """Create the problem for an unknown or missing shape of the indenter.

    The problem suggests the shape with the most similar name.

    path   path of the key `shape`
    given  name of the shape, or table of the indenter
    """
    expected = "one of " + ", ".join(f'"{shape}"' for shape in SHAPES)
    if isinstance(given, dict) and "shape" not in given:
        return Problem(path, _MISSING, expected)
    name = given["shape"] if isinstance(given, dict) else given
    near = nearest_shape(name)
    hint = f'did you mean "{near}"?' if near else ""
    return Problem(path, f"got {shown(name)}", expected, hint)


def _bracket_hint(path: Path, given: Any) -> str:
    """Return a hint if single (table) and double
    (array of tables) brackets may be confused, else ""."""
    if path[-1:] != ("layers",) and len(path) != 1:
        return ""
    header = ".".join(str(part) for part in path if isinstance(part, str))
    if isinstance(given, dict):
        return f"write [[{header}]], with double brackets"
    return f"write [{header}], with single brackets" if isinstance(given, list) else ""


# In locations, pydantic names the branch of a union in angle brackets.
Location = tuple[str | int, ...]

_MATERIAL = '{ young_modulus = "210 GPa", poisson_ratio = 0.3 } or "rigid"'
_IN_BRANCH = {"<elastic>": _MATERIAL, "<rigid>": _MATERIAL}
_MODEL_IN_BRANCH: dict[str, type[BaseModel]] = {
    "<elastic>": IsotropicMaterial,
    "<mapped>": FrictionMap,
    **{f"<{name}>": shape for name, shape in SHAPES.items()},
}


def _is_branch(part: str | int) -> bool:
    """Return True for a part of an error location that names a member of a union, and is no key."""
    return isinstance(part, str) and part.startswith("<")


def _model_at(location: Iterable[str | int]) -> type[BaseModel] | None:
    """Return the model class of the table at a pydantic error location; None if there is none.

    Used to find the expected keys of the table for a message.

    location  keys, indices and names of union members from the scene file to the table
    """
    model: type[BaseModel] | None = SceneFile
    for part in location:
        if isinstance(part, int):
            continue
        if _is_branch(part):
            model = _MODEL_IN_BRANCH.get(part)
        elif model is not None and part in model.model_fields:
            model = _model_in(model.model_fields[part].annotation)
    return model


def _expected_components(key: str | int) -> str:
    """Describe the array that is expected as the value of a key with components along axes."""
    of_strain = str(key).startswith("bulk_")
    return "an array of 3, for xx, yy and xy" if of_strain else "an array of 2, for x and y"


def _expected_value(location: Location) -> str:
    """Describe the expected value of a key of the scene in words, for a message.

    location  pydantic error location of the key
    returns   description; empty for an unknown key
    """
    model, key = _model_at(location[:-1]), location[-1]
    if model is None or str(key) not in model.model_fields:
        return ""
    field = model.model_fields[str(key)]
    quantity = next((m for m in field.metadata if isinstance(m, Quantity)), None)
    if quantity is not None:
        return quantity.expected
    sentence = " ".join(field_descriptions(model).get(str(key), "").split()).rstrip(".")
    return sentence[:1].lower() + sentence[1:]


def _expected_table(location: Location) -> str:
    """Describe the table at a pydantic error location in words, with its required keys."""
    if location and location[-1] in _IN_BRANCH:
        return _IN_BRANCH[str(location[-1])]
    model = _model_at(location)
    required = [k for k, f in (model.model_fields.items() if model else ()) if f.is_required()]
    return "a table with " + " and ".join(required) if required else "a table"


def _model_in(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next(filter(None, map(_model_in, get_args(annotation))), None)
