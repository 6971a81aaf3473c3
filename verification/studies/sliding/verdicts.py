"""What the computed histories say: physics is judged, the paper's number is a finding."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from contact_scene.summary import ContactStatus
from verification.exhibits.numbers import plain
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.row import CaseRecord
from verification.running.rules import converged, judged, total
from verification.running.study import Statement
from verification.studies.sliding.estimate import Estimate
from verification.studies.sliding.full_slip import FullSlip
from verification.studies.sliding.path import SlidingPath

PAPER = 0.76
# A variant is near the paper's number within this and its own bar: a round figure, and every
# variant's numbers are listed beside it.
NEAR = 0.03
SHORT_OF_LIMIT = 1e-3
ABOVE_LIMIT = 1e-8
IDENTITY = 1e-8
SLIP_ANGLE = 0.05  # degree, root mean square
ALIKE_AT_LEAST = 0.98
COVERAGE = 2.0  # bars
FEWEST_BARS = 5.0  # between T_fs and the paper's number

Paths = Mapping[str, SlidingPath]


@dataclass(frozen=True)
class Variant:
    """Another path or another reading of the law of friction.

    kind       what it varies; the same on coarse and fine cells
    cells      along each side
    vanishing  where its stick area vanishes, if that is resolved
    largest    largest T / µW that it reached
    """

    name: str
    kind: str
    cells: int
    vanishing: FullSlip | None
    largest: float

    @property
    def vanishing_text(self) -> str:
        """Where its stick area vanishes."""
        return self.vanishing.text if self.vanishing else "not resolved"

    @property
    def near_paper(self) -> bool:
        """Whether one of its two numbers comes near the paper's."""
        fs = self.vanishing
        near = fs is not None and abs(fs.force - PAPER) <= NEAR + fs.uncertainty
        return near or abs(self.largest - PAPER) <= NEAR


def largest_force(path: SlidingPath) -> float:
    """Largest T / µW on a path."""
    return max(point.force for point in path.points)


def limit_is_reached(paths: Paths) -> Statement:
    """T_max -> µW under shift control: the theorem that the paper's claim would contradict."""
    values = {name: largest_force(path) for name, path in paths.items()}
    sliding = [p.points[-1].status is ContactStatus.GROSS_SLIDING for p in paths.values()]
    good = all(1 - SHORT_OF_LIMIT <= v <= 1 + ABOVE_LIMIT for v in values.values())
    return Statement(
        claim="physics: T_max → µW",
        outcome=judged(good and all(sliding), complete=bool(values)),
        measured=_listed({name: f"{value:.6f} µW" for name, value in values.items()}),
        because="in sustained sliding every slip increment is along the motion, so that "
        f"T = µW (allowed: {SHORT_OF_LIMIT:g} below after three times Mindlin's displacement)",
    )


def force_is_mean_cosine(paths: Paths) -> Statement:
    """T = µW⟨cosψ⟩ in every state without stick area."""
    worst = [
        abs(point.force - point.mean_cosine)
        for path in paths.values()
        for point in path.points
        if point.full_slip and point.shift > 0
    ]
    return Statement(
        claim="identity: T = µW⟨cosψ⟩ at full slip",
        outcome=judged(max(worst, default=0.0) <= IDENTITY, complete=bool(worst)),
        measured=f"largest difference {plain(max(worst, default=0.0), 2)} in {len(worst)} states",
        because=f"|q| = µp in every cell; allowed {IDENTITY:g}",
    )


def slip_opposes_shear(paths: Paths) -> Statement:
    """Shear points against the slip increment wherever cells slip."""
    angles = [p.slip_angle for path in paths.values() for p in path.points if p.slip_angle]
    largest = [
        p.largest_slip_angle for path in paths.values() for p in path.points if p.largest_slip_angle
    ]
    worst = max(angles, default=0.0)
    return Statement(
        claim="direction: shear opposes the slip increment",
        outcome=judged(worst <= SLIP_ANGLE, complete=bool(angles)),
        measured=f"{plain(worst, 2)}° root mean square in the worst increment, "
        f"{plain(max(largest, default=0.0), 2)}° in the worst cell",
        because=f"maximum dissipation; allowed {SLIP_ANGLE:g}°, weighted by the work of friction",
    )


def all_converged(records: Sequence[CaseRecord]) -> Statement:
    """Every increment within the solver's tolerance."""
    where = f"in {total(records, 'increments')} increments, {total(records, 'halvings')} of them"
    return converged(records, SOLVER_TOLERANCE, f"{where} halved", asked=1)


