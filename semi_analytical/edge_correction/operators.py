"""Operators of what tractions do within the cells of a model, and pressure on a given contact.

The edge inside the cells determines the contact. The remaining problem is linear: the set of cells
in contact does not change while it is solved.
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Mask
from semi_analytical.edge.displacement import EdgeOperator
from semi_analytical.edge.film import FilmLaw, film_law
from semi_analytical.edge.kernels import PARITY, PART_OFFSETS, PARTS, EdgeKernels
from semi_analytical.edge.shape import depth_of
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.model import ContactModel
from semi_analytical.normal.normal_load import (
    Map,
    Motion,
    NormalLoad,
)
from semi_analytical.normal.normal_problem import close_gap
from semi_analytical.operator.domain import WINDOW, ReducedDomain

Row = tuple[tuple[int, str], ...]
Matrix = tuple[Row, ...]

PRESSURE: Matrix = (((1, "zz"),),)
SHEAR: Matrix = (((1, "xx"), (1, "xy")), ((1, "xy"), (1, "yy")))
APART: Matrix = (((1, "zx"), (1, "zy"), (1, "zz")),)


class EdgeOperators:
    """Of a model, each built at its first use."""

    def __init__(self, model: ContactModel) -> None:
        self.model = model

    @cached_property
    def by_pressure(self) -> EdgeOperator:
        """u_z by the pressure within the cells of the domain."""
        return self._operator(PRESSURE, self.model.domain)

    @cached_property
    def by_shear(self) -> EdgeOperator:
        """(u_x, u_y) by the shear within the cells of the window."""
        return self._operator(SHEAR, WINDOW)

    @cached_property
    def apart(self) -> EdgeOperator:
        """u_z by shear and pressure (x, y, z) within the cells of the window."""
        return self._operator(APART, WINDOW)

    def film(self, contact: Mask, domain: ReducedDomain) -> FilmLaw | None:
        """The law of the pressure at the edge of a contact (nx, ny) where layers change it within a
        few cells, and the contact is wide against them."""
        law = self._film
        return law if law and law.holds_within(np.max(depth_of(contact, domain))) else None

    @cached_property
    def _film(self) -> FilmLaw | None:
        scene = self.model.scene
        return film_law(scene.body, scene.indenter, self.model.grid.spacing)

    def _operator(self, rows: Matrix, domain: ReducedDomain) -> EdgeOperator:
        model = self.model
        kernels = [[(sign, self._kernels[name]) for sign, name in row] for row in rows]
        known = {}
        if rows is not SHEAR:
            known["zz"] = model.operator(model.grid.cells).spectrum("zz")
        cells = domain.cells(model.window.cells)
        return EdgeOperator(kernels, cells, model.convolutions, known, domain)

    @cached_property
    def _kernels(self) -> dict[str, EdgeKernels]:
        model = self.model
        dx, dy = model.grid.spacing
        parts = influence_coefficients(
            model.scene.body,
            model.scene.indenter,
            (dx / PARTS, dy / PARTS),
            (PART_OFFSETS, PART_OFFSETS),
            model.scene.rig,
        )
        return {name: EdgeKernels(name, model.coefficients, parts) for name in PARITY}


class Closed(NamedTuple):
    """Pressure (nx, ny), the gap that it leaves (nx, ny) and the motion of the load."""

    pressure: Field
    gap: Field
    motion: Motion


def closed(
    displace: Map,
    precondition: Map,
    gap: Field,
    load: NormalLoad,
    contact: Mask,
    start: Field,
    beside: Field,
    enough: float,
) -> Closed:
    """By conjugate gradients, until the part `enough` of what is not closed is left.

    gap      without the pressure (nx, ny) [length]
    load     that the cells of the contact carry
    contact  cells whose gap closes (nx, ny)
    start    a first pressure, not zero in all of them
    beside   pressure of other cells, which stays (nx, ny)
    """
    p = load.admissible(np.where(contact, start, 0.0))
    u = displace(p + beside)
    h = np.where(contact, gap, 0.0)  # without what is infinite
    motion = load.motion(p, u + h)
    projected = load.projection(contact.astype(np.float64))
    g = u + h - load.closure(motion)
    p, u, _ = close_gap(displace, precondition, projected, p, u, g, enough)
    motion = load.motion(p, u + h)
    return Closed(np.maximum(p, 0.0) + beside, u + gap - load.closure(motion), motion)
