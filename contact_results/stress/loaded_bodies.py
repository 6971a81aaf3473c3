"""What loads the two bodies at the end of a loading step, from a result or from its directory."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np
from numpy.typing import NDArray

from contact_results.directory.file_names import FIELDS
from contact_results.files.stored_values import MISREAD, refuse_other_shape, text, values
from contact_results.surface import surface_of
from contact_scene import Body, FiniteElementDiscretisation

if TYPE_CHECKING:
    from contact_results.surface import Result

Field = NDArray[np.float64]

AXES = ("x", "y", "radii", "angles")
SCALARS = ("pressure", "shear_radial", "shear_circumferential", "shear_along_load")
VECTORS = ("shear",)


class NoSuchState(Exception):
    """The directory holds no run, or the run has no such step."""


@dataclass(frozen=True)
class LoadedBodies:
    """The two bodies of a scene and what loads their surface.

    step            loading step, from 1
    axes            what the indices of the tractions count, as in `Surface`
    tractions       pressure and shear on the lower body, those that there are, by name
                    [force/length^2]
    discretisation  of finite elements; None of others
    """

    title: str
    body: Body
    indenter: Body
    step: int
    axes: Mapping[str, Field]
    tractions: Mapping[str, Field]
    discretisation: FiniteElementDiscretisation | None

    @property
    def on_rings(self) -> bool:
        """Whether finite elements found the tractions."""
        return "radii" in self.axes


def state_of_result(result: Result, step: int | None) -> LoadedBodies:
    """State at the end of a step, None for the last. Raises NoSuchState."""
    ends = {end.step: end for end in result.steps}
    end = ends[_existing(step, sorted(ends))]
    surface, scene = surface_of(result), result.scene
    names = [name for name in (*SCALARS, *VECTORS) if hasattr(end, name)]
    tractions = {name: surface.scalar(end, name) for name in names}
    return LoadedBodies(
        scene.title,
        scene.body,
        Body(material=scene.indenter.material, layers=scene.indenter.layers),
        end.step,
        surface.axes,
        {name: field for name, field in tractions.items() if field is not None},
        getattr(result, "discretisation", None),
    )


def state_of_run(directory: Path, step: int | None) -> LoadedBodies:
    """The same from the fields that `slipstick run` has written there.

    Raises NoSuchState, also for a file that is no result, and ResourceRefused.
    """
    path = directory / FIELDS
    if not path.is_file():
        raise NoSuchState(f"{directory} has no {FIELDS}; give the output of a run, or a scene file")
    try:
        with h5py.File(path) as file:
            return _read(file, step)
    except MISREAD as error:
        raise NoSuchState(f"{path} is not the {FIELDS} of a run: {error}") from None


def _read(file: h5py.File, step: int | None) -> LoadedBodies:
    group = file["increments"]
    axes = [name for name in AXES if name in file]
    shape = tuple(n for name in axes for n in file[name].shape)
    fields = {name: group[name] for name in (*SCALARS, *VECTORS) if name in group}
    for name, field in fields.items():
        inner = (2, *shape) if name in VECTORS else shape
        refuse_other_shape(field, (*group["step"].shape, *inner))
    scene = json.loads(text(file["scene"]))
    steps = values(group["step"]).astype(int)
    chosen = _existing(step, sorted(set(steps.tolist())))
    last = int(np.flatnonzero(steps == chosen)[-1])
    asked = None
    if "discretisation" in file:
        asked = FiniteElementDiscretisation.model_validate_json(text(file["discretisation"]))
    return LoadedBodies(
        scene["title"],
        _body(scene["body"]),
        _body(scene["indenter"]),
        chosen,
        {name: values(file[name]) for name in axes},
        {name: values(field, last) for name, field in fields.items()},
        asked,
    )


def _body(description: dict[str, object]) -> Body:
    return Body.model_validate({name: description[name] for name in ("material", "layers")})


def _existing(step: int | None, steps: list[int]) -> int:
    if step is None:
        return steps[-1]
    if step not in steps:
        raise NoSuchState(f"there is no step {step}; the run has steps {steps[0]} to {steps[-1]}")
    return step
