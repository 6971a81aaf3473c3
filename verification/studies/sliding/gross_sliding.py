"""The gross-sliding study: its question, and what is concluded from its records."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from verification.exhibits.chart import Chart
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.running.row import CaseRecord, found
from verification.running.study import Conclusion, Records, Settings, Study, StudyCase
from verification.studies.sliding import verdicts
from verification.studies.sliding.charts import (
    MICROMETRE,
    force_chart,
    stick_fraction_chart,
    variants_chart,
)
from verification.studies.sliding.estimate import Estimate, estimate
from verification.studies.sliding.full_slip import full_slip
from verification.studies.sliding.path import SlidingPath
from verification.studies.sliding.selection import (
    ALIKE,
    ASSUMED,
    PAPER_RATIO,
    RATIOS,
    UNCOUPLED,
    ContactCases,
    VariantRun,
    cases,
    cases_of,
    null_runs,
    path_of,
    variant_group,
    variant_kind,
    variant_name,
)
from verification.studies.sliding.verdicts import Variant, largest_force

REMARKS = (
    f"{ASSUMED}normal steps uniform in contact radius.",
    "Gross sliding cannot begin below µW as a greatest force: in sustained sliding every particle "
    "slips along the motion, and T = µW. What can happen below µW is that the last cell lets go "
    "while slip directions still differ; that force is T_fs.",
    "Two variants leave out part of the coupling, to which the paper attributes its number: the "
    "shear's effect on the pressure (one way), or both effects.",
    "The friction-law variants keep the pressure of the end of the normal loading and start from "
    "the shear that the vector law leaves there; 'vector' among them shows what the fixed pressure "
    "changes. Frozen directions depend on the size of the increments, which the paper does not "
    "state: the fewer, the larger the force.",
    "The variants are computed on at most 64 × 64 cells unless they say otherwise, at the quick "
    "level for E1/E2 = 2 only.",
)


@dataclass(frozen=True)
class _Found:
    """The records, sorted by what they are for; contacts by the name that people see."""

    settings: Settings
    records: Records

    @cached_property
    def contacts(self) -> dict[str, ContactCases]:
        return {_name(ratio): cases_of(ratio, self.settings) for ratio in RATIOS}

    @cached_property
    def base(self) -> dict[str, SlidingPath]:
        """Histories under shift control on the finest grid."""
        known = {name: path_of(self.records, c.base) for name, c in self.contacts.items()}
        return {name: path for name, path in known.items() if path is not None}

    @cached_property
    def null(self) -> dict[str, SlidingPath]:
        """Histories of the identical bodies."""
        runs = zip(ALIKE, null_runs(self.settings), strict=True)
        known = {f"identical, ν = {a.poisson_ratio:g}": path_of(self.records, r) for a, r in runs}
        return {name: path for name, path in known.items() if path is not None}

    @cached_property
    def estimates(self) -> dict[str, Estimate]:
        evidence = {name: c.evidence(self.records) for name, c in self.contacts.items()}
        known = {name: estimate(e) for name, e in evidence.items() if e is not None}
        return {name: e for name, e in known.items() if e is not None}

    def variant_runs(self, contact: str) -> dict[VariantRun, SlidingPath]:
        """The variants of a contact that have a record."""
        known = {run: path_of(self.records, run) for run in self.contacts[contact].variants}
        return {run: path for run, path in known.items() if path is not None}

    def variants(self, contact: str) -> tuple[Variant, ...]:
        return tuple(
            Variant(
                variant_name(run), variant_kind(run), run.cells, full_slip(path),
                largest_force(path),
            )
            for run, path in self.variant_runs(contact).items()
        )  # fmt: skip

    @cached_property
    def product(self) -> tuple[CaseRecord, ...]:
        """All histories that the product's solver made, the short paths left out."""
        runs: list[StudyCase] = [*null_runs(self.settings)]
        for c in self.contacts.values():
            runs += [*c.histories, c.force]
        return tuple(found(runs, self.records).values())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """The verdict from the records that there are."""
    here = _Found(settings, records)
    paper = _name(PAPER_RATIO)
    null = [full_slip(path) for path in here.null.values()]
    return Conclusion(
        answer=verdicts.answer(here.base.get(paper), here.estimates.get(paper)),
        statements=(
            verdicts.limit_is_reached(here.base),
            verdicts.paper_number(here.estimates.get(paper), here.variants(paper)),
            verdicts.force_is_mean_cosine(here.base),
            verdicts.slip_opposes_shear(here.base),
            verdicts.null_tests(*(null if len(null) == len(ALIKE) else (None, None))),
            verdicts.uncoupled_sticks(
                {
                    name: v
                    for name in here.contacts
                    for v in here.variants(name)
                    if v.kind == UNCOUPLED
                }
            ),
            verdicts.refinement_agrees(here.estimates),
            verdicts.all_converged(here.product),
        ),
        tables=(_results(here), _variant_table(here)),
        charts=_charts(here, paper),
        remarks=REMARKS,
    )


