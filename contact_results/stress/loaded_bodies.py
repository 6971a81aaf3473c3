"""Tractions and bodies at the end of an increment, from a result or from its directory."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.directory.atomic_file import Refused
from contact_results.directory.file_names import FIELDS
from contact_results.stress.points import StressPoints
from contact_results.surface import Surface, surface_of, surface_on
from contact_scene import Body, CoulombFriction, FiniteElementDiscretisation, Scene
from contact_scene.array_types import Field
from contact_scene.bulk_strain import Strain, stress_by
from contact_scene.discretised import Fineness
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.increment import State
from contact_scene.quantities.stated_error import (
    ErrorStatus,
    Part,
    StatedError,
    StatedErrors,
)

if TYPE_CHECKING:
    from contact_results.files.stored_run import StoredRun
    from contact_results.surface import Result


TRACTIONS = ("pressure", "shear_radial", "shear_circumferential", "shear_along_load", "shear")

RADIAL = "radial"  # name of the solver with an analytical pressure between the rings

OF_HEIGHTS = "the indenter is not a smooth shape"
OF_MAP = "the coefficient of friction varies"


class NoSuchState(Refused):
    """The directory has no readable run, or the run has no such load step in contact."""


ROUNDING = 1e-9  # relative to the approach: smaller shifts are round-off
# Scalars whose errors show the error of the pressure, or the errors of pressure and shear. That of
# the peak pressure is always compared.
OF_PRESSURE = ("approach",)
OF_TRACTIONS = ("approach", "tangential_shift", "twist")


@dataclass(frozen=True)
class LoadedBodies:
    """The two bodies of a scene, and the tractions between them at the end of an increment.

    title           title of the scene
    body, indenter  layers and base material of the lower body and of the indenter
    step            load step, from 1
    axes            coordinates of the tractions, as in `Surface`
    tractions       pressure and shear on the lower body by name, if present [force/length^2]
    discretisation  settings of the finite elements; None for other solvers
    no_root         reason why the tractions may not fall like the square root of the distance from
                    the contact edge; None if they do
    edges           True if the tractions are cell means and the contact edge runs inside the cells
    by_increments   increment error of the pressure relative to the pressure; None if unknown
    shear_error     increment error of the shear relative to the shear; None if unknown
    by_map          error of the tractions by the points of a measured indenter, relative to the
                    tractions; 0 for other shapes; None if unknown
    direction       unit vector of the tangential load, at angle 0 of rings
    pressed         indenter, contact radius [length] and approach [length], if they determine the
                    pressure at every radius; None if the pressure is known on cells or rings only
    normal_force    [force], per length of a line contact; None if unknown
    contact_radius  [length]; None if unknown
    stick_radius    [length]; None if unknown
    peak_pressure   [force/length^2]; None if unknown
    strain          bulk strain of the lower body; None if there is none
    scene           scene of the result; None if unknown
    ring_fineness   rings and increments of the radial solver; None for other solvers, and if a
                    stored run does not state them
    increment       increment within the load step, from 1
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
    shear_error: float | None = None
    by_map: float | None = None
    direction: tuple[float, float] = (1.0, 0.0)
    pressed: tuple[ShapedBody, float, float] | None = None
    normal_force: float | None = None
    contact_radius: float | None = None
    stick_radius: float | None = None
    peak_pressure: float | None = None
    strain: Strain | None = None
    scene: Scene | None = None
    ring_fineness: Fineness | None = None
    increment: int = 1

    @property
    def on_rings(self) -> bool:
        """True if the tractions are given on rings, False if on cells."""
        return self.radial in self.axes

    @property
    def of_strips(self) -> bool:
        """True if the tractions are those of a line contact on pairs of lines."""
        return "distances" in self.axes

    @property
    def radial(self) -> str:
        """Name of the radii of rings, or of the distances of pairs of lines, among the axes."""
        return "distances" if self.of_strips else "radii"

    def with_bodies_of(self, scene: Scene) -> LoadedBodies:
        """Return the tractions on the bodies of a scene: solvers merge layers of equal constants.

        scene  scene of the contact, before its normal form
        """
        upper = Body(material=scene.indenter.material, layers=scene.indenter.layers)
        return replace(self, body=scene.body, indenter=upper)

    def loaded_body(self, indenter: bool) -> Body:
        """Return the indenter or the lower body."""
        return self.indenter if indenter else self.body

    def bulk_stress(self, layer: int, indenter: bool) -> Field:
        """Return the stress that the bulk strain causes in one layer or in the base.

        The stress has the components xx, yy, zz, yz, xz, xy (6,) [force/length^2]. It is zero in
        the indenter and without bulk strain.

        layer     index of the layer, 0 for the outermost; the number of layers denotes the base
        indenter  True for the indenter, False for the lower body
        """
        if self.strain is None or indenter:
            return np.zeros(6)
        return stress_by(self.strain, self.body, layer)

    def add_bulk_stress(self, points: StressPoints, indenter: bool) -> StressPoints:
        """Add the stress from the bulk strain to the stress at points of one body.

        indenter  True if the points are in the indenter, which has no bulk strain
        """
        if self.strain is None:
            return points
        layers = range(int(np.max(points.material)) + 1)
        by_layer = np.stack([self.bulk_stress(layer, indenter) for layer in layers])
        return replace(points, stress=points.stress + np.moveaxis(by_layer[points.material], -1, 0))

    @property
    def shear_turns(self) -> bool:
        """True if the shear acts in all directions: less than half of it adds up to a force."""
        if self.on_rings and "angles" not in self.axes:  # equal on all sides, or along the load
            return not np.any(self.tractions.get("shear_along_load", 0.0))
        given: Any = SimpleNamespace(**{**dict.fromkeys(TRACTIONS), **self.tractions})
        shear = self.surface.vector(given, "shear")
        if shear is None:
            return False
        weighted = shear.reshape(2, -1) * self.surface.weights.ravel()
        force = np.hypot(*np.sum(weighted, axis=1))
        return bool(force < 0.5 * np.sum(np.hypot(*weighted)))

    @property
    def surface(self) -> Surface:
        """Surface grid that carries the tractions: cells or rings."""
        return surface_on(self.axes, self.direction)


