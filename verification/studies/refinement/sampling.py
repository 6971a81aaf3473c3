"""The usual route, which samples the frequency response, beside the exact coefficients."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from pathlib import Path

from fem_reference import Method
from semi_analytical import SurfaceGrid
from verification.exhibits.numbers import percent, plain
from verification.running.row import CaseRecord, Row, found, value_of
from verification.running.rules import judged
from verification.running.study import (
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    StudyCase,
)
from verification.studies.refinement import page
from verification.studies.refinement.expected import Expected, by_period
from verification.studies.refinement.fit import Fit
from verification.studies.refinement.refinement import Refinement, count_of, joined
from verification.studies.refinement.sampled_level import SampledLevel
from verification.studies.refinement.sampling_page import (
    AXES,
    EXTENSION,
    REFINEMENT,
    distances,
    error_chart,
    error_table,
    quantities,
)
from verification.studies.refinement.studied_scene import CannotRefine, StudiedScene
from verification.studies.refinement.surface_level import SurfaceLevel
from verification.studies.refinement.surface_start import SurfaceStart
from verification.studies.work_precision.usual_route import Sampling

CELLS = 32  # samples grow with the square of cells, refinement and extension each
HELD = 2  # of the factor that is not refined
MOST_SAMPLES = 4096  # along a side
JUDGED = ("approach", "peak_pressure", "tangential_shift_x")
CAP = 1e-3  # of a value: above, limits say too little of it
LIMITS = (
    "What is compared is solved on one grid, so that only the coefficients differ. Refinement is "
    "samples per cell side, extension the period over twice the window: below one, images would "
    "reach into the window.",
    "How much sampling costs depends on the cells over the thickness of the layers: --cells takes "
    "others.",
)


def sampling_study(
    path: Path, overrides: Sequence[str], step: int | None, method: Method | None = None
) -> Study:
    """Samples per cell and period of the usual route, each refined while the other is held.

    Raises SceneError, CannotRefine for a step that is not there or more samples than are allowed,
    UnsupportedScene where a friction map fixes the cells.
    """
    scene = StudiedScene.of(path, overrides, step)
    start = SurfaceStart.of(scene)
    by_images = by_period(start.contents.scene, start.couples)
    by_factor = {
        REFINEMENT: _swept(start, REFINEMENT, {}),
        EXTENSION: _swept(start, EXTENSION, by_images),
    }

    def cases(settings: Settings) -> tuple[StudyCase, ...]:
        levels = (level for one in by_factor.values() for level in one.levels(settings))
        return (_exact(start, settings), *{level.name: level for level in levels}.values())

    def conclude(settings: Settings, records: Records) -> Conclusion:
        orders = [one.conclusion(settings, records) for one in by_factor.values()]
        orders = [_named(name, one) for name, one in zip(by_factor, orders, strict=True)]
        known = found((_exact(start, settings),), records)
        if not known:
            return joined(*orders)
        (exact,) = known.values()
        sweeps = (
            distances(name, one.found(settings, records), exact) for name, one in by_factor.items()
        )
        whole = [rows for rows in sweeps if rows]
        shown = Conclusion(
            statements=_extrapolated(by_factor, settings, records, exact),
            answer=_answer(whole[-1], _grid(start, settings)) if whole else "",
            tables=(error_table(whole),) if whole else (),
            charts=tuple(error_chart(rows, f"the other factor is {HELD}") for rows in whole),
            remarks=LIMITS,
        )
        return joined(shown, *orders)

    return Study(
        "sampling",
        f"Sampled response of {scene.title}",
        "What would it cost to take the influence coefficients from a sampled frequency response, "
        "as is usual? Samples finer than the cells stand against aliasing, a longer period against "
        "periodic images; the coefficients of this project need neither.",
        cases,
        conclude,
    )


def _grid(start: SurfaceStart, settings: Settings) -> SurfaceGrid:
    return start.grid_of(settings.cells or CELLS)


def _exact(start: SurfaceStart, settings: Settings) -> SurfaceLevel:
    return start.level(0.0, "exact coefficients", grid=_grid(start, settings))


def _swept(start: SurfaceStart, name: str, expected: Mapping[str, Expected]) -> Refinement:
    """Of one factor of the sampling, by doubling; periods begin where images bend the surface
    little."""

    def levels(settings: Settings) -> tuple[SampledLevel, ...]:
        grid = _grid(start, settings)
        first = 1 if name == REFINEMENT else HELD
        factors = [first * 2**number for number in range(count_of(settings))]
        pairs = [(f, HELD) if name == REFINEMENT else (HELD, f) for f in factors]
        count = Sampling(factors[-1], HELD).count(max(grid.cells))
        if count > MOST_SAMPLES:
            raise CannotRefine(
                f"the finest of {len(factors)} samplings would have {count} samples along a side, "
                f"more than {MOST_SAMPLES}; use fewer --cells or fewer levels"
            )
        return tuple(
            SampledLevel(start.level(1 / factor, _words(*pair), grid=grid), *pair)
            for factor, pair in zip(factors, pairs, strict=True)
        )

    return Refinement(f"sampling_{name}", levels, expected, f"1 / {AXES[name]}", start.tolerance)


def _words(refinement: int, extension: int) -> str:
    return f"{refinement} per cell side, period {2 * extension} windows"


def _named(name: str, conclusion: Conclusion) -> Conclusion:
    """Which factor its statements, tables and rows are about."""
    return conclusion.model_copy(
        update={
            "statements": tuple(
                one.model_copy(update={"claim": f"{name}: {one.claim}"})
                for one in conclusion.statements
            ),
            "tables": tuple(
                one.model_copy(update={"title": f"{one.title}, {name}"})
                for one in conclusion.tables
            ),
            "rows": tuple(
                one.model_copy(update={"parameters": {"factor": name, **one.parameters}})
                for one in conclusion.rows
            ),
        }
    )


def _answer(extended: Sequence[Row], grid: SurfaceGrid) -> str:
    """What both factors as they are held leave."""
    first = extended[0]
    period = int(first.number("value") or 0)
    left = {page.label(name): first.measures[name] for name in quantities(first)}
    parts = ", ".join(f"{percent(error)} of the {name}" for name, error in left.items() if error)
    cells = "{} x {} cells".format(*grid.cells)
    return (
        f"On {cells}, {_words(HELD, period)} leave {parts}; exact coefficients have neither factor."
    )


def _extrapolated(
    by_factor: Mapping[str, Refinement], settings: Settings, records: Records, exact: CaseRecord
) -> tuple[Statement, ...]:
    """Both limits together, against the solution by exact coefficients: what one factor changes
    hardly depends on the other."""
    refined, extended = (one.found(settings, records) for one in by_factor.values())
    by_refinement, by_extension = (
        {fit.name: fit for fit in one.fitted(levels)}
        for one, levels in zip(by_factor.values(), (refined, extended), strict=True)
    )
    statements = []
    for name in JUDGED:
        one, other = by_refinement.get(name), by_extension.get(name)
        if one is None or other is None or not extended:
            continue
        held, right = value_of(extended[0], name), value_of(exact, name)
        both = _limit(one) + _limit(other) - held
        doubt = 2 * hypot(one.uncertainty or 0.0, other.uncertainty or 0.0)
        off_held, off_both = (abs(value - right) / abs(right) for value in (held, both))
        statements.append(_agrees(name, off_held, off_both, doubt / abs(right)))
    return tuple(statements)


def _limit(fit: Fit) -> float:
    assert fit.limit is not None
    return fit.limit


def _agrees(name: str, held: float, both: float, doubt: float) -> Statement:
    allowed = min(doubt, CAP)
    complete = both <= allowed or not both <= doubt
    return Statement(
        claim=f"{page.label(name)}: sampled ever finer and wider it tends to the exact one",
        outcome=judged(both <= allowed, complete=complete),
        measured=f"{plain(held, 2)} off where both factors are {HELD}, {plain(both, 2)} by both "
        "limits",
        because=f"allowed {plain(allowed, 2)}: twice the uncertainty of the limits, no more than "
        f"{CAP:g}",
    )
