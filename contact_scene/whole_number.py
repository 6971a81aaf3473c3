"""Whole numbers within bounds."""

from dataclasses import dataclass
from operator import index
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from contact_scene.plain_number import is_plain
from contact_scene.refusal import refusal, shown


@dataclass(frozen=True)
class WholeNumber:
    """Validator of a whole number, bounds included, for use in `Annotated[int, ...]`."""

    at_least: int
    at_most: int

    def __call__(self, value: Any) -> int:
        """The number; raises a refusal for anything else, 5.0 and true included."""
        try:
            number = index(value) if is_plain(value) else None
        except TypeError:
            number = None
        if number is None or not self.at_least <= number <= self.at_most:
            raise refusal(
                f"got {shown(value)}", f"a whole number from {self.at_least} to {self.at_most}"
            )
        return number

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "integer", "minimum": self.at_least, "maximum": self.at_most}
