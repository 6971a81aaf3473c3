"""`slipstick maintain history`: accuracy and cost over commits, as a page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.options import LevelName, optional
from slipstick.cli.report import read_report

if TYPE_CHECKING:
    from verification.regression.history import Standing


def history(
    places: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="PLACE",
            help="Reports, folders or their report.json, or folders of baselines, the oldest "
            "first; the baselines at every commit of the clone that slipstick runs from if absent.",
        ),
    ] = None,
    level: Annotated[
        LevelName | None,
        optional("--level", help="Which level's numbers; of the first report if absent, or quick."),
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FILE", help="The page.")
    ] = Path("reports/history.html"),
) -> None:
    """Draw the error over U, the counted work and the CPU time of every case over commits or
    reports, red where one became worse (an error half as large again, and by a twentieth of U) or
    dearer (a twentieth more convolutions, factorisations or iterations).

    Nothing is computed. One file, without script, for a browser. Exit code 2 if there is no
    history, or a place that cannot be read.
    """
    from contact_results.directory.atomic_file import atomic_file
    from verification.regression.history import marks, standings_of_commits
    from verification.report.files import refuse_if_unwritable
    from verification.report.history_page import render_history

    refuse_if_unwritable(output.parent)
    if places:
        chosen, standings = _standings(places, level)
    else:
        chosen = str(level or LevelName.QUICK)
        standings = standings_of_commits(chosen)
    page = render_history(standings, chosen)
    with atomic_file(output) as temporary:
        temporary.write_text(page, encoding="utf-8", newline="\n")
    since = [mark for mark in marks(standings) if mark.at == len(standings) - 1]
    typer.echo(f"{len(standings)} standings; worse or dearer at the last: {len(since)}")
    typer.echo(f"history: {output}")


def _standings(places: list[Path], level: LevelName | None) -> tuple[str, list[Standing]]:
    """Those at the level, or at that of the first report, and the level."""
    from verification.regression.acceptance import baselines_of
    from verification.regression.baseline_files import read_baselines
    from verification.regression.history import Standing, recordings_at
    from verification.regression.refusal import BaselineRefused
    from verification.report.files import record_in

    chosen = None if level is None else str(level)
    standings = []
    for place in places:
        if place.is_dir() and not record_in(place).is_file() and any(place.glob("*.json")):
            baselines, date = read_baselines(place), ""
        else:
            report = read_report(place)
            chosen = chosen or report.level
            baselines = baselines_of(report, f"the report {place}")
            date = report.provenance.date[:10]
        recordings = recordings_at(chosen or str(LevelName.QUICK), baselines)
        if not recordings:
            raise BaselineRefused(f"{place} has nothing of level {chosen}; --level chooses another")
        because = next(iter(recordings.values())).by.reason
        standings.append(Standing(str(place), date, because, recordings))
    return chosen or str(LevelName.QUICK), standings
