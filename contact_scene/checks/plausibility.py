"""Warnings about implausible numbers in a scene.

Unit errors, such as a factor of 1000 between a data sheet and a scene file, give a valid scene with
wrong results. A warning does not refuse the scene.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, pairwise, product

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from contact_scene.checks.expected_contact import (
    SMALL_STRAIN,
    ExpectedContact,
    estimate_contacts,
)
from contact_scene.friction import FrictionMap
from contact_scene.friction_limit import step_at_limit, undefined_motion_warning
from contact_scene.geometry import HeightMap
from contact_scene.material import IsotropicMaterial
from contact_scene.reading.array_file import ArrayFile
from contact_scene.reading.engineering_units import quantity
from contact_scene.reading.quantity import WithUnit
from contact_scene.reading.scene_error import (
    Path,
    dotted_key,
)
from contact_scene.rig import compliances
from contact_scene.scene import Scene
from contact_scene.stepping.load_path import ControlKind


@dataclass(frozen=True)
class Usual:
    """Usual range of a physical quantity in scenes, for warnings about numbers outside the range.

    least, most  limits of the magnitude [SI unit]
    unit         SI unit
    meant        units that the user of a bare number may have intended, with their factors, most
                 likely first
    signed       True if the limits apply to the value instead of its magnitude
    """

    least: float
    most: float
    unit: str
    meant: Mapping[str, float]
    signed: bool = False


_MODULUS = Usual(1e3, 2e12, "Pa", {"GPa": 1e9, "MPa": 1e6})
_SIZE = Usual(1e-9, 1.0, "m", {"mm": 1e-3, "um": 1e-6})
_STEP = Usual(1e-12, 1e-3, "m", {"um": 1e-6, "nm": 1e-9})
_DEGREE = {"deg": math.pi / 180}
_FRICTION = Usual(0.0, 5.0, "", {"per cent": 1e-2})

# Usual ranges by key, from gels to diamond and from microscope tips to wheels.
USUAL: Mapping[str, Usual] = {
    "young_modulus": _MODULUS,
    **dict.fromkeys(("radius", "radii", "window", "contact_radius"), _SIZE),
    "thickness": Usual(1e-10, 0.1, "m", {"um": 1e-6, "mm": 1e-3}),
    "spacing": Usual(1e-10, 1e-2, "m", {"um": 1e-6, "nm": 1e-9}),
    **dict.fromkeys(("approach", "tangential_shift"), _STEP),
    "normal_force": Usual(1e-12, 1e9, "N", {}),
    **dict.fromkeys(("coefficient", "map"), _FRICTION),
    "twist": Usual(0.0, 0.1, "rad", _DEGREE),
    "tilt": Usual(0.0, 0.02, "rad", _DEGREE),  # about 1 deg, the tilt of a bad mounting
    "slope_angle": Usual(0.0, 0.36, "rad", _DEGREE),  # 20 deg, the slope of sharp indenters
    "poisson_ratio": Usual(0.0, 0.5, "", {}, signed=True),
    "tolerance": Usual(0.0, 1e-3, "", {}),
}
# Limits of modulus [Pa] and radius [m] of a dimensionless scene: softer than rubber and larger than
# a ball.
_SOFTEST = 1e6
_LARGEST = 0.1
_MARKED = 1 / 3  # largest fraction of marks, as of heights that were not measured
_FEW = 6  # values that are evenly spaced by chance
# Largest distance of coordinates from even spacing, in steps, if their steps are written with two
# digits.
_ROUNDED = 0.1
_STEEP = 1.0  # largest difference of adjacent heights over their distance
_STIFF = 2e10  # least modulus of metals and ceramics [Pa], where hardness limits the mean pressure
# Ratio of mean pressure to E* above the hardness of most materials: hardness is 0.01 to 0.04 of the
# modulus in steels, 0.05 in ceramics, 0.1 in diamond.
_HARD = 0.05
# Stiffness of a rig over that of the contact below which the force is nearly prescribed.
_SOFT = 1e-3
SPRINGS = (
    ("normal_stiffness", "approach", "normal_force"),
    ("tangential_stiffness", "tangential_shift", "tangential_force"),
)
# Layer thickness in contact radii above which the material below has no effect, and below which
# the layer has none. The ratio of the moduli shifts both limits.
_DEEP = 20.0
_THIN = 1e-4


def implausible_input(scene: Scene, **fineness: BaseModel) -> tuple[str, ...]:
    """Return warnings about implausible numbers of a scene, with the probable intention.

    An example is a modulus of 210 without a unit, which was probably meant in GPa. A dimensionless
    scene, with consistent numbers near 1, causes no warnings.

    scene     bodies, friction and loads
    fineness  discretisation tables of the scene file, by name
    """
    at_limit = step_at_limit(scene.friction, scene.load_path())
    return (
        *unlikely_numbers(scene, **fineness),
        *_strain_warnings(tuple(estimate_contacts(scene))),
        *([undefined_motion_warning(at_limit, "tangential_shift")] if at_limit else ()),
    )


def unlikely_numbers(scene: Scene, **fineness: BaseModel) -> tuple[str, ...]:
    """Return warnings about implausible numbers of a scene, except warnings about strains.

    Used for scenes with a result, since the result determines the strains better.

    scene     bodies, friction and loads
    fineness  discretisation tables of the scene file, by name
    """
    pressed = tuple(estimate_contacts(scene))
    of_maps = tuple(chain.from_iterable(_map_warnings(*each) for each in _maps(scene)))
    if _is_dimensionless(scene) and not any(_strain_warnings(pressed)):
        return of_maps
    parts = [
        _scene_numbers(scene, ()),
        *(_scene_numbers(part, (name,)) for name, part in fineness.items()),
    ]
    unusual = chain.from_iterable(map(_number_warnings, parts))
    return (
        *unusual,
        *of_maps,
        *(_height_map_warnings(scene.indenter) if isinstance(scene.indenter, HeightMap) else ()),
        *_size_warnings(scene, pressed, fineness),
        *_layer_warnings(scene, pressed),
        *(_shift_warnings(pressed) if compliances(scene.rig)[1] == 0 else ()),
        *_spring_warnings(scene, pressed),
        *_yield_warnings(pressed),
    )


def _number_warnings(numbers: Iterator[tuple[Path, float]]) -> Iterator[str]:
    for path, value in numbers:
        usual = USUAL.get(next((part for part in reversed(path) if isinstance(part, str)), ""))
        if usual is None or not value:
            continue
        size = value if usual.signed else abs(value)
        if usual.least <= size <= usual.most:
            continue
        side, limit = ("below", usual.least) if size < usual.least else ("above", usual.most)
        meant = [
            f'; was "{value:g} {unit}" meant?'
            for unit, factor in usual.meant.items()
            if usual.least <= abs(value * factor) <= usual.most and not isinstance(value, WithUnit)
        ]
        text, limit_text = _quantity_text(value, usual), _quantity_text(limit, usual)
        yield f"{dotted_key(path)}: {text} is {side} the usual {limit_text}{''.join(meant[:1])}"


def _quantity_text(value: float, usual: Usual) -> str:
    return quantity(value, usual.unit, 6) if usual.unit else f"{value:g}"


def _scene_numbers(value: object, path: Path) -> Iterator[tuple[Path, float]]:
    """Yield every number in a part of a scene, with the path of its key.

    Used to compare each number with the usual range of its quantity.

    value  model, tuple, number or array of the scene; of an array, the largest value is yielded
    path   keys and indices of the value in the scene
    """
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _scene_numbers(getattr(value, name), (*path, name))
    elif isinstance(value, tuple):
        for index, entry in enumerate(value):
            yield from _scene_numbers(entry, (*path, index))
    elif isinstance(value, float):
        yield path, value
    elif isinstance(value, ArrayFile):
        yield path, float(np.max(value.values))


def _is_dimensionless(scene: Scene) -> bool:
    """Determine if usual ranges do not apply:
    all moduli are below that of rubber, and all radii above that of a ball."""
    known = list(_scene_numbers(scene, ()))
    moduli = [value for path, value in known if path[-1] == "young_modulus"]
    radii = [value for path, value in known if {"radius", "radii"} & {*path}]
    return max(moduli) < _SOFTEST and min(radii, default=1.0) >= _LARGEST


def _maps(scene: Scene) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield key and values of the height map and the friction map of a scene."""
    if isinstance(scene.indenter, HeightMap):
        yield "indenter.file", scene.indenter.file.values
    if scene.friction and isinstance(scene.friction.coefficient, FrictionMap):
        yield "friction.coefficient.map", scene.friction.coefficient.map.values


