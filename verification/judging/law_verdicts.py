"""The laws of contact and friction and the first law, judged in every run of every case.

A solver's residuals are its own word. Here its fields are held against the laws once more.

Of the semi-analytical method this shares the grid, the indenter's undeformed gap and µ: the laws
are looked for in tractions, gaps, slips and motions alone, with no influence coefficient. That the
displacements follow from the tractions shows only as far as Betti's theorem goes, in the energy. Of
finite elements it works the displacements out anew, but shares what they are worked out from:
meshes, the bodies' compliances with and without torsion, undeformed gap, hat functions and Gauss
points, and the energy stored and put in that are compared. A wrong compliance, a mesh that is too
coarse or ends too near, a wrong shape and a wrong E*, G or µ obey all laws: only the references of
a case see them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from verification.judging.case import Case
from verification.judging.outcome import Status, Verdict
from verification.judging.verdicts import finite
from verification.observed.laws import observed
from verification.observed.unseen import Unseen, unseen
from verification.problems.reference import ReferenceKind

Results = Mapping[str, Any]

# Fields are judged apart from the solver, with other norms.
OTHER_NORMS = 10.0
VIOLATION, IMBALANCE = "observed_violation", "energy_imbalance"


def judge_laws(case: Case, results: Results) -> tuple[Verdict, ...]:
    """The largest violation and the largest imbalance of all runs that were solved, each against
    the tolerance of its run."""
    found = {label: observed(results[label]) for label in _solved(case, results)}
    violated = {label: violation for label, (violation, _) in found.items()}
    missing = {label: energy for label, (_, energy) in found.items() if energy is not None}
    gaps = {label: unseen(results[label]) for label in found}
    verdicts = [
        _verdict(
            case, violated, VIOLATION, "largest violation of a law of contact and "
            "friction in any increment",
            "gap, overlap, friction, slip against shear, forces, moments and energy lost, found "
            "again in the fields",
            "within the tolerance, but for a factor of {factor:g} between the norms of the solver "
            "and these",
            sum(gaps.values(), Unseen()).of_slip,
        ),
    ]  # fmt: skip
    if missing:
        verdicts.append(
            _verdict(
                case, missing, IMBALANCE, "largest part of the energy that any increment "
                "cannot account for",
                "first law: work put in is stored, dissipated or left open by the increment",
                "residuals within the tolerance move the energy by a few times as much; "
                "{factor:g} times are allowed",
                sum((gaps[label] for label in missing), Unseen()).of_energy,
            )
        )  # fmt: skip
    return tuple(verdicts)


def _solved(case: Case, results: Results) -> list[str]:
    return [run.label for run in case.runs if run.label in results]


def _verdict(
    case: Case,
    found: Mapping[str, float],
    name: str,
    what: str,
    source: str,
    because: str,
    but: str,
) -> Verdict:
    """On the run that is worst for its tolerance; what is no number is worse than all.

    but  what could not be held against the laws
    """
    clearance = {label: value / case.run(label).tolerance for label, value in found.items()}
    worst = max(clearance, key=lambda label: (math.isnan(clearance[label]), clearance[label]))
    allowed = OTHER_NORMS * case.run(worst).tolerance
    value = found[worst]
    return Verdict(
        name=name,
        run=worst,
        meaning=f"{what} of the {len(found)} run(s); it is in this one{but}",
        unit="",
        value=finite(value),
        reference=0.0,
        reference_kind=ReferenceKind.IDENTITY,
        source=source,
        error=finite(value),
        allowed=allowed,
        scale=1.0,
        scale_name="dimensionless",
        tolerance_kind="required",
        because=because.format(factor=OTHER_NORMS),
        status=Status.PASS if value <= allowed else Status.FAIL,
    )
