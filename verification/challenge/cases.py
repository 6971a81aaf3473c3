"""The challenges: problems whose answer nobody doubts, axes and bodies unalike where that tells
slips apart."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

from verification.challenge.cases_at_places import at_places
from verification.challenge.changing_loads import changing_loads
from verification.challenge.frictional_cases import frictional
from verification.challenge.half_ellipsoids import (
    Half,
    HalfEllipsoids,
    fitted,
    round_halves,
)
from verification.challenge.often_asked import LARGE, SMALL, approach, contact_radius, stick_radius
from verification.challenge.paper_figure import paper_figure
from verification.challenge.requested_quantities import (
    AskedField,
    AskedValue,
    Challenge,
)
from verification.challenge.tilted_cases import tilted
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.tangential_history import TangentialHistory
from verification.problems import paper_scene as paper
from verification.problems.cattaneo_mindlin import sheared
from verification.problems.classical import CONE, PUNCH
from verification.problems.coated_ball import ROWS, coated_ball, solved_here
from verification.problems.elliptical import BARREL
from verification.problems.hertz import BALL
from verification.problems.loop_history import AMPLITUDE
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, HERTZ, NU_ZERO
from verification.problems.problem import Problem

PARTS = (0.3, 0.6, 0.9, 0.99)  # of µW
QUARTERS = (0.25, 0.5, 0.75, 1.0)  # of the largest force of the loop
SERIES = 24  # of a coated pressure: 1e-13 in all rows


@cache
def challenges() -> dict[str, Challenge]:
    """All, by name."""
    classical = (hertz_point(), hertz_elliptical(), cone(), punch(), cattaneo_mindlin(), loop())
    return {
        one.name: one
        for one in (
            *(*classical, *tilted(), *coated(), *frictional()),
            *(paper_figure(), *at_places(), *changing_loads()),
        )
    }


def hertz_point() -> Challenge:
    """Frictionless ball."""
    pressure = round_halves((HERTZ.contact_radius, HERTZ.peak_pressure))
    return _pressed("hertz_point", "Hertz: a ball on a half-space", BALL, pressure)


def hertz_elliptical() -> Challenge:
    """On a square window, where exchanged axes are seen."""
    exact = BARREL.ends[0]
    a, b = exact.semi_axes
    axes = (
        AskedValue(
            "semi_axis_x", 1, "m", "semi-axis of the contact along x", a, a, "itself", limit=1
        ),
        AskedValue(
            "semi_axis_y", 1, "m", "semi-axis of the contact along y", b, b, "itself", limit=1
        ),
    )
    pressure = HalfEllipsoids((Half((a, b), exact.peak_pressure),))
    return _pressed("hertz_elliptical", "Hertz: a barrel on a half-space", BARREL, pressure, axes)


def cone() -> Challenge:
    """Without a finite peak."""
    return _pressed("cone_contact", "A cone on a half-space", CONE, None)


def punch() -> Challenge:
    """Known contact radius: the approach alone."""
    exact = PUNCH.ends[0]
    return Challenge(
        "flat_punch", "A flat punch on a half-space", _words(PUNCH), PUNCH.scene, PUNCH.source,
        (approach(exact.approach),), (), SMALL,
    )  # fmt: skip


def coated() -> Iterator[Challenge]:
    """A ball on coatings, each a challenge of its own."""
    for row in ROWS:
        problem = coated_ball(row)
        exact = solved_here(problem).ends[0]
        yield _pressed(
            f"coated_paraboloid/E1_over_E2={row['E1_over_E2']:g}",
            problem.scene.title, problem, fitted(exact.pressure, exact.contact_radius, SERIES),
            shares="of the numbers nothing; the pressure is of a semi-closed solution that takes "
            "the layers' frequency response from ours",
        )  # fmt: skip


def cattaneo_mindlin() -> Challenge:
    """Pressed, then sheared in steps."""
    problem = sheared("Ball pressed and sheared, ν = 0", PARTS)
    values, fields = [approach(HERTZ.approach)], []
    for step, end in enumerate(problem.ends[1:], start=2):
        values += _tangential(step, end, end.sliding_shift)
        fields.append(_shear(step, _cattaneo(end), end.tangential_force))
    return Challenge(
        "cattaneo_mindlin", "Cattaneo and Mindlin: pressed, then sheared",
        _words(problem), problem.scene, problem.source, tuple(values), tuple(fields), SMALL,
    )  # fmt: skip


def loop() -> Challenge:
    """A fretting loop as equilibria, so that nobody needs our increments."""
    turns = (*QUARTERS, *reversed(QUARTERS[:-1]), 0.0, *(-q for q in QUARTERS))
    turns += (*(-q for q in reversed(QUARTERS[:-1])), 0.0, *QUARTERS)
    problem = sheared("Fretting loop, ν = 0", tuple(AMPLITUDE * part for part in turns))
    state = TangentialHistory(paper.partial_slip(NU_ZERO, 0.0))
    values: list[AskedValue] = []
    fields: list[AskedField] = []
    lost = 0.0
    for step, part in enumerate(turns, start=2):
        state = state.loaded_to(AMPLITUDE * part * FRICTION_LIMIT)
        if step == 1 + len(QUARTERS):
            lost = state.dissipated_energy
        scale = state.virgin.sliding_shift
        values += _tangential(step, state, scale)
        fields.append(_shear(step, _branches(state), state.tangential_force))
    energy = state.dissipated_energy - lost
    first = 1 + len(QUARTERS)
    values.append(
        AskedValue(
            "energy_per_cycle", 1 + len(turns), "J",
            f"energy lost to friction between the ends of load steps {first} and {1 + len(turns)}",
            energy, energy, "itself", since=first,
        )
    )  # fmt: skip
    return Challenge(
        "fretting_loop", "A fretting loop: sheared to and fro under a constant load",
        _words(problem), problem.scene, "Mindlin and Deresiewicz 1953", tuple(values),
        tuple(fields), SMALL,
    )  # fmt: skip


def _pressed(
    name: str,
    title: str,
    problem: Problem,
    pressure: HalfEllipsoids | None,
    more: tuple[AskedValue, ...] = (),
    shares: str = "",
) -> Challenge:
    """One loading step under the paper's force."""
    exact, u = problem.ends[0], problem.uncertainty
    values = [approach(exact.approach, u), *more]
    if not more:
        values.append(contact_radius(exact.contact_radius, u))
    fields = []
    if pressure is not None:
        peak = float(pressure.terms[0].coefficient)
        meaning = "pressure at the centre, extrapolated as you like"
        values.append(
            AskedValue("central_pressure", 1, "Pa", meaning, peak, peak, "itself", required=False,
                       uncertainty=u, limit=2)
        )  # fmt: skip
        fields.append(
            AskedField("pressure", 1, "pressure, zero outside the contact", pressure, "L2",
                       paper.NORMAL_FORCE, paper.NORMAL_FORCE, uncertainty=u)
        )  # fmt: skip
    return Challenge(
        name, title, _words(problem), problem.scene, problem.source, tuple(values),
        tuple(fields), SMALL if problem.radius < 0.4 * SMALL else LARGE, shares,
    )  # fmt: skip