def state_of_result(
    result: Result, step: int | None, errors: StatedErrors | None = None
) -> LoadedBodies:
    """Return bodies and tractions at the end of a load step of a result.

    step    load step, from 1; None for the last
    errors  stated errors of the result; None if they were not computed

    Raises NoSuchState if there is no such load step, or if the bodies are separated.
    """
    ends = result.steps
    number = _step_index(step, len(ends))
    stated, of_shear = (
        (None, None) if errors is None else (errors.steps[number], errors.shear[number])
    )
    surface = surface_of(result)
    return _require_contact(loaded_bodies(result, surface, ends[number], stated, of_shear))


def state_of_increment(result: Result, step: int, increment: int) -> LoadedBodies:
    """Return bodies and tractions at the end of an increment of a result.

    step       load step, from 1
    increment  increment within the load step, from 1

    Raises NoSuchState if the bodies are separated.
    """
    (end,) = (one for one in result.increments if (one.step, one.index) == (step, increment))
    return _require_contact(loaded_bodies(result, surface_of(result), end))


def states_of_result(result: Result) -> Iterator[LoadedBodies]:
    """Yield bodies and tractions at the ends of all increments of a result that have contact."""
    surface = surface_of(result)
    states = (loaded_bodies(result, surface, increment) for increment in result.increments)
    return (state for state in states if state is not None)


def state_of_run(directory: Path, step: int | None) -> LoadedBodies:
    """Return bodies and tractions at the end of a load step of a stored run.

    directory  directory of the run
    step       load step, from 1; None for the last

    Raises NoSuchState if there is no readable run, no such load step, or no contact, and
    ResourceRefused if the fields do not fit into memory.
    """
    with _open_run(directory) as run:
        number = _step_index(step, len(run.summary.steps))
        end, summary = run.end_of_step(number), run.summary.steps[number]
        state = loaded_bodies(run, run.surface, end, summary.errors, summary.shear_error)
        return _require_contact(state)


def states_of_run(directory: Path) -> Iterator[LoadedBodies]:
    """Yield bodies and tractions at the ends of all increments of a run that have contact.

    directory  directory of the run

    Raises NoSuchState if there is no readable run, or if the run has no fields of all increments,
    and ResourceRefused if the fields do not fit into memory.
    """
    with _open_run(directory) as run:
        for number in range(len(run.increments["step"].array)):
            state = loaded_bodies(run, run.surface, run.increment(number))
            if state is not None:
                yield state


@contextmanager
def _open_run(directory: Path) -> Iterator[StoredRun]:
    """Provide a stored run, and convert errors of reading it in the `with` block to NoSuchState.

    directory  directory of the run
    """
    from contact_results.files.stored_run import load
    from contact_results.files.stored_values import MISREAD, FieldsAtEndsOnly

    try:
        run = load(directory)
    except (FileNotFoundError, ValueError) as error:
        raise NoSuchState(f"{error}; give the output of a run, or a scene file") from None
    try:
        yield run
    except FieldsAtEndsOnly as error:
        raise NoSuchState(f"{error}, or give the scene file") from None
    except MISREAD as error:
        raise NoSuchState(f"{directory / FIELDS} is not the {FIELDS} of a run: {error}") from None


