"""Errors and work of the penalty, drawn."""

from __future__ import annotations

from collections.abc import Iterable

from verification.exhibits.chart import Chart
from verification.exhibits.log_chart import log_chart, point_curves, slope_line
from verification.judging.case import Level
from verification.running.row import rows_of
from verification.running.row_views import points
from verification.studies.penalty.case import FRICTIONAL, PenaltyCase
from verification.studies.penalty.families import (
    BOXED,
    UPDATES,
    Found,
    of_boxes,
    of_friction,
    of_increments,
    of_springs,
)

NAMES = {
    "hertz": "no friction", "weak": "µ = 0.1", "strong": "µ = 0.3", "coated": "coated, µ = 0.1"
}  # fmt: skip
HOW = {0: "springs alone", 1: "one augmentation"}


def charts(level: Level, found: Found) -> tuple[Chart, ...]:
    """All figures."""

    def drawn(
        name: str,
        title: str,
        caption: str,
        axes: tuple[str, str],
        along: str,
        lines: Iterable[tuple[str, Iterable[PenaltyCase], str]],
        slope: float | None = None,
    ) -> Chart:
        """Lines are a label, cases and what is drawn of them; the slope is one of the first."""
        shown = [(label, points(rows_of(cases, found), along, y)) for label, cases, y in lines]
        below = [] if slope is None else slope_line(shown[0][1], slope)
        return log_chart(name, title, caption, *axes, below + point_curves(shown))

    by_updates = {
        updates: [case for case in of_springs(level) if case.augmentations == updates]
        for updates in UPDATES
    }
    return (
        drawn(
            "penalty_stiffness",
            "Error against the stiffness of the springs",
            "Relative errors of Hertz's contact against the penalty factor c. Springs alone err by "
            "a constant over c until the mesh's error is left; one augmentation leaves it at any "
            "c.",
            ("c", "relative error"),
            "factor",
            [
                (f"{words}, {how}", by_updates[updates], error)
                for updates, how in HOW.items()
                for error, words in (("approach", "approach"), ("peak", "peak pressure"))
            ],
            slope=-1,
        ),
        drawn(
            "penalty_ripple",
            "Ripple of the pressure at the edge",
            "L2 norm of the pressure's error over that of the pressure, against c. It is nearly "
            "all in the last element: stiff springs and many augmentations make it larger.",
            ("c", "L2 error of the pressure"),
            "factor",
            [
                (f"augmentations: {updates}" if updates else HOW[0], cases, "ripple")
                for updates, cases in by_updates.items()
            ],
        ),
        drawn(
            "penalty_work",
            "Work against the stiffness of the springs",
            "Linear systems per increment, two passes each, against c. Where Newton's method gives "
            "up and springs in series take over, their systems are added to its own.",
            ("c", "linear systems per increment"),
            "factor",
            [(NAMES[c], of_friction(level, c, 1), "systems_per_increment") for c in FRICTIONAL],
        ),
        drawn(
            "penalty_increments",
            "Error against the number of increments",
            "Pressing with µ = 0.3 at the default penalty. Shear remembers the path, until the "
            "mesh's error at the edge of stick is left; approach and pressure hardly notice it.",
            ("increments", "error"),
            "increments",
            [(error, of_increments(level), error) for error in ("shear", "pressure", "approach")],
            slope=-1,
        ),
        drawn(
            "penalty_box",
            "Error of the approach against the size of the section",
            "The displacement of the substrate under the load is prescribed on the border. A "
            "coating adds a source that this leaves out, which falls with the square of the size.",
            ("size of the section / contact radius", "relative error of the approach"),
            "box",
            [(NAMES[contact], of_boxes(level, contact), "approach") for contact in BOXED],
        ),
    )
