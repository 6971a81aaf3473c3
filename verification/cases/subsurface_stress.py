"""Stress below a sliding ball, and across the interface of a coated body."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body, IsotropicMaterial, Layer
from contact_scene.residuals import worst
from semi_analytical.stress import SubsurfaceField, interfaces, subsurface, subsurface_section
from verification.closed_forms.hamilton_stress import hamilton_stress
from verification.closed_forms.huber_stress import axis_stress, huber_stress, sliding_axis_shear
from verification.exhibits.numbers import plain
from verification.exhibits.table import NONE, Table
from verification.judging.case import Case, Check, Level, Required
from verification.problems.paper_scene import HERTZ, STEEL, hertz_grid
from verification.problems.reference import Reference, ReferenceKind

if TYPE_CHECKING:
    from semi_analytical import Result

Field = NDArray[np.float64]

SLIDING = 0.3  # shear over pressure
AXIS = np.array([0.1, 0.25, 0.48, 1.0, 2.0])  # depths over the contact radius
OFF_AXIS = np.array([0.2, 0.5, 1.0])
BELOW = (0.5, 1.0)  # the same
APART = 16  # cells between places
XX, YY, ZZ, YZ, XZ = 0, 1, 2, 3, 4
COATED = Body(
    material=STEEL,
    layers=(
        Layer(
            thickness=0.5 * HERTZ.contact_radius,
            material=IsotropicMaterial(young_modulus=840e9, poisson_ratio=0.2),
        ),
    ),
)


def subsurface_stress(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    closed = ReferenceKind.CLOSED_FORM
    required = "required of subsurface stress by the project's accuracy targets"
    return Case(
        name="subsurface_stress",
        title="Stress below a sliding ball",
        problem=(
            "Hertz's pressure, sampled at the cell centres, and a shear of 0.3 times it, on a "
            "steel half-space: stress on the axis, in the plane y = 0 and below the whole contact "
            "against Huber and Hamilton. Then the same tractions on a coated body: what must be "
            "continuous across the interface, what must jump and by how much, and the tractions "
            "at the surface."
        ),
        runs=(),
        quantities=(),
        checks=(
            Check(
                "hertz_axis", "largest error of σ_zz and σ_xx on the axis, over p₀", "",
                "256x256", lambda: float(np.max(_axis_errors(256)[:, :2])),
                Reference(0.0, closed, "Huber 1904; Johnson 1985, ch. 3.4"),
                Required(1e-4, required), 1.0, "p₀",
            ),
            Check(
                "sliding_axis", "largest error of τ_xz on the axis, over p₀", "", "256x256",
                lambda: float(np.max(_axis_errors(256)[:, 2])),
                Reference(0.0, closed, "Hamilton 1983, on the axis"),
                Required(1e-4, required), 1.0, "p₀",
            ),
            Check(
                "hertz_off_axis", "largest error of σ_zz and σ_yy in the plane y = 0 at depths "
                "from 0.2 a, over p₀", "", "256x256", lambda: _off_axis_error(256),
                Reference(0.0, closed, "Huber 1904"), Required(1e-4, required), 1.0, "p₀",
            ),
            Check(
                "sliding_below", "largest error of the six components of stress below pressure "
                "and shear, at depths 0.5 a and a all over the window, over p₀", "", "256x256",
                lambda: _error_below(256), Reference(0.0, closed, "Hamilton 1983"),
                Required(1e-4, required), 1.0, "p₀",
            ),
            Check(
                "interface_continuity", "largest jump of σ_zz, σ_xz, σ_yz over p₀ and of u over "
                "its largest value", "", "coated, 64x64", _continuity,
                Reference(0.0, ReferenceKind.IDENTITY, "the bond"),
                Required(1e-10, required), 1.0, "1",
            ),
            Check(
                "in_plane_jump", "σ_xx above minus what the strains below demand of it, over p₀",
                "", "coated, 64x64", _in_plane_jump,
                Reference(0.0, ReferenceKind.IDENTITY, "in-plane strains are continuous"),
                Required(1e-10, required), 1.0, "p₀",
            ),
            Check(
                "surface_tractions", "σ_zz, σ_xz at z = 0 against the tractions, over p₀", "",
                "coated, 64x64", _surface,
                Reference(0.0, ReferenceKind.IDENTITY, "the boundary condition"),
                Required(1e-10, required), 1.0, "p₀",
            ),
        ),
        tables=_tables,
    )  # fmt: skip


@cache
def _tractions(cells: int) -> tuple[Field, Field]:
    """Hertz's pressure at the cell centres and the shear of sliding along x."""
    x, y = hertz_grid(cells).coordinates()
    p = np.asarray(HERTZ.pressure(np.hypot(x, y)))
    return p, np.stack([SLIDING * p, np.zeros_like(p)])


