"""Plan of a solve: effects that a scene requires, refusal of unsupported scenes, and increments."""

from dataclasses import dataclass
from enum import Enum

from contact_scene import LoadRamp, Scene, effect
from contact_scene.checks.axisymmetric import (
    ELSEWHERE,
    AxisymmetricLoads,
    refuse_coefficient_map,
)
from contact_scene.effect import Effect
from contact_scene.friction_limit import increments_by_force
from contact_scene.normal_form import normal_form
from contact_scene.quantities.cycles import loop_increments
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.growing_contact import grows_without_slip
from contact_scene.stepping.load_path import first_direction

# Largest ratio of shear moduli within a body. Above this ratio the stiffness of the softest
# material is lost in round-off.
MAX_CONTRAST = 1e8
# Number of increments of a path-dependent load step. Errors are proportional to its inverse.
PATH_INCREMENTS = 20
LARGEST_SHARE = 0.05


class Path(Enum):
    """Tractions that a solve computes, and their dependence on the angle.

    PRESSING   pressure alone
    PRESSING_WITH_FRICTION
               pressure and radial shear, both axisymmetric, for coupled bodies
    TWISTING   pressure, then circumferential shear by torsion
    TWISTING_WITH_FRICTION
               pressure, radial and circumferential shear, all axisymmetric, for torsion of coupled
               bodies
    SHEARING   pressure, then shear along the tangential load, without coupling
    HARMONICS  pressure and shear of coupled bodies under a tangential load, on several angular
               harmonics
    WHOLE_CIRCLE
               pressure and shear under tangential loads on several lines, or together with torsion,
               on two families of angular harmonics
    """

    PRESSING = "pressure alone"
    PRESSING_WITH_FRICTION = "pressure and radial shear, coupled"
    TWISTING = "pressure, then circumferential shear"
    TWISTING_WITH_FRICTION = "pressure and axisymmetric shear, coupled"
    SHEARING = "pressure, then shear along the load"
    HARMONICS = "pressure and shear, coupled, on many harmonics"
    WHOLE_CIRCLE = "pressure and shear on the whole circle"


UNCOUPLED = (Path.PRESSING, Path.SHEARING, Path.TWISTING)
# Paths on which the indenter can twist.
TWISTED = (Path.TWISTING, Path.TWISTING_WITH_FRICTION, Path.WHOLE_CIRCLE)
# Paths with several angles on each ring.
ANGULAR = (Path.HARMONICS, Path.WHOLE_CIRCLE)
# Reasons why slip perpendicular to a tangential load is computed or omitted. Poisson's ratio causes
# such slip (Munisamy, Hills and Nowell 1994).
CROSS_SLIP = (
    dict.fromkeys(Path, "nothing pushes sideways")
    | {
        Path.SHEARING: "neglected, as by Cattaneo and Mindlin: shear and slip are along the load",
    }
    | dict.fromkeys(ANGULAR, "Coulomb's law is obeyed as a vector law at every point")
)

IN_PLANE = "plane strain: shear and slip are along the load"
SPRINGS = "the springs of the penalty law change the stiffness; use fem-complementarity"


@dataclass(frozen=True)
class Plan:
    """Plan of a solve: the tractions that it computes, and the increments of each load step.

    path          tractions of the solve
    direction     unit vector (x, y) of the tangential load, (1, 0) without one
    increments    number of increments of each load step
    path_matters  for each load step, True if its final state depends on the number of increments
    effects       all physical effects, such as friction, with the reasons for or against them, for
                  output
    twists        True if torque and twist are output
    stiffness     True if the contact stiffnesses are computed at the end of each load step
    """

    path: Path
    direction: tuple[float, float]
    increments: tuple[int, ...]
    path_matters: tuple[bool, ...]
    effects: tuple[Effect, ...]
    twists: bool = False
    stiffness: bool = False


def plan(scene: Scene, *, penalty: bool = False) -> Plan:
    """Determine the tractions that a scene requires, and the increments of each load step.

    Effects that do not occur in the scene, such as friction or torsion, are omitted from the solve.
    Raise UnsupportedScene if the scene is not axisymmetric, or has a tilt. A line contact is
    supported if one half of the section represents it: symmetric about x = 0, pressed, and pushed
    across its line without coupling of pressure and shear.

    penalty  True for the penalty law of contact and friction
    """
    scene = normal_form(scene)
    if scene.indenter.is_line and not scene.indenter.is_even:
        raise UnsupportedScene(
            "the line profile is not symmetric about x = 0, and finite elements represent a line "
            f"contact by one half of its section. Give equal heights at x and -x, or {ELSEWHERE}"
        )
    loads = AxisymmetricLoads.of(scene, MAX_CONTRAST, lines=True)
    _refuse_compliant_bonds(scene)
    if scene.indenter.is_line:
        _refuse_two_halves(loads)
    path = _choose_path(loads)
    if path is not Path.PRESSING:
        refuse_coefficient_map(scene)
    matters = _path_matters(scene, path, loads.couples)
    return Plan(
        path,
        first_direction(loads.ramps),
        _increment_counts(scene, path, matters),
        matters,
        _list_effects(scene, path, loads)
        + effect.contact_stiffness(scene, SPRINGS if penalty else ""),
        loads.twists,
        bool(scene.contact_stiffness) and not penalty and not scene.indenter.is_line,
    )


