"""Charts of a verification case: computed and exact tractions over the radius, and errors
over h.
"""

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
    """Create a chart of a finite element traction over the radius, with its reference.

    The upper panel shows the traction and, in grey, the reference. The lower panel shows their
    difference.

    labels     texts of the chart
    radius     contact radius, the unit of the abscissa [length]
    scale      unit of the ordinate [force/length²]
    increment  increment that the traction belongs to
    traction   values at the rings of the increment [force/length²]
    exact      radii [length] and values [force/length²] of the reference
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


# Number of points of an exact profile in a chart.
POINTS = 120


@dataclass(frozen=True)
class Drawn:
    """Description of one pair of curves in a profile chart: a computed and an exact field of a load
    step.

    found  function from the increment at the end of the step to the computed field
    exact  function from the exact answer to the exact field, a function of the radius r
    label  name of the curve
    step   index of the load step
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
    """Return a function that draws computed fields of the judged run together with the exact
    fields.

    The function receives the results of a case by run label. On cells the chart shows the row of
    cells next to y = 0. On rings it shows one field over the radius.

    ladder   refinement levels, of which the judged run is drawn
    name     file name of the chart
    y_label  label of the ordinate
    unit     unit of the ordinate, in SI
    drawn    fields to draw; default: the pressure at the end of the last step
    """
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
    """Return a function that draws relative errors of observables over the cell or element side h.

    Lines of the expected slope show the order of convergence. The function receives the results of
    a case by run label.

    ladder  refinement levels from which orders of convergence are computed
    rows    rows of the case; those of type Falls have an expected slope
    name    file name of the chart
    also    observables whose errors are drawn without an expected slope
    beside  further refinement levels with equal sizes, by the name of their curves
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
