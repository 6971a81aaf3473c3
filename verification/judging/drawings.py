"""Charts of refinement levels: a field with the exact one, and errors over the cell size."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.declared_case import Drawing, Falls, Observable, Row
from verification.judging.refinement_levels import RefinementLevels
from verification.judging.run import Run
from verification.observed.ring_errors import SHOWN, at_radii

if TYPE_CHECKING:
    from fem_reference import Increment


Field = NDArray[np.float64]


def radial_chart(
    labels: ProfileLabels,
    radius: float,
    scale: float,
    increment: Increment,
    traction: Field,
    exact: tuple[Field, Field],
) -> Chart:
    """A traction over the radius with what it should be in grey, and their difference below.

    radius  that r is divided by; scale what the traction is divided by
    exact   radii and values of the reference
    """
    shown = increment.radii <= SHOWN * radius
    r, found = increment.radii[shown] / radius, traction[shown] / scale
    known_r, known = exact[0] / radius, exact[1] / scale
    difference = at_radii(increment, traction, exact[0]) / scale - known
    above = Panel(
        x_label="",
        y_label=labels.y_label,
        curves=(
            curve("reference", known_r, known, Look.REFERENCE),
            curve("finite elements", r, found, Look.COMPUTED),
        ),
        height=2.6,
    )
    below = Panel(
        x_label=labels.x_label,
        y_label=labels.difference_label,
        curves=(curve("", known_r, difference, Look.COMPUTED),),
    )
    return Chart(
        name=labels.name, title=labels.title, caption=labels.caption, rows=((above,), (below,))
    )


POINTS = 120  # of an exact profile


@dataclass(frozen=True)
class Drawn:
    """A field at the end of a step.

    found, exact  from the end of the step, and of the exact answer as a function of r
    """

    found: Callable[[Any], Field]
    exact: Callable[[Any], Callable[[Field], Field]]
    label: str = "computed"
    step: int = -1


PRESSURE = Drawn(lambda end: end.pressure, lambda exact: exact.pressure)


def profile(
    ladder: RefinementLevels,
    name: str,
    title: str,
    caption: str,
    y_label: str,
    unit: float,
    *drawn: Drawn,
) -> Drawing:
    """Draw fields of the judged run with the exact ones, in units of `unit`.

    Cells show the row next to y = 0, rings one field over the radius."""
    problem, run = ladder.problem, ladder.judged.run
    fields = drawn or (PRESSURE,)

    def draw(results: Mapping[str, Any]) -> Chart:
        result = results[run.label]
        if isinstance(run, Run):
            section = Section(result.grid, problem.radius)
            profiles = [
                Profile(
                    one.label,
                    section.of(one.found(result.steps[one.step])) / unit,
                    problem.on_surface(one.exact(problem.ends[one.step]), section.x, section.y)
                    / unit,
                )
                for one in fields
            ]
            return profile_chart(ProfileLabels(name, title, caption, y_label), section, profiles)
        (one,) = fields
        end, answer = result.steps[one.step], problem.ends[one.step]
        r = getattr(answer, "radii", np.linspace(0.0, problem.radius, POINTS))
        exact = one.exact(answer)(r)
        labels = ProfileLabels(name, title, caption, y_label, "r / a")
        return radial_chart(
            labels,
            problem.radius,
            unit,
            end,
            one.found(end),
            (r, exact),
        )

    return draw


def convergence(
    ladder: RefinementLevels,
    rows: Sequence[Row],
    name: str,
    title: str,
    caption: str,
    also: Sequence[Observable] = (),
    beside: Mapping[str, RefinementLevels] | None = None,
) -> Drawing:
    """Draw relative errors on the levels that orders are computed from, with the expected slopes.

    also    errors without an expected order
    beside  further refinement levels with the same sizes, by name
    """
    cells = isinstance(ladder.judged.run, Run)
    unit = ladder.problem.radius if cells else 1.0
    expected = {row.what.label: row for row in rows if isinstance(row, Falls)}
    ladders = {"": ladder} | {f", {of}": other for of, other in (beside or {}).items()}
    errors = (*(row.what for row in expected.values()), *also)

    def draw(results: Mapping[str, Any]) -> Chart:
        found = {
            f"{one.label}{of}": [one.error(other.problem)(results[run]) for run in other.levels]
            for one in errors
            for of, other in ladders.items()
        }
        return convergence_chart(
            name,
            title,
            caption,
            [rung.run.spacing / unit for rung in ladder.followed],
            found,
            {label: row.expected for label, row in expected.items()},
            f"{'cell' if cells else 'element'} side / contact radius",
        )

    return draw
