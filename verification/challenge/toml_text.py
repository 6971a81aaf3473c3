"""A scene as the text of a TOML file in SI numbers, which reads back as the same scene."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from contact_scene import Scene
from verification.challenge.requested_quantities import Patch


def toml_text(scene: Scene | Patch) -> str:
    """All that is not usual."""
    if isinstance(scene, Patch):
        tables = scene.document(exclude_defaults=True)
        return "\n".join(_table(tables, ())).lstrip("\n") + "\n"
    content = scene.model_dump(mode="json", exclude_defaults=True, exclude_none=True)
    shape = scene.model_dump(mode="json")["indenter"]["shape"]
    content["indenter"] = {"shape": shape, **content["indenter"]}
    return "\n".join(_table(content, ())).lstrip("\n") + "\n"


def _table(content: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    """Its own values first; tables and arrays of tables after them."""
    deeper = {name: v for name, v in content.items() if _is_table(v) or _is_tables(v)}
    for name, value in content.items():
        if name not in deeper:
            yield f"{name} = {_value(value)}"
    for name, value in deeper.items():
        here = (*path, name)
        for one in [value] if _is_table(value) else value:
            head = ".".join(here)
            yield f"\n[{head}]" if _is_table(value) else f"\n[[{head}]]"
            yield from _table(one, here)


def _is_table(value: Any) -> bool:
    return isinstance(value, dict)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(map(_is_table, value))


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=False)
