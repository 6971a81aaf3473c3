"""Verification cases that compare the three solvers with each other, and with CalculiX.

The contacts are a rigid ball on coated bodies, with and without friction. Tractions are compared on
the line through the contact centre along the load. A difference counts by the area of the ring it
lies on, so that the edges of contact and stick zone have a small weight.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations, product
from types import SimpleNamespace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene import FiniteElementDiscretisation, LoadStep, Scene
from contact_scene.array_types import Field
from fem_reference.stress import SurfaceTractions
from fem_reference.stress import subsurface as section_field
from semi_analytical.frf.depth import Level as Depth
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress import subsurface
from verification.closed_forms.hertz import PointContact
from verification.exhibits.chart import Look, Panel, curve, stacked
from verification.judging.case import (
    OVER_ANGLES,
    OVER_RINGS,
    AnyRun,
    Case,
    Level,
    RadiiRun,
    Run,
    SectionRun,
    per_radius,
)
from verification.judging.declared_case import (
    FORCE,
    Judged,
    Within,
    case,
    compared,
    error_norm,
    judged,
    on_cells,
    on_elements,
)
from verification.judging.field_errors import pressure_at, shear_at
from verification.norms import max_norm
from verification.problems.problem import (
    FRICTION,
    HERTZ,
    NORMAL_FORCE,
    Problem,
    ReferenceKind,
    coated,
    exact_contact,
    film,
    pressed,
    pressing,
    rigid_ball,
    square_grid,
    tangential_step,
)
from verification.quantities import relative_difference, shear_of, tractions_along_load
from verification.references import load_reference

Results = Mapping[str, Any]

MARGIN = 1.15  # half the window side over the contact radius without friction
WITHIN = 0.85  # largest judged radius over the frictionless contact radius; edges are steep
POINTS = 801  # on the line of the load
# Number of increments by µ; equal for all solvers, uniform in contact radius.
INCREMENTS = {0.0: 1, 0.1: 20, 0.3: 80}
PARTS = (0.3, 0.6, 0.9)  # of µW, one load step each
# The radial solver takes 24 rings under a tangential load. Between them the shear is linear.
ON_FEW_RINGS = 3.0
ASKED = "accuracy target of two solvers that share only the scene"
HAND = "set by hand: three times the errors of both on the coarsest meshes here"


@dataclass(frozen=True)
class Contact:
    """Hold a contact of a rigid ball on a coated half-space that all three solvers compute.

    modulus_ratio  Young's modulus E1 of the coating over E2 of the substrate
    thickness      coating thickness over the Hertz contact radius of the uncoated substrate
    friction       coefficient of friction µ
    cells          number of cells per side of the window
    elements       number of finite elements over the frictionless contact radius
    harmonics      highest angular harmonic of the finite elements; 0: no tangential load
    """

    modulus_ratio: float
    thickness: float
    friction: float
    cells: int
    elements: int
    harmonics: int = 0

    @property
    def name(self) -> str:
        """Label of the contact in reports: modulus ratio, coating thickness, and friction."""
        numbers = f"E1/E2 = {self.modulus_ratio:g}, h = {self.thickness:g} a_H, µ = "
        return f"{numbers}{self.friction:g}" + (", pushed" if self.harmonics else "")

    @property
    def radius(self) -> float:
        """Contact radius without friction, from the semi-closed solution of the coated contact
        [length].
        """
        return exact_contact(coated(film(self.modulus_ratio, self.thickness))).contact_radius

    @property
    def runs(self) -> tuple[AnyRun, AnyRun, AnyRun]:
        """Runs of the contact by the three solvers: on cells, on finite elements, and by the radial
        solver.
        """
        scene = self._coated_scene
        mesh = per_radius(self.elements, self.radius)
        if self.harmonics:
            mesh = mesh.model_copy(update={"harmonics": self.harmonics})
        grid = square_grid(self.cells, MARGIN * self.radius)
        return (
            Run(f"{self.name}, {self.cells} x {self.cells} cells", scene, grid),
            SectionRun(f"{self.name}, {self.elements} elements", scene, mesh),
            RadiiRun(
                f"{self.name}, on radii", scene, laws=OVER_ANGLES if self.harmonics else OVER_RINGS
            ),
        )

    @property
    def _coated_scene(self) -> Scene:
        push: tuple[LoadStep, ...] = ()
        if self.harmonics:
            push = tuple(tangential_step(part, 6) for part in PARTS)
        return pressed(
            f"Rigid ball on a coated half-space, {self.name}",
            rigid_ball(),
            coated(film(self.modulus_ratio, self.thickness)),
            pressing(INCREMENTS[self.friction]),
            *push,
            friction=self.friction,
        )

    def tractions(self, result: Any, step: int) -> tuple[Field, Field, Field]:
        """Interpolate pressure and shear of a result to points on the line through the contact
        centre.

        The line has the direction of the tangential load. Without tangential load it begins at the
        centre. Used to compare the tractions of solvers with different discretisations.

        result  result of any solver
        step    index of the load step, at whose end the tractions are taken

        Returns the positions [length], the pressure and the shear component along the line
        [force/length²], each of shape (801,).
        """
        places, p, q = tractions_along_load(result, result.steps[step])
        reach = WITHIN * self.radius
        x = np.linspace(-reach if self.harmonics else 0.0, reach, POINTS)
        # Tractions on rings are linear in between; those on cells are means of smooth ones.
        if hasattr(result, "grid"):
            return x, CubicSpline(places, p)(x), CubicSpline(places, q)(x)
        return x, np.interp(x, places, p), np.interp(x, places, q)

    def apart(self, of: str, step: int, one: Any, other: Any) -> float:
        """Compute the mean difference of the pressure or of the shear between two results [1].

        The result is ∫|Δp| dA / ∫p dA for the pressure, and ∫|Δq| dA / ∫µp dA for the shear along
        the load. Each point of the line through the centre stands for a ring of area ∝ |x|.

        of          compared traction: "pressure" or "shear"
        step        index of the load step, at whose end the results are compared
        one, other  results of two solvers
        """
        (x, p, q), (_, p_other, q_other) = (self.tractions(r, step) for r in (one, other))
        area, limit = np.abs(x), self.friction * p_other
        off, whole = (p - p_other, p_other) if of == "pressure" else (q - q_other, limit)
        return float(np.sum(np.abs(off) * area) / np.sum(whole * area))

    def comparisons(self) -> tuple[Judged, ...]:
        """List the judged comparisons of every two of the three solvers at the end of every load
        step.

        Compared are pressure and approach, with friction also the shear, and with a tangential load
        also the stick area and the tangential shift.
        """
        measures: dict[str, tuple[str, Callable[[int, Any, Any], float], float, str]] = {
            "pressure": (
                "∫|Δp| dA / ∫p dA on the line of the load",
                partial(self.apart, "pressure"),
                2e-3,
                HAND,
            ),
            "approach": (
                "approach, relative",
                partial(relative_difference, "approach"),
                2e-4,
                HAND,
            ),
        }
        if self.friction:
            measures["shear"] = (
                "∫|Δq| dA / ∫µp dA on the line of the load",
                partial(self.apart, "shear"),
                1e-2,
                ASKED,
            )
        if self.harmonics:  # otherwise the stick radius is known to one element only
            measures["stick_area"] = (
                "stick area over contact area",
                _stick_apart,
                3e-2,
                ASKED,
            )
            measures["shift"] = (
                "shift, relative",
                partial(relative_difference, "tangential_shift"),
                1.5e-3,
                HAND,
            )
        parts = (0.0, *PARTS) if self.harmonics else (0.0,)
        return tuple(
            compared(
                f"{name}_difference" + (f"_at_{part:g}" if self.harmonics else ""),
                f"difference of two solvers: {meaning}"
                + (f", at {part:g} µW" if self.harmonics else ""),
                one,
                other,
                partial(difference, step),
                allowed * (ON_FEW_RINGS if name == "shear" and self.harmonics and rings else 1.0),
                because,
                "the other solver, on the same increments",
                ReferenceKind.OTHER_SOLVER,
            )
            for one, other in combinations(self.runs, 2)
            for rings in (isinstance(other, RadiiRun),)
            for step, part in enumerate(parts)
            for name, (meaning, difference, allowed, because) in measures.items()
            if part or name != "shift"
        )

    def stress_apart(self, one: Any, other: Any) -> float:
        """Compute the largest stress difference between cells and finite elements, over the peak
        pressure.

        The points lie on the axis from 0.1 to 3 contact radii, and on both sides of the interface
        up to 1.5 contact radii. The finite element tractions are applied to another section mesh
        for the stress. The tractions on cells are extended by zeros to a window of 1.5 times the
        width.

        one    result on cells
        other  result on finite elements
        """
        a, body = self.radius, self._coated_scene.body
        depth, end, grid = body.layers[0].thickness, one.steps[-1], one.grid
        mesh = FiniteElementDiscretisation(elements_per_radius=32)
        section = section_field(body, SurfaceTractions.of(other.steps[-1]), mesh)
        pad = grid.cells[0] // 4
        counts = (grid.cells[0] + 2 * pad, grid.cells[1] + 2 * pad)
        wide = SurfaceGrid(counts, (counts[0] * grid.spacing[0], counts[1] * grid.spacing[1]))
        pressure, shear = (
            np.pad(end.pressure, pad),
            np.pad(shear_of(end), [(0, 0), (pad, pad), (pad, pad)]),
        )
        components, apart = [0, 1, 2, 4], []  # rr, θθ, zz, rz
        z = section.points[1, section.axis]
        on_axis = section.axis[(z >= 0.1 * a) & (z <= 3.0 * a)]
        levels = tuple(
            Depth(float(z), int(m))
            for z, m in zip(section.points[1, on_axis], section.material[on_axis], strict=True)
        )
        found = subsurface(body, wide, pressure, shear, levels).below()[1].T[components]
        apart.append(max_norm(found - section.stress()[components][:, on_axis]))
        for side in (0, 1):
            chosen = section.interface_points(depth, side)
            chosen = chosen[section.points[0, chosen] <= 1.5 * a]
            field = subsurface(body, wide, pressure, shear, (Depth(depth, side),)).along_x()
            spline = CubicSpline(field.x, field.stress[0, :, :, 0], axis=1)
            found = spline(section.points[0, chosen])[components]
            apart.append(max_norm(found - section.stress()[components][:, chosen]))
        return float(np.max(apart) / np.max(end.pressure))

    def panels(self, results: Results) -> tuple[Panel, Panel]:
        """Draw pressure and shear of the last load step on the line through the centre along the
        load.

        The curves of the finite elements are grey and lie below those of the cells.

        results  results of the case by label of the run

        Returns one panel for the pressure and one for the shear.
        """
        (x, p, q), (_, p_grey, q_grey) = (
            self.tractions(results[run.label], -1) for run in self.runs[:2]
        )
        unit = np.max(p)
        pressure, shear = (
            Panel(
                x_label="x / a",
                y_label=label,
                curves=(
                    curve("elements", x / self.radius, grey / scale, Look.REFERENCE),
                    curve("cells", x / self.radius, colour / scale),
                ),
                title=title,
                height=1.4,
            )
            for label, title, grey, colour, scale in (
                ("p / p₀", self.name, p_grey, p, unit),
                ("q / µp₀", "", q_grey, q, unit * (self.friction or 1.0)),
            )
        )
        return pressure, shear


def _stick_apart(step: int, one: Any, other: Any) -> float:
    ends = one.steps[step], other.steps[step]
    a, b = ((end.stick_radius or 0.0) ** 2 / end.contact_radius**2 for end in ends)
    return float(abs(a - b))


FEW_CONTACTS = ((2.0, 1.0, 0.1), (10.0, 0.25, 0.0), (0.25, 2.0, 0.1))
MORE_CONTACTS = (*FEW_CONTACTS, (4.0, 1.0, 0.3))
# A coating of the base material has no effect, so that one thickness is sufficient.
EVERY_CONTACT = tuple(
    (ratio, thickness, friction)
    for ratio, thickness, friction in product(
        (0.25, 0.5, 1.0, 2.0, 4.0, 10.0), (0.25, 1.0, 2.0), INCREMENTS
    )
    if ratio != 1.0 or thickness == 1.0
)


def contacts(level: Level) -> tuple[Contact, ...]:
    """Return the contacts that are computed to compare the three solvers.

    The last contact has a tangential load, the others are pressed only. The full level has every
    combination of modulus ratio, coating thickness and friction.
    """
    chosen, cells, elements, harmonics = {
        Level.QUICK: (FEW_CONTACTS, 96, 32, 8),
        Level.STANDARD: (MORE_CONTACTS, 192, 64, 12),
        Level.FULL: (EVERY_CONTACT, 128, 64, 16),
    }[level]
    return (
        *(Contact(*of, cells, 64) for of in chosen),
        Contact(2.0, 1.0, FRICTION, 64 * 2**level, elements, harmonics),
    )


def cross_check(level: Level = Level.QUICK) -> Case:
    """Create the verification case that compares the three solvers on equal coated contacts.

    Judged are the differences of tractions, approach, stick area and shift between every two
    solvers. The subsurface stress on cells and on finite elements is compared for the first
    contact.
    """
    chosen = contacts(level)
    first = chosen[0]
    return case(
        "cross_check",
        "Three solvers on coated contacts",
        "A rigid ball is pressed on coated half-spaces with equal increments by three solvers: "
        "cells with Fourier transforms, axisymmetric finite elements, and the radial solver. On "
        "a coating twice as stiff as its base the ball is pressed by 1 kN and then loaded "
        "tangentially to 0.3, 0.6 and 0.9 of µW. Every two solvers are compared. Cells and the "
        "radial solver share the response of layers to one wavenumber; otherwise the three "
        "solvers share only the scene.",
        *(comparison for one in chosen for comparison in one.comparisons()),
        compared(
            "stress_difference",
            "largest difference of a component of the stress over p₀: on the axis from 0.1 to 3 "
            "contact radii, above the interface and below it",
            first.runs[0],
            first.runs[1],
            first.stress_apart,
            5e-3,
            "set by hand: five times the error of the stress recovery of elements, against "
            "Huber's stress on an equally fine mesh",
            "the other solver, on the same increments",
            ReferenceKind.OTHER_SOLVER,
            1e-3,
        ),
        charts=(
            lambda results: stacked(
                "cross_check_profiles",
                "Tractions by both solvers",
                "Pressure (left) and shear (right) on the line of the load for some of the "
                "contacts: finite elements in grey below cells.",
                *(one.panels(results) for one in (*chosen[:3], chosen[-1])),
            ),
        ),
        limits=(
            "All solvers take equal increments, so that the increment error is not visible.",
            "Errors next to the edge and to kinks of the shear count by the area of these regions.",
        ),
        equations=(
            r"\mathbf{u} = \mathbf{C} * (\mathbf{q}, p),\quad p \ge 0,\ g \ge 0,\ p g = 0,\quad "
            r"|\mathbf{q}| \le \mu p,\ \mu p \, \dot{\mathbf{s}} = -|\dot{\mathbf{s}}| \mathbf{q}",
        ),
        no_order="two solvers are compared on one discretisation; orders are judged in cases "
        "with a known solution",
        shows=("figure 3", "figure 4", "coated friction"),
    )


LEFT_OF_CORRECTION = 1 / 20
NAME = "external_code_calculix"
# The recorded ball: W [N], R [mm], E [MPa], ν. Its gap is measured on the moved surface, which
# raises the load by (1-2ν)(1+ν) p_H / 2E.
MODULUS = 210e3
RATIO = 0.3
RECORDED_BALL = PointContact.under_load(10.0, 1800.0, MODULUS / (1 - RATIO**2))
MOVED_GAP = (1 - 2 * RATIO) * (1 + RATIO) * RECORDED_BALL.peak_pressure / (2 * MODULUS)


def extrapolated(
    record: Mapping[str, Any], read: Callable[[Mapping[str, Any]], Any]
) -> tuple[Any, Any]:
    """Extrapolate numbers that CalculiX computed to rigid contact.

    The record has three runs: a coarse mesh, a mesh that is twice as fine, and the fine mesh with
    half the contact stiffness (pressure per overlap of the surfaces).

    record  stored results of one scene
    read    function that reads the numbers of one run

    Returns the numbers and their standard uncertainty.
    """
    coarse, fine, soft = map(read, record["runs"])
    correction = fine - soft
    return fine + correction, np.hypot(LEFT_OF_CORRECTION * correction, fine - coarse)


FIRST = 0.1  # Hertz radii; nearer to the axis are its bore and, with friction, a cusp
EDGE = 3 / 16  # Hertz radii, three elements of the coarser mesh; its edge ripples that far
FORCE_ERROR = 2e-4
TRACTION_ERROR = 1e-3
OURS = (
    "twice the root sum of squares of the recorded uncertainty and that of this program: "
    f"{FORCE_ERROR:g} of the force, {TRACTION_ERROR:g} of p_H and µp_H, as for the semi-closed "
    "references"
)
NAMES = {
    "coated_frictionless": "coated, no friction",
    "coated_frictional": "coated, µ = 0.1",
}
Reader = Callable[[Any, Field], Field]


def _recorded_parts(
    name: str, row: Mapping[str, Any], cells: int, elements: int
) -> tuple[Judged, ...]:
    """Create the judged runs of one scene that CalculiX has computed, on finite elements and on
    cells.

    Judged are the normal force and the tractions. The ball is moved by the approach of the record,
    in the increments of the record.

    name      label of the scene in reports
    row       stored CalculiX results of the scene
    cells     number of cells per side
    elements  number of elements per contact radius
    """
    friction = float(row["friction"])
    step = {"increments": row["increments"]} if friction else {}
    scene = pressed(
        f"Rigid ball moved towards a body: {name}",
        rigid_ball(),
        coated(film(row["modulus_ratio"], row["thickness"])),
        LoadStep(approach=row["approach"] * HERTZ.approach, **step),
        friction=friction,
    )
    value, left = extrapolated(row, lambda run: float(run["normal_force"]))
    uncertainty = math.hypot(left, MOVED_GAP * row["runs"][1]["normal_force"])
    problem = Problem(
        scene,
        (SimpleNamespace(load=value * NORMAL_FORCE),),
        HERTZ.contact_radius,
        "references/external_code_calculix.json: CalculiX 2.20",
        ReferenceKind.EXTERNAL_CODE,
        uncertainty / value,
    )
    force = replace(FORCE, meaning="force at this approach")
    rows = [
        (problem, Within(force, 2 * math.hypot(problem.uncertainty, FORCE_ERROR), OURS)),
        _traction_row(problem, row, "pressure", 1.0, "p_H", pressure_at),
    ]
    if friction:
        rows.append(_traction_row(problem, row, "shear", friction, "µp_H", shear_at))
    return tuple(
        judged(replace(ladder, problem=answer), (within,))
        for ladder in (
            on_elements(problem, (elements,), of=name),
            on_cells(problem, (cells,), of=name),
        )
        for answer, within in rows
    )


def _traction_row(
    problem: Problem, record: Mapping[str, Any], name: str, part: float, unit: str, read: Reader
) -> tuple[Problem, Within]:
    """Create the row that judges a computed traction against the stored CalculiX traction.

    Returns the problem with the uncertainty of this traction, and the row with the tolerance.

    problem  problem of the recorded scene
    record   stored CalculiX results of the scene
    name     "pressure" or "shear"
    part     error scale over the Hertz peak pressure p_H: 1, or µ for the shear
    unit     description of the error scale
    read     function that interpolates the computed traction to given radii
    """
    last = min(run["radii"][-1] for run in record["runs"]) - EDGE
    coarse = record["runs"][0]
    radii = np.array(coarse["radii"])
    common = np.flatnonzero((radii >= FIRST) & (radii <= last))
    known, errors = extrapolated(
        record, lambda run: np.array(run[name])[(1 if run is coarse else 2) * common]
    )
    uncertainty = float(np.max(errors)) / part

    def largest_difference(result: Any, *_: Any) -> float:
        found = read(result, radii[common] * HERTZ.contact_radius) / HERTZ.peak_pressure
        return max_norm(found - known[:, None]) / part

    what = error_norm(
        name,
        f"largest difference of the {name} from {FIRST:g} to {last:.2g} a_H, over {unit}",
        largest_difference,
        unit,
    )
    within = Within(what, 2 * math.hypot(uncertainty, TRACTION_ERROR), OURS)
    return replace(problem, uncertainty=uncertainty), within


def external_codes(level: Level = Level.QUICK) -> Case:
    """Create the verification case that compares cells and finite elements with stored CalculiX
    results.

    The contacts are a rigid ball on a coating, with and without friction. Normal force, pressure
    and shear are judged.
    """
    sizes = ((128, 32), (256, 64), (512, 64))[level]
    return case(
        "external_codes",
        "Comparison with CalculiX",
        "The paper's ball, rigid, is moved by a prescribed approach towards a coating twice as "
        "stiff as its base and as thick as the Hertz radius, without friction and with µ = 0.1. "
        "The results of CalculiX for these scenes, with its own elements and contact, are "
        "stored: see docs/studies/calculix.md.",
        *(
            part
            for record in load_reference(NAME)["scenes"]
            for part in _recorded_parts(NAMES[record["name"]], record, *sizes)
        ),
        limits=(
            "In CalculiX the ball has a hundred times the radius and a hundredth of the force, "
            "because CalculiX measures the gap on the deformed surface, unlike linear theory.",
            "Its springs are removed by extrapolation. Near the axis and the edge its nodal "
            "stresses are too coarse for a comparison.",
            "Where shear is judged the contact slips, so that the shear is µp; "
            "frictional_indentation judges the effect of a stick disc.",
        ),
        equations=(
            r"\nabla \cdot \boldsymbol{\sigma} = 0,\quad p = k \max(-g, 0),\quad "
            r"|\mathbf{q}| \le \mu p",
        ),
        no_order="the records of CalculiX have two meshes; this program is judged on one "
        "discretisation",
        shows=("other codes", "coated friction"),
    )
