"""A number somebody else vouches for: value, kind, source and uncertainty."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

ROUNDING = 1e-12  # relative uncertainty of a closed form in double precision


class ReferenceKind(StrEnum):
    """Where a reference comes from."""

    CLOSED_FORM = "closed form"
    SEMI_CLOSED = "semi-closed"
    THEORY = "theory"
    EXTERNAL_CODE = "external code"
    OTHER_SOLVER = "other solver"
    OWN_REFINEMENT = "own refinement"  # the same solver on a coarser discretisation
    IDENTITY = "identity"  # holds exactly by a theorem or by the equations themselves


@dataclass(frozen=True)
class Reference:
    """A number somebody else vouches for.

    uncertainty  standard uncertainty u_ref, in the unit of the value
    """

    value: float
    kind: ReferenceKind
    source: str
    uncertainty: float = 0.0


def closed_form(value: float, source: str, scale: float | None = None) -> Reference:
    """A closed form, uncertain by rounding of itself or of the scale it is compared on."""
    uncertainty = ROUNDING * abs(value if scale is None else scale)
    return Reference(value, ReferenceKind.CLOSED_FORM, source, uncertainty)


def identity(value: float, source: str) -> Reference:
    """A value that follows from the equations themselves."""
    return Reference(value, ReferenceKind.IDENTITY, source)
