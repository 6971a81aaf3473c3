"""Reference pages from the code: keys of scene files, columns of results, commands, exit codes."""

import re
from collections.abc import Iterable, Iterator
from typing import Any

import typer
from pydantic import BaseModel

from contact_scene import (
    Body,
    InterfaceStiffness,
    InterfaceStrength,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
)
from contact_scene.accuracy import AccuracyRequest
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.friction import CoulombFriction, FrictionMap
from contact_scene.geometry import SHAPES
from contact_scene.quantities.field_metadata import reported
from contact_scene.quantities.increment import (
    Counters,
    Quality,
    State,
)
from contact_scene.quantities.ring_increment import RingIncrement
from contact_scene.quantities.summary import ClosedCycle
from contact_scene.reading.description import field_descriptions
from contact_scene.reading.quantity import Quantity
from contact_scene.rig import Rig
from semi_analytical.fields import Increment
from slipstick.cli.application import ALL_COMMANDS, application

TABLES: dict[str, type[BaseModel]] = {
    "the file itself": Scene,
    **{f'[indenter], shape = "{name}"': shape for name, shape in SHAPES.items()},
    "[body]": Body,
    "[[body.layers]] and [[indenter.layers]], outermost first": Layer,
    "material = { … }": IsotropicMaterial,
    "interface_strength = { … }": InterfaceStrength,
    "interface_stiffness = { … }": InterfaceStiffness,
    "[friction]": CoulombFriction,
    "coefficient = { … }, a map": FrictionMap,
    "[rig]": Rig,
    "[[loading]], one per step": LoadStep,
    "[semi_analytical]": SurfaceDiscretisation,
    "[fem_reference]": FiniteElementDiscretisation,
    "[radial]": RadialDiscretisation,
    "[accuracy]": AccuracyRequest,
}
COLUMNS = {
    "State at the end of an increment": State,
    "Closed load cycles": ClosedCycle,
    "Fields on cells": Increment,
    "Fields on rings": RingIncrement,
    "Residual and edge correction": Quality,
    "Counters of the solver, in timing.json": Counters,
}


def scene_keys() -> str:
    """Return the page of all tables of a scene file with their keys."""
    parts = []
    for title, model in TABLES.items():
        meanings = field_descriptions(model)
        rows = [_key(name, f, meanings.get(name, "")) for name, f in model.model_fields.items()]
        rows = [row for row in rows if row[0] != "`shape`"]
        parts += [f"## {title}\n", _first_sentence(model.__doc__), table(("key", "expects"), rows)]
    return "\n".join(parts)


def columns() -> str:
    """Return the page of all reported quantities with their units in files."""
    parts, seen = [], set()
    for title, record in COLUMNS.items():
        marks = {k: v for k, v in reported(record).items() if k not in seen}
        seen |= set(marks)
        rows = [(f"`{k}`", v.unit or "1", _cell(v.meaning), v.kind.value) for k, v in marks.items()]
        parts += [f"## {title}\n", table(("name", "unit", "meaning", "what it is"), rows)]
    return "\n".join(parts)


def commands() -> str:
    """Return the page of all commands: usage, help text and options."""
    parts = []
    for name, lazy in ALL_COMMANDS.items():
        command = lazy.load(name.split()[-1])
        context = typer.Context(command, info_name=f"slipstick {name}")
        usage = " ".join(command.collect_usage_pieces(context))
        rows = [_option(parameter) for parameter in command.params if parameter.name != "help"]
        parts += [f"## {name}\n", f"    slipstick {name} {usage}\n", f"{command.help}\n"]
        parts += [table(("", "meaning"), rows)]
    return "\n".join(parts)


def exit_codes() -> str:
    """Return the exit codes, which end `slipstick --help`, as a table."""
    line = str(application.info.epilog).removeprefix("Exit codes: ").rstrip(".")
    rows = [item.split(" ", 1) for item in line.split("; ")]
    return table(("code", "meaning"), rows)


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a Markdown table of text cells."""
    head = tuple(head)
    lines = [head, ("---",) * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def parameters(model: type[BaseModel]) -> Iterator[tuple[str, str]]:
    """Yield name and meaning of each attribute of a scene object, in reStructuredText."""
    meanings = field_descriptions(model)
    for name, field in model.model_fields.items():
        if name not in meanings:
            continue
        meaning = " ".join(meanings[name].split())
        marks = [mark.expected for mark in _marks(field.annotation, field.metadata)]
        yield name, f"{meaning} *{marks[0]}*" if marks else meaning


def _key(name: str, field: Any, meaning: str) -> tuple[str, str]:
    quantity = next((m for m in _marks(field.annotation, field.metadata)), None)
    expects = f" *{quantity.expected}*" if quantity is not None else ""
    must = "**needed.** " if field.is_required() else ""
    return f"`{name}`", f"{must}{_cell(meaning)}{expects}"


def _marks(annotation: Any, metadata: Iterable[Any]) -> Iterator[Quantity]:
    yield from (mark for mark in metadata if isinstance(mark, Quantity))
    for part in getattr(annotation, "__args__", ()):
        yield from _marks(part, getattr(part, "__metadata__", ()))


def _option(parameter: Any) -> tuple[str, str]:
    names = " ".join(f"`{name}`" for name in (*parameter.opts, *parameter.secondary_opts))
    if parameter.param_type_name == "argument":
        names = f"`{parameter.metavar or parameter.name}`"
    return names, _cell(getattr(parameter, "help", "") or "")


def _first_sentence(text: str | None) -> str:
    paragraph = " ".join((text or "").split("\n\n")[0].split())
    return f"{paragraph}\n"


def _cell(text: str) -> str:
    """Return text for a table cell: one line, with escaped bars and brackets."""
    flat = " ".join(text.split()).replace("|", "\\|")
    return re.sub(r"\[([^\]]+)\]", r"\\[\1\\]", flat)
