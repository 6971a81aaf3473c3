"""`slipstick plan`: what a solve would do, before it does it."""

import re
from typing import TYPE_CHECKING, Annotated

from slipstick.cli.options import (
    SceneArgument,
    SetOption,
    SolverOption,
    optional,
    warn_of_odd_numbers,
)
from slipstick.solvers.names import SolverName
from slipstick.solvers.solver import increments_text, time_text

if TYPE_CHECKING:
    from contact_errors.adaptive_refinement import Price
    from contact_scene import Scene, SceneFile
    from slipstick.solvers.solver import Solver

HEADINGS = ("accuracy", "cells, elements, rings", "increments", "time", "memory")
NAMED = re.compile(r"\s*([A-Za-z]\w*)")


def plan(
    scene: SceneArgument,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    accuracy: Annotated[
        str | None,
        optional(
            "--accuracy",
            metavar="SHARES",
            help='Say what each of these would cost, such as "1%,0.1%,0.01%", or "approach 0.1%, '
            'contact_radius 0.1%" together, or requests of "run" with semicolons between them; '
            "solves on a coarse grid. Absent: nothing of it.",
        ),
    ] = None,
) -> None:
    """Say which effects a scene needs and why, on which grid or mesh, and what a run would take.

    The time is within a factor of two. It follows from a coarse solve, on at most 32 cells along a
    side or 8 elements over the contact radius and in at most 48 increments, which this command
    makes. A scene that the solver does not support is refused as by 'run'. With --accuracy, cells,
    increments, time and memory of 'run --accuracy' follow from a coarse solve, too.
    """
    from contact_scene import read_scene_file
    from slipstick.cli.terminal import print_pairs, print_table

    contents = read_scene_file(scene, overrides or ())
    warn_of_odd_numbers(contents)
    chosen = solver.solver
    fineness = chosen.fineness(contents)
    decided = chosen.plan(contents.scene, fineness)
    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in decided.effects)
    print_table(("effect", "", "why"), rows)
    print_pairs(chosen.work(contents.scene, fineness, decided))
    if reasons := chosen.reasons(decided):
        print_table(("step", "increments", "why"), reasons)
    if solver is not SolverName.RADIAL and (how := by_radii(contents.scene)):
        print_pairs([("radial", f"--solver radial would do: {how}")])
    if accuracy is not None:
        _print_prices(accuracy, chosen, contents)


def by_radii(scene: "Scene") -> str | None:
    """What one dimension makes of a scene; None where it calls for more."""
    from contact_scene.solver_errors import UnsupportedScene
    from radial.angular_grid import Circle
    from radial.plan import plan

    how = {
        None: "pressing, or torsion of what is pressed, nearly exact",
        Circle.ONE: "pressing and torsion together, on rings",
        Circle.HALF: "a push along one line, on rings and angles",
        Circle.WHOLE: "pushes that turn, or torsion beside them, on rings and angles",
    }
    try:
        decided = plan(scene)
    except UnsupportedScene:
        return None
    return how[decided.circle]


def _print_prices(option: str, solver: "Solver", contents: "SceneFile") -> None:
    """Print cells, increments, time and memory of every accuracy that an option names, and of those
    that no grid can meet why not."""
    from contact_errors.adaptive_refinement import Levels, price
    from contact_scene.reading.scene_file import read_accuracy
    from contact_scene.solver_errors import AccuracyOutOfReach
    from slipstick.cli.terminal import print_pairs, print_table

    items = requests_of(option)
    requests = [read_accuracy(item, "--accuracy") for item in items]
    last = len(contents.scene.loading)
    stress = any(request.binds_stress for request in requests)
    refined = solver.refined(contents.scene, solver.fineness(contents), stress=stress)
    levels = Levels(refined, last if stress else None)
    first = levels.first()
    rows, refused = [], []
    for item, request in zip(items, requests, strict=True):
        try:
            rows.append((item, *_price_texts(price(levels, first, request))))
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


def _price_texts(found: "Price") -> tuple[str, ...]:
    cells, rings = found.settings.cells, found.settings.ring_factor
    fineness = f"{rings:.2g} times the rings" if rings else ""
    fineness = fineness or f"{found.settings.elements_per_radius} per radius"
    return (
        f"{cells[0]} x {cells[1]}" if cells else fineness,
        increments_text(found.settings.increments),
        time_text(found.seconds),
        f"about {found.memory / 2**20:.0f} MiB" + ("" if found.fits else ", more than there is"),
    )
