"""What loads the two bodies at the end of a loading step, from a result or from its directory."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from numpy.typing import NDArray

from contact_results.directory.file_names import FIELDS, SUMMARY
from contact_results.files.stored_values import (
    MISREAD,
    STEP,
    ends_of_steps,
    refuse_other_shape,
    row_of,
    text,
    values,
)
from contact_results.natural_sizes import SI, Units, natural_units, natural_units_of
from contact_results.surface import Surface, surface_of, surface_on
from contact_scene import Body, CoulombFriction, FiniteElementDiscretisation
from contact_scene.geometry import SHAPES, HeightMap, ShapedBody
from contact_scene.increment import State
from contact_scene.stated_error import ErrorStatus, StatedError, StatedErrors
from contact_scene.summary import load_summary

if TYPE_CHECKING:
    from contact_results.surface import Result

Field = NDArray[np.float64]

AXES = ("x", "y", "radii", "angles")
SCALARS = ("pressure", "shear_radial", "shear_circumferential", "shear_along_load")
VECTORS = ("shear",)

RADIAL = "radial"  # the solver whose pressure is known at every radius

OF_HEIGHTS = "the indenter is no smooth shape"
OF_MAP = "the coefficient of friction varies"


class NoSuchState(Exception):
    """The directory holds no run, or the run has no such step."""


ROUNDING = 1e-9  # of the approach: what shifts by symmetry are below


@dataclass(frozen=True)
class _End:
    """Of a stored loading step."""

    normal_force: float
    approach: float
    contact_radius: float
    peak_pressure: float


@dataclass(frozen=True)
class LoadedBodies:
    """The two bodies of a scene and what loads their surface.

    step            loading step, from 1
    axes            what the indices of the tractions count, as in `Surface`
    tractions       pressure and shear on the lower body, those that there are, by name
                    [force/length^2]
    discretisation  of finite elements; None of others
    no_root         why the pressure need not fall like a root of the distance from the edge of the
                    contact, or the shear not like the pressure; None where it does
    direction       unit vector along which the rings' angles start
    pressed         indenter, contact radius and approach, where they determine the pressure at
                    every radius; None where it is known on cells or rings alone [length]
    contact_radius, peak_pressure
                    as the run has them, which knows more than its cells; None where nobody has told
                    [length], [force/length^2]
    edges           whether the tractions have their edges inside the cells, and are means of these
    units           the contact's own, for figures
    by_increments   part of themselves by which increments may leave the tractions wrong; None where
                    nobody has stated it
    """

    title: str
    body: Body
    indenter: Body
    step: int
    axes: Mapping[str, Field]
    tractions: Mapping[str, Field]
    discretisation: FiniteElementDiscretisation | None
    no_root: str | None = None
    edges: bool = False
    by_increments: float | None = None
    direction: tuple[float, float] = (1.0, 0.0)
    pressed: tuple[ShapedBody, float, float] | None = None
    contact_radius: float | None = None
    peak_pressure: float | None = None
    units: Units = SI

    @property
    def on_rings(self) -> bool:
        """Whether the tractions are functions of the radius."""
        return "radii" in self.axes

    @property
    def surface(self) -> Surface:
        """Where the tractions live."""
        return surface_on(self.axes, self.direction)


def state_of_result(
    result: Result, step: int | None, errors: StatedErrors | None = None
) -> LoadedBodies:
    """State at the end of a step, None for the last. Raises NoSuchState.

    errors  of the result
    """
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
        _no_root(scene.indenter, scene.friction),
        end.edge_change is not None,
        None if errors is None else _by_increments(end, errors.steps[end.step - 1]),
        surface.direction,
        (scene.indenter, end.contact_radius, end.approach or 0.0)
        if result.solver == RADIAL
        else None,
        end.contact_radius,
        end.peak_pressure,
        natural_units(result),
    )


def state_of_run(directory: Path, step: int | None) -> LoadedBodies:
    """The same from the fields and the summary that `slipstick run` has written there.

    Raises NoSuchState, also for a file that is no result, and ResourceRefused.
    """
    path = directory / FIELDS
    if not path.is_file():
        raise NoSuchState(f"{directory} has no {FIELDS}; give the output of a run, or a scene file")
    try:
        with h5py.File(path) as file:
            state = _read(file, step)
    except MISREAD as error:
        raise NoSuchState(f"{path} is not the {FIELDS} of a run: {error}") from None
    return replace(state, by_increments=_stated_by_increments(directory / SUMMARY, state.step))


def _stated_by_increments(path: Path, step: int) -> float | None:
    """What the summary of a run says; None where there is none that says it."""
    try:
        end = load_summary(path.read_text(encoding="utf-8")).steps[step - 1]
    except (OSError, ValueError, IndexError):
        return None
    return None if end.errors is None else _by_increments(end, end.errors)


def _by_increments(end: State, errors: Mapping[str, StatedError]) -> float | None:
    """Stress is linear in the tractions, whose largest change by increments is that of the peak
    pressure or, with the shear, of the shift; of the contact radius, where the peak has no error
    because it is infinite. None where nobody tells."""
    peak = errors.get("peak_pressure")
    of_pressure = "contact_radius" if peak is None or peak.error is None else "peak_pressure"
    parts = []
    for name in (of_pressure, "approach", "tangential_shift"):
        value, error = getattr(end, name), errors.get(name)
        if value is None or error is None or error.status is ErrorStatus.EXACT:
            continue
        if error.error is None:
            return None
        size = float(np.max(np.abs(value)))
        if size > ROUNDING * abs(end.approach or 0.0):  # nothing is known by the digits of a zero
            parts.append(float(np.max(error.parts.get("increments", 0.0))) / size)
    return max(parts, default=0.0)


def _read(file: h5py.File, step: int | None) -> LoadedBodies:
    group = file["increments"]
    axes = [name for name in AXES if name in file]
    shape = tuple(n for name in axes for n in file[name].shape)
    stored = {name: group[name] for name in (*SCALARS, *VECTORS) if name in group}
    scene = json.loads(text(file["scene"]))
    steps = values(group["step"]).astype(int)
    for name, field in stored.items():
        inner = (2, *shape) if name in VECTORS else shape
        kept = len(ends_of_steps(steps)) if field.dims[0].label == STEP else len(steps)
        refuse_other_shape(field, (kept, *inner))
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
        {name: values(field, row_of(field, last)) for name, field in stored.items()},
        asked,
        _no_root_of(scene),
        "edge_change" in group and bool(np.isfinite(values(group["edge_change"], last))),
        direction=_direction(file),
        pressed=_pressed(file, scene, last),
        contact_radius=float(values(group["contact_radius"], last)),
        peak_pressure=float(values(group["peak_pressure"], last)),
        units=_units(group, scene, steps),
    )


def _pressed(
    file: h5py.File, scene: Mapping[str, Any], at: int
) -> tuple[ShapedBody, float, float] | None:
    if file.attrs.get("solver") != RADIAL:
        return None
    group, indenter = file["increments"], scene["indenter"]
    radius, approach = (float(values(group[n], at)) for n in ("contact_radius", "approach"))
    return SHAPES[indenter["shape"]].model_validate(indenter), radius, approach


def _units(group: h5py.Group, scene: Mapping[str, Any], steps: NDArray[np.int64]) -> Units:
    """Of a description whose maps may be gone."""
    names = [field.name for field in fields(_End)]
    ends = [_End(*(float(values(group[n], at)) for n in names)) for at in ends_of_steps(steps)]
    body, indenter, friction = _body(scene["body"]), scene["indenter"], scene["friction"]
    shape = SHAPES[indenter["shape"]]
    tip = None if shape is HeightMap else shape.model_validate(indenter)
    mu = None if friction is None else friction["coefficient"]
    coated = bool(body.layers or indenter["layers"])
    return natural_units_of(tip, body, None if isinstance(mu, Mapping) else mu, ends, coated=coated)


def _direction(file: h5py.File) -> tuple[float, float]:
    x, y = file.attrs.get("direction", (1.0, 0.0))
    return float(x), float(y)


def _no_root_of(scene: Mapping[str, Any]) -> str | None:
    """The same of the description that a run has written, whose maps may be gone."""
    shape = SHAPES[scene["indenter"]["shape"]]
    if shape is HeightMap:
        return OF_HEIGHTS
    friction = scene["friction"]
    if friction is not None and isinstance(friction["coefficient"], Mapping):
        return OF_MAP
    return _no_root(shape.model_validate(scene["indenter"]), None)


def _no_root(indenter: ShapedBody, friction: CoulombFriction | None) -> str | None:
    if indenter.rim is not None:
        return "the contact ends at the rim of the indenter"
    if indenter.extent is not None or indenter.gap_exponent is None:
        return OF_HEIGHTS
    if friction is not None and friction.varying is not None:
        return OF_MAP
    return None


def _body(description: dict[str, object]) -> Body:
    return Body.model_validate({name: description[name] for name in ("material", "layers")})


def _existing(step: int | None, steps: list[int]) -> int:
    if step is None:
        return steps[-1]
    if step not in steps:
        raise NoSuchState(f"there is no step {step}; the run has steps {steps[0]} to {steps[-1]}")
    return step
