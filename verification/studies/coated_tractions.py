"""Study of coated contacts: tractions by two solvers with errors, for figures 3 and 4 of the paper.

A rigid ball is pressed with friction on a coated half-space and pushed tangentially to 0.3, 0.6 and
0.9 of µW (friction coefficient times normal force). The two solvers, with cells and with rings,
share only the frequency responses of the layers.

The error of a curve is estimated by coarse solves. Their convergence order is 1 in theory; the
estimate assumes 0.6 to be safe: $|f - f_k| / (r_k^{0.6} - 1)$, where $r_k$ is the refinement
factor. The contributions of fewer cells or rings and of half of the increments are added. The norm
is ∫|Δp| dx / ∫p dx or ∫|Δq| dx / ∫µp dx on y = 0.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import radial
import semi_analytical
from contact_errors.error_formula import BELIEVED
from contact_scene import LoadStep, Scene
from contact_scene.array_types import Field
from verification.exhibits.chart import (
    NONE,
    Chart,
    Curve,
    Look,
    Panel,
    Table,
    curve,
    plain,
    stacked,
)
from verification.judging.case import SOLVER_TOLERANCE, Level
from verification.judging.outcome import finite
from verification.norms import max_norm
from verification.problems.problem import (
    FRICTION,
    FRICTION_LIMIT,
    HERTZ,
    coated,
    exact_contact,
    film,
    pressed,
    pressing,
    rigid_ball,
    square_grid,
)
from verification.quantities import largest_residual, tractions_along_load
from verification.running.study import (
    RESIDUAL,
    CaseRecord,
    Conclusion,
    Records,
    Row,
    Settings,
    Statement,
    Study,
    found,
    judged,
    parameters_of,
    solved,
    value_of,
)

RATIOS = (0.5, 1.0, 2.0, 4.0)
FORCES = (0.0, 0.3, 0.6, 0.9)  # T / µW
INCREMENTS = (16, 6, 6, 6)
CELLS = "semi-analytical"
RINGS = "radial"
# Cells a side, and multiple of the rings, of the fine solves.
FINEST = {Level.QUICK: (48, 0.5), Level.STANDARD: (96, 1.0), Level.FULL: (128, 1.5)}
MARGIN = 1.15  # half a window in contact radii
# Solves of one contact: fraction of the cells or rings, and of the increments.
SOLVES = {"fine": (1.0, 1.0), "coarse": (2 / 3, 1.0), "half the increments": (1.0, 0.5)}
SHOWN = np.linspace(-1.3, 1.3, 131)  # x / a_H
ROUND_OFF = 1e-15
SELF_EQUILIBRIUM = 1e-6  # |∫q| / ∫|q| on y = 0 at T = 0: the curve is odd
FIELDS = ("pressure", "shear")
AT = {force: f"at {force:g} µW" for force in FORCES}


@dataclass(frozen=True)
class TractionRun:
    """Solve of one coated contact by one solver, whose tractions on y = 0 a record stores.

    solver    "semi-analytical" or "radial"
    ratio     E1 / E2, Young's modulus of the coating over that of the substrate
    fineness  cells per side, or factor by which the radial solver multiplies its number of rings
    share     factor by which the increments of all load steps are multiplied
    """

    solver: str
    ratio: float
    fineness: float
    share: float

    @property
    def name(self) -> str:
        words = f"{self.solver}-{self.ratio:g}-{self.fineness:.4g}-{self.share:g}"
        return words.replace(".", "p")

    def compute(self) -> CaseRecord:
        """Solve the coated contact and record its tractions on y = 0 at the end of every load step.

        The load steps press the ball and then push it tangentially. Raises the errors of the
        solvers.
        """
        pushes = (LoadStep(tangential_force=(t * FRICTION_LIMIT, 0.0)) for t in FORCES[1:])
        body = coated(film(self.ratio, 1.0))
        title = f"Rigid ball on a coated half-space, E1/E2 = {self.ratio:g}"
        scene = pressed(title, rigid_ball(), body, pressing(), *pushes, friction=FRICTION)
        counts = tuple(max(1, round(self.share * n)) for n in INCREMENTS)
        result = self._solve_scene(scene, counts, exact_contact(body).contact_radius)
        ends = zip(FORCES, result.steps, strict=True)
        return CaseRecord(
            parameters=parameters_of(self),
            measures={
                RESIDUAL: largest_residual(result),
                "stick_fraction": result.steps[-1].stick_area / result.steps[-1].contact_area,
            },
            counters={"increments": sum(counts)},
            parts=tuple(row for force, end in ends for row in _profile_rows(result, end, force)),
        )

    def _solve_scene(self, scene: Scene, counts: tuple[int, ...], radius: float) -> Any:
        if self.solver == RINGS:
            plan = replace(radial.plan(scene), increments=counts, fineness=self.fineness)
            return radial.solve(scene, plan=plan)
        grid = square_grid(round(self.fineness), MARGIN * radius)
        cut = semi_analytical.plan(scene, edge="last").cut_into(counts)
        return semi_analytical.solve(scene, grid, SOLVER_TOLERANCE, plan=cut)


def _profile_rows(result: Any, end: Any, force: float) -> list[Row]:
    """Return the pressure and the shear of a coated contact on y = 0 at fixed x, as rows of a
    record.

    The pressure is divided by the Hertz peak pressure p_H, the shear by µ p_H.

    result  result of a solver
    end     state at the end of a load step
    force   tangential force over µW, stored with each row
    """
    places, p, q = tractions_along_load(result, end)
    x, scale = places / HERTZ.contact_radius, HERTZ.peak_pressure
    lines = p / scale, q / (FRICTION * scale)
    at = (np.interp(SHOWN, x, line, left=0.0, right=0.0).tolist() for line in lines)
    return [
        Row(parameters={"T_over_muW": force, "x_over_aH": place}, measures={"p": p, "q": q})
        for place, p, q in zip(SHOWN.tolist(), *at, strict=True)
    ]


@dataclass(frozen=True)
class Curves:
    """Pressure and shear curves of a coated contact on y = 0 at every tangential force, with their
    errors.

    pressure  pressure over Hertz peak pressure p_H (force, x)
    shear     shear over µ p_H (force, x)
    errors    estimated relative error of each curve (field, force); field 0 is the pressure
    """

    pressure: Field
    shear: Field
    errors: Field

    @classmethod
    def of(cls, solves: Mapping[str, CaseRecord]) -> Curves:
        """Create the curves from the fine solve of a coated contact, and estimate their errors.

        One coarse solve has fewer cells or rings, the other one half of the increments. Their
        errors are added.

        solves  records by kind of solve: "fine", "coarse", "half the increments"
        """
        fine, *coarse = (_curves_of_record(solves[name]) for name in SOLVES)
        errors = np.zeros((2, len(FORCES)))
        for (cells, increments), other in zip(list(SOLVES.values())[1:], coarse, strict=True):
            factor = (1 / min(cells, increments)) ** BELIEVED - 1
            errors += _curve_differences(fine, other) / factor
        return cls(*fine, errors)


def _curves_of_record(record: CaseRecord) -> tuple[Field, Field]:
    rows = np.array([[value_of(row, "p"), value_of(row, "q")] for row in record.parts])
    pressure, shear = rows.T.reshape(2, len(FORCES), len(SHOWN))
    return pressure, shear


def _curve_differences(one: tuple[Field, Field], other: tuple[Field, Field]) -> Field:
    """Compute the relative differences (field, force) between the traction curves of two solves.

    A difference is the integral of |Δp| or |Δq| on y = 0, divided by the integral of the pressure
    of the first solve. The curves are normalised by p_H and µ p_H.

    one, other  pressure and shear curves (force, x) of each solve
    """
    total = one[0].sum(axis=1)
    return np.array([np.abs(a - b).sum(axis=1) / total for a, b in zip(one, other, strict=True)])


def runs(settings: Settings) -> dict[tuple[float, str, str], TractionRun]:
    """Return all solves of coated contacts in the study, by modulus ratio, solver and kind of
    solve.

    The modulus ratio E1/E2 is that of coating over substrate. The kinds are "fine", "coarse" (2/3
    of the cells or rings) and "half the increments".
    """
    cells, rings = FINEST[settings.level]
    finest = {CELLS: float(settings.cells or cells), RINGS: rings}
    return {
        (ratio, solver, kind): TractionRun(
            solver, ratio, 2 * round(part * fine / 2) if solver == CELLS else part * fine, share
        )
        for ratio in RATIOS
        for solver, fine in finest.items()
        for kind, (part, share) in SOLVES.items()
    }


def cases(settings: Settings) -> tuple[TractionRun, ...]:
    """Return the solves of all coated contacts: each modulus ratio, solver and kind of solve."""
    return tuple(runs(settings).values())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Derive the conclusion of the study of coated contacts from its records.

    The conclusion has the figures of the tractions, the errors of the curves, and checks of two
    statements of the paper.
    """
    asked = runs(settings)
    known = found(asked.values(), records)
    curves = {
        (ratio, solver): Curves.of({kind: known[asked[ratio, solver, kind]] for kind in SOLVES})
        for ratio in RATIOS
        for solver in (CELLS, RINGS)
        if all(asked[ratio, solver, kind] in known for kind in SOLVES)
    }
    fine = {key: known[asked[*key, "fine"]] for key in curves}
    both = [ratio for ratio in RATIOS if {(ratio, CELLS), (ratio, RINGS)} <= set(curves)]
    rows = tuple(_solver_difference(ratio, curves, field) for ratio in both for field in range(2))
    stick = {
        f"{solver}, E1/E2 = {ratio:g}": value_of(fine[ratio, solver], "stick_fraction")
        for ratio, solver in fine
    }
    return Conclusion(
        answer=_answer_text(stick) if 2.0 in both else "",
        statements=(
            solved("every contact is solved", len(known), len(asked), "solves"),
            _solvers_agree(rows, complete=len(both) == len(RATIOS)),
            _shear_without_force(curves),
            Statement(
                claim="the paper: gross sliding past 0.76 µW for E1/E2 = 2",
                outcome=None,
                measured="stick area over contact area at 0.9 µW: "
                + ", ".join(f"{name}: {100 * part:.2f} %" for name, part in stick.items()),
                because="a finding: the last stick zone vanishes later",
            ),
            _converged(tuple(fine.values())),
        ),
        tables=(_difference_table(rows),),
        charts=tuple(_traction_figure(curves, field) for field in range(2)) if curves else (),
        rows=rows,
        remarks=(
            "Assumed, because the paper does not say: substrate E2 = 210 GPa (from its contact "
            "radius and peak pressure), ν = 0.3 of coating and substrate, a rigid ball, a "
            "paraboloid for the sphere, 16 normal and 18 tangential increments.",
            "The paper's curves are not digitised, and no difference from them is claimed.",
        ),
    )


