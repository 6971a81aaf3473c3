"""Tests of the picture of one contact on the first report page: reproducible, small, and an
image."""

import re

import pytest

from verification.exhibits.chart import Picture
from verification.report.drawing import image_address
from verification.showcase import showcase

LARGEST = 120_000  # bytes of one picture on the page


@pytest.fixture(scope="module")
def pictures() -> tuple[Picture, ...]:
    return showcase()


def test_equal_solves_give_equal_bytes(pictures: tuple[Picture, ...]) -> None:
    assert showcase() == pictures


def test_pictures_are_small_and_name_themselves(pictures: tuple[Picture, ...]) -> None:
    assert [one.name for one in pictures] == ["pressure", "shear", "zones", "section"]
    for one in pictures:
        address = image_address(one)
        assert address.startswith("data:image/svg+xml,")
        assert len(address) < LARGEST
        assert one.title
        assert one.caption


def test_fields_are_images_and_their_axes_are_text(pictures: tuple[Picture, ...]) -> None:
    assert pictures
    for one in pictures:
        assert "data:image/png" in one.svg
        assert len(re.findall("<text", one.svg)) > 8
