"""Challenges of tilted indenters, where exchanged axes and the sign of a slope are seen."""

from __future__ import annotations

from collections.abc import Iterator

from contact_scene import FlatPunch, LoadStep
from contact_scene.geometry import Indenter
from verification.challenge.often_asked import CLOSED, SMALL, approach, contact_radius
from verification.challenge.requested_quantities import (
    AskedValue,
    Challenge,
    Grade,
)
from verification.closed_forms.tilted_punch import TiltedPunch
from verification.problems import paper_scene as paper
from verification.problems.classical import PUNCH_RADIUS
from verification.problems.paper_scene import CONTACT_MODULUS, HERTZ, NORMAL_FORCE, RADIUS, STEEL

# Slopes that close the gap at positive y and x; the punch touches all over, its load 0.24 radii
# from the axis, and the ball's contact stays in the window.
PUNCH_TILT, BALL_TILT = (0.004, 0.003), (0.008, 0.005)
WORDS = (
    "The tilt (φ_x, φ_y) is given: slopes that close the gap at positive y and at positive x, so "
    "that h = h_i + u_z - approach - φ_x y - φ_y x. Approach is that of the origin."
)


def tilted() -> Iterator[Challenge]:
    """All of them."""
    yield tilted_punch()
    yield tilted_ball()


def tilted_punch() -> Challenge:
    """A plane of displacement below the whole end."""
    arm = 4 / 3 * CONTACT_MODULUS * PUNCH_RADIUS**3 / NORMAL_FORCE  # per slope
    force_at = (arm * PUNCH_TILT[1], arm * PUNCH_TILT[0])
    exact = TiltedPunch(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE, force_at)
    punch = FlatPunch(radius=PUNCH_RADIUS, material=STEEL)
    return _tilted(
        "tilted_punch", "A flat punch pressed and tilted", punch, PUNCH_TILT,
        "Galin's theorem; Sneddon 1951, § 52", force_at, (approach(exact.approach),),
    )  # fmt: skip


def tilted_ball() -> Challenge:
    """A tilted paraboloid is a shifted one: x²/2R - φx = (x - Rφ)²/2R - Rφ²/2."""
    drop = 0.5 * RADIUS * (BALL_TILT[0] ** 2 + BALL_TILT[1] ** 2)
    return _tilted(
        "tilted_ball", "A ball pressed and tilted", paper.paraboloid(STEEL), BALL_TILT,
        "Hertz 1882, below the place where the slope is zero",
        (RADIUS * BALL_TILT[1], RADIUS * BALL_TILT[0]),
        (approach(HERTZ.approach - drop), contact_radius(HERTZ.contact_radius)),
    )  # fmt: skip


def _tilted(
    name: str,
    title: str,
    indenter: Indenter,
    tilt: tuple[float, float],
    source: str,
    force_at: tuple[float, float],
    values: tuple[AskedValue, ...],
) -> Challenge:
    step = LoadStep(normal_force=NORMAL_FORCE, tilt=tilt)
    scene = paper.frictionless(title, indenter, STEEL, step)
    arm = max(force_at)
    moments = (
        AskedValue(
            f"moment_{axis}", 1, "N m", f"Σ p {other} Δ, over all places", NORMAL_FORCE * at,
            NORMAL_FORCE * arm, "the larger moment", Grade.C, uncertainty=CLOSED, limit=1,
        )
        for axis, other, at in (("x", "y", force_at[1]), ("y", "x", force_at[0]))
    )  # fmt: skip
    return Challenge(
        name, title, f"{title}. {WORDS}", scene, source, (*values, *moments), (), SMALL
    )