def _charts(here: _Found, paper: str) -> tuple[Chart, ...]:
    if not here.base:
        return ()
    scales = {name: c.base.contact.sliding_scale for name, c in here.contacts.items()}
    scales |= {f"identical, ν = {a.poisson_ratio:g}": a.sliding_scale for a in ALIKE}
    charts = [
        stick_fraction_chart(here.base | here.null, scales),
        force_chart(here.base, here.estimates),
    ]
    groups: dict[str, dict[str, SlidingPath]] = {}
    for run, path in here.variant_runs(paper).items():
        groups.setdefault(variant_group(run), {})[variant_name(run)] = path
    if groups and paper in here.base:
        charts.append(variants_chart(here.base[paper], groups))
    return tuple(charts)


def _results(here: _Found) -> Table:
    rows = []
    for name, path in here.base.items():
        e = here.estimates.get(name)
        by_force = path_of(here.records, here.contacts[name].force)
        in_force = full_slip(by_force) if by_force is not None else None
        full = [p for p in path.points if p.full_slip and p.shift > 0]
        rows.append((
            name,
            e.text if e else "not resolved",
            ", ".join(plain(v, 2) for v in _parts(e)) if e else "–",
            in_force.text if in_force else "–",
            f"{e.full_slip.shift / MICROMETRE:.3f}" if e else "–",
            f"{largest_force(path):.7f}",
            f"{full[0].mean_cosine:.4f}" if full else "–",
        ))  # fmt: skip
    return Table(
        title="Where the stick area vanishes, and how far the force still grows",
        columns=(
            "contact", "T_fs / µW", "bar from fit, cells, steps of shift and W",
            "T_fs by force, 20 steps", "shift at T_fs (µm)", "T_max / µW",
            "⟨cosψ⟩, first without stick",
        ),
        rows=tuple(rows),
        note="T_fs from the halved shift steps on the finest grid. In twenty steps of force the "
        "increments are coarser, and the difference is theirs.",
    )  # fmt: skip


def _parts(e: Estimate) -> tuple[float, ...]:
    return e.full_slip.uncertainty, e.by_cells, e.by_shift_steps, e.by_normal_steps


def _variant_table(here: _Found) -> Table:
    rows = [
        (
            f"{variant.name}; {contact}",
            variant.vanishing.text if variant.vanishing else "not resolved",
            f"{variant.largest:.4f}",
            "near" if variant.near_paper else "no",
        )
        for contact in here.contacts
        for variant in here.variants(contact)
    ]
    return Table(
        title="Other paths and other readings of the friction law",
        columns=("variant", "T_fs / µW", "T_max / µW", "near 0.76"),
        rows=tuple(rows),
        note=f"T_max up to three times Mindlin's sliding displacement. Near is T_fs within "
        f"{verdicts.NEAR:g} and its bar of {verdicts.PAPER:g}, or T_max within {verdicts.NEAR:g} "
        "of it. On the total slip the stick "
        "zone is a spot of a few cells that wanders to the trailing edge and leaves there: where "
        "that happens depends on the cells, so a number near 0.76 on one grid proves nothing.",
    )


def _name(ratio: float) -> str:
    return f"E1/E2 = {ratio:g}"


STUDY = Study(
    name="gross-sliding",
    title="Does a coated contact slide grossly at 0.76 µW?",
    question="The paper reports gross sliding of a coated contact (E1/E2 = 2) once T exceeds "
    "0.76 µW, although the limit of friction is µW. Here the indenter is shifted until everything "
    "slides, for four coatings; the paper's law of friction is completed in several ways; and "
    "physics is judged apart from the paper's number.",
    cases=cases,
    conclude=conclude,
)
