"""Figures of the gross-sliding study."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve, stacked
from verification.studies.sliding.estimate import Estimate
from verification.studies.sliding.path import SlidingPath
from verification.studies.sliding.verdicts import PAPER

MICROMETRE = 1e-6
FINE = 60
SHOWN_SHIFT = 1.6

Paths = Mapping[str, SlidingPath]


def stick_fraction_chart(paths: Paths, scales: Mapping[str, float]) -> Chart:
    """Stick area against force and against shift.

    scales  shift at the end of each curve's axis unit [length]
    """
    force = np.linspace(0, 1, FINE)
    closed = curve("Cattaneo–Mindlin", force, (1 - force) ** (2 / 3), Look.REFERENCE)
    by_force = [closed, *(_stick(path, n, "") for n, path in enumerate(paths.values()))]
    by_shift = [
        curve("Cattaneo–Mindlin", [0, 1], [1, 0], Look.REFERENCE),
        *(_stick(path, n, name, scales[name]) for n, (name, path) in enumerate(paths.items())),
    ]
    left = Panel(
        x_label="T / µW", y_label="stick area / contact area",
        curves=tuple(_unlabelled(by_force)), height=2.2,
    )  # fmt: skip
    right = Panel(x_label="shift / sliding scale", y_label="", curves=tuple(by_shift), height=2.2)
    return stacked(
        "stick_fraction",
        "Stick area against force and against shift",
        "Part of the contact that sticks while the indenter is shifted, after a normal "
        "loading that has already made most of the coated contact slip. The jump at the beginning: "
        "where slip would have to turn back, the surfaces stick again. Grey: Cattaneo and Mindlin. "
        "The sliding scale is Mindlin's sliding displacement of the identical bodies, and "
        "for a coating a mean of those of coating and substrate.",
        (left, right),
    )


def force_chart(paths: Paths, estimates: Mapping[str, Estimate]) -> Chart:
    """Force against shift, with the states in which the stick area vanishes."""
    curves = [_force(name, path, n) for n, (name, path) in enumerate(paths.items())]
    marks = curve(
        "stick area vanishes",
        [e.full_slip.shift / MICROMETRE for e in estimates.values()],
        [e.force for e in estimates.values()],
        Look.MARKS,
    )
    return stacked(
        "force_against_shift",
        "Tangential force against shift",
        "Force over the friction limit while the shift grows to at least three times "
        "Mindlin's sliding displacement. Dots: the stick area vanishes; the force still grows, "
        "towards µW. Thin black dashes: the number the paper gives for E1/E2 = 2.",
        Panel(
            x_label="shift (µm)", y_label="T / µW", curves=(_paper(paths.values()), *curves, marks),
            height=2.4,
        ),
    )  # fmt: skip


def variants_chart(product: SlidingPath, groups: Mapping[str, Paths]) -> Chart:
    """Force against shift under other readings of the friction law, the product's with each group.

    groups  at most five paths each, so that no two curves of a panel look alike
    """
    paths = [product, *(path for group in groups.values() for path in group.values())]
    paper, rows = _paper(paths), []
    for number, (title, group) in enumerate(groups.items(), 1):
        drawn = [_force(name, path, n) for n, (name, path) in enumerate(group.items(), 1)]
        x_label = "shift (µm)" if number == len(groups) else ""
        curves = (paper, _force("product", product, 0), *drawn)
        rows.append(
            Panel(title=title, x_label=x_label, y_label="T / µW", curves=curves, height=1.7)
        )
    return stacked(
        "friction_law_variants",
        "Other readings of the friction law and other paths, E1/E2 = 2",
        "Force over the friction limit against shift, one group of readings in each panel; "
        "the blue solid line is the product's in all of them. Thin black dashes: the paper's 0.76. "
        "Readings that freeze a direction lose part of the friction for good; slip that opposes "
        "its total instead of its increment turns only slowly into the direction of motion.",
        *rows,
    )


def _paper(paths: Iterable[SlidingPath]) -> Curve:
    end = max(path.points[-1].shift for path in paths) / MICROMETRE
    return curve("0.76 (paper)", [0, end], [PAPER, PAPER], Look.BOUND)


def _force(label: str, path: SlidingPath, series: int) -> Curve:
    x, y = [p.shift / MICROMETRE for p in path.points], [p.force for p in path.points]
    return curve(label, x, y, series=series)


def _stick(path: SlidingPath, series: int, label: str, scale: float | None = None) -> Curve:
    points = [p for p in path.points if p.stick_fraction > 0 or p.full_slip]
    x = [p.force if scale is None else p.shift / scale for p in points]
    shown = [(a, p.stick_fraction) for a, p in zip(x, points, strict=True) if a <= SHOWN_SHIFT]
    return curve(label, [a for a, _ in shown], [f for _, f in shown], series=series)


def _unlabelled(curves: list[Curve]) -> list[Curve]:
    return [c.model_copy(update={"label": ""}) for c in curves]
