"""A scene in the words and units of a person."""

from collections.abc import Iterator
from typing import get_args

from pydantic.fields import FieldInfo

from contact_scene import (
    ArrayFile,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    HeightMap,
    IsotropicMaterial,
    LoadRamp,
    Rigid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.engineering_units import engineering_unit, quantity
from contact_scene.quantity import Quantity

MOST_STEPS_SHOWN = 12
EDGE = {
    "off": "tractions are constant on cells up to their edges",
    "last": "inside the cells at the end of each step, where the plan knows how",
    "all": "inside the cells at the end of each increment, where the plan knows how",
}

Line = tuple[str, str]


def describe(
    scene: Scene,
    discretisation: SurfaceDiscretisation,
    elements: FiniteElementDiscretisation | None = None,
) -> Iterator[Line]:
    """Pairs of a word and what the scene says about it, in the order of the file.

    elements  those of its numbers are told that are not what is usual
    """
    if scene.title:
        yield "title", scene.title
    yield "indenter", f"{shape_text(scene.indenter)}; {_body(scene.indenter)}"
    yield "body", _body(scene.body)
    yield "friction", _friction(scene.friction)
    yield from _loading(scene.load_path())
    yield from _discretisation(discretisation)
    if elements is not None:
        yield from _elements(elements)


def shape_text(indenter: Body) -> str:
    """The shape with its parameters, whatever these are."""
    fields = type(indenter).model_fields.items()
    own = {name: field for name, field in fields if name not in ("material", "layers")}
    texts = {name: _value(getattr(indenter, name), _unit(own[name])) for name in own}
    parts = [
        text.replace("_", " ") if name == "shape" else f"{name.replace('_', ' ')} {text}"
        for name, text in texts.items()
    ]
    if isinstance(indenter, HeightMap):
        parts.append("heights " + _map(indenter.file, indenter.spacing, "m"))
    return ", ".join(parts)


def _unit(field: FieldInfo) -> str:
    """SI unit of a quantity, or of both of a pair; empty for a pure number and what is none."""
    both = next(iter(get_args(field.annotation)), None)
    marks = (*field.metadata, *getattr(both, "__metadata__", ()))
    return next((mark.kind.si for mark in marks if isinstance(mark, Quantity)), "")


def _value(value: object, unit: str) -> str:
    if isinstance(value, tuple):
        return " x ".join(_value(part, unit) for part in value)
    if not isinstance(value, float):
        return str(value)
    return quantity(value, "m", 6) if unit == "m" else f"{value:.6g} {unit}".rstrip()


def _body(body: Body) -> str:
    layers = [
        f"layer of {quantity(layer.thickness, 'm', 6)} ({_material(layer.material)})"
        for layer in body.layers
    ]
    return " on ".join([*layers, _material(body.material)])


def _material(material: IsotropicMaterial | Rigid) -> str:
    from contact_scene import RIGID

    if material is RIGID:
        return "rigid"
    E, nu = material.young_modulus, material.poisson_ratio
    return f"E = {quantity(E, 'Pa', 6)}, ν = {nu:.6g}"


def _friction(friction: CoulombFriction | None) -> str:
    if friction is None:
        return "none"
    mu = friction.coefficient
    if isinstance(mu, float):
        return f"Coulomb, µ = {mu:.6g}"
    shift = f", its middle at {_vector(mu.origin, 'm')}" if any(mu.origin) else ""
    return f"Coulomb, µ from {mu.map}: {_map(mu.map, mu.spacing, '')}{shift}"


def _map(file: ArrayFile, spacing: tuple[float, float], unit: str) -> str:
    """Values, points and size of a map."""
    (nx, ny), (dx, dy) = file.shape, spacing
    ends = (float(file.values.min()), float(file.values.max()))
    values = [quantity(end, unit, 4) if unit else f"{end:.4g}" for end in ends]
    size = _value((nx * dx, ny * dy), "m")
    return f"{values[0]} to {values[1]}, {nx} x {ny} values on {size}"


def _loading(path: tuple[LoadRamp, ...]) -> Iterator[Line]:
    for ramp in path[:MOST_STEPS_SHOWN]:
        increments = "" if ramp.increments is None else f", in {ramp.increments} increments"
        yield f"step {ramp.step}", "; ".join(_changes(ramp)) + increments
    if len(path) > MOST_STEPS_SHOWN:
        yield "…", f"{len(path) - MOST_STEPS_SHOWN} more steps"


def _changes(ramp: LoadRamp) -> Iterator[str]:
    """What moves within a step; what is held goes without saying."""
    from contact_scene import ControlKind

    moves = False
    for control, force, displacement in (
        (ramp.normal, ("normal force", "N"), ("approach", "m")),
        (ramp.tangential, ("tangential force", "N"), ("tangential shift", "m")),
        (ramp.twisting, ("torque", "N m"), ("twist", "rad")),
        (ramp.tilting, ("moment", "N m"), ("tilt", "rad")),
    ):
        name, unit = force if control.kind is ControlKind.FORCE else displacement
        if control.start != control.end:
            moves = True
            yield f"{name} {_from(control.start, unit)}to {_load(control.end, unit)}"
    if not moves:
        yield "held"


def _from(start: float | tuple[float, float] | None, unit: str) -> str:
    """Where a ramp starts, if that is known before solving and not the unloaded state."""
    if start is None or start in (0.0, (0.0, 0.0)):
        return ""
    return f"from {_load(start, unit)} "


def _load(value: float | tuple[float, float], unit: str) -> str:
    return _vector(value, unit) if isinstance(value, tuple) else quantity(value, unit, 6)


def _vector(vector: tuple[float, float], unit: str) -> str:
    scale = engineering_unit(max(abs(part) for part in vector), unit)
    return f"({vector[0] / scale.size:.6g}, {vector[1] / scale.size:.6g}) {scale.name}"


def _discretisation(discretisation: SurfaceDiscretisation) -> Iterator[Line]:
    cells, window = discretisation.cells, discretisation.window
    yield "cells", "chosen" if cells is None else f"{cells[0]} x {cells[1]}"
    yield "window", "chosen" if window is None else _value(window, "m")
    yield "tolerance", f"{discretisation.tolerance:.3g}"
    yield "path accuracy", f"{discretisation.path_accuracy:.3g}"
    yield "edge", EDGE[discretisation.edge]


def _elements(given: FiniteElementDiscretisation) -> Iterator[Line]:
    for name, field in type(given).model_fields.items():
        value = getattr(given, name)
        if value != field.default:
            yield f"elements: {name}".replace("_", " "), _value(value, _unit(field))