def _words(problem: Problem) -> str:
    return f"{problem.scene.title}."


def _tangential(step: int, end: Any, sliding: float) -> Iterator[AskedValue]:
    yield AskedValue(
        "shift_x", step, "m",
        "tangential shift of the indenter along +x, relative to far points of the body",
        end.shift, sliding, "the shift at gross sliding", limit=2,
    )  # fmt: skip
    yield stick_radius(end.stick_radius, step)


def _shear(step: int, halves: HalfEllipsoids, force: float) -> AskedField:
    return AskedField(
        "shear_x", step, "shear traction along x on the lower body, along +x where the indenter "
        "pulls that way", halves, "L1", FRICTION_LIMIT, force,
    )  # fmt: skip


def _cattaneo(end: PartialSlip, times: float = 1.0) -> HalfEllipsoids:
    peak = times * FRICTION * HERTZ.peak_pressure * (1 if end.tangential_force >= 0 else -1)
    a, c = HERTZ.contact_radius, end.stick_radius
    return round_halves((a, peak), (c, -peak * c / a)) if c > 0 else round_halves((a, peak))


def _branches(state: TangentialHistory) -> HalfEllipsoids:
    return HalfEllipsoids(
        tuple(term for times, one in state.branches() for term in _cattaneo(one, times).terms)
    )
