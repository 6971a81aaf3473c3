"""Result of a fretting contact on few cells, for tests of output."""

from functools import cache

from contact_scenes import PRESS, push, scene

from contact_scene.quantities.stated_error import StatedError, StatedErrors
from semi_analytical import solve
from semi_analytical.fields import Result
from semi_analytical.grid import SurfaceGrid

SCENE = scene(PRESS, push(0.9, increments=3), push(-0.9, increments=2)).model_copy(
    update={"title": "small"}
)


@cache
def small_result() -> Result:
    """Solve partial slip back and forth, once in a process."""
    return solve(SCENE, SurfaceGrid((24, 20), (1.2e-3, 1.0e-3)), 1e-8)


def small_errors(result: Result) -> StatedErrors:
    """Errors that differ from step to step."""
    return StatedErrors(
        tuple(
            {
                name: StatedError(error=10.0 ** (-9 - end.step), parts={}, status="estimated")
                for name in ("approach", "normal_force", "dissipated_energy")
            }
            for end in result.steps
        ),
        (),
        tuple(10.0 ** (-2 - end.step) for end in result.steps),
    )
