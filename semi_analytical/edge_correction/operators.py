"""Operators of what tractions do within the cells of a model."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.displacement import EdgeOperator
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.film_response import film_law
from semi_analytical.edge.kernels import PARITY, PART_OFFSETS, PARTS, EdgeKernels
from semi_analytical.edge.mirrored_displacement import MirroredEdgeOperator
from semi_analytical.edge.shape import depth_of
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.model import ContactModel
from semi_analytical.part import Part

Mask = NDArray[np.bool_]
Shape = tuple[int, int]
Row = tuple[tuple[int, str], ...]
Matrix = tuple[Row, ...]

PRESSURE: Matrix = (((1, "zz"),),)
SHEAR: Matrix = (((1, "xx"), (1, "xy")), ((1, "xy"), (1, "yy")))
APART: Matrix = (((1, "zx"), (1, "zy"), (1, "zz")),)


class EdgeOperators:
    """Of a model, each built when first asked for, and kept on the whole window and one box."""

    def __init__(self, model: ContactModel) -> None:
        self.model = model
        self._known: dict[tuple[Matrix, Shape], EdgeOperator] = {}

    def by_pressure(self, shape: Shape) -> EdgeOperator | MirroredEdgeOperator:
        """u_z by the pressure within the cells of the part that tells pressures."""
        if not self.model.part.quarter:
            return self._operator(PRESSURE, shape)
        return self._mirrored

    @cached_property
    def _mirrored(self) -> MirroredEdgeOperator:
        nx, ny = self.model.grid.cells
        kernels, counter = self._kernels["zz"], self.model.convolutions
        cells = nx // 2, ny // 2
        known = self.model.pressure_operator(cells).symbols[0]
        return MirroredEdgeOperator(kernels, cells, counter, known)

    def by_shear(self, shape: Shape) -> EdgeOperator:
        """(u_x, u_y) by the shear."""
        return self._operator(SHEAR, shape)

    def apart(self, shape: Shape) -> EdgeOperator:
        """u_z by shear and pressure (x, y, z)."""
        return self._operator(APART, shape)

    def film(self, contact: Mask, part: Part) -> FilmLaw | None:
        """The law of the pressure at the edge of a contact (nx, ny) where layers change it within a
        few cells, and the contact is wide against them."""
        law = self._film
        return law if law and law.holds_within(np.max(depth_of(contact, part))) else None

    @cached_property
    def _film(self) -> FilmLaw | None:
        scene = self.model.scene
        return film_law(scene.body, scene.indenter, self.model.grid.spacing)

    def _operator(self, rows: Matrix, shape: Shape) -> EdgeOperator:
        key = rows, shape
        if key not in self._known:
            whole = self.model.grid.cells
            if shape != whole:
                for other in [k for k in self._known if k[0] == key[0] and k[1] != whole]:
                    del self._known[other]
            kernels = [[(sign, self._kernels[name]) for sign, name in row] for row in rows]
            known = {}
            if rows is not SHEAR:
                known["zz"] = self.model.normal_operator(shape).symbols[0]
            self._known[key] = EdgeOperator(kernels, shape, self.model.convolutions, known)
        return self._known[key]

    @cached_property
    def _kernels(self) -> dict[str, EdgeKernels]:
        model = self.model
        dx, dy = model.grid.spacing
        parts = influence_coefficients(
            model.scene.body,
            model.scene.indenter,
            (dx / PARTS, dy / PARTS),
            (PART_OFFSETS, PART_OFFSETS),
        )
        return {name: EdgeKernels(name, model.coefficients, parts) for name in PARITY}