def loaded_bodies(
    source: Result | StoredRun,
    surface: Surface,
    end: Any,
    errors: Mapping[str, StatedError] | None = None,
    shear_error: float | None = None,
) -> LoadedBodies | None:
    """Combine the tractions of an increment with the data of its scene; None without contact.

    source       result or stored run that contains the increment
    surface      surface grid of the tractions
    end          scalars and fields at the end of the increment
    errors       stated errors of these scalars, by name; None if not needed
    shear_error  increment error of the shear relative to the shear; None if unknown
    """
    if not end.contact_area:
        return None
    scene = source.scene
    pressed = (scene.indenter, end.contact_radius, end.approach or 0.0)
    fields = {name: surface.scalar(end, name) for name in TRACTIONS}
    return LoadedBodies(
        title=scene.title,
        body=scene.body,
        indenter=Body(material=scene.indenter.material, layers=scene.indenter.layers),
        step=int(end.step),
        axes=surface.axes,
        tractions={name: field for name, field in fields.items() if field is not None},
        discretisation=getattr(source, "discretisation", None),
        no_root=_reason_without_root(scene.indenter, scene.friction),
        edges=end.edge_change is not None,
        by_increments=_relative_part(end, errors, "increments", OF_PRESSURE),
        shear_error=shear_error,
        by_map=_relative_part(end, errors, "map", OF_TRACTIONS),
        direction=surface.direction,
        pressed=pressed if source.solver == RADIAL else None,
        normal_force=end.normal_force,
        contact_radius=end.contact_radius,
        stick_radius=end.stick_radius,
        peak_pressure=end.peak_pressure,
        strain=None if end.bulk_strain is None else (*end.bulk_strain, end.bulk_shear or 0.0),
        scene=scene,
        ring_fineness=getattr(source, "ring_fineness", None),
        increment=int(end.index),
    )


def _relative_part(
    end: State, errors: Mapping[str, StatedError] | None, part: Part, names: Sequence[str]
) -> float | None:
    """Estimate the relative error of the tractions that is due to one cause, such as increments.

    The estimate is the largest relative part of the errors of the peak pressure and of other
    scalars. If the peak pressure has no error because it is infinite, the contact radius replaces
    it.

    end     scalars at the end of the increment
    errors  stated errors of these scalars, by name
    part    part of the errors
    names   names of the other scalars

    Returns None if the error of any of them is unknown.
    """
    if errors is None:
        return None
    peak = errors.get("peak_pressure")
    of_pressure = "contact_radius" if peak is None or peak.error is None else "peak_pressure"
    approach = abs(end.approach or 0.0)
    round_off = {"twist": ROUNDING * approach / (end.contact_radius or inf)}
    parts = []
    for name in (of_pressure, *names):
        value, error = getattr(end, name), errors.get(name)
        if value is None or error is None or error.status is ErrorStatus.EXACT:
            continue
        if error.error is None:
            return None
        size = float(np.max(np.abs(value)))
        if size > round_off.get(name, ROUNDING * approach):  # round-off has no relative error
            parts.append(float(np.max(error.parts.get(part, 0.0))) / size)
    return max(parts, default=0.0)


def _reason_without_root(indenter: ShapedBody, friction: CoulombFriction | None) -> str | None:
    """Return the reason why the tractions may not fall like a root at the contact edge.

    For a smooth indenter without rim and with uniform friction, the tractions fall like the square
    root of the distance from the contact edge, and the result is None.
    """
    if indenter.rim is not None:
        return "the contact ends at the rim of the indenter"
    if indenter.extent is not None or indenter.gap_exponent is None:
        return OF_HEIGHTS
    if friction is not None and friction.coefficient_map is not None:
        return OF_MAP
    return None


def _require_contact(state: LoadedBodies | None) -> LoadedBodies:
    if state is None:
        raise NoSuchState(
            "the bodies are separated at the end of this step, and the stress is zero everywhere; "
            "give a --step that ends in contact"
        )
    return state


def _step_index(step: int | None, count: int) -> int:
    """Return the index of load step `step`, from 1; the last for None. Raises NoSuchState."""
    if step is not None and not 1 <= step <= count:
        raise NoSuchState(f"there is no step {step}; the run has steps 1 to {count}")
    return (count if step is None else step) - 1
