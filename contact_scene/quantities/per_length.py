"""Names, units and meanings of the reported values of a line contact, which are per unit length.

Records of the solvers have the same attributes for all contacts. A strip has a length of 1 m, so
that a force in N is a force per length in N/m. Files, tables and pages use the names of this module
for a line contact.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from contact_scene.quantities.field_metadata import Reported

UNITS: Mapping[str, str] = MappingProxyType(
    {"N": "N/m", "N m": "N", "J": "J/m", "m^2": "m", "N/m": "N/m^2"}
)
# Name and meaning of each value that has another name in a line contact.
_RENAMED: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "contact_area": ("contact_width", "Width in contact, with sub-cell accuracy."),
        "contact_radius": ("half_width", "Half of the contact width."),
        "stick_area": (
            "stick_width",
            "Width of the stick zone, with sub-cell accuracy; null without friction.",
        ),
        "stick_radius": (
            "stick_half_width",
            "Half of the width of the stick zone; null without friction.",
        ),
    }
)
SHOWN_NAMES: Mapping[str, str] = MappingProxyType({n: shown for n, (shown, _) in _RENAMED.items()})
ATTRIBUTES: Mapping[str, str] = MappingProxyType({s: name for name, s in SHOWN_NAMES.items()})
# Values that depend on the reference length of a line contact.
OF_REFERENCE = ("approach", "tangential_shift", "elastic_energy", "input_work")


def shown_unit(unit: str, *, line: bool) -> str:
    """Return the unit of a reported value, per length for a line contact.

    unit  SI unit of the value
    line  True for a line contact
    """
    return UNITS.get(unit, unit) if line else unit


def shown_name(name: str, *, line: bool) -> str:
    """Return the name of a reported value in files and tables.

    name  attribute of the value
    line  True for a line contact
    """
    return SHOWN_NAMES.get(name, name) if line else name


def shown_mark(name: str, mark: Reported, *, line: bool) -> Reported:
    """Return unit and meaning of a reported value, per length for a line contact.

    name  attribute of the value
    mark  unit and meaning for other contacts
    line  True for a line contact
    """
    if not line:
        return mark
    meaning = _RENAMED[name][1] if name in _RENAMED else mark.meaning
    return replace(mark, unit=shown_unit(mark.unit, line=True), meaning=meaning)


def rename_keys(record: Mapping[str, Any], names: Mapping[str, str]) -> dict[str, Any]:
    """Return a record with other names of some of its keys, in the same order.

    record  values by name
    names   new names by old names
    """
    return {names.get(name, name): value for name, value in record.items()}
