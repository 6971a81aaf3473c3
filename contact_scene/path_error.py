"""What finite increments cost, estimated by doubling them: part of the summary of a run."""

from typing import Annotated

from pydantic import Field

from contact_scene.description import Description


class DoubledQuantity(Description):
    """A quantity at the end of a step, as it was computed and with twice the increments.

    An error that falls about as the inverse of their number, or faster, lies between the change and
    two and a half changes; the extrapolated value is exact where it falls as the inverse.
    """

    name: str
    """Key of the quantity in the step, with x or y for a component."""

    unit: str
    """Unit of the four numbers."""

    value: float
    """As reported in the step."""

    error: Annotated[float, Field(ge=0)]
    """Estimated error of the value by finite increments: two and a half times the
    change by doubling them; of a stick radius twice the largest change so far and a quarter of a
    cell."""

    extrapolated: float
    """Richardson's value for errors of first order in the increment."""

    uncertainty: Annotated[float, Field(ge=0)]
    """Of the extrapolated value: the change by doubling."""


class PathError(Description):
    """Errors by finite increments at the end of one loading step."""

    step: Annotated[int, Field(ge=1)]
    """Number of the loading step, from 1."""

    increments: Annotated[int, Field(ge=1)]
    """Increments of the step in the run that is reported."""

    doubled_increments: Annotated[int, Field(ge=1)]
    """Increments of the step in the run it was compared with; the same where nothing is sheared."""

    pressure: Annotated[float, Field(ge=0, json_schema_extra={"unit": "1"})]
    """Estimated error of the pressure: 2.5 times the sum of |change| over the sum of p."""

    shear: Annotated[float, Field(ge=0, json_schema_extra={"unit": "1"})] | None = None
    """Estimated error of the shear: 2.5 times the sum of |change| over the sum of the friction
    limit; null without shear."""

    quantities: tuple[DoubledQuantity, ...]
    """Every scalar of the step that is not prescribed by definition."""
