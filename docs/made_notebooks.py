"""Jupyter notebooks of the gallery, which write, solve and draw one scene each."""

from __future__ import annotations

import json
from typing import Any

from gallery_claims import SCENES, Entry

SOLVED = """\
from pathlib import Path

from contact_scene import read_scene_file
from slipstick import save, solve, stated_errors

scene = Path("{scene}.toml")
scene.write_text(SCENE, encoding="utf-8")
result = solve(read_scene_file(scene), "{solver}")
errors = stated_errors(result)
for end, error in zip(result.steps, errors.steps, strict=True):
    print(f"step {{end.step}}:", end.status.value)
    for name, stated in error.items():
        print(f"    {{name}}: {{getattr(end, name, None)}} ± {{stated.error}}")
"""
DRAWN = """\
from IPython.display import Image, display

save(result, Path("out") / "{scene}", figures="all", errors=errors)
for figure in sorted((Path("out") / "{scene}").glob("*.png")):
    display(Image(figure))
"""


def notebook(entry: Entry) -> str:
    """Return the notebook of a scene as JSON text of nbformat 4.5."""
    scene = (SCENES / f"{entry.scene}.toml").read_text(encoding="utf-8")
    cells = (
        _cell("markdown", f"# {entry.title}\n\n{entry.words}\n\n*Source*: {entry.source}."),
        _cell("code", f'SCENE = """\\\n{scene}"""\n'),
        _cell("code", SOLVED.format(scene=entry.scene, solver=entry.solver)),
        _cell("code", DRAWN.format(scene=entry.scene)),
        _cell("markdown", entry.conclusion),
    )
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    contents = {
        "cells": [cell | {"id": f"{entry.scene}-{k}"} for k, cell in enumerate(cells)],
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(contents, indent=1, ensure_ascii=False) + "\n"


def _cell(kind: str, text: str) -> dict[str, Any]:
    cell: dict[str, Any] = {
        "cell_type": kind,
        "metadata": {},
        "source": text.rstrip("\n").splitlines(keepends=True),
    }
    return cell | ({"execution_count": None, "outputs": []} if kind == "code" else {})
