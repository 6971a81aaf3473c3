"""The base of every part of a scene: a frozen value that admits no unknown key."""

from pydantic import BaseModel, ConfigDict


class Description(BaseModel):
    """A frozen, hashable value; unknown keys and non-finite numbers are refused."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        use_attribute_docstrings=True,
        json_schema_serialization_defaults_required=True,
    )
