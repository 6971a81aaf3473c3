"""Method by which the radial solver can solve a scene, as advice beside question marks."""

from __future__ import annotations

from contact_scene import Scene
from contact_scene.solver_errors import UnsupportedScene


def radial_method(scene: Scene) -> str | None:
    """Describe in words by which solution method the radial solver can solve a scene.

    The result is None for a scene that the radial solver does not support.
    """
    from radial.angular_grid import RingAngles
    from radial.plan import plan

    how = {
        None: "normal load, or torsion at constant load, nearly exact",
        RingAngles.ONE: "normal load and torsion together, on rings",
        RingAngles.HALF: "tangential load along one line, on rings and angles",
        RingAngles.WHOLE: "tangential load with changing direction or torsion, on rings and angles",
    }
    try:
        decided = plan(scene)
    except UnsupportedScene:
        return None
    return how[decided.circle]


def radial_advice(scene: Scene, solver: str, *, doubted: bool) -> list[str]:
    """Return the line that advises the radial solver, if it can solve a scene; else no line.

    solver   name of the solver of the result; there is no advice for the radial solver itself
    doubted  True if a stated error has not converged or a requested accuracy is not met
    """
    how = radial_method(scene) if doubted and solver != "radial" else None
    return [f"--solver radial can solve this: {how}"] if how else []
