"""Stress below one contact by both solvers: on the axis and on both sides of the interface."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from contact_scene import Body, FiniteElementDiscretisation
from fem_reference.stress import SectionField, SurfaceTractions
from fem_reference.stress import subsurface as section_field
from semi_analytical.frf.depth import Level
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress import SubsurfaceField, subsurface
from verification.cases.both_solvers.contacts import CheckedContact
from verification.exhibits.chart import Chart, Look, Panel, curve

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

Field = NDArray[np.float64]

SHALLOWEST, DEEPEST = 0.1, 3.0  # contact radii; at the surface the kink of the shear shows
ELEMENTS = 32  # per radius, of the mesh for the stress
WIDEST = 1.5  # on the interface; the grid reaches hardly further than the contact
COMPONENTS = {"rr": 0, "tt": 1, "zz": 2, "rz": 4}
PLACES = {"axis": None, "interface_above": 0, "interface_below": 1}


def stress_difference(
    contact: CheckedContact, one: semi_analytical.Result, other: fem_reference.Result
) -> float:
    """Largest difference of a component anywhere over p₀."""
    section = _section(other)
    apart = []
    for place in PLACES:
        _, on_cells, on_elements = _stresses(contact, place, one, section)
        apart.append(np.max(np.abs(on_cells - on_elements)))
    return float(np.max(apart) / contact.peak_pressure)


def stress_of_section(
    contact: CheckedContact, one: semi_analytical.Result, other: fem_reference.Result
) -> Chart:
    """Profiles of the stress, finite elements in grey."""
    panels = []
    section = _section(other)
    for place, title in (("axis", "on the axis"), ("interface_above", "above the interface")):
        at, on_cells, on_elements = _stresses(contact, place, one, section)
        curves = []
        for number, name in enumerate(COMPONENTS):
            unit = contact.peak_pressure
            curves.append(curve("", at, on_elements[number] / unit, Look.REFERENCE))
            curves.append(curve(f"σ_{name}", at, on_cells[number] / unit, series=number))
        panels.append(
            (
                Panel(
                    x_label="depth / a" if place == "axis" else "r / a",
                    y_label="σ / p₀",
                    curves=tuple(curves),
                    title=f"{contact.name}, {title}",
                    height=2.0,
                ),
            )
        )
    return Chart(
        name="cross_check_stress",
        title="Stress by both solvers",
        caption="Components of the stress on the axis and in the coating above the interface: "
        "finite elements in grey, cells on top of them.",
        rows=tuple(panels),
    )


def _stresses(
    contact: CheckedContact,
    place: str,
    one: semi_analytical.Result,
    section: SectionField,
) -> tuple[Field, Field, Field]:
    """Positions over the contact radius, and components (4, n) by cells and by elements at the
    points of the mesh."""
    a = contact.contact_radius
    body = contact.scene.body
    depth = body.layers[0].thickness
    side = PLACES[place]
    if side is None:
        z = section.points[1, section.axis]
        chosen = section.axis[(z >= SHALLOWEST * a) & (z <= DEEPEST * a)]
        at = section.points[1, chosen]
    else:
        chosen = section.side(depth, side)
        chosen = chosen[section.points[0, chosen] <= WIDEST * a]
        at = section.points[0, chosen]
    on_elements = section.stress()[list(COMPONENTS.values())][:, chosen]
    if side is None:
        levels = tuple(
            Level(float(z), int(m))
            for z, m in zip(section.points[1, chosen], section.material[chosen], strict=True)
        )
        field = _levels(one, body, levels)
        stress = field.below()[1].T
    else:
        field = _levels(one, body, (Level(depth, side),)).along_x()
        stress = CubicSpline(field.x, field.stress[0, :, :, 0], axis=1)(at)
    return at / a, np.asarray(stress[list(COMPONENTS.values())]), on_elements


def _levels(
    result: semi_analytical.Result, body: Body, levels: tuple[Level, ...]
) -> SubsurfaceField:
    """Fields on a window half as wide again as the contact's."""
    end, grid = result.steps[-1], result.grid
    pressure, shear = end.pressure, end.shear
    pad = grid.cells[0] // 4
    cells = (grid.cells[0] + 2 * pad, grid.cells[1] + 2 * pad)
    window = tuple(n * h for n, h in zip(cells, grid.spacing, strict=True))
    wide = SurfaceGrid(cells, (window[0], window[1]))
    pressure = np.pad(pressure, pad)
    if shear is not None:
        shear = np.pad(shear, [(0, 0), (pad, pad), (pad, pad)])
    return subsurface(body, wide, pressure, shear, levels)


def _section(result: fem_reference.Result) -> SectionField:
    """On a mesh of its own, from the tractions of the result."""
    asked = FiniteElementDiscretisation(elements_per_radius=ELEMENTS)
    return section_field(result.scene.body, SurfaceTractions.of(result.steps[-1]), asked)