Drawn = Mapping[tuple[float, str], Curves]


def _answer_text(stick: Mapping[str, float]) -> str:
    cells, rings = (f"{100 * stick[f'{solver}, E1/E2 = 2']:.1f} %" for solver in (CELLS, RINGS))
    return (
        f"No: at 0.9 µW the contact with E1/E2 = 2 still sticks on {cells} of its area by cells, "
        f"on {rings} by the radial solver. The page on the onset of gross slip has the force at "
        "which the last stick zone vanishes."
    )


def _solver_difference(ratio: float, curves: Drawn, field: int) -> Row:
    """Compare the traction curves by cells and by the radial solver at every tangential force.

    The returned row has the relative difference of the solvers and the estimated error of each
    curve.

    ratio   E1 / E2, modulus of the coating over that of the substrate
    curves  curves by modulus ratio and solver
    field   0 for the pressure, 1 for the shear
    """
    cells, rings = curves[ratio, CELLS], curves[ratio, RINGS]
    apart = _curve_differences((cells.pressure, cells.shear), (rings.pressure, rings.shear))[field]
    measures: dict[str, float | None] = {}
    for number, force in enumerate(FORCES):
        measures |= {
            f"apart {AT[force]}": float(apart[number]),
            f"{CELLS} {AT[force]}": float(cells.errors[field, number]),
            f"{RINGS} {AT[force]}": float(rings.errors[field, number]),
        }
    return Row(parameters={"E1/E2": ratio, "field": FIELDS[field]}, measures=measures)


