"""`result.h5`: every field at every increment, with units and meaning next to the numbers."""

import io
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from semi_analytical import Increment, Result
from semi_analytical.fretting import FrettingCycle
from verification.run_output.file_names import FIELDS

# Level 1 with shuffled bytes is within a tenth of the size of level 9 on these fields, at a
# fraction of its time.
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}


@dataclass(frozen=True)
class Quantity:
    """A dataset: its name, unit and meaning, and where its values come from.

    of  the value at one increment; None where the effect is off
    """

    name: str
    unit: str
    meaning: str
    of: Callable[[Increment], Any]


FIELD_QUANTITIES = (
    Quantity("pressure", "Pa", "normal traction, positive in contact", lambda i: i.pressure),
    Quantity("gap", "m", "distance of the deformed surfaces", lambda i: i.gap),
    Quantity("in_contact", "", "whether the cell is in contact", lambda i: i.in_contact),
    Quantity("shear", "Pa", "tangential traction (x, y) on the lower body", lambda i: i.shear),
    Quantity("slip", "m", "slip (x, y) of the lower body relative to the indenter, since the start",
             lambda i: i.slip),
    Quantity("slip_increment", "m", "slip (x, y) within the increment", lambda i: i.slip_increment),
    Quantity("slip_distance", "m", "way slipped since the start", lambda i: i.slip_distance),
    Quantity("dissipation", "J/m^2", "energy per area lost to friction since the start",
             lambda i: i.dissipation),
    Quantity("dissipation_increment", "J/m^2", "the same within the increment",
             lambda i: i.dissipation_increment),
    Quantity("in_stick", "", "whether the cell is in contact and sticks", lambda i: i.in_stick),
)  # fmt: skip

SCALAR_QUANTITIES = (
    Quantity("step", "", "loading step, from 1", lambda i: i.step),
    Quantity("increment", "", "increment within the step, from 1", lambda i: i.index),
    Quantity("normal_force", "N", "of the indenter on the body", lambda i: i.normal_force),
    Quantity("approach", "m", "of the bodies since first touch", lambda i: i.approach),
    Quantity("tangential_force", "N", "(x, y), of the indenter", lambda i: i.tangential_force),
    Quantity("tangential_shift", "m", "(x, y), of the indenter", lambda i: i.tangential_shift),
    Quantity("torque", "N m", "about z, of the indenter", lambda i: i.torque),
    Quantity("twist", "rad", "about z, of the indenter", lambda i: i.twist),
    Quantity("moment", "N m", "(x, y), sums of pressure times y and x", lambda i: i.moment),
    Quantity("tilt", "rad", "(x, y), slopes that close the gap at positive y and x",
             lambda i: i.tilt),
    Quantity("contact_area", "m^2", "with parts of cells", lambda i: i.contact_area),
    Quantity("contact_radius", "m", "sqrt(contact_area / pi)", lambda i: i.contact_radius),
    Quantity("stick_area", "m^2", "with parts of cells", lambda i: i.stick_area),
    Quantity("stick_radius", "m", "sqrt(stick_area / pi)", lambda i: i.stick_radius),
    Quantity("peak_pressure", "Pa", "largest pressure of a cell", lambda i: i.peak_pressure),
    Quantity("dissipated_energy", "J", "by friction, since the start",
             lambda i: i.dissipated_energy),
    Quantity("elastic_energy", "J", "stored in both bodies", lambda i: i.elastic_energy),
    Quantity("input_work", "J", "of forces and moments since the start, trapezoidal rule",
             lambda i: i.input_work),
    Quantity("unresolved_work", "J", "of the input work, what finite increments leave open",
             lambda i: i.unresolved_work),
    Quantity("energy_imbalance", "", "of the increment, over the largest energy so far",
             lambda i: i.energy_imbalance),
    Quantity("worst_residual", "", "largest dimensionless residual", lambda i: i.residuals.worst),
    Quantity("iterations", "", "of the increment", lambda i: i.iterations),
    Quantity("convolutions", "", "of the increment", lambda i: i.convolutions),
)  # fmt: skip


