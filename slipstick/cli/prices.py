"""What accuracies cost, as a table."""

import re
from typing import TYPE_CHECKING

from slipstick.solvers.solver import increments_text, time_text

if TYPE_CHECKING:
    from contact_errors.price import Price
    from contact_scene import SceneFile
    from slipstick.solvers.solver import Solver

HEADINGS = ("accuracy", "cells or elements", "increments", "rounds", "time", "memory")
NAMED = re.compile(r"\s*([A-Za-z]\w*)")


def print_prices(option: str, solver: "Solver", contents: "SceneFile") -> None:
    """Print cells, increments, time and memory of every accuracy that an option names, and of those
    that no grid can meet why not."""
    from contact_errors.price import price
    from contact_scene.scene_file import read_accuracy
    from contact_scene.solver_errors import AccuracyOutOfReach
    from slipstick.cli.terminal import print_pairs, print_table

    items = requests_of(option)
    requests = [read_accuracy(item, "--accuracy") for item in items]
    last = len(contents.scene.loading)
    wanted = last if any(request.binds_stress for request in requests) else None
    ladder = solver.ladder(contents.scene, solver.fineness(contents), stress_at=wanted)
    first = ladder.climbed(ladder.first())
    rows, refused = [], []
    for item, request in zip(items, requests, strict=True):
        try:
            rows.append((item, *_texts(price(ladder, first, request))))
        except AccuracyOutOfReach as error:
            refused.append((item, str(error)))
    if rows:
        print_table(HEADINGS, rows)
    if refused:
        print_pairs(refused)


def requests_of(option: str) -> list[str]:
    """Each as `run --accuracy` takes it: what stands between semicolons, and without these every
    share without a name, and the names in a row until one comes again."""
    if ";" in option:
        return [part.strip() for part in option.split(";") if part.strip()] or [option]
    requests: list[list[str]] = []
    names: set[str] = set()
    for item in option.split(","):
        name = match[1] if (match := NAMED.match(item)) else None
        if name is None or not names or name in names:
            requests.append([])
            names.clear()
        requests[-1].append(item.strip())
        names |= {name} if name else set()
    return [", ".join(items) for items in requests]


def _texts(found: "Price") -> tuple[str, ...]:
    cells = found.settings.cells
    return (
        f"{cells[0]} x {cells[1]}" if cells else f"{found.settings.elements_per_radius} per radius",
        increments_text(found.settings.increments),
        str(found.rounds),
        time_text(found.seconds),
        f"about {found.memory / 2**20:.0f} MiB" + ("" if found.fits else ", more than there is"),
    )
