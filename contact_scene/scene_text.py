"""A scene in the words and units of a person."""

from collections.abc import Iterator

from contact_scene import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    LoadRamp,
    Rigid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.engineering_units import engineering_unit, quantity

MOST_STEPS_SHOWN = 12

Line = tuple[str, str]


def describe(scene: Scene, discretisation: SurfaceDiscretisation) -> Iterator[Line]:
    """Pairs of a word and what the scene says about it, in the order of the file."""
    if scene.title:
        yield "title", scene.title
    yield "indenter", f"{shape_text(scene.indenter)}; {_body(scene.indenter)}"
    yield "body", _body(scene.body)
    yield "friction", _friction(scene.friction)
    yield from _loading(scene.load_path())
    yield from _discretisation(discretisation)


def shape_text(indenter: Body) -> str:
    """The shape with its parameters, whatever these are."""
    own = [name for name in type(indenter).model_fields if name not in ("material", "layers")]
    texts = [_value(name, getattr(indenter, name)) for name in own]
    named = zip(own, texts, strict=True)
    parts = [text if name == "shape" else f"{name} {text}" for name, text in named]
    return ", ".join(parts).replace("_", " ")


def _value(name: str, value: object) -> str:
    if isinstance(value, tuple):
        return " x ".join(_value(name, part) for part in value)
    if not isinstance(value, float):
        return str(value)
    return f"{value:.6g} rad" if name.endswith("angle") else quantity(value, "m", 6)


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
    return f"Coulomb, µ = {mu:.6g}" if isinstance(mu, float) else f"Coulomb, µ from {mu.map}"


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
    yield "window", "chosen" if window is None else _value("window", window)
    yield "tolerance", f"{discretisation.tolerance:.3g}"
    yield "path accuracy", f"{discretisation.path_accuracy:.3g}"
