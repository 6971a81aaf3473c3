"""Requested accuracy of a run, from the table `[accuracy]` or the text of a command-line option."""

from collections.abc import Mapping
from re import fullmatch
from typing import TYPE_CHECKING, Any

from pydantic import Field, create_model, model_validator

from contact_scene.quantities.field_metadata import (
    Reported,
    reported,
)
from contact_scene.quantities.increment import State
from contact_scene.quantities.per_length import ATTRIBUTES, SHOWN_NAMES, shown_mark
from contact_scene.quantities.summary import ClosedCycle
from contact_scene.reading.description import Description
from contact_scene.reading.quantity import Share
from contact_scene.reading.scene_error import (
    Problem,
    SceneError,
    refusal,
    shown,
)

# Quantities that `overall` limits.
OVERALL = (
    *("approach", "peak_pressure", "contact_radius"),
    *("tangential_shift", "twist", "energy_per_cycle"),
)

# The first maximum of this name that `slipstick stress` lists.
LARGEST_TENSION = "max_principal"
TENSION = Reported("Pa", "Largest principal stress anywhere in the body, tension positive.")

BOUND = {
    name: annotation
    for name, annotation in {
        **reported(State),
        **reported(ClosedCycle),
        LARGEST_TENSION: TENSION,
    }.items()
    if annotation.physical and annotation.unit
}
# Keys of the request. Those of a line contact have the names of its results.
_KEYS = BOUND | {
    shown: shown_mark(name, BOUND[name], line=True) for name, shown in SHOWN_NAMES.items()
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
                Field(None, description=f"Largest error, relative: {annotation.meaning}"),
            )
            for name, annotation in _KEYS.items()
        },
    )


class AccuracyRequest(_Named):
    """Largest allowed errors, each relative to the largest value of its quantity in the history."""

    overall: Share | None = None
    """Largest error of approach, peak pressure, contact radius, tangential shift, twist and the
    energy of closed cycles. Quantities that are absent, prescribed or infinite are left out."""

    @model_validator(mode="after")
    def _limits_an_error(self) -> "AccuracyRequest":
        if not self.shares():
            raise refusal("the table is empty", 'overall = "1 %" or the name of a quantity')
        return self

    @property
    def named_quantities(self) -> tuple[str, ...]:
        """Names of the quantities with an individual error limit, in the order of the results.

        These are attributes of the results, also for a line contact.
        """
        return tuple(self._own_shares())

    def shares(self) -> Mapping[str, float]:
        """Return the largest allowed relative error of each scalar that has a limit, by its name.

        A limit for a single scalar overrides the limit `overall`. The errors are relative to the
        largest value of the scalar in the load history.
        """
        overall = {} if self.overall is None else dict.fromkeys(OVERALL, self.overall)
        return overall | self._own_shares()

    def _own_shares(self) -> dict[str, float]:
        return {
            ATTRIBUTES.get(key, key): share
            for key in _KEYS
            if (share := getattr(self, key)) is not None
        }

    @property
    def binds_stress(self) -> bool:
        """True if the request limits the error of the largest principal stress in the body."""
        return LARGEST_TENSION in self.named_quantities


def accuracy_texts(text: str) -> dict[str, Any]:
    """Parse the text of a requested accuracy into the entries of the table `[accuracy]`.

    Examples are "0.1%" and "peak_pressure 0.1%, approach 1%". Names and limits are not checked.

    Raises `SceneError` for other texts.
    """
    table: dict[str, Any] = {}
    for item in text.split(","):
        found = fullmatch(r"\s*(?:(\w+)[\s=:]+)?([^\s%=:]+ ?%?)\s*", item)
        name = found and (found[1] or "overall")
        if found is None or name is None or name in table:
            wrong = f"got {shown(item)}" if name is None else f"{name} is given twice"
            expected = '"0.1%" or names such as "peak_pressure 0.1%, approach 1%"'
            raise SceneError([Problem(("accuracy",), wrong, expected)])
        try:
            table[name] = float(found[2])
        except ValueError:
            table[name] = found[2]
    return table
