"""Which cases the gross-sliding study computes."""

from __future__ import annotations

from dataclasses import dataclass, replace

from semi_analytical import Coupling
from verification.judging.case import Level
from verification.running.study import Records, Settings, StudyCase
from verification.studies.gross_sliding.estimate import Evidence
from verification.studies.sliding_runs.contacts import AlikeContact, CoatedContact
from verification.studies.sliding_runs.friction_laws import FrictionLaw
from verification.studies.sliding_runs.law_run import LawRun
from verification.studies.sliding_runs.path import SlidingPath
from verification.studies.sliding_runs.runs import (
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
OTHER_COUNTS = (80, 20, 10, 5)  # of increments, for directions that freeze


VariantRun = LawRun | ShortPathRun | ShiftRun
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

    def evidence(self, records: Records) -> Evidence | None:
        """Their records; None if one is missing."""
        paths = [path_of(records, run) for run in self.histories]
        found = [path for path in paths if path is not None]
        return Evidence(*found) if len(found) == len(paths) else None


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
        ForceRun(contact, cells, steps.normal, FORCE_INCREMENTS, LARGEST_FORCE),
        variants,
    )


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """All cases, the long ones first so that no worker is left with one at the end."""
    contacts = [cases_of(ratio, settings) for ratio in RATIOS]
    return (
        *(c.half_shift for c in contacts),
        *(c.base for c in contacts),
        *(c.half_normal for c in contacts),
        *(c.coarse for c in contacts),
        *(c.force for c in contacts),
        *null_runs(settings),
        *(variant for c in contacts for variant in c.variants),
    )


def null_runs(settings: Settings) -> tuple[ShiftRun, ...]:
    """Identical bodies, ν = 0 and ν = 0.3."""
    cells = settings.cells or CELLS[settings.level]
    steps = replace(STEPS[settings.level], normal=1)
    return tuple(ShiftRun(alike, cells, steps) for alike in ALIKE)


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


def path_of(records: Records, run: StudyCase) -> SlidingPath | None:
    """The record of a run; None if it is missing."""
    record = records.get(run.name)
    return record if isinstance(record, SlidingPath) else None