def _refuse_compliant_bonds(scene: Scene) -> None:
    """Raise UnsupportedScene if the bond of a layer is compliant."""
    for name, body in (("body", scene.body), ("indenter", scene.indenter)):
        for number, layer in enumerate(body.layers, start=1):
            if layer.interface_stiffness is not None:
                raise UnsupportedScene(
                    f"{name}.layers[{number}].interface_stiffness: the bond is compliant, and "
                    f"finite elements bond layers rigidly. Remove the key, or {ELSEWHERE}"
                )


def _refuse_two_halves(loads: AxisymmetricLoads) -> None:
    """Raise UnsupportedScene if the two halves of a line contact have different fields.

    loads  loads of the scene, and the causes of shear
    """
    why = ""
    if any(ramp.stretch for ramp in loads.ramps):
        why = "the lower body has a bulk strain"
    elif loads.couples:
        why = f"unlike bodies have friction ({loads.why})"
    elif loads.friction and any(ramp.tangential.end[1] for ramp in loads.ramps):
        why = "a step pushes along the line"
    if why:
        raise UnsupportedScene(
            f"{why}, and finite elements represent a line contact by one half of its section, on "
            f"which pressure and shear across the line are symmetric and not coupled; {ELSEWHERE}"
        )


def _choose_path(loads: AxisymmetricLoads) -> Path:
    """Determine the tractions that the solve computes, from the loads and friction of the scene.

    Examples are pressure alone, and pressure with shear along a tangential load.
    """
    couples = loads.frictional
    if not loads.friction:
        return Path.PRESSING
    if loads.loaded and (loads.twisted or loads.curved):
        return Path.WHOLE_CIRCLE
    if loads.twisted:
        return Path.TWISTING_WITH_FRICTION if couples else Path.TWISTING
    if loads.loaded:
        return Path.HARMONICS if couples else Path.SHEARING
    return Path.PRESSING_WITH_FRICTION if couples else Path.PRESSING


def _path_matters(scene: Scene, path: Path, couples: bool) -> tuple[bool, ...]:
    """Determine for each load step whether its final state depends on the number of increments.

    Friction makes a load step path-dependent if there is shear while the normal load or the imposed
    strain changes, unless nothing slips. For coupled pressure and shear, and on the whole circle, a
    change of the tangential load or of the twist is sufficient.

    scene    contact problem with its load history
    path     tractions that the solve computes
    couples  True if normal loading causes shear
    """
    matters = []
    sheared = couples or path is Path.PRESSING_WITH_FRICTION
    uncoupled = path in UNCOUPLED or (path is Path.WHOLE_CIRCLE and not couples)
    for ramp in scene.load_path():
        sheared = sheared or any(ramp.tangential.end) or ramp.twisting.end != 0
        sheared = sheared or ramp.strains
        pressing = ramp.normal.start != ramp.normal.end or ramp.strains
        shearing = path in ANGULAR and ramp.tangential.start != ramp.tangential.end
        shearing = shearing or (path is not Path.TWISTING and _twists(path, ramp))
        sheared = sheared and path is not Path.PRESSING
        moves = sheared and (pressing or shearing)
        sticks = uncoupled and grows_without_slip(scene, ramp)
        matters.append(moves and not sticks)
    return tuple(matters)


def _increment_counts(scene: Scene, path: Path, matters: tuple[bool, ...]) -> tuple[int, ...]:
    """Return the requested number of increments of each load step, else the larger of two:
    for the path dependence of friction, and for closed load cycles."""
    ramps = scene.load_path()
    loops = loop_increments(ramps) if scene.friction else (1,) * len(ramps)
    return tuple(
        ramp.increments or max(of_loop, _path_increments(scene, path, ramp) if path_matters else 1)
        for ramp, path_matters, of_loop in zip(ramps, matters, loops, strict=True)
    )


def _path_increments(scene: Scene, path: Path, ramp: LoadRamp) -> int:
    """Return the number of increments for a shear error of about 1 %,
    or for steps of LARGEST_SHARE of the friction limit if only the tangential force changes."""
    pressing = ramp.normal.start != ramp.normal.end or ramp.strains
    if pressing or _twists(path, ramp):
        return PATH_INCREMENTS
    return increments_by_force(scene.friction, ramp, LARGEST_SHARE, PATH_INCREMENTS)


def _twists(path: Path, ramp: LoadRamp) -> bool:
    """Return True if the torque or the twist changes in a load step."""
    return path in TWISTED and ramp.twisting.start != ramp.twisting.end


def _list_effects(scene: Scene, path: Path, loads: AxisymmetricLoads) -> tuple[Effect, ...]:
    return (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene),
        effect.friction(scene),
        Effect(
            "tangential load",
            loads.friction and loads.loaded,
            "a step names a tangential force or shift"
            if loads.loaded
            else "no step pushes sideways",
        ),
        Effect(
            "torsion",
            loads.twists,
            "a step names a torque or twist" if loads.twists else "no step twists the indenter",
        ),
        effect.strained(scene),
        effect.coupled(scene, loads.couples, loads.why),
        Effect(
            "slip across the load",
            path in ANGULAR,
            IN_PLANE if scene.indenter.is_line else CROSS_SLIP[path],
        ),
        effect.load_history(path is not Path.PRESSING and len(scene.loading) > 1),
    )
