"""Comparison of three solvers on coated contacts with and without friction, and under shear.

The solvers are not compared near the axis, near the edge, and at kinks of the shear. Cells that
stick keep the error of the shear at the onset of stick. A stick edge that moves outward steadily
leaves only the ripple of its increments. A stick edge that recedes and moves outward again leaves a
kink until slip passes over it, and so does an edge that is stationary when the load turns. Cells
and elements smooth a kink in different ways.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.ndimage import map_coordinates

import fem_reference
import radial
from contact_scene import FiniteElementDiscretisation, Scene
from fem_reference.stress import SurfaceTractions
from fem_reference.stress import subsurface as section_field
from semi_analytical.frf.depth import Level as Depth
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress import subsurface
from verification.cases.points_run import PointsRun
from verification.closed_forms.coated_indentation import LayeredIndentation
from verification.exhibits.chart import NONE, Chart, Look, Panel, Table, curve, plain
from verification.judging.case import Case, Comparison, Finding, Level
from verification.judging.refinement_levels import cells_label
from verification.judging.run import (
    OVER_ANGLES,
    SOLVER_TOLERANCE,
    AnyRun,
    RadiiRun,
    Run,
    SectionRun,
)
from verification.observed.ring_errors import judged_within, outward, tractions_at
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import coated, exact_contact, film, pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, HERTZ, pressing
from verification.problems.problem import ReferenceKind
from verification.quantities import shear_of, shift_along_x

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Results = Mapping[str, Any]

MARGIN = 1.15  # half a window in contact radii without friction
JUDGED_WITHIN = 0.9  # contact radii; nearer the edge everything is steep
# In cells or elements, whichever is larger.
AXIS = 2.0  # nearer, the outward shear turns round within a cell
KINK = 2.0
FRONT = 1.5  # on a line through the contact, where fronts are known to half a spacing
EVEN = 1e-9
# Contacts grow uniformly in radius. While a contact is a few elements wide, the shear locked in has
# an error that depends on the number of elements to the axis alone; at a given radius it falls.
FEW = 8  # elements of the coarser mesh
DIRECTIONS = 16
# By µ; equal for all solvers, uniform in contact radius. Each increment leaves a ripple of the
# shear in the stick zone. The ripple falls with the increments, not with finer cells or elements.
INCREMENTS = {0.0: 1, 0.1: 20, 0.3: 80}
OWN, OTHER = ReferenceKind.OWN_REFINEMENT, ReferenceKind.OTHER_SOLVER
ASKED = "accuracy target of two solvers that share only the scene"
SOURCE = "the other solver, on the same increments"
HAND = "set by hand: twice the errors of both on the coarsest meshes here"
# What pressed contacts are compared in: allowed, and in words.
COMPARED = {
    "pressure": (5e-3, "pressure, r < 0.9 a, over p₀"),
    "shear": (2e-2, "shear, r < 0.9 a and away from its kinks, over µp₀"),
    "approach": (1e-3, "approach, relative"),
}


def kept_edges(stick_radii: Sequence[float], resolution: float) -> tuple[float, ...]:
    """Return the radii of the kinks of the shear after a sequence of increments.

    A kink remains where the stick edge turned outward and did not return later. The last radius is
    that of the present edge.

    stick_radii  after every increment
    resolution   smaller returns of the edge are ignored
    """
    c = np.asarray(stick_radii)
    least_later = np.minimum.accumulate(c[::-1])[::-1][1:]
    passed_for_good = np.flatnonzero(c[:-1] < least_later)
    since = [0, *(passed_for_good[:-1] + 1)]
    turned = (
        float(c[k])
        for start, k in zip(since, passed_for_good, strict=False)
        if np.max(c[start : k + 1]) - c[k] > resolution
    )
    return (*turned, float(c[-1]))


def kept_fronts(x: Field, stuck: Mask, turns: Sequence[int]) -> list[float]:
    """Return the positions of the kinks of the shear on a line after a sequence of increments.

    A kink remains at a stick boundary at which the load turned, if both sides have stuck since.

    x      positions of the solution on the line [length]
    stuck  (increments, positions)
    turns  increments after which the load turned; the last entry is at most the last of `stuck`,
           whose boundaries are the present ones
    """
    middles, fronts = 0.5 * (x[1:] + x[:-1]), []
    for turn in turns:
        kept = np.all(stuck[turn + 1 :], axis=0)
        between = (stuck[turn, 1:] != stuck[turn, :-1]) & kept[1:] & kept[:-1]
        fronts.extend(middles[between].tolist())
    return fronts


@dataclass(frozen=True)
class Pressed:
    """The paper's ball, rigid, pressed on a coated half-space, by all solvers, coarse and fine.

    modulus_ratio    E1 / E2, coating over substrate
    thickness        over the Hertz radius without a coating
    friction         µ
    cells, elements  of the finer run, even: along each side of the window, and over the contact
                     radius
    refined          compare cells and elements with half of their number as well
    """

    modulus_ratio: float
    thickness: float
    friction: float
    cells: int
    elements: int
    refined: bool = True

    @property
    def name(self) -> str:
        """Label for reports."""
        return f"E1/E2 = {self.modulus_ratio:g}, h = {self.thickness:g} a_H, µ = {self.friction:g}"

    @property
    def scene(self) -> Scene:
        """Scene of all solvers."""
        return pressed(
            f"Rigid ball on a coated half-space, {self.name}",
            rigid_ball(),
            coated(film(self.modulus_ratio, self.thickness)),
            pressing(INCREMENTS[self.friction]),
            friction=self.friction,
        )

    @property
    def frictionless(self) -> LayeredIndentation:
        """Semi-closed solution without friction; its radius and peak pressure are the scales."""
        return exact_contact(coated(film(self.modulus_ratio, self.thickness)))

    @property
    def on_cells(self) -> tuple[Run, Run]:
        """Coarse and fine run on cells."""
        half = MARGIN * self.frictionless.contact_radius
        coarse, fine = (
            Run(f"{self.name}, {n} x {n} cells", self.scene, paper.square_grid(n, half))
            for n in (self.cells // 2, self.cells)
        )
        return coarse, fine

    @property
    def on_elements(self) -> tuple[SectionRun, SectionRun]:
        """Coarse and fine run on elements.

        Elements are counted over the contact radius without friction, so that the finer mesh
        contains the rings of the coarser mesh.
        """
        coarse, fine = (
            SectionRun(
                f"{self.name}, {n} elements",
                self.scene,
                FiniteElementDiscretisation(
                    elements_per_radius=n,
                    contact_radius=self.frictionless.contact_radius,
                    tolerance=SOLVER_TOLERANCE,
                ),
            )
            for n in (self.elements // 2, self.elements)
        )
        return coarse, fine

    @property
    def on_radii(self) -> RadiiRun:
        """Run by the radial solver."""
        return RadiiRun(f"{self.name}, on radii", self.scene)

    @property
    def runs(self) -> tuple[AnyRun, ...]:
        """Runs of all solvers."""
        fine = self.on_cells[1], self.on_elements[1]
        own = (*self.on_cells, *self.on_elements) if self.refined else fine
        return (*own, self.on_radii)

    @property
    def resolution(self) -> float:
        """Resolution of the coarser of the fine runs, over the contact radius."""
        return max(2 * MARGIN / self.cells, 1 / self.elements)

    def radii(self, *results: Any) -> Field:
        """Return the rings of the coarser mesh at which results are compared, over the contact
        radius.

        The rings are away from the axis and within 0.9 a. Two meshes are compared beyond the first
        rings and out of reach of the edge ripple of the coarser mesh.
        """
        n, within = self.elements // 2, JUDGED_WITHIN
        meshes = all(isinstance(result, fem_reference.Result) for result in results)
        if meshes:
            # Without friction the edge is on a ring, from where its ripple reaches one further.
            within = judged_within(n) - 1 / n
        rings = np.arange(AXIS, n + 1) / n
        kept = (rings >= AXIS * 2 * MARGIN / self.cells) & (rings <= within * (1 + EVEN))
        return np.asarray(rings[kept & (rings >= FEW / n)] if meshes else rings[kept])

    def kinks(self, result: Any) -> tuple[float, ...]:
        """Return the radii of kinks of the shear of a result, over the contact radius."""
        a = self.frictionless.contact_radius
        radii = [i.stick_radius / a for i in result.increments if i.stick_radius is not None]
        return kept_edges(radii, self.resolution) if radii else ()

    def tractions(self, result: Any, radii: Field) -> tuple[Field, Field]:
        """Return the pressure over p₀ and the outward shear over µp₀ at some radii.

        Elements give the values of their rings. The radial solver is interpolated linearly. Cells
        are interpolated by cubic splines and averaged over the directions.
        """
        end, unit = result.steps[-1], float(self.frictionless.pressure(0.0))
        r, grid = radii * self.frictionless.contact_radius, getattr(result, "grid", None)
        limit = (self.friction or 1.0) * unit
        if grid is not None:
            q = outward(shear_of(end), grid)
            return _around(end.pressure, grid, r) / unit, _around(q, grid, r) / limit
        shear = 0 * end.radii if end.shear_radial is None else end.shear_radial
        if isinstance(result, radial.Result):
            return np.interp(r, end.radii, end.pressure) / unit, np.interp(
                r, end.radii, shear
            ) / limit
        found = np.rint(r / (end.radii[1] - end.radii[0])).astype(int)
        if not np.allclose(end.radii[found], r, rtol=EVEN, atol=0.0):
            raise ValueError(
                "the rings of the result are not at the requested radii. Request "
                "radii of the coarser mesh"
            )
        return end.pressure[found] / unit, shear[found] / limit

    def apart(self, name: str, one: Any, other: Any) -> float:
        """Compute the largest difference of two results.

        The difference is that of the pressure, of the shear away from its kinks, or of the approach
        (relative).
        """
        if name == "approach":
            return abs(float(one.steps[-1].approach / other.steps[-1].approach) - 1)
        at = self.radii(one, other)
        (p, q), (p_other, q_other) = (self.tractions(result, at) for result in (one, other))
        if name == "pressure":
            return float(np.max(np.abs(p - p_other)))
        away = np.ones(len(at), dtype=bool)
        for edge in self.kinks(other):
            away &= np.abs(at - edge) > KINK * self.resolution
        return float(np.max(np.abs(q - q_other), where=away, initial=0.0))

    def comparisons(self) -> tuple[Comparison, ...]:
        """List the comparisons: errors of cells and elements first, then differences of every two
        solvers."""
        cells, elements, rings = self.on_cells, self.on_elements, self.on_radii
        own = (
            "the tolerance of the difference is meaningful only if the error of each solver is "
            "below it"
        )
        half, other = "the same solver on half of the cells or elements", "between the solvers"
        pairs: tuple[tuple[str, str, tuple[AnyRun, AnyRun]], ...] = (
            ("own_error_of_cells", "change from half the cells", cells),
            ("own_error_of_elements", "change from half the elements", elements),
            ("difference", other, (cells[1], elements[1])),
            ("difference_of_radial", other, (rings, cells[1])),
            ("difference_of_radial", other, (rings, elements[1])),
        )
        return tuple(
            Comparison(
                f"{name}_{which}", f"{meaning}: {words}", (first.label, second.label),
                partial(self.apart, name), allowed, because, source, kind,
            )
            for name, (allowed, meaning) in COMPARED.items()
            if name != "shear" or self.friction
            for which, words, (first, second) in (pairs if self.refined else pairs[2:])
            for because, source, kind in [
                (ASKED, SOURCE, OTHER) if words == other else (own, half, OWN)
            ]
        )  # fmt: skip

    def findings(self) -> tuple[Finding, ...]:
        """List stick radius and dissipated energy on cells and elements."""
        numbers: dict[str, tuple[str, Callable[[Any], float]]] = {
            "stick_radius": ("stick radius over contact radius", _stick_ratio),
            "dissipated_energy": ("energy dissipated by friction over W δ", _energy_ratio),
        }
        return tuple(
            Finding(
                f"{name}_{kind}", meaning, "", run.label, read, "compare the other solver's"
            )
            for name, (meaning, read) in numbers.items()
            for kind, run in (("cells", self.on_cells[1]), ("elements", self.on_elements[1]))
            if self.friction
        )  # fmt: skip

    def stress_apart(self, one: Any, other: Any) -> float:
        """Compute the largest difference of a stress component, over p₀.

        Points are on the axis from 0.1 to 3 contact radii, and on both sides of the interface up to
        1.5 contact radii. The stress by elements takes the tractions of the result on a separate
        mesh; the stress by cells takes a window of 1.5 times the width.
        """
        a, body = self.frictionless.contact_radius, self.scene.body
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
        apart.append(np.max(np.abs(found - section.stress()[components][:, on_axis])))
        for side in (0, 1):
            chosen = section.side(depth, side)
            chosen = chosen[section.points[0, chosen] <= 1.5 * a]
            field = subsurface(body, wide, pressure, shear, (Depth(depth, side),)).along_x()
            spline = CubicSpline(field.x, field.stress[0, :, :, 0], axis=1)
            found = spline(section.points[0, chosen])[components]
            apart.append(np.max(np.abs(found - section.stress()[components][:, chosen])))
        return float(np.max(apart) / float(self.frictionless.pressure(0.0)))

    def panels(self, results: Results) -> tuple[Panel, Panel]:
        """Draw the tractions over the radius: elements in grey below cells."""
        cells, elements = results[self.on_cells[1].label], results[self.on_elements[1].label]
        at = self.radii(cells, elements)
        pressure, shear = (
            Panel(
                x_label="r / a",
                y_label=label,
                curves=(
                    curve("elements", at, grey, Look.REFERENCE),
                    curve("cells", at, colour),
                ),
                title=title,
                height=1.4,
            )
            for label, title, grey, colour in zip(
                ("p / p₀", "q / µp₀"), (self.name, ""),
                self.tractions(elements, at), self.tractions(cells, at), strict=True,
            )
        )  # fmt: skip
        return pressure, shear


def _around(field: Field, grid: SurfaceGrid, r: Field) -> Field:
    """Compute the mean of a field over the directions at distances r from the axis."""
    angle = (np.arange(DIRECTIONS) + 0.5) * 2 * np.pi / DIRECTIONS
    x, y = np.outer(r, np.cos(angle)), np.outer(r, np.sin(angle))
    at = [(x - grid.x[0]) / grid.spacing[0], (y - grid.y[0]) / grid.spacing[1]]
    return np.asarray(map_coordinates(field, at, order=3).mean(axis=1))


def _stick_ratio(result: Any) -> float:
    end = result.steps[-1]
    return float(end.stick_radius / end.contact_radius)


def _energy_ratio(result: Any) -> float:
    end = result.steps[-1]
    return float(end.dissipated_energy / (end.normal_force * end.approach))


PARTS = (0.0, 0.3, 0.6, 0.9)  # of µW, one loading step each
EDGE = 0.82  # contact radius over a_H, about


@dataclass(frozen=True)
class Pushed:
    """Contact of the paper's figure 4: a rigid ball on a coating as thick as the Hertz radius.

    The ball is pressed in 20 increments, then loaded tangentially in 6 increments per step.

    modulus_ratio  E1 / E2, coating over substrate
    cells          per side, an odd number so that a row lies on y = 0
    elements       per contact radius
    harmonics      highest harmonic of the angle, for the elements
    """

    modulus_ratio: float
    cells: int
    elements: int
    harmonics: int

    @property
    def scene(self) -> Scene:
        """Scene of all solvers."""
        return pressed(
            "Coated body under a rigid ball, sheared, "
            f"E1/E2 = {self.modulus_ratio:g} (paper, figure 4)",
            rigid_ball(),
            coated(film(self.modulus_ratio, 1.0)),
            pressing(20),
            *(paper.tangential_step(part, 6) for part in PARTS[1:]),
            friction=FRICTION,
        )

    def _label(self, by: str) -> str:
        return f"E1/E2 = {self.modulus_ratio:g}, pushed, {by}"

    @property
    def on_elements(self) -> PointsRun:
        """Run by finite elements with harmonics of the angle."""
        mesh = FiniteElementDiscretisation(
            elements_per_radius=self.elements,
            contact_radius=EDGE * HERTZ.contact_radius,
            harmonics=self.harmonics,
        )
        by = f"{self.elements} elements per radius, harmonics 0 … {self.harmonics}"
        return PointsRun(self._label(by), self.scene, mesh)

    @property
    def on_cells(self) -> Run:
        """Run on cells."""
        grid = paper.square_grid(self.cells, 1.16 * EDGE * HERTZ.contact_radius)
        return Run(self._label(cells_label(self.cells)), self.scene, grid)

    @property
    def on_radii(self) -> RadiiRun:
        """Run by the radial solver on rings and angles."""
        return RadiiRun(self._label("on radii"), self.scene, laws=OVER_ANGLES)

    @property
    def fewer(self) -> PointsRun:
        """Run by finite elements with half the harmonics."""
        return replace(self, harmonics=self.harmonics // 2).on_elements

    @property
    def runs(self) -> tuple[AnyRun, ...]:
        """Runs of all solvers."""
        return (self.on_elements, self.fewer, self.on_cells, self.on_radii)

    def comparisons(self) -> tuple[Comparison, ...]:
        """List the comparisons at the end of every step; on the line of the load, of cells and
        elements."""
        direct = self.on_elements.label, self.on_cells.label
        rings = [(self.on_radii.label, other) for other in direct]
        on_line: dict[str, tuple[str, Callable[[int, Any, Any], float], float, str]] = {
            "shear": (
                "largest difference of q_x on y = 0, over µp_H, away from axis, edge and stick "
                "boundaries,",
                lambda step, fem, sam: float(np.max(Line(fem, sam, step).shear_judged)),
                5e-2, ASKED,
            ),
            "mean_shear": (
                "mean difference of q_x on y = 0, over µp_H",
                lambda step, fem, sam: float(np.mean(Line(fem, sam, step).shear_judged)),
                5e-3, HAND,
            ),
            "pressure": (
                "largest difference of p on y = 0, over p_H",
                lambda step, fem, sam: Line(fem, sam, step).pressure_apart, 1e-2, ASKED,
            ),
        }  # fmt: skip
        of_motion: dict[str, tuple[str, Callable[[int, Any, Any], float], float, str]] = {
            "stick_area": (
                "difference of the stick areas over the contact area", _stick_apart, 3e-2, ASKED,
            ),
            "approach": ("relative difference of the approach", _approach_apart, 2e-4, HAND),
            "shift": ("relative difference of the shift", shift_apart, 1e-3, HAND),
        }  # fmt: skip
        by_radial = of_motion | {"shift": (*of_motion["shift"][:2], 1.5e-3, HAND)}
        return (
            *(
                Comparison(
                    f"{of}{name}_at_{part:g}", f"{meaning} at {part:g} µW", runs,
                    partial(difference, step), allowed, because, SOURCE, OTHER,
                )
                for of, pairs, measures in (
                    ("", [direct], on_line | of_motion), ("radial_", rings, by_radial),
                )
                for runs in pairs
                for step, part in enumerate(PARTS, 1)
                for name, (meaning, difference, allowed, because) in measures.items()
                if part or name != "shift"
            ),
            Comparison(
                "harmonics", "shift at 0.9 µW with half of the harmonics, relative",
                (self.fewer.label, self.on_elements.label), partial(shift_apart, len(PARTS)), 6e-3,
                "set by hand: the error is 4e-3 with harmonics 0 … 4, and smaller with more",
                "the same solver", OWN,
            ),
        )  # fmt: skip

    def findings(self) -> tuple[Finding, ...]:
        """List the stick area over the contact area by every solver."""
        return tuple(
            Finding(
                f"stick_part_at_{part:g}", f"stick area over contact area at {part:g} µW", "",
                run.label, partial(_stick_part, step), "compared above",
            )
            for step, part in enumerate(PARTS, 1)
            for run in (self.on_elements, self.on_cells, self.on_radii)
        )  # fmt: skip

    def lines(self, results: Results) -> dict[float, Line]:
        """Map each fraction of µW to the results on the line of the load."""
        fem, sam = results[self.on_elements.label], results[self.on_cells.label]
        return {part: Line(fem, sam, step) for step, part in enumerate(PARTS, 1)}


def _end(step: int, result: Any) -> Any:
    return result.steps[step - 1]


def _stick_part(step: int, result: Any) -> float:
    end = _end(step, result)
    return float((end.stick_radius or 0.0) ** 2 / end.contact_radius**2)


def _stick_apart(step: int, one: Any, other: Any) -> float:
    return abs(_stick_part(step, one) - _stick_part(step, other))


def _approach_apart(step: int, one: Any, other: Any) -> float:
    return float(abs(_end(step, one).approach / _end(step, other).approach - 1))


def shift_apart(step: int, one: Any, other: Any) -> float:
    """Compute the relative difference of the shifts of two results at the end of a step."""
    return float(abs(shift_along_x(_end(step, one)) / shift_along_x(_end(step, other)) - 1))


@dataclass(frozen=True)
class Line:
    """Results of elements and cells at the cell centres on y = 0, at the end of a step."""

    fem: Any
    sam: Any
    step: int

    @property
    def x(self) -> Field:
        """Positions [length]."""
        return np.asarray(self.sam.grid.x)

    @property
    def shears(self) -> tuple[Field, Field]:
        """Shear q_x / µp_H on the compared line: by finite elements, by cells."""
        q, _ = tractions_at(_end(self.step, self.fem), self.x, 0 * self.x)
        row, limit = self.sam.grid.cells[1] // 2, FRICTION * HERTZ.peak_pressure
        return q[0] / limit, _end(self.step, self.sam).shear[0][:, row] / limit

    @property
    def shear_apart(self) -> Field:
        """Difference of the two shears over µp_H, on the whole line."""
        one, other = self.shears
        return np.abs(one - other)

    @property
    def shear_judged(self) -> Field:
        """|Δq_x| / µp_H at the positions that are judged."""
        return np.asarray(self.shear_apart[~np.any(list(self.left_out.values()), axis=0)])

    @property
    def pressure_apart(self) -> float:
        """Largest |Δp| / p_H away from axis and edge."""
        _, p = tractions_at(_end(self.step, self.fem), self.x, 0 * self.x)
        found = _end(self.step, self.sam).pressure[:, self.sam.grid.cells[1] // 2]
        axis, edge, _ = self.left_out.values()
        return float(np.max(np.abs(p - found)[~(axis | edge)]) / HERTZ.peak_pressure)

    @property
    def left_out(self) -> dict[str, Mask]:
        """Positions at which the shear is not judged, by the reason."""
        width = float(max(self.fem.steps[0].radii[1], self.sam.grid.spacing[0]))
        within = judged_within(self.fem.discretisation.elements_per_radius)
        reach = within * _end(self.step, self.fem).contact_radius
        fronts = np.array(self.fronts())
        return {
            "near the axis": np.abs(self.x) <= AXIS * width,
            "near the edge of contact": np.abs(self.x) >= reach,
            "where stick begins or ends, or did": np.any(
                np.abs(self.x[:, None] - fronts) <= FRONT * width, axis=1
            ),
        }

    def fronts(self) -> list[float]:
        """Return the positions of stick boundaries and of remaining kinks in either solution
        [length]."""
        sam, fem = (
            [one for one in result.increments if one.step <= self.step]
            for result in (self.sam, self.fem)
        )
        turns = list({one.step: k for k, one in enumerate(sam)}.values())
        row = self.sam.grid.cells[1] // 2
        found = kept_fronts(self.x, np.stack([one.in_stick[:, row] for one in sam]), turns)
        rays = np.stack([one.in_stick.reshape(len(one.radii), -1)[:, [0, -1]] for one in fem])
        turns = list({one.step: k for k, one in enumerate(fem)}.values())
        ahead, behind = (kept_fronts(fem[-1].radii, rays[..., k], turns) for k in (0, 1))
        return [*found, *ahead, *(-front for front in behind)]


def everywhere(lines: Mapping[float, Line]) -> Table:
    """Tabulate the differences of the shear by load, including positions that are not compared."""
    rows, left = [], []
    for part, line in lines.items():
        apart, out = line.shear_apart, line.left_out
        somewhere = np.any(list(out.values()), axis=0)
        at = int(np.argmax(np.where(somewhere, apart, -1.0)))
        why = next(reason for reason, mask in out.items() if mask[at])
        judged = np.max(apart, where=~somewhere, initial=0.0)
        load, place = f"{part:g} µW", plain(line.x[at] / HERTZ.contact_radius, 2)
        rows.append((load, plain(judged, 2), plain(apart[at], 2), place, why))
        left.append(apart[at])
    load, _, most, place, why = rows[int(np.argmax(left))]
    return Table(
        title="Both solvers at all positions, including those that are not compared",
        columns=(
            "load", "largest difference of q_x on y = 0 over µp_H, compared", "left out",
            "at x / a_H", "left out, since it is",
        ),
        rows=tuple(rows),
        note=f"Omitted from the comparison of q_x on y = 0 are positions {', '.join(out)}. There "
        f"the largest difference is {most} µp_H: {why}, at x = {place} a_H, at {load}.",
        units=NONE,
    )  # fmt: skip


def _chart(lines: Mapping[float, Line]) -> Chart:
    """Draw the shear of a tangentially loaded contact on the line of the load."""
    above, below = [], []
    for series, (part, line) in enumerate(lines.items()):
        x, (elements, cells) = line.x / HERTZ.contact_radius, line.shears
        above.append(curve("" if series else "cells", x, cells, Look.REFERENCE))
        above.append(curve(f"{part:g} µW", x, elements, series=series))
        below.append(curve("", x, elements - cells, series=series))
    return Chart(
        name="cross_check_tangential_shear",
        title="Shear on y = 0 by both solvers",
        caption="Shear along the load on the line y = 0 at four tangential forces, by finite "
        "elements in colour and on cells in grey, and their difference, which is largest at the "
        "stick boundary and at the edge.",
        rows=(
            (Panel(x_label="", y_label="q_x / µp_H", curves=tuple(above), height=2.6),),
            (Panel(x_label="x / a_H", y_label="Δq_x / µp_H", curves=tuple(below)),),
        ),
    )


FEW_CONTACTS = ((2.0, 1.0, 0.1), (10.0, 0.25, 0.0), (0.25, 2.0, 0.1))
MORE_CONTACTS = (*FEW_CONTACTS, (4.0, 1.0, 0.3))
# A coating like its body is none, whatever its thickness.
EVERY_CONTACT = tuple(
    (ratio, thickness, friction)
    for ratio, thickness, friction in product(
        (0.25, 0.5, 1.0, 2.0, 4.0, 10.0), (0.25, 1.0, 2.0), INCREMENTS
    )
    if ratio != 1.0 or thickness == 1.0
)


def contacts(level: Level) -> tuple[tuple[Pressed, ...], tuple[Pushed, ...]]:
    """Return the contacts of a level.

    The full level has every combination of modulus ratio, thickness and friction.
    """
    if level is Level.QUICK:
        return tuple(Pressed(*of, 96, 64) for of in FEW_CONTACTS), (Pushed(2.0, 65, 32, 8),)
    fine, pushed = (192, 64), Pushed(2.0, 129, 64, 12)
    if level is Level.STANDARD:
        return tuple(Pressed(*of, *fine) for of in MORE_CONTACTS), (pushed,)
    rest = (Pressed(*of, 128, 64, refined=False) for of in EVERY_CONTACT if of not in MORE_CONTACTS)
    chosen = (Pressed(*of, 256, 96) for of in MORE_CONTACTS)
    return (*chosen, *rest), (replace(pushed, cells=257, harmonics=16),)


def cross_check(
    level: Level = Level.QUICK,
    given: tuple[tuple[Pressed, ...], tuple[Pushed, ...]] | None = None,
) -> Case:
    """Build the case of three solvers on equal contacts; the stress is compared for the first
    contact.

    given  contacts, instead of those of the level
    """
    of_press, of_push = given or contacts(level)
    first = of_press[0]
    return Case(
        name="cross_check",
        title="Three solvers on coated contacts",
        problem=(
            "A rigid ball is pressed on coated half-spaces with equal increments by three "
            "solvers: cells with Fourier transforms, axisymmetric finite elements, and the "
            "radial solver. On a coating twice as stiff as its base the ball is pressed by 1 kN "
            "and then loaded tangentially to 0.3, 0.6 and 0.9 of µW. Cells and elements are "
            "compared with half of their number first, then every two solvers with each other. "
            "Cells and the radial solver share the response of layers to one wavenumber; "
            "otherwise the three solvers share only the scene."
        ),
        runs=(
            *(run for one in of_press for run in one.runs),
            *(run for one in of_push for run in one.runs),
        ),
        quantities=(),
        comparisons=(
            *(comparison for one in of_press for comparison in one.comparisons()),
            Comparison(
                "stress_difference",
                "largest difference of a component of the stress over p₀: on the axis from 0.1 "
                "to 3 contact radii, above the interface and below it",
                (first.on_cells[1].label, first.on_elements[1].label), first.stress_apart, 5e-3,
                "set by hand: five times the error of the stress recovery of elements, against "
                "Huber's stress on an equally fine mesh", SOURCE, OTHER,
            ),
            *(comparison for one in of_push for comparison in one.comparisons()),
        ),
        findings=(
            *(finding for one in of_press for finding in one.findings()),
            *(finding for one in of_push for finding in one.findings()),
        ),
        charts=lambda results: (
            Chart(
                name="cross_check_profiles",
                title="Tractions by both solvers",
                caption="Pressure (left) and outward shear (right) over the radius for the first "
                "contacts of the case: finite elements in grey below cells.",
                rows=tuple(one.panels(results) for one in of_press[:4]),
            ),
            *(_chart(one.lines(results)) for one in of_push),
        ),
        tables=lambda results: tuple(everywhere(one.lines(results)) for one in of_push),
        limits=(
            "All solvers take equal increments, so that the increment error is not visible.",
            "Pressure and shear are not compared within two cells or elements of the axis. The "
            "shear is not compared either within this distance of the stick edge, and of radii "
            "at which a receding stick edge turned outward.",
            "On the line of the load both solvers smooth the cusp at a stick boundary in "
            "different ways. At the start of the tangential load the contact behind the stick "
            "disc of indentation sticks at once, so that the cusp remains; it is omitted until "
            "slip passes over it.",
        ),
        equations=(
            r"\mathbf{u} = \mathbf{C} * (\mathbf{q}, p),\quad p \ge 0,\ g \ge 0,\ p g = 0,\quad "
            r"|\mathbf{q}| \le \mu p,\ \mu p \, \dot{\mathbf{s}} = -|\dot{\mathbf{s}}| \mathbf{q}",
        ),
        no_order="own errors are changes from half of the cells or elements; orders are judged "
        "in cases with a known solution",
    )  # fmt: skip
