"""Tractions of a result on a section at the end of a step, from the result or from its run."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from contact_results.directory.file_names import FIELDS
from contact_results.files.stored_values import MISREAD, refuse_other_shape, text, values
from contact_results.files.surface_state import NoSuchState
from contact_scene import Body, FiniteElementDiscretisation
from fem_reference import Result
from fem_reference.stress import SurfaceTractions

SHEARS = ("shear_radial", "shear_circumferential", "shear_along_load")


@dataclass(frozen=True)
class SectionState:
    """What loads the two bodies of a scene, and how finely it was computed.

    step  loading step, from 1
    """

    title: str
    body: Body
    indenter: Body
    discretisation: FiniteElementDiscretisation
    step: int
    tractions: SurfaceTractions


def is_section_run(directory: Path) -> bool:
    """Whether a directory holds the result of finite elements."""
    try:
        with h5py.File(directory / FIELDS) as file:
            return str(file.attrs.get("solver", "")).startswith("fem_reference")
    except OSError:
        return False


def section_state_of_result(result: Result, step: int | None) -> SectionState:
    """State at the end of a step, None for the last. Raises NoSuchState."""
    ends = {end.step: end for end in result.steps}
    chosen = _existing(step, sorted(ends))
    scene = result.scene
    indenter = Body(material=scene.indenter.material, layers=scene.indenter.layers)
    tractions = SurfaceTractions.of(ends[chosen])
    return SectionState(
        scene.title, scene.body, indenter, _own_radius(result.discretisation), chosen, tractions
    )


def section_state_of_run(directory: Path, step: int | None) -> SectionState:
    """The same from the fields that `slipstick run` has written there.

    Raises NoSuchState, also for a file that is no result, and ResourceRefused.
    """
    path = directory / FIELDS
    try:
        with h5py.File(path) as file:
            return _read(file, step)
    except MISREAD as error:
        raise NoSuchState(f"{path} is not the {FIELDS} of a run: {error}") from None


def _read(file: h5py.File, step: int | None) -> SectionState:
    group = file["increments"]
    shape = (*group["step"].shape, *file["radii"].shape)
    shape = (*shape, *file["angles"].shape) if "angles" in file else shape
    fields = {name: group[name] for name in ("pressure", *SHEARS) if name in group}
    for field in fields.values():
        refuse_other_shape(field, shape)
    scene = json.loads(text(file["scene"]))
    fineness = FiniteElementDiscretisation.model_validate_json(text(file["discretisation"]))
    steps = values(group["step"]).astype(int)
    chosen = _existing(step, sorted(set(steps.tolist())))
    last = int(np.flatnonzero(steps == chosen)[-1])
    at_end = {name: values(field, last) for name, field in fields.items()}
    angles = values(file["angles"]) if "angles" in file else None
    tractions = SurfaceTractions(values(file["radii"]), at_end.pop("pressure"), angles, **at_end)
    return SectionState(
        scene["title"],
        _body(scene["body"]),
        _body(scene["indenter"]),
        _own_radius(fineness),
        chosen,
        tractions,
    )


def _own_radius(asked: FiniteElementDiscretisation) -> FiniteElementDiscretisation:
    """Elements over the circle that is loaded at the end of the step, not over the largest one."""
    return asked.model_copy(update={"contact_radius": None})


def _body(description: dict[str, object]) -> Body:
    return Body.model_validate({name: description[name] for name in ("material", "layers")})


def _existing(step: int | None, steps: list[int]) -> int:
    if step is None:
        return steps[-1]
    if step not in steps:
        raise NoSuchState(f"there is no step {step}; the run has steps {steps[0]} to {steps[-1]}")
    return step
