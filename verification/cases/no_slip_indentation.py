"""Friction so large that nothing slips: the stiffening factor of bonded indentation."""

from __future__ import annotations

from collections.abc import Callable
from math import log
from typing import TYPE_CHECKING

from contact_scene import (
    RIGID,
    FlatPunch,
)
from verification.judging.case import Case, Comparison, Level
from verification.judging.run import Run
from verification.observed.end_state import approach
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import half_space, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, pressing
from verification.problems.reference import ReferenceKind

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Mossakovskii 1963; Spence 1968: (1 - ν) ln(3 - 4ν) / (1 - 2ν)"
BALL_SOURCE = "Spence 1968, superposition of bonded flat punches"
RATIOS = (0.0, 0.3)  # Poisson's
FRICTION = 2.0  # at the edge of full stick |q|/p stays below; µ|beta| = 1 for ν = 0
WINDOW_PER_RADIUS = 2.4
# Approach over a²/R, and load over Hertz's at equal contact radius.
BALL = {0.0: (1.0887337, 1.1960963), 0.3: (1.0245802, 1.0539106)}
FEW, MANY = 20, 40


def no_slip_indentation(level: Level = Level.QUICK) -> Case:
    """The case: the punch at every level, the ball above the quick one."""
    return no_slip_indentation_on(96, () if level is Level.QUICK else RATIOS)


def no_slip_indentation_on(cells: int, balls: tuple[float, ...]) -> Case:
    """The case on a square grid, with a ball for these ratios of Poisson."""
    bonded = {nu: _punch(nu, cells, FRICTION) for nu in RATIOS}
    smooth = {nu: _punch(nu, cells, None) for nu in RATIOS}
    few, many = ({nu: _ball(nu, cells, count) for nu in balls} for count in (FEW, MANY))
    return Case(
        name="no_slip_indentation",
        title="Indentation without slip",
        problem=(
            "A rigid flat punch, and a ball, pressed on homogeneous bodies with so much friction "
            "that no cell slips. Bonding stiffens the contact by a factor that Mossakovskii found. "
            "It is strong coupling: plain alternation between pressure and shear hardly converges."
        ),
        runs=(*bonded.values(), *smooth.values(), *few.values(), *many.values()),
        quantities=(),
        comparisons=(
            *(
                Comparison(
                    f"punch_nu_{_text(nu)}", f"ν = {nu:g}: load factor of the bonded over the "
                    "smooth punch, relative error",
                    (bonded[nu].label, smooth[nu].label), _factor_error(nu), 1e-3,
                    "the singular edge leaves errors of the order of a cell in either stiffness",
                    SOURCE, ReferenceKind.CLOSED_FORM,
                )
                for nu in RATIOS
            ),
            *(
                Comparison(
                    f"ball_nu_{_text(nu)}", f"ν = {nu:g}: approach of the ball, extrapolated from "
                    f"{FEW} and {MANY} increments, relative error",
                    (few[nu].label, many[nu].label), _ball_error(nu), 2e-4,
                    "asked of the coupled solver; first order in the increment",
                    BALL_SOURCE, ReferenceKind.SEMI_CLOSED,
                )
                for nu in balls
            ),
        ),
    )  # fmt: skip


def _text(nu: float) -> str:
    return f"{nu:g}".replace(".", "_")


def _punch(nu: float, cells: int, friction: float | None) -> Run:
    title = "Flat punch" + ("" if friction is None else " that does not slip")
    punch = FlatPunch(radius=HERTZ.contact_radius, material=RIGID)
    # The radius is fixed and nothing slips: the state does not depend on the way.
    scene = pressed(title, punch, half_space(nu), pressing(1), friction=friction)
    kind = "smooth" if friction is None else "bonded"
    grid = paper.square_grid(cells, WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius)
    return Run(f"{kind} punch, ν = {nu:g}", scene, grid)


def _ball(nu: float, cells: int, increments: int) -> Run:
    title, body = "Rigid ball that does not slip", half_space(nu)
    scene = pressed(title, rigid_ball(), body, pressing(increments), friction=FRICTION)
    grid = paper.square_grid(cells, WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius)
    return Run(f"ball, ν = {nu:g}, {increments} increments", scene, grid)


def _factor_error(nu: float) -> Callable[[Result, Result], float]:
    factor = (1 - nu) * log(3 - 4 * nu) / (1 - 2 * nu)
    return lambda bonded, smooth: abs(approach(smooth) / approach(bonded) / factor - 1)


def _ball_error(nu: float) -> Callable[[Result, Result], float]:
    approach_factor, load_factor = BALL[nu]
    exact = HERTZ.approach * approach_factor / load_factor ** (2 / 3)
    return lambda few, many: abs((2 * approach(many) - approach(few)) / exact - 1)
