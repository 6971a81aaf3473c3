"""How accurate the numbers of a run shall be: the table `[accuracy]`, or a text for an option."""

from collections.abc import Mapping
from dataclasses import replace
from re import fullmatch
from typing import TYPE_CHECKING, Any

from pydantic import Field, create_model, model_validator

from contact_scene.quantities.field_metadata import (
    Reported,
    reported,
)
from contact_scene.quantities.increment import State
from contact_scene.quantities.summary import Closed
from contact_scene.reading.description import Description
from contact_scene.reading.quantity import Share
from contact_scene.reading.scene_error import (
    Problem,
    SceneError,
)
from contact_scene.reading.validator_error import (
    refusal,
    shown,
)

# What a share without a name binds.
OVERALL = (
    *("approach", "peak_pressure", "contact_radius"),
    *("tangential_shift", "twist", "energy_per_cycle"),
)

# Of the maxima that `slipstick stress` lists the first with this name.
LARGEST_TENSION = "max_principal"
TENSION = Reported("Pa", "Largest principal stress anywhere in the body, tension positive.")

BOUND = {
    name: mark
    for name, mark in {
        **reported(State),
        **reported(Closed),
        LARGEST_TENSION: TENSION,
    }.items()
    if mark.physical and mark.unit
}

if TYPE_CHECKING:
    _Named = Description
else:
    _Named = create_model(
        "_Named",
        __base__=Description,
        **{
            name: (
                Share | None,
                Field(None, description=f"Largest error, relative: {mark.meaning}"),
            )
            for name, mark in BOUND.items()
        },
    )


class AccuracyRequest(_Named):
    """Largest errors of the numbers of a run, each relative to the largest value that its quantity
    has in the history."""

    overall: Share | None = None
    """Of approach, peak pressure, contact radius, tangential shift, twist and the energy of closed
    cycles: as far as the scene has them, does not prescribe them, and they are finite."""

    @model_validator(mode="after")
    def _asks_for_something(self) -> "AccuracyRequest":
        if not self.shares():
            raise refusal("the table asks for nothing", 'overall = "1 %" or the name of a quantity')
        return self

    @property
    def named(self) -> tuple[str, ...]:
        """Quantities that are bound by name, in the order of the results."""
        return tuple(name for name in BOUND if getattr(self, name) is not None)

    def shares(self) -> Mapping[str, float]:
        """Largest relative error of every quantity that is bound; a name counts more than
        `overall`."""
        overall = {} if self.overall is None else dict.fromkeys(OVERALL, self.overall)
        return overall | {name: getattr(self, name) for name in self.named}

    @property
    def binds_stress(self) -> bool:
        """Whether it binds a stress below the surface."""
        return LARGEST_TENSION in self.named


def accuracy_texts(text: str, option: str) -> dict[str, Any]:
    """The table that a text such as "0.1%" or "peak_pressure 0.1%, approach 1%" stands for.

    option  how messages name where the text comes from
    Raises `SceneError` for what is neither; names and shares are not checked.
    """
    table: dict[str, Any] = {}
    for item in text.split(","):
        found = fullmatch(r"\s*(?:(\w+)[\s=:]+)?([^\s%=:]+ ?%?)\s*", item)
        name = found and (found[1] or "overall")
        if found is None or name is None or name in table:
            wrong = f"got {shown(item)}" if name is None else f"{name} is bound twice"
            expected = '"0.1%" or names such as "peak_pressure 0.1%, approach 1%"'
            raise SceneError([Problem(("accuracy",), wrong, expected, file=option)])
        try:
            table[name] = float(found[2])
        except ValueError:
            table[name] = found[2]
    return table


def of_option(error: SceneError, option: str) -> SceneError:
    """The same mistakes, as those of an option."""
    return SceneError([replace(problem, file=option) for problem in error.problems])
