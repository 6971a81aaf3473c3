"""Base class of all models of a scene: frozen, without unknown keys, with documented fields."""

import ast
import inspect
from functools import cache
from textwrap import dedent
from typing import Any

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue

from contact_scene.reading.scene_error import refusal

MAX_TITLE = 500  # characters


class Description(BaseModel):
    """Base class of the models of a scene, which are immutable and hashable.

    Validation refuses unknown keys, sets, and numbers that are not finite.
    """

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        defer_build=True,
        json_schema_serialization_defaults_required=True,
    )

    @model_validator(mode="before")
    @classmethod
    def _refuse_sets(cls, given: Any) -> Any:
        """Raise a validation error for a Python set,
        which has no order, unlike load steps and layers."""
        for name, value in given.items() if isinstance(given, dict) else ():
            if isinstance(value, set | frozenset):
                raise refusal(f"got a set for {name}", "a tuple or list, which has an order")
        return given


@cache
def field_descriptions(model: type) -> dict[str, str]:
    """Return the description of each field of a pydantic model, by the name of the field.

    The description is given to pydantic's `Field`, or is the docstring below the field. Docstrings
    are read from the source on demand, since reading them takes longer than the solve of a small
    contact.

    model  class of a table of the scene, or of a record of results
    """
    found: dict[str, str] = {}
    for base in reversed(model.__mro__[:-1]):
        if not base.__module__.startswith("pydantic"):
            found |= _attribute_docstrings(base)
    fields = getattr(model, "__pydantic_fields__", {})
    given = {name: field.description for name, field in fields.items() if field.description}
    return {name: text for name, text in (found | given).items() if name in fields}


def _attribute_docstrings(model: type) -> dict[str, str]:
    try:
        (definition,) = ast.parse(dedent(inspect.getsource(model))).body
    except OSError:  # made by a function, without a class statement
        return {}
    assert isinstance(definition, ast.ClassDef)
    return {
        attribute.target.id: inspect.cleandoc(text.value.value)
        for attribute, text in zip(definition.body, definition.body[1:], strict=False)
        if isinstance(attribute, ast.AnnAssign)
        and isinstance(attribute.target, ast.Name)
        and isinstance(text, ast.Expr)
        and isinstance(text.value, ast.Constant)
        and isinstance(text.value.value, str)
    }


class DescribedSchema(GenerateJsonSchema):
    """Generator of a JSON Schema whose properties are described by `field_descriptions`."""

    def model_schema(self, schema: Any) -> JsonSchemaValue:
        return _add_descriptions(super().model_schema(schema), schema["cls"])

    def dataclass_schema(self, schema: Any) -> JsonSchemaValue:
        return _add_descriptions(super().dataclass_schema(schema), schema["cls"])


def _add_descriptions(made: JsonSchemaValue, model: type) -> JsonSchemaValue:
    for name, text in field_descriptions(model).items():
        if name in made.get("properties", {}):
            made["properties"][name]["description"] = text
    return made
