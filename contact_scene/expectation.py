"""What belongs at a place of a scene file, read off the models themselves."""

from collections.abc import Iterable
from typing import Any, get_args

from pydantic import BaseModel

from contact_scene.document import SceneDocument
from contact_scene.friction import FrictionMap
from contact_scene.geometry import SHAPES
from contact_scene.material import IsotropicMaterial
from contact_scene.quantity import Quantity

# Where pydantic goes through a union, its locations name the branch in angle brackets.
Location = tuple[str | int, ...]

_MATERIAL = '{ young_modulus = "210 GPa", poisson_ratio = 0.3 } or "rigid"'
_IN_BRANCH = {"<elastic>": _MATERIAL, "<rigid>": _MATERIAL}
_MODEL_IN_BRANCH: dict[str, type[BaseModel]] = {
    "<elastic>": IsotropicMaterial,
    "<mapped>": FrictionMap,
    **{f"<{name}>": shape for name, shape in SHAPES.items()},
}


def is_branch(part: str | int) -> bool:
    """Whether this part of a location names a branch of a union and not a key."""
    return isinstance(part, str) and part.startswith("<")


def model_at(location: Iterable[str | int]) -> type[BaseModel] | None:
    """The part of the scene that is described at a location."""
    model: type[BaseModel] | None = SceneDocument
    for part in location:
        if isinstance(part, int):
            continue
        if is_branch(part):
            model = _MODEL_IN_BRANCH.get(part)
        elif model is not None and part in model.model_fields:
            model = _model_in(model.model_fields[part].annotation)
    return model


def known_keys(location: Location) -> list[str]:
    """Keys of the table at a location."""
    model = model_at(location)
    return list(model.model_fields) if model is not None else []


def expected_value(location: Location) -> str:
    """What a key stands for, in words."""
    model, key = model_at(location[:-1]), location[-1]
    field = model.model_fields.get(str(key)) if model is not None else None
    if field is None:
        return ""
    quantity = next((m for m in field.metadata if isinstance(m, Quantity)), None)
    if quantity is not None:
        return quantity.expected
    sentence = " ".join((field.description or "").split()).rstrip(".")
    return sentence[:1].lower() + sentence[1:]


def expected_table(location: Location) -> str:
    """The table that belongs at a location, by the keys it must have."""
    if location and location[-1] in _IN_BRANCH:
        return _IN_BRANCH[str(location[-1])]
    model = model_at(location)
    required = [k for k, f in (model.model_fields.items() if model else ()) if f.is_required()]
    return "a table with " + " and ".join(required) if required else "a table"


def _model_in(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next(filter(None, map(_model_in, get_args(annotation))), None)