def _map_warnings(key: str, values: NDArray[np.float64]) -> Iterator[str]:
    """Warn about values of a map that probably mark missing values or are coordinates.

    key     key of the map in the scene
    values  values of the map, NaN where missing (nx, ny)
    """
    for extreme in (np.nanmin(values), np.nanmax(values)):
        others = np.isfinite(values) & (values != extreme)
        count = np.count_nonzero(values == extreme)
        low = np.min(values, where=others, initial=np.inf)
        high = np.max(values, where=others, initial=-np.inf)
        gap = max(low - extreme, extreme - high)
        if low < high and gap > high - low and count <= _MARKED * values.size:
            yield (
                f"{key}: {count} of {values.size} values are "
                f"{extreme:g}, all others between {low:g} and {high:g}. Write nan for heights that "
                "were not measured, and correct other values that are marks"
            )
    sides = values, values[::-1], values.T, values.T[::-1]
    # The corner between a column and a row of coordinates is no coordinate.
    if any(
        _unevenness(side[0, part]) <= _ROUNDED and _unevenness(side[1, part]) > 1.0
        for side in sides
        if side.shape[1] > _FEW
        for part in (slice(1, None), slice(None, -1))
    ):
        yield (
            f"{key}: the values of the first or last column or row are evenly spaced, as "
            "coordinates are, and those next to them are not. Remove coordinates from the file"
        )


