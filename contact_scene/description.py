"""The base of every part of a scene: a frozen value that admits no unknown key."""

from typing import Any

from pydantic import BaseModel, ConfigDict, model_validator

from contact_scene.refusal import refusal

MAX_TITLE = 500  # characters


class Description(BaseModel):
    """A frozen, hashable value; unknown keys and non-finite numbers are refused."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        use_attribute_docstrings=True,
        json_schema_serialization_defaults_required=True,
    )

    @model_validator(mode="before")
    @classmethod
    def _keeps_the_order(cls, given: Any) -> Any:
        """Steps, layers and components in a set come in any order."""
        for name, value in given.items() if isinstance(given, dict) else ():
            if isinstance(value, set | frozenset):
                raise refusal(f"got a set for {name}", "a tuple or list, which has an order")
        return given