def _solvers_agree(rows: Sequence[Row], *, complete: bool) -> Statement:
    """Judge the agreement of both solvers: no difference of curves exceeds the sum of their errors.

    rows      differences and errors of the curves
    complete  True if every modulus ratio is solved by both solvers
    """
    shares = []
    for row in rows:
        for at in AT.values():
            both = value_of(row, f"{CELLS} {at}") + value_of(row, f"{RINGS} {at}")
            shares.append(value_of(row, f"apart {at}") / max(both, ROUND_OFF))
    return Statement(
        claim="cells and the radial solver agree within the stated errors of their curves",
        outcome=judged(all(share <= 1 for share in shares), complete=complete),
        measured=f"{sum(share <= 1 for share in shares)} of {len(shares)} curves; largest "
        f"difference {plain(max(shares, default=0.0), 2)} times the sum of both errors",
        because="they share only the frequency response of the layers",
    )


def _shear_without_force(curves: Drawn) -> Statement:
    shears = [known.shear[0] for known in curves.values()]
    worst = max((abs(q.sum()) / np.abs(q).sum() for q in shears), default=0.0)
    return Statement(
        claim="the paper: self-equilibrating shear at T = 0",
        outcome=judged(bool(worst <= SELF_EQUILIBRIUM), complete=len(curves) == 2 * len(RATIOS)),
        measured=f"|∫q| / ∫|q| ≤ {plain(float(worst), 2)}; largest |q| at least "
        f"{min((max_norm(q) for q in shears), default=0.0):.2f} µp_H",
        because="bodies of different moduli move past each other under pressure alone",
    )