def null_tests(exact: FullSlip | None, alike: FullSlip | None) -> Statement:
    """Bodies that do not couple keep stick area up to µW: exactly so for ν = 0."""
    known = exact is not None and alike is not None
    good = False
    measured = "not resolved"
    if exact is not None and alike is not None:
        good = abs(exact.force - 1) <= COVERAGE * exact.uncertainty
        good &= ALIKE_AT_LEAST <= alike.force <= 1 + COVERAGE * alike.uncertainty
        measured = f"T_fs/µW = {exact.text} for ν = 0, {alike.text} for ν = 0.3"
    return Statement(
        claim="null test: identical bodies stick until µW",
        outcome=judged(good, complete=known),
        measured=measured,
        because="Cattaneo and Mindlin's solution is exact for ν = 0; for ν = 0.3 it violates the "
        "direction law a little, and the stick area vanishes between 0.987 and 0.9996 µW",
    )


def uncoupled_sticks(variants: Mapping[str, Variant]) -> Statement:
    """With the coupling left out, a coated contact keeps stick area nearly up to µW."""
    found = {name: v.vanishing for name, v in variants.items()}
    known = [fs for fs in found.values() if fs is not None]
    good = all(ALIKE_AT_LEAST <= fs.force <= 1 + COVERAGE * fs.uncertainty for fs in known)
    return Statement(
        claim="null test: without coupling coated contacts stick until µW",
        outcome=judged(good, complete=bool(known) and len(known) == len(found)),
        measured=_listed({n: "not resolved" if fs is None else f"T_fs/µW = {fs.text}"
                          for n, fs in found.items()}),
        because="the paper attributes its number to the coupling: left out, it must be gone; "
        f"allowed from {ALIKE_AT_LEAST:g}, because for ν = 0.3 shear is not all along x",
    )  # fmt: skip


def answer(path: SlidingPath | None, found: Estimate | None) -> str:
    """To the title's question; empty where the history was not computed."""
    if path is None:
        return ""
    largest = largest_force(path)
    grossly = "No" if largest >= 1 - SHORT_OF_LIMIT else "The limit of friction is not reached"
    vanishes = f"at {found.text} µW" if found else "at a force that was not resolved"
    return (
        f"{grossly}: under a growing shift the force of E1/E2 = 2 goes on to {largest:.4f} µW. "
        f"Its last stick area vanishes {vanishes} (the paper: {PAPER:g}); even then the directions "
        "of slip still differ, so that friction is not exhausted."
    )


def refinement_agrees(estimates: Mapping[str, Estimate]) -> Statement:
    """Cells and steps change T_fs by less than would matter for the comparison with the paper."""
    away = {n: abs(e.force - PAPER) / e.uncertainty for n, e in estimates.items()}
    bars = {name: f"± {e.uncertainty:.3f}" for name, e in estimates.items()}
    return Statement(
        claim="numerics: cells and steps do not decide the answer",
        outcome=judged(all(factor > FEWEST_BARS for factor in away.values()), complete=bool(away)),
        measured="bars of T_fs/µW: " + _listed(bars),
        because="halved cells, halved steps in shift and in load; the distance to 0.76 is to be "
        "more than five bars, either way",
    )


def paper_number(found: Estimate | None, variants: Iterable[Variant]) -> Statement:
    """The finding about 0.76 µW, with the variants that come near it."""
    variants = tuple(variants)
    near = [_confirmed(v, variants) for v in variants if v.near_paper]
    there = (
        f"stick area vanishes at T_fs/µW = {found.text}"
        if found
        else "where the stick area vanishes was not resolved"
    )
    if near:
        others = "variants that come near 0.76: " + ", ".join(near)
    elif variants:
        others = f"none of {len(variants)} variants comes near 0.76 (within {NEAR:g} and its bar)"
    else:
        others = "no variant was computed"
    return Statement(
        claim="the paper's 0.76, E1/E2 = 2",
        outcome=None,
        measured=f"{there}; {others}",
        because="the paper states gross sliding past 0.76 µW; what it leaves unsaid is assumed "
        "here, and nothing was adjusted to meet its number",
    )


def _confirmed(near: Variant, variants: Iterable[Variant]) -> str:
    """Name and numbers of a variant, and whether finer cells agree."""
    text = f"{near.name} (T_fs/µW = {near.vanishing_text}, T_max/µW = {near.largest:.3f})"
    finer = [v for v in variants if v.kind == near.kind and v.cells > near.cells]
    return text + (", not confirmed by finer cells" if any(not v.near_paper for v in finer) else "")


def _listed(values: Mapping[str, str]) -> str:
    return ", ".join(f"{name}: {value}" for name, value in values.items()) or "nothing"
