"""Tests of the HTML page and the overview figure of a run."""

from typing import Any

import numpy as np
import pytest

from contact_results.figures.map_panels import RingsAbove
from contact_results.number_text import Uncertainty, number_text
from contact_results.surface import Rings


@pytest.mark.parametrize("error", [3.2e-5, 4e-13, 4e-16])
def test_an_error_however_small_does_not_read_as_zero(error: float) -> None:
    text = number_text(0.3177303649, Uncertainty(error, True), 1.0)
    assert float(text.split(" ± ")[1]) == pytest.approx(error, rel=0.1, abs=0.0)


@pytest.mark.parametrize("value", [0.0, -4e-12, 3e-12])
@pytest.mark.parametrize(("error", "text"), [(7.5e-4, "0 ± 0.00075"), (7.5e-10, "0 ± 7.5e-10")])
def test_what_its_error_rounds_away_is_zero(value: float, error: float, text: str) -> None:
    assert number_text(value, Uncertainty(error, True), 1.0) == text


# ---- Round-off as nothing, and wide tables in blocks.


# ---- Figures of slip show what was computed, seen alike from cells and from rings.


RADII = np.linspace(0.0, 1.0, 201)
CELLS = np.linspace(-0.9, 0.9, 31)


class OnRings:
    """One increment, whose slip has these components."""

    def __init__(self, **components: Any) -> None:
        for part in ("radial", "circumferential", "along_load"):
            setattr(self, f"slip_{part}", components.get(part))


def seen(direction: tuple[float, float], angles: Any = None, **components: Any) -> Any:
    step: Any = OnRings(**components)
    rings = Rings(RADII, angles, direction, polar="along_load" not in components)
    return RingsAbove(rings, CELLS, CELLS).vector(step, "slip")


@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.6, 0.8)])
def test_rings_seen_from_above_are_the_field_that_they_sample(
    direction: tuple[float, float],
) -> None:
    """Slip outward, around, along the load, and one that depends on the angle."""
    x, y = np.meshgrid(CELLS, CELLS, indexing="ij")
    (c, s), near = direction, np.hypot(x, y) <= 1.0

    def assert_same(found: Any, x_expected: Any, y_expected: Any) -> None:
        for one, other in zip(found, (x_expected, y_expected), strict=True):
            np.testing.assert_allclose(one[near], (other + 0 * x)[near], atol=2e-4)

    assert_same(seen(direction, radial=RADII), x, y)
    assert_same(seen(direction, circumferential=RADII), -y, x)
    assert_same(seen(direction, along_load=np.ones_like(RADII)), c, s)
    angles = np.linspace(0.0, np.pi, 181)
    outward, around = RADII[:, None] * np.cos(angles), -RADII[:, None] * np.sin(angles)
    along = np.hypot(x, y)  # r cos θ outward and −r sin θ around are r along the load
    assert_same(
        seen(direction, angles, radial=outward, circumferential=around), c * along, s * along
    )