@cache
def _section(cells: int, sliding: bool) -> SubsurfaceField:
    p, q = _tractions(cells)
    depths = [float(d) for d in np.concatenate([AXIS, OFF_AXIS]) * HERTZ.contact_radius]
    body = Body(material=STEEL)
    return subsurface_section(body, hertz_grid(cells), p, q if sliding else None, depths)


@cache
def _axis_errors(cells: int) -> Field:
    """Errors of zz, xx (pressure alone) and xz (with shear) at the depths AXIS, over p0."""
    a, p0 = HERTZ.contact_radius, HERTZ.peak_pressure
    exact = axis_stress(AXIS * a, a, p0, STEEL.poisson_ratio)
    pressed = _section(cells, False).below()[1][: len(AXIS)]
    sliding = _section(cells, True).below()[1][: len(AXIS)]
    shear = sliding_axis_shear(AXIS * a, a, SLIDING * p0)
    columns = (pressed[:, ZZ] - exact.axial, pressed[:, XX] - exact.radial, sliding[:, XZ] - shear)
    return np.abs(np.stack(columns, axis=1)) / p0


def _off_axis_error(cells: int) -> float:
    a, p0 = HERTZ.contact_radius, HERTZ.peak_pressure
    field = _section(cells, False)
    exact = huber_stress(field.x, OFF_AXIS[:, None] * a, a, p0, STEEL.poisson_ratio)
    stress = field.stress[len(AXIS) :, ..., 0]
    errors = (stress[:, ZZ] - exact.axial, stress[:, YY] - exact.hoop)
    return float(np.max(np.abs(errors)) / p0)


def _error_below(cells: int) -> float:
    a, p0 = HERTZ.contact_radius, HERTZ.peak_pressure
    grid, depths = hertz_grid(cells), np.array(BELOW) * HERTZ.contact_radius
    found = subsurface(Body(material=STEEL), grid, *_tractions(cells), depths.tolist())
    some = slice(APART // 2, None, APART)
    X, Y = (at.ravel() for at in np.meshgrid(found.x[some], found.y[some], indexing="ij"))
    errors = []
    for depth, stress in zip(depths, found.stress[:, :, some, some], strict=True):
        places = X, Y, np.full_like(X, depth)
        exact = hamilton_stress(*places, a, p0, SLIDING * p0, STEEL.poisson_ratio)
        errors.append(np.max(np.abs(stress.reshape(6, -1) - exact)))
    return float(np.max(errors) / p0)


@cache
def _coated() -> SubsurfaceField:
    """Both sides of the interface and the surface."""
    p, q = _tractions(64)
    ((above, below),) = interfaces(COATED)
    return subsurface(COATED, hertz_grid(64), p, q, [above, below, 0.0])


def _continuity() -> float:
    field = _coated()
    jump = np.max(np.abs(field.stress[0] - field.stress[1])[[ZZ, YZ, XZ]]) / HERTZ.peak_pressure
    u = field.displacement
    return worst(jump, np.max(np.abs(u[0] - u[1])) / np.max(np.abs(u)))


def _in_plane_jump() -> float:
    """Strains e_xx, e_yy from the side below, stress from them on the side above."""
    above, below = _coated().stress[:2]
    base, film = STEEL, COATED.layers[0].material
    xx, yy, zz = below[XX], below[YY], below[ZZ]
    E, nu = base.young_modulus, base.poisson_ratio
    e_xx, e_yy = (xx - nu * (yy + zz)) / E, (yy - nu * (xx + zz)) / E
    E, nu = film.young_modulus, film.poisson_ratio
    demanded = E / (1 - nu**2) * (e_xx + nu * e_yy) + nu / (1 - nu) * zz
    return float(np.max(np.abs(above[XX] - demanded)) / HERTZ.peak_pressure)


def _surface() -> float:
    p, q = _tractions(64)
    stress = _coated().stress[2]
    errors = np.abs(np.stack([stress[ZZ] + p, stress[XZ] + q[0], stress[YZ] + q[1]]))
    return float(np.max(errors) / HERTZ.peak_pressure)


def _tables(results: Mapping[str, Result]) -> tuple[Table, ...]:
    rows = tuple(
        (
            f"{depth:g}",
            *(plain(_axis_errors(cells)[k, c], 2) for c in range(3) for cells in (64, 128, 256)),
        )
        for k, depth in enumerate(AXIS)
    )
    heads = tuple(f"{name}, {n}²" for name in ("σ_zz", "σ_xx", "τ_xz") for n in (64, 128, 256))
    return (
        Table(
            title="Error on the axis over p₀, against depth and cells",
            columns=("z / a", *heads),
            rows=rows,
            note="Second order in the cell: the pressure is sampled at cell centres. Close to the "
            "surface and to the edge of the contact the cells themselves show.",
            units=NONE,
        ),
    )
