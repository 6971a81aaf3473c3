"""Reference solutions that other programs computed, as JSON files; README.md states their
accuracy."""

import json
from importlib.resources import files
from typing import Any


def load_reference(name: str) -> dict[str, Any]:
    """Load a stored reference solution `<name>.json` from this folder.

    Raises ValueError for an unknown name, with the list of available names.
    """
    folder = files(__name__)
    available = sorted(
        entry.name.removesuffix(".json")
        for entry in folder.iterdir()
        if entry.name.endswith(".json")
    )
    if name not in available:
        raise ValueError(f"no reference {name!r}; available: {', '.join(available) or 'none'}")
    content: dict[str, Any] = json.loads(
        folder.joinpath(f"{name}.json").read_text(encoding="utf-8")
    )
    return content
