"""Result of a fretting contact on few cells, for tests of output."""

from functools import cache

from contact_scene import Body, CoulombFriction, IsotropicMaterial, LoadStep, Paraboloid, Scene
from contact_scene.quantities.stated_error import StatedError, StatedErrors
from semi_analytical import solve
from semi_analytical.fields import Result
from semi_analytical.grid import SurfaceGrid

STEEL = IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3)
SCENE = Scene(
    title="small",
    indenter=Paraboloid(radius=18e-3, material=STEEL),
    body=Body(material=STEEL),
    friction=CoulombFriction(coefficient=0.1),
    loading=(
        LoadStep(normal_force=1000.0),
        LoadStep(tangential_force=(90.0, 0.0), increments=3),
        LoadStep(tangential_force=(-90.0, 0.0), increments=2),
    ),
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
    )