def _converged(rows: Sequence[Row]) -> Statement:
    residuals = [row.measures[RESIDUAL] for row in rows]
    # A residual that is null is not finite.
    worst = max((math.inf if one is None else one for one in residuals), default=0.0)
    return Statement(
        claim="every increment converged",
        outcome=judged(worst <= SOLVER_TOLERANCE),
        measured=f"largest residual {plain(finite(worst), 2)} in the fine solves",
        because=f"allowed {SOLVER_TOLERANCE:g}",
    )


def _difference_table(rows: Sequence[Row]) -> Table:
    names = [f"{what} {at}" for at in AT.values() for what in ("apart", CELLS, RINGS)]
    return Table(
        title="Differences of the solvers, and the error of each curve",
        columns=("curve", *names),
        rows=tuple(
            (
                f"{row.parameters['field']}, E1/E2 = {row.parameters['E1/E2']}",
                *(plain(value_of(row, name), 2) for name in names),
            )
            for row in rows
        ),
        note="Relative to the integral of the pressure, or of µ times it, on y = 0.",
        units=NONE,
    )


def _traction_figure(curves: Drawn, field: int) -> Chart:
    """Draw the pressure or shear curves of all coated contacts, one panel per modulus ratio.

    Curves by cells are lines on top of wide grey lines of the radial solver.

    curves  curves by modulus ratio and solver
    field   0 for the pressure (figure 3 of the paper), 1 for the shear (figure 4)
    """
    number, what, label = (
        (3, "pressure", "p / Hertz pressure"),
        (4, "shear", "qₓ / (µ × Hertz pressure)"),
    )[field]
    panels = [
        Panel(
            x_label="x / Hertz radius" if place > 1 else "",
            y_label="" if place % 2 else label,
            curves=tuple(_panel_curves(curves, ratio, field, legend=place == 1)),
            title=f"E1/E2 = {ratio:g}",
            height=1.7,
        )
        for place, ratio in enumerate(RATIOS)
    ]
    return stacked(
        f"figure_{number}_{what}",
        f"Figure {number} of the paper: {what} in the plane y = 0",
        f"The {what} of four coated contacts at T = 0, 0.3, 0.6, 0.9 µW by cells (lines) and by "
        "the radial solver (wide, grey).",
        tuple(panels[:2]),
        tuple(panels[2:]),
    )


def _panel_curves(curves: Drawn, ratio: float, field: int, *, legend: bool) -> list[Curve]:
    found_ = []
    for solver, look in ((RINGS, Look.REFERENCE), (CELLS, Look.COMPUTED)):
        known = curves.get((ratio, solver))
        lines = () if known is None else (known.pressure, known.shear)[field]
        for series, (force, line) in enumerate(zip(FORCES, lines)):  # noqa: B905
            text = _legend_text(solver, force, series) if legend else ""
            found_.append(curve(text, SHOWN, line, look, series))
    return found_


def _legend_text(solver: str, force: float, series: int) -> str:
    """Return the tangential force for a line by cells; name the other solver at its first line."""
    if solver == CELLS:
        return f"T = {force:g} µW" if force else "T = 0"
    return "radial solver" if series == 0 else ""


STUDY = Study(
    name="coated-tractions",
    title="The paper's figures 3 and 4: tractions of coated contacts",
    question="A rigid ball is pressed on a coated half-space and pushed sideways, for four ratios "
    "of coating to substrate modulus. How far are the curves of two solvers apart, and does the "
    "contact slide grossly past 0.76 µW?",
    cases=cases,
    conclude=conclude,
)