def _unevenness(line: NDArray[np.float64]) -> float:
    """Return the largest distance from even spacing over the mean step;
    infinite for a mean step of 0, NaN if unknown."""
    even = np.linspace(line[0], line[-1], len(line))
    step = abs(line[-1] - line[0]) / (len(line) - 1)
    return float(np.max(np.abs(line - even)) / step) if step else np.inf


def _height_map_warnings(indenter: HeightMap) -> Iterator[str]:
    rows, (dx, dy) = indenter.heights, indenter.spacing
    # Row by row, without a second array of equal size.
    along_x = max(float(np.max(np.abs(b - a))) for a, b in pairwise(rows)) / dx
    along_y = max(float(np.max(np.abs(np.diff(row)))) for row in rows) / dy
    if (steepest := max(along_x, along_y)) > _STEEP:
        range_ = quantity(float(np.ptp(rows)), "m")
        yield (
            f"indenter.file: the heights differ by {range_}, adjacent heights by {steepest:.2g} "
            "times their distance. Set indenter.height_unit unless the unit is metres"
        )
    if indenter.lowest_on_rim:
        yield (
            "indenter.file: the lowest point, at which contact begins, lies on the rim of the map. "
            "Heights are positive away from the body, with flip = true towards it. Change "
            "indenter.flip if the map is inverted"
        )
    if indenter.unmeasured_fraction:
        yield (
            f"indenter.file: {indenter.unmeasured_fraction:.2g} of the points were not measured; "
            "heights there solve Laplace's equation between their neighbours"
        )


def _size_warnings(
    scene: Scene, pressed: tuple[ExpectedContact, ...], fineness: Mapping[str, BaseModel]
) -> Iterator[str]:
    """Warn about a window or a finite-element mesh that is smaller than the expected contact.

    The window is the region of the surface that the cells of the semi-analytical solver cover.

    scene     bodies, indenter shape and load steps
    pressed   expected contacts at the ends of the load steps
    fineness  discretisation tables of the scene file, by name
    """
    a = max((end.radius for end in pressed), default=scene.indenter.rim or 0.0)
    window = getattr(fineness.get("semi_analytical"), "window", None)
    radius = getattr(fineness.get("fem_reference"), "contact_radius", None)
    for key, size, reach in (
        ("semi_analytical.window", np.min(window) if window else None, 2 * a),
        ("fem_reference.contact_radius", radius, a),
    ):
        if size is not None and size < reach:
            yield (
                f"{key}: {quantity(size, 'm', 6)} is less than the "
                f"{'diameter' if key.endswith('window') else 'radius'} of the contact of about "
                f"{quantity(reach, 'm', 2)}; leave it out to have it chosen"
            )


