"""Tests of the ticks and labels of the chart of `slipstick sweep`."""

from pathlib import Path

import numpy as np
import pytest
from command import succeeded
from matplotlib.figure import Figure

from contact_results.figures.style import round_ticks
from slipstick.sweep import Variation
from slipstick.sweep_chart import MAX_LABEL, SweptQuantity, _draw_map, _label


@pytest.mark.parametrize(
    ("ends", "ticks"),
    [
        ((10.0, 100.0), [10, 20, 50, 100]),
        ((3.0, 70.0), [5, 10, 20, 50]),
        ((2e-6, 9e-6), [2e-6, 5e-6]),
        ((1.0, 1e3), [1, 10, 100, 1000]),
        ((1e-9, 1e6), [1e-9, 1e-7, 1e-5, 1e-3, 0.1, 10, 1000, 1e5]),
        ((11.0, 18.0), [12, 13, 14, 15, 16, 17]),
        ((7.0, 7.0), [7]),
    ],
)
def test_ticks_of_a_logarithmic_axis_are_round_numbers(ends, ticks):
    assert round_ticks(*ends) == ticks


def test_a_map_has_ticks_at_its_values_and_labels_that_fit():
    """A field of a map reaches half a step beyond its value, to thicknesses below zero."""
    keys = [
        Variation("body.layers[1].thickness", "mm", (0.1, 0.4, 0.7)),
        Variation("body.layers[1].material.young_modulus", "GPa", (100.0, 450.0)),
    ]
    ax = Figure().add_subplot()
    quantity = SweptQuantity("approach", "m", np.ones((3, 2, 1)), np.zeros((3, 2, 1)))
    _draw_map(ax, quantity, *keys)
    for key, axis in zip(keys, "xy", strict=True):
        _label(ax, key, axis)
    assert (*ax.get_xticks(), *ax.get_yticks()) == (0.1, 0.4, 0.7, 100.0, 450.0)
    assert max(len(line) for line in ax.get_ylabel().splitlines()) <= MAX_LABEL


@pytest.mark.parametrize(
    ("errors", "title"), [((np.nan, 2e-6), "largest numerical error: 2 µm"), ((np.nan,) * 2, "")]
)
def test_a_map_states_errors_only_if_there_are_any(errors, title):
    keys = [Variation("indenter.radius", "mm", ends) for ends in ((1.0, 2.0), (3.0,))]
    ax = Figure().add_subplot()
    values = np.full((2, 1, 1), 5e-6)
    _draw_map(ax, SweptQuantity("approach", "m", values, np.reshape(errors, (2, 1, 1))), *keys)
    assert ax.get_title() == title


def test_an_estimate_of_time_states_that_it_lacks_the_stresses(tmp_path, monkeypatch):
    monkeypatch.setattr("slipstick.cli.commands.sweep.LONG_SWEEP", 2)
    hertz = Path(__file__).parents[1] / "scenes" / "hertz.toml"
    vary = "indenter.radius=10..11 mm 2"
    for name, lacks in (("von_mises@body", True), ("approach", False)):
        options = ("--get", name, "--solver", "radial", "--no-error", "-o", name)
        said = succeeded("sweep", hertz, "--vary", vary, *options, cwd=tmp_path).stdout
        assert ("without that of the stresses" in " ".join(said.split())) == lacks
