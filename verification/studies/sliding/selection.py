"""Which cases the studies compute."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import chain
from typing import TypeVar

from semi_analytical import Coupling
from verification.judging.case import Level
from verification.running.row import found
from verification.running.study import Records, Settings, StudyCase
from verification.studies.sliding.contacts import AlikeContact, CoatedContact
from verification.studies.sliding.estimate import Estimate, estimate
from verification.studies.sliding.friction_laws import FrictionLaw
from verification.studies.sliding.law_run import LawRun
from verification.studies.sliding.path import SlidingPath
from verification.studies.sliding.runs import (
    ForceRun,
    ShiftRun,
    ShortPath,
    ShortPathRun,
    Steps,
)

RATIOS = (0.5, 1.0, 2.0, 4.0)
PAPER_RATIO = 2.0
ALIKE = (AlikeContact(0.0), AlikeContact(0.3))
CELLS = {Level.QUICK: 64, Level.STANDARD: 128, Level.FULL: 256}
STEPS = {
    Level.QUICK: Steps(15, 30, 10),
    Level.STANDARD: Steps(15, 40, 20),
    Level.FULL: Steps(15, 40, 20),
}
# The variants answer with two digits; they need no more cells.
VARIANT_CELLS = 64
LAW_STEPS = Steps(15, 40, 10)
SHORT_STEPS = Steps(1, 44, 6)
FORCE_INCREMENTS = 20
LARGEST_FORCE = 0.99
# Forces whose tractions are drawn, T / µW; the paper gives no numbers for its curves.
FORCES = (0.3, 0.6, 0.9)
PUSHES = (6, 7, 7)  # increments of each
OTHER_COUNTS = (80, 20, 10, 5)  # of increments, for directions that freeze


VariantRun = LawRun | ShortPathRun | ShiftRun
R = TypeVar("R", bound=StudyCase)
ASSUMED = (
    "Assumed, because the paper does not say: substrate E2 = 210 GPa (from its contact radius and "
    "peak pressure), ν = 0.3 of coating and substrate, a rigid ball, a paraboloid for the sphere, "
)
UNCOUPLED = "coupling left out"


@dataclass(frozen=True)
class ContactCases:
    """Everything that is computed for one coated contact."""

    base: ShiftRun
    coarse: ShiftRun
    half_shift: ShiftRun
    half_normal: ShiftRun
    force: ForceRun
    variants: tuple[VariantRun, ...]

    @property
    def histories(self) -> tuple[ShiftRun, ...]:
        """The four that the estimate rests on."""
        return self.base, self.coarse, self.half_shift, self.half_normal

    def estimate(self, records: Records) -> Estimate | None:
        """T_fs; None if one of them has no record or does not resolve it."""
        paths = paths_of(records, self.histories)
        return estimate(*paths.values()) if len(paths) == len(self.histories) else None


def cases_of(ratio: float, settings: Settings) -> ContactCases:
    """The cases of one ratio of moduli."""
    contact = CoatedContact(ratio)
    cells, steps = settings.cells or CELLS[settings.level], STEPS[settings.level]
    base = ShiftRun(contact, cells, steps)
    coarse = replace(base, cells=cells // 2)
    variants: tuple[VariantRun, ...] = ()
    if ratio == PAPER_RATIO or settings.level is not Level.QUICK:
        few = min(cells, VARIANT_CELLS)
        frozen = (replace(LAW_STEPS, tangential=count) for count in OTHER_COUNTS)
        variants = (
            *(ShortPathRun(contact, few, path, SHORT_STEPS) for path in ShortPath),
            ShortPathRun(contact, 2 * few, ShortPath.TOTAL, SHORT_STEPS),
            *(LawRun(contact, few, LAW_STEPS, law) for law in FrictionLaw),
            *(LawRun(contact, few, s, FrictionLaw.FROZEN_DIRECTIONS) for s in frozen),
            *(ShiftRun(contact, few, LAW_STEPS, c) for c in (Coupling.ONE_WAY, Coupling.NONE)),
        )
    return ContactCases(
        base,
        coarse,
        replace(base, steps=steps.halved_tangential()),
        replace(coarse, steps=steps.halved_normal()),
        ForceRun(contact, cells, steps.normal, (LARGEST_FORCE,), (FORCE_INCREMENTS,)),
        variants,
    )


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """All cases, the long ones first so that no worker is left with one at the end."""
    contacts = [cases_of(ratio, settings) for ratio in RATIOS]
    long = zip(
        *((c.half_shift, c.base, c.half_normal, c.coarse, c.force) for c in contacts), strict=True
    )
    return (
        *chain.from_iterable(long),
        *null_runs(settings),
        *(variant for c in contacts for variant in c.variants),
    )


def null_runs(settings: Settings) -> tuple[ShiftRun, ...]:
    """Identical bodies, ν = 0 and ν = 0.3."""
    cells = settings.cells or CELLS[settings.level]
    steps = replace(STEPS[settings.level], normal=1)
    return tuple(ShiftRun(alike, cells, steps) for alike in ALIKE)


def traction_runs(settings: Settings) -> dict[float, ForceRun]:
    """The paper's figures 3 and 4, by ratio of moduli."""
    cells = settings.cells or CELLS[settings.level]
    normal = STEPS[settings.level].normal
    return {r: ForceRun(CoatedContact(r), cells, normal, FORCES, PUSHES) for r in RATIOS}


def variant_name(run: VariantRun) -> str:
    """What a variant is called in texts."""
    kind = variant_kind(run)
    return f"{kind}, {run.cells} cells" if isinstance(run, ShortPathRun) else kind


def variant_kind(run: VariantRun) -> str:
    """What a variant varies, in words."""
    if isinstance(run, ShiftRun):
        return UNCOUPLED if run.coupling is Coupling.NONE else "coupled one way"
    if isinstance(run, ShortPathRun):
        return {ShortPath.ONE_STEP: "one step each", ShortPath.TOTAL: "total slip"}[run.path]
    law = {
        FrictionLaw.VECTOR: "vector law at fixed pressure",
        FrictionLaw.FROZEN_DIRECTIONS: "directions frozen",
        FrictionLaw.FROZEN_TRANSVERSE: "q_y frozen",
        FrictionLaw.COMPONENT_WISE: "by component",
    }[run.law]
    frozen = run.law is FrictionLaw.FROZEN_DIRECTIONS
    return f"{law}, {run.steps.tangential} steps" if frozen else law


def variant_group(run: VariantRun) -> str:
    """What it is drawn together with."""
    if not isinstance(run, LawRun):
        return "other paths and less coupling"
    if run.law is FrictionLaw.FROZEN_DIRECTIONS:
        return "directions frozen, in so many steps"
    return "other bounds of the shear"


def paths_of(records: Records, runs: Iterable[R]) -> dict[R, SlidingPath]:
    """The paths of the runs that have a record."""
    return {run: SlidingPath.of(record) for run, record in found(runs, records).items()}
