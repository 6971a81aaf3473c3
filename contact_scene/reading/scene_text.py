"""Description of a scene as text for the user: every key with its value in a readable unit."""

from collections.abc import Container, Iterable, Iterator
from typing import get_args

import numpy as np
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from contact_scene.body import Body
from contact_scene.discretisation import FiniteElementDiscretisation, SurfaceDiscretisation
from contact_scene.material import Rigid
from contact_scene.quantities.per_length import shown_unit
from contact_scene.reading.array_file import ArrayFile
from contact_scene.reading.engineering_units import quantity
from contact_scene.reading.quantity import Quantity
from contact_scene.scene import Scene

MAX_STEPS_SHOWN = 12

Line = tuple[str, str]


def describe(
    scene: Scene,
    discretisation: SurfaceDiscretisation,
    elements: FiniteElementDiscretisation | None = None,
) -> Iterator[Line]:
    """Yield lines that describe a scene to the user: its tables, load steps and discretisation.

    scene           contact problem
    discretisation  settings of the semi-analytical solver
    elements        settings of the finite-element solvers; only values other than the default are
                    shown
    yields          name and text of each line
    """
    if scene.title:
        yield "title", scene.title
    yield "indenter", _table_text(scene.indenter)
    yield "body", _table_text(scene.body)
    yield "friction", "none" if scene.friction is None else _table_text(scene.friction)
    line = scene.indenter.is_line
    if scene.rig is not None:
        yield "rig", _table_text(scene.rig, line=line)
    for number, step in enumerate(scene.loading[:MAX_STEPS_SHOWN], 1):
        yield f"step {number}", _table_text(step, line=line)
    if len(scene.loading) > MAX_STEPS_SHOWN:
        yield "…", f"{len(scene.loading) - MAX_STEPS_SHOWN} more steps"
    for name, text in _key_texts(discretisation):
        yield name.replace("_", " "), text or "chosen"
    for name, field in FiniteElementDiscretisation.model_fields.items():
        if elements is not None and (value := getattr(elements, name)) != field.default:
            yield f"elements: {name}".replace("_", " "), _value_text(value, _unit_of_field(field))


def shape_text(indenter: Body) -> str:
    """Describe the shape of an indenter in words with its parameters: "sphere, radius 18 mm".

    Used in messages.

    indenter  indenter with its shape
    """
    return _table_text(indenter, Body.model_fields)


def _key_texts(model: BaseModel, *, line: bool = False) -> Iterator[Line]:
    """Yield the name of each key with its value in a readable unit;
    the text is empty without a value."""
    for name, field in type(model).model_fields.items():
        unit = shown_unit(_unit_of_field(field), line=line)
        yield name, _value_text(getattr(model, name), unit)


def _table_text(model: BaseModel, left_out: Container[str] = (), *, line: bool = False) -> str:
    """Write keys and values of a table as one text.
    The shape of an indenter comes first, without its key."""
    texts = {
        name: text for name, text in _key_texts(model, line=line) if text and name not in left_out
    }
    shape = [texts.pop("shape").replace("_", " ")] if "shape" in texts else []
    own = sorted(texts, key=lambda name: name in Body.model_fields)
    return ", ".join([*shape, *(f"{name.replace('_', ' ')} {texts[name]}" for name in own)])


def _value_text(value: object, unit: str = "") -> str:
    if value is None or value == ():
        return ""
    if isinstance(value, ArrayFile):
        if 2 in value.shape:  # radii and heights of a profile
            return f"{value} ({max(value.shape)} points)"
        low, high = np.nanmin(value.values), np.nanmax(value.values)
        points = " x ".join(map(str, value.shape))
        return f"{value} ({points} values from {low:.4g} to {high:.4g})"
    if isinstance(value, BaseModel):
        return f"({_table_text(value)})"
    if isinstance(value, tuple):
        texts = [_value_text(part, unit) for part in value]
        return "".join(texts) if texts[0].startswith("(") else f"({', '.join(texts)})"
    if not isinstance(value, float):
        return str(value.value if isinstance(value, Rigid) else value)
    return quantity(value, unit, 6) if unit else f"{value:.6g}"


def _unit_of_field(field: FieldInfo) -> str:
    """Return the SI unit of a key, such as "m"; empty for pure numbers and other values."""
    unit = next(_quantity_units((*field.metadata, field.annotation)), "")
    return unit if unit != "1" else ""


def _quantity_units(parts: Iterable[object]) -> Iterator[str]:
    for part in parts:
        if isinstance(part, Quantity):
            yield part.kind.si
        yield from _quantity_units(get_args(part))


def increments_text(counts: tuple[int, ...]) -> str:
    """Return the text of the numbers of increments, such as "30 = 10 + 20 in 2 steps".

    counts  number of increments of each load step
    """
    if len(counts) == 1:
        return str(counts[0])
    shown = " + ".join(map(str, counts[:MAX_STEPS_SHOWN]))
    more = " + …" if len(counts) > MAX_STEPS_SHOWN else ""
    return f"{sum(counts)} = {shown}{more} in {len(counts)} steps"