def _layer_warnings(scene: Scene, pressed: tuple[ExpectedContact, ...]) -> Iterator[str]:
    """Warn about layers without effect on the contact, and about layers that hide all others.

    A layer that is thin relative to the contact radius has no effect. Below a thick layer, the
    other materials have none.

    scene    bodies with their layers
    pressed  expected contacts at the ends of the load steps
    """
    a = max((end.radius for end in pressed), default=0.0)
    if not a:
        return
    for name, body in (("body", scene.body), ("indenter", scene.indenter)):
        for number, layer in enumerate(body.layers, 1):
            below = body.layers[number].material if number < len(body.layers) else body.material
            softer = (
                layer.material.young_modulus / below.young_modulus
                if isinstance(below, IsotropicMaterial)
                else 0.0
            )
            bond = layer.interface_stiffness
            if bond is not None:
                softest = min(bond.given) * layer.thickness
                softer = max(softer, layer.material.young_modulus / softest)
            radii = layer.thickness / a
            text = (
                f"{name}.layers[{number}].thickness: {quantity(layer.thickness, 'm', 6)} is "
                f"{radii:.2g} times the contact radius of about {quantity(a, 'm', 2)}: hardly "
                "anything shows of"
            )
            if radii > _DEEP * max(1.0, softer):
                yield f"{text} what lies below"
                break
            if bond is None and softer and radii * max(softer, 1 / softer) < _THIN:
                yield f"{text} it"


def _shift_warnings(pressed: tuple[ExpectedContact, ...]) -> Iterator[str]:
    """Warn about the first load step whose tangential shift exceeds the expected contact radius.

    The assumption of small displacements relative to the contact is then violated.

    pressed  expected contacts at the ends of the load steps
    """
    for end in pressed:
        if end.ramp.tangential.kind is ControlKind.DISPLACEMENT:
            shift = math.hypot(*end.ramp.tangential.end)
            if shift > end.radius:
                yield (
                    f"loading[{end.ramp.step}].tangential_shift: {quantity(shift, 'm')} is further "
                    f"than the contact radius of about {quantity(end.radius, 'm', 2)}, beyond the "
                    "theory of small displacements"
                )
                return


def _spring_warnings(scene: Scene, pressed: tuple[ExpectedContact, ...]) -> Iterator[str]:
    """Warn about springs of a test rig that are too soft for a prescribed displacement.

    With a spring much softer than the contact, a prescribed displacement of the actuator nearly
    prescribes the force on the indenter.

    scene    contact problem with the springs of the test rig
    pressed  expected contacts at the ends of the load steps
    """
    pairs = zip(SPRINGS, compliances(scene.rig), strict=True)
    for end, ((key, name, force), compliance) in product(pressed, pairs):
        control = end.ramp.normal if force == "normal_force" else end.ramp.tangential
        if control.kind is ControlKind.DISPLACEMENT and compliance * end.stiffness > 1 / _SOFT:
            yield (
                f"rig.{key}: {quantity(1 / compliance, 'N/m')} is less than {_SOFT:g} of the "
                f"stiffness of the contact of about {quantity(end.stiffness, 'N/m', 2)}: {name} "
                "prescribes nearly a force, at a higher cost and with more round-off; prescribe "
                f"{force} instead"
            )
            return


def _yield_warnings(pressed: tuple[ExpectedContact, ...]) -> Iterator[str]:
    """Warn about the first mean pressure above the hardness
    of most metals and ceramics, at most about _HARD times E*."""
    for end in pressed:
        if end.modulus > _STIFF and _HARD < end.strain <= SMALL_STRAIN:
            yield (
                f"loading[{end.ramp.step}].{_normal_load(end)} presses with about "
                f"{quantity(end.strain * end.modulus, 'Pa', 2)} in the mean, {end.strain:.2g} of "
                f"E* = {quantity(end.modulus, 'Pa')}: all but diamond and the hardest ceramics "
                "yield before, and the theory excludes plastic yield"
            )
            return


def _normal_load(end: ExpectedContact) -> str:
    """Write the prescribed normal load of a load step as text, such as "approach: 1 µm"."""
    by_force = end.ramp.normal.kind is ControlKind.FORCE
    load = quantity(end.ramp.normal.end, "N" if by_force else "m")
    return f"{'normal_force' if by_force else 'approach'}: {load}"


def _strain_warnings(pressed: tuple[ExpectedContact, ...]) -> Iterator[str]:
    for end in pressed:
        if end.strain > SMALL_STRAIN:
            yield (
                f"loading[{end.ramp.step}].{_normal_load(end)} on E* = "
                f"{quantity(end.modulus, 'Pa')} causes strains of about {end.strain:.2g}, beyond "
                "the theory of small strains"
            )
            return
