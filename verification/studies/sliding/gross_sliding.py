"""The gross-sliding study: its question, and what is concluded from its records."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

from verification.exhibits.chart import Chart
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table, table_of
from verification.running.row import CaseRecord, found
from verification.running.study import Conclusion, Records, Settings, Study, StudyCase
from verification.studies.sliding import verdicts
from verification.studies.sliding.charts import (
    MICROMETRE,
    force_chart,
    stick_fraction_chart,
    variants_chart,
)
from verification.studies.sliding.estimate import Estimate
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
    paths_of,
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

# By the name that people see.
IDENTICAL = {f"identical, ν = {alike.poisson_ratio:g}": alike for alike in ALIKE}


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
        return self._named({name: c.base for name, c in self.contacts.items()})

    @cached_property
    def null(self) -> dict[str, SlidingPath]:
        """Histories of the identical bodies."""
        return self._named(dict(zip(IDENTICAL, null_runs(self.settings), strict=True)))

    @cached_property
    def estimates(self) -> dict[str, Estimate]:
        known = {name: c.estimate(self.records) for name, c in self.contacts.items()}
        return {name: e for name, e in known.items() if e is not None}

    @cached_property
    def by_force(self) -> dict[str, SlidingPath]:
        """Histories in twenty steps of force."""
        return self._named({name: c.force for name, c in self.contacts.items()})

    def _named(self, runs: Mapping[str, StudyCase]) -> dict[str, SlidingPath]:
        paths = paths_of(self.records, runs.values())
        return {name: paths[run] for name, run in runs.items() if run in paths}

    def variant_runs(self, contact: str) -> dict[VariantRun, SlidingPath]:
        """The variants of a contact that have a record."""
        return paths_of(self.records, self.contacts[contact].variants)

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
            verdicts.null_tests(*(null if len(null) == len(IDENTICAL) else (None, None))),
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
    scales |= {name: alike.sliding_scale for name, alike in IDENTICAL.items()}
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
    def resolved(text: Callable[[Estimate], str], without: str = "–") -> Callable[[str], str]:
        known = here.estimates
        return lambda name: text(known[name]) if name in known else without

    def in_force(name: str) -> str:
        found = full_slip(here.by_force[name]) if name in here.by_force else None
        return found.text if found else "–"

    def without_stick(name: str) -> str:
        full = (p for p in here.base[name].points if p.full_slip and p.shift > 0)
        first = next(full, None)
        return f"{first.mean_cosine:.4f}" if first else "–"

    return table_of(
        "Where the stick area vanishes, and how far the force still grows",
        {
            "contact": str,
            "T_fs / µW": resolved(lambda e: e.text, "not resolved"),
            "bar from fit, cells, steps of shift and W": resolved(
                lambda e: ", ".join(plain(part, 2) for part in e.parts)
            ),
            "T_fs by force, 20 steps": in_force,
            "shift at T_fs": resolved(lambda e: f"{e.full_slip.shift / MICROMETRE:.3f}"),
            "T_max / µW": lambda name: f"{largest_force(here.base[name]):.7f}",
            "⟨cosψ⟩, first without stick": without_stick,
        },
        here.base,
        "T_fs from the halved shift steps on the finest grid. In twenty steps of force the "
        "increments are coarser, and the difference is theirs.",
        {"shift at T_fs": "µm"},
    )


def _variant_table(here: _Found) -> Table:
    return table_of(
        "Other paths and other readings of the friction law",
        {
            "variant": lambda of: f"{of[1].name}; {of[0]}",
            "T_fs / µW": lambda of: of[1].vanishing_text,
            "T_max / µW": lambda of: f"{of[1].largest:.4f}",
            "near 0.76": lambda of: "near" if of[1].near_paper else "no",
        },
        [(contact, one) for contact in here.contacts for one in here.variants(contact)],
        f"T_max up to three times Mindlin's sliding displacement. Near is T_fs within "
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
