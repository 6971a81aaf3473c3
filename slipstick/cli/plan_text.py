"""How fine a solve would be, and what it would take."""

from collections.abc import Iterator

from contact_scene import SurfaceDiscretisation
from semi_analytical import Plan, SurfaceGrid
from semi_analytical.memory import estimated_bytes
from slipstick.cli.grid_text import grid_text

MOST_STEPS_SHOWN = 12


def work(plan: Plan, grid: SurfaceGrid, asked: SurfaceDiscretisation) -> Iterator[tuple[str, str]]:
    """Grid, tolerance, increments and memory; what the scene left open says so."""
    left_open = [name for name in ("cells", "window") if getattr(asked, name) is None]
    chosen = f" ({' and '.join(left_open)} chosen)" if left_open else ""
    yield "grid", grid_text(grid) + chosen
    yield "tolerance", f"{asked.tolerance:.3g}"
    yield "increments", increments_text(plan.increments)
    if any(step.path_matters for step in plan.path):
        yield "path accuracy", f"{asked.path_accuracy:.3g}, where the scene names no increments"
    yield "memory", f"about {estimated_bytes(grid, plan) / 2**20:.0f} MiB"


def reasons(plan: Plan) -> Iterator[tuple[str, str, str]]:
    """Steps, what they are cut into and why; the beginning of a long history."""
    for number, step in enumerate(plan.path[:MOST_STEPS_SHOWN], start=1):
        yield str(number), str(step.count), step.why
    if len(plan.path) > MOST_STEPS_SHOWN:
        yield "…", "", ""


def increments_text(counts: tuple[int, ...]) -> str:
    """How many, and of a short history how many in every step."""
    if len(counts) == 1:
        return str(counts[0])
    shown = " + ".join(map(str, counts[:MOST_STEPS_SHOWN]))
    more = " + …" if len(counts) > MOST_STEPS_SHOWN else ""
    return f"{sum(counts)} = {shown}{more} in {len(counts)} steps"
