"""Which path a scene takes: the only place that asks what kind of scene this is."""

from dataclasses import dataclass
from math import ceil, hypot

from contact_scene import ControlKind, LoadRamp, Scene
from contact_scene.cycles import loop_increments
from contact_scene.effect import Effect
from contact_scene.expected_contact import refuse_equator
from contact_scene.normal_form import normal_form
from contact_scene.pair import coupling, refuse_contrast
from fem_reference.effects import effects
from fem_reference.path import Path as Path
from fem_reference.refusals import refuse_loads, refuse_shapes

# Of the shear moduli within a body: beyond, its stiffness matrix loses the softest part.
MOST_CONTRAST = 1e8
ROUND_OFF = 1e-9
# Increments of a step whose path matters; errors fall as their inverse.
PATH_INCREMENTS = 20
LARGEST_SHARE = 0.05


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene. What is off costs nothing downstream.

    path          which tractions are solved for
    direction     unit vector of the tangential load, (1, 0) if there is none
    increments    how many increments each loading step takes
    path_matters  whether the end of each step depends on how finely it is cut
    effects       every effect with its reason, as shown to people
    """

    path: Path
    direction: tuple[float, float]
    increments: tuple[int, ...]
    path_matters: tuple[bool, ...]
    effects: tuple[Effect, ...]


def plan(scene: Scene) -> Plan:
    """Decide the path of a scene; raises UnsupportedScene for what is not axisymmetric enough."""
    scene = normal_form(scene)
    refuse_equator(scene)
    refuse_shapes(scene)
    refuse_contrast(
        scene, MOST_CONTRAST, f", and finite elements carry a ratio up to {MOST_CONTRAST:.0e}"
    )
    friction = scene.friction is not None
    ramps = scene.load_path()
    loaded = any(any(ramp.tangential.end) for ramp in ramps)
    twisted = any(ramp.twisting.end != 0 for ramp in ramps)
    couples, why = coupling(scene)
    couples = couples and scene.friction is not None and scene.friction.largest > 0
    refuse_loads(scene, loaded, twisted, couples)
    path = _path(friction, loaded, twisted, couples)
    matters = _path_matters(ramps, path)
    return Plan(
        path,
        _direction(ramps),
        _increments(scene, matters),
        matters,
        effects(scene, path, (friction, loaded, twisted), why),
    )


def _path(friction: bool, loaded: bool, twisted: bool, couples: bool) -> Path:
    if not friction:
        return Path.PRESSING
    if twisted:
        return Path.TWISTING
    if loaded:
        return Path.HARMONICS if couples else Path.SHEARING
    return Path.PRESSING_WITH_FRICTION if couples else Path.PRESSING


def _direction(ramps: tuple[LoadRamp, ...]) -> tuple[float, float]:
    """Of the first tangential load that is not zero: so positive loads come first."""
    for ramp in ramps:
        x, y = ramp.tangential.end
        if x or y:
            return x / hypot(x, y), y / hypot(x, y)
    return 1.0, 0.0


def _path_matters(ramps: tuple[LoadRamp, ...], path: Path) -> tuple[bool, ...]:
    """Whether the end of each step depends on the path to it."""
    matters = []
    sheared = path in (Path.PRESSING_WITH_FRICTION, Path.HARMONICS)
    for ramp in ramps:
        sheared = sheared or any(ramp.tangential.end) or ramp.twisting.end != 0
        pressing = ramp.normal.start != ramp.normal.end
        shearing = path is Path.HARMONICS and ramp.tangential.start != ramp.tangential.end
        matters.append(path is not Path.PRESSING and sheared and (pressing or shearing))
    return tuple(matters)


def _increments(scene: Scene, matters: tuple[bool, ...]) -> tuple[int, ...]:
    """As asked for; else one wherever the end of the step does not depend on its path, but enough
    for the work of closed cycles."""
    ramps = scene.load_path()
    loops = loop_increments(ramps) if scene.friction else (1,) * len(ramps)
    return tuple(
        ramp.increments or max(of_loop, _path_increments(scene, ramp) if path_matters else 1)
        for ramp, path_matters, of_loop in zip(ramps, matters, loops, strict=True)
    )


def _path_increments(scene: Scene, ramp: LoadRamp) -> int:
    """Fine enough for about one per cent of the shear, first order in the increment."""
    friction = scene.friction
    by_force = ramp.normal.kind is ramp.tangential.kind is ControlKind.FORCE
    pressing = ramp.normal.start != ramp.normal.end
    if pressing or not by_force:
        return PATH_INCREMENTS
    limit = friction.carried(ramp.normal.end) if friction is not None else None
    if limit is None:
        return PATH_INCREMENTS
    start, end = ramp.tangential.start or (0.0, 0.0), ramp.tangential.end
    change = hypot(end[0] - start[0], end[1] - start[1])
    return max(1, ceil(change / (LARGEST_SHARE * limit) - ROUND_OFF)) if limit > 0 else 1
