"""The laws of contact and friction and the first law, judged in every run of every case.

A solver's residuals are its own word. Here its fields are held against the laws once more.

Of the semi-analytical method this shares the grid, the indenter's undeformed gap and µ: the laws
are looked for in tractions, gaps, slips and motions alone, with no influence coefficient. That the
displacements follow from the tractions shows only as far as Betti's theorem goes, in the energy. Of
finite elements it works the displacements out anew, but shares what they are worked out from:
meshes, the bodies' compliances with and without torsion, undeformed gap, hat functions and Gauss
points, and the energy stored and put in that are compared. Of the radial solver it shares µ and the
indenter's undeformed gap; integrals are its own sums over the rings. A wrong compliance, a mesh
that is too coarse or ends too near, a wrong shape and a wrong E*, G or µ obey all laws: only the
references of a case see them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from verification.judging.case import Case
from verification.judging.outcome import IMBALANCE, VIOLATION, Verdict
from verification.judging.run import OTHER_NORMS, OVER_ANGLES, OVER_RINGS
from verification.judging.verdicts import judge_worst
from verification.observed.imbalance import Imbalance
from verification.observed.laws import observed
from verification.observed.unseen import Unseen, unseen

WITHIN = (
    f"on cells and elements within {OTHER_NORMS:g} times the tolerance, as the norms of the solver "
    f"are others; on radii within what sums over rings and angles leave: "
    f"{OVER_RINGS:g}, or {OVER_ANGLES:g} where the solver interpolates between angles"
)


def judge_laws(case: Case, results: Mapping[str, Any]) -> tuple[Verdict, ...]:
    """The largest violation and the largest imbalance of all runs that were solved, each against
    the tolerance of its run."""
    found = {run.label: observed(results[run.label]) for run in case.runs if run.label in results}
    violated = {label: violation for label, (violation, _) in found.items()}
    missing = {label: energy for label, (_, energy) in found.items() if energy is not None}
    gaps = {label: unseen(results[label]) for label in found}
    but_slip = sum(gaps.values(), Unseen()).of_slip
    verdicts = [
        judge_worst(
            case, violated, VIOLATION, "largest violation of a law of contact and friction in any "
            f"increment of the {{runs}} run(s); it is in this one{but_slip}",
            "gap, overlap, friction, slip against shear, forces, moments and energy lost, found "
            "again in the fields",
            WITHIN, lambda run: run.laws,
        )
    ]  # fmt: skip
    if missing:
        but_energy = sum((gaps[label] for label in missing), Unseen()).of_energy
        verdicts.append(
            judge_worst(
                case, missing, IMBALANCE, "largest part of the energy that any increment cannot "
                f"account for of the {{runs}} run(s); it is in this one{{where}}{but_energy}",
                "first law: work put in is stored, dissipated or left open by the increment",
                f"residuals within the tolerance move the energy by a few times as much; {WITHIN}",
                lambda run: run.energy,
                {label: f", {e.terms}" for label, e in missing.items() if isinstance(e, Imbalance)},
            )
        )  # fmt: skip
    return tuple(verdicts)