CYCLE_FIELDS = (
    ("dissipation", "J/m^2", "energy per area lost to friction in the cycle"),
    ("slip_amplitude", "m", "half the range of slip in the cycle"),
    ("largest_shear", "Pa", "largest shear in the cycle"),
    ("ruiz_f1", "Pa m", "largest shear times slip amplitude"),
    ("surface_tension", "Pa", "largest stress of the surface along the tangential force"),
    ("ruiz_f2", "Pa^2 m", "ruiz_f1 times the surface tension, zero under compression"),
)


def write_fields(result: Result, cycles: Sequence[FrettingCycle], directory: Path) -> None:
    """Write grid, scene, fields and scalars, and of the last cycle the fields; equal results give
    equal bytes.

    Every dataset of `increments` has the increment as its first index and one chunk per increment,
    so that one of them can be read without the others. Effects that are off have no dataset.
    """
    # Made in memory: the HDF5 library may crash the process when the disk is full.
    contents = io.BytesIO()
    with h5py.File(contents, "w") as file:
        file.attrs["description"] = "slipstick, SI units; arrays are [increment, (x, y), i, j]"
        file.attrs["tolerance"] = result.tolerance
        _write(file, "scene", result.scene.model_dump_json(), "", "what was solved (JSON)")
        for name, values in (("x", result.grid.x), ("y", result.grid.y)):
            _write(file, name, values, "m", f"cell centres along {name}")
        group = file.create_group("increments", track_order=False)
        for quantity in FIELD_QUANTITIES:
            _write_field(group, quantity, result.increments)
        for quantity in SCALAR_QUANTITIES:
            scalars = [quantity.of(increment) for increment in result.increments]
            if any(scalar is not None for scalar in scalars):
                _write(group, quantity.name, _numbers(scalars), quantity.unit, quantity.meaning)
        if cycles:
            _write_cycle(file.create_group("last_cycle", track_order=False), cycles[-1])
    (directory / FIELDS).write_bytes(contents.getbuffer())


def _write_cycle(group: Any, cycle: FrettingCycle) -> None:
    group.attrs["start_step"], group.attrs["end_step"] = cycle.cycle.start, cycle.cycle.end
    for name, unit, meaning in CYCLE_FIELDS:
        values = getattr(cycle, name)
        if values is not None:
            dataset = group.create_dataset(name, data=values, track_times=False, **COMPRESSION)
            _describe(dataset, unit, meaning)


def _write_field(group: Any, quantity: Quantity, increments: tuple[Increment, ...]) -> None:
    first = next(_present(quantity, increments), None)
    if first is None:
        return
    dataset = group.create_dataset(
        quantity.name,
        shape=(len(increments), *first.shape),
        chunks=(1, *first.shape),
        dtype=first.dtype,
        track_times=False,
        **COMPRESSION,
    )
    _describe(dataset, quantity.unit, quantity.meaning)
    for index, increment in enumerate(increments):
        values = quantity.of(increment)
        if values is not None:
            dataset[index] = values


def _present(quantity: Quantity, increments: tuple[Increment, ...]) -> Iterator[Any]:
    return (values for values in map(quantity.of, increments) if values is not None)


def _numbers(values: list[Any]) -> Any:
    """An array of values of which some may be undefined: NaN stands for these."""
    shape = np.shape(next(value for value in values if value is not None))
    return np.array([np.full(shape, np.nan) if value is None else value for value in values])


def _write(group: Any, name: str, values: Any, unit: str, meaning: str) -> None:
    _describe(group.create_dataset(name, data=values, track_times=False), unit, meaning)


def _describe(dataset: Any, unit: str, meaning: str) -> None:
    dataset.attrs["unit"] = unit
    dataset.attrs["description"] = meaning
