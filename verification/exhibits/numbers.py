"""Numbers as a reader sees them."""

from __future__ import annotations

from contact_scene.reading.engineering_units import engineering_unit

NOT_FINITE = "not finite"


def value_text(value: float | None, unit: str, digits: int = 6) -> str:
    """A value with its unit."""
    if value is None:
        return NOT_FINITE
    if value == 0:
        return "0"
    if unit in ("", "°"):
        return plain(value, digits) + unit
    scale = engineering_unit(abs(value), unit)
    return f"{value / scale.size:#.{digits}g}".rstrip(".") + f" {scale.name}"


def plain(value: float | None, digits: int = 3) -> str:
    """A number without unit: 0.0123, 1.2e-5."""
    if value is None:
        return NOT_FINITE
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def percent(part: float) -> str:
    """A part of something, in hundredths."""
    return f"{plain(100 * part, 2)} %"


NOT_REACHED = "–"


EXTRAPOLATED = "≈"  # before a cost that no setting was tried for
