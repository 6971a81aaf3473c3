"""Tests of `--save-expected` and `--expect`: a later result is held to the stated errors alone."""

import pytest

from slipstick.expected import (
    ExpectedNumber,
    Source,
    expected_changes,
)

SOURCE = Source("run", {"indenter.radius": 0.018}, "radial")
EXPECTED = "expected.json"


def number(value: float, error: float | None, mark: str = "") -> ExpectedNumber:
    return ExpectedNumber(value=value, error=error, reliable=not mark, unit="m", scale=1.0)


@pytest.mark.parametrize(
    ("was", "now", "kind"),
    [
        ((1, 0.1), (1.19, 0.1), "unchanged"),
        ((1, 0.1), (1.21, 0.1), "outside"),
        ((1, 0.1), (0.79, 0.1), "outside"),
        ((1, 1e-9), (1 + 3e-9, 1e-9), "outside"),
        ((1, 0.1), (1, 0.149), "unchanged"),
        ((1, 0.1), (1, 0.151), "worse"),
        ((1, 1e-6), (1, 1.9e-6), "unchanged"),
        ((1, 1e-6), (1, 2.1e-6), "worse"),
        ((1, 0.1), (1, 0.049), "better"),
        ((1, 0.0), (1 + 0.9e-6, 0.0), "unchanged"),
        ((1, 0.0), (1 + 1.1e-6, 0.0), "outside"),
        ((1, 0.1), (1, 0.1, "?"), "worse"),
        ((1, 0.1, "?"), (1, 0.1), "better"),
        ((1, 0.1, "?"), (2.9, 0.1, "?"), "unchanged"),
        ((1, 0.1, "?"), (3.1, 0.1, "?"), "outside"),
        ((1, 0.1), (1, None, "?"), "worse"),
        ((1, None, "?"), (2, None, "?"), "drift"),
        ((1, 0.1), None, "gone"),
        (None, (1, 0.1), "new"),
    ],
)
def test_numbers_are_compared_by_their_stated_errors(was, now, kind):
    """No tolerance is chosen. An error with a question mark is right to an order of magnitude."""
    expected, found = (
        SOURCE.with_numbers({"step 1": {"approach": number(*one)} if one else {}})
        for one in (was, now)
    )
    kinds = [row.kind for row in expected_changes(found, expected, EXPECTED)]
    assert kinds == [kind] * (kind != "unchanged")
