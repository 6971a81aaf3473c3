"""`slipstick maintain bench`: what our method costs, beside other codes in turn."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.options import optional


def bench(
    output: Annotated[
        Path | None,
        optional("--output", "-o", metavar="FILE", help="Write the record as JSON."),
    ] = None,
    cells: Annotated[
        int, typer.Option("--cells", metavar="N", min=32, help="Cells of the finest grid a side.")
    ] = 256,
    peers: Annotated[
        bool,
        typer.Option(
            "--peers/--no-peers",
            help="Ask other codes too; they are installed once, in an environment of their own.",
        ),
    ] = True,
) -> None:
    """Solve the same contacts on finer and finer grids, ours and other codes in turn.

    One thread, each run in a process of its own: CPU seconds, convolutions, memory, the ratio to
    the cheapest other code, and how the cost grows with the grid; then where ours spends its time
    on three scenes, on at most 256 cells a side. About two minutes of CPU to 256 cells a side, ten
    to 1024. The first time other codes are installed, each within three minutes.
    """  # fmt: skip
    import json

    from contact_results.directory.atomic_file import atomic_file, refuse_what_is_in_the_way
    from slipstick.cli.terminal import print_table
    from verification.peers.asked import ASKED
    from verification.peers.costs import cost_table, growth
    from verification.peers.environment import FAILED, made_environment, peers_directory
    from verification.peers.measure import all_runs, record_of
    from verification.peers.profile import MOST_CELLS, profile_of, profile_table, profiled_scenes

    if output is not None and not output.parent.is_dir():
        raise typer.BadParameter(f"there is no directory {output.parent} to write {output.name} to")
    if output is not None:
        refuse_what_is_in_the_way(output)
    installed = made_environment(peers_directory()) if peers else None
    for distribution, reason in (installed.missing if installed else {}).items():
        typer.echo(f"left out: {distribution}: {reason}", err=True)
    if installed is not None and installed.missing:
        failed = peers_directory() / FAILED
        typer.echo(f"not tried again until {failed} is removed", err=True)
    runs = []
    for run in all_runs(installed, cells, tuple(ASKED.values())):
        runs.append(run)
        took = run.get("lost") or f"{run['seconds']:.3g} s"
        typer.echo(f"{run['code']}, {run['contact']}, {run['cells']} cells: {took}", err=True)
    profiles = [profile_of(asked, min(cells, MOST_CELLS)) for asked in profiled_scenes()]
    record = record_of(runs, installed, profiles)
    for table in (cost_table(record), profile_table(record)):
        print_table(table.columns, table.rows)
    typer.echo(growth(record))
    if output is not None:
        text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
        with atomic_file(output) as unfinished:
            unfinished.write_text(text, encoding="utf-8")
