"""Challenges of changing loads: both forces at once, in two directions, and a twist.

Laws that follow the tangential force by increments of its size alone fail here: the friction limit
changes with the normal force, the direction of slip turns, and a torque adds slip around the axis.
"""

from __future__ import annotations

from collections.abc import Iterator

from contact_scene import IsotropicMaterial, LoadStep, Scene
from verification.challenge.often_asked import SMALL
from verification.challenge.requested_quantities import (
    AskedValue,
    Challenge,
    Grade,
)
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import CONTACT_MODULUS, NORMAL_FORCE
from verification.references import load_reference

RATIOS = (0.0, 0.3, 0.5)  # of Poisson
STEPS = (
    LoadStep(normal_force=0.8 * NORMAL_FORCE),
    LoadStep(normal_force=NORMAL_FORCE, tangential_force=(50.0, 0.0)),
    LoadStep(tangential_force=(50.0, 50.0)),
    LoadStep(normal_force=0.9 * NORMAL_FORCE, tangential_force=(20.0, 60.0)),
    LoadStep(torque=6e-3),
)
UNITS = {"shift_x": "m", "shift_y": "m", "twist": "rad", "dissipated_energy": "J"}
MEANINGS = {
    "shift_x": "tangential shift of the indenter along +x, relative to far points of the body",
    "shift_y": "tangential shift of the indenter along +y, relative to far points of the body",
    "twist": "rotation of the indenter about z relative to far points of the body, right-handed",
    "dissipated_energy": "energy lost to friction since the first touch",
}


def scene_of(poisson_ratio: float) -> Scene:
    """Identical bodies with the compliance of the paper's pair under pressure."""
    modulus = 2 * CONTACT_MODULUS * (1 - poisson_ratio**2)
    material = IsotropicMaterial(young_modulus=modulus, poisson_ratio=poisson_ratio)
    scene = paper.frictional(
        f"Ball under changing loads, ν = {poisson_ratio:g}", paper.paraboloid(material), material
    )
    return scene.model_copy(update={"loading": STEPS})


def changing_loads() -> Iterator[Challenge]:
    """All of them, with numbers of the radial solver in the limit of fine increments."""
    content = load_reference("changing_loads")
    for nu in RATIOS:
        scene, ends = scene_of(nu), content["ends"][f"{nu:g}"]
        yield Challenge(
            f"changing_loads/nu={nu:g}",
            f"Both forces change, the direction turns, then a twist: ν = {nu:g}",
            f"{scene.title}. Each load step is a straight path from the preceding loads to its "
            "own: pressed by 0.8 kN; 1 kN and 50 N along x; 50 N along y added; 0.9 kN "
            "and (20, 60) N; a torque of 6 N mm about z.",
            scene, content["source"],
            tuple(_asked(step, name, value, ends) for step, values in ends.items()
                  for name, value in values.items()),
            (), SMALL, shares="the scene: two solvers of this program agree within the uncertainty",
        )  # fmt: skip


def _asked(step: str, name: str, value: float, ends: dict[str, dict[str, float]]) -> AskedValue:
    """Relative to the largest shift, twist or energy of the path."""
    kind = name.partition("_")[0]
    scale = max(
        abs(number)
        for values in ends.values()
        for other, number in values.items()
        if other.startswith(kind)
    )
    return AskedValue(
        name, int(step), UNITS[name], MEANINGS[name], value, scale, f"the largest {kind}", Grade.C,
        uncertainty=load_reference("changing_loads")["uncertainty"][name],
    )  # fmt: skip
