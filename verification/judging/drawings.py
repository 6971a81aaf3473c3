"""Charts of a ladder: a field beside the exact one, and errors against fineness."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.declared_case import Drawing, Falls, Row
from verification.judging.observable import Observable
from verification.judging.radial_chart import radial_chart
from verification.judging.refinement_levels import RefinementLevels
from verification.judging.run import Run

Field = NDArray[np.float64]
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
    """Fields on the judged run beside the exact ones, in this unit: along the row of cells next to
    y = 0, or over the radius. Rings show one field."""
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
    """Relative errors on the rungs that orders are read off, with the slopes that rows expect.

    also    errors that no row expects an order of
    beside  by what they are of: ladders as fine whose errors are drawn too
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
