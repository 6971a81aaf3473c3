"""The load history as it is written: one step after the other."""

from typing import Annotated

from pydantic import model_validator

from contact_scene.description import Description
from contact_scene.quantity import Force, Length, PositiveForce, PositiveLength
from contact_scene.refusal import refusal
from contact_scene.whole_number import WholeNumber

MOST_STEPS = 20_000
Increments = Annotated[int, WholeNumber(1, 100_000)]


class LoadStep(Description):
    """One step: what it names ramps linearly to the value given, all else is held.

    Forces and shifts are of the indenter relative to the body, with components along x and y.
    """

    normal_force: PositiveForce | None = None
    """Normal force at the end of the step [force]."""

    approach: PositiveLength | None = None
    """Approach at the end of the step, counted from first touch [length]."""

    tangential_force: tuple[Force, Force] | None = None
    """Tangential force (Tx, Ty) at the end of the step [force]."""

    tangential_shift: tuple[Length, Length] | None = None
    """Tangential shift (x, y) at the end of the step [length]."""

    increments: Increments | None = None
    """Number of the solver's increments within the step; absent: chosen by the solver."""

    @model_validator(mode="after")
    def _names_one_control_each(self) -> "LoadStep":
        if self.normal_force is not None and self.approach is not None:
            raise refusal("got both normal_force and approach", "one of them")
        if self.tangential_force is not None and self.tangential_shift is not None:
            raise refusal("got both tangential_force and tangential_shift", "one of them")
        if not self.names_normal and not self.names_tangential:
            raise refusal(
                "the step names no load",
                "at least one of normal_force, approach, tangential_force, tangential_shift",
            )
        return self

    @property
    def names_normal(self) -> bool:
        """Whether the step changes the normal load."""
        return self.normal_force is not None or self.approach is not None

    @property
    def names_tangential(self) -> bool:
        """Whether the step changes the tangential load."""
        return self.tangential_force is not None or self.tangential_shift is not None
