"""Data of a verification case: its runs, the quantities measured on them, and their references."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any

from verification.judging.order_of_convergence import OrderOfChange, OrderOfConvergence
from verification.judging.run import AnyRun
from verification.problems.problem import Reference, ReferenceKind

if TYPE_CHECKING:
    from verification.exhibits.chart import Chart


class Level(IntEnum):
    """Amount of computation of a verification: quick at every push, standard before a merge, full
    at night."""

    QUICK = 0
    STANDARD = 1
    FULL = 2


@dataclass(frozen=True)
class Required:
    """Tolerance of a judged quantity that is prescribed, not derived from refinement.

    allowed  largest accepted error, relative to the error scale of the quantity
    because  reason for this tolerance
    """

    allowed: float
    because: str


@dataclass(frozen=True)
class Derived:
    """Tolerance of a judged quantity that is derived from its convergence under refinement.

    The tolerance is 2 √(u_num² + u_ref²), relative to the error scale of the quantity. u_num is the
    numerical uncertainty from the refinement levels, u_ref the uncertainty of the reference.

    levels   labels of the runs, coarse to fine
    order    expected order of convergence of the value
    cap      upper bound of the tolerance, which a poor solver cannot exceed
    because  reason for order and cap
    """

    levels: tuple[str, ...]
    order: float
    cap: float
    because: str


@dataclass(frozen=True)
class Quantity:
    """Number that is measured on one run of a case and judged against a reference.

    run         label of the run
    measure     function from the result of the run to the number
    reference   reference value with its uncertainty
    scale       error scale, in the unit of the number; None: absolute value of the reference
    scale_name  description of the error scale
    scalar      name, component and load step of a registered scalar, whose stated error is judged
                in addition; None for other numbers
    """

    name: str
    meaning: str
    unit: str
    run: str
    measure: Callable[[Any], float]
    reference: Reference
    tolerance: Required | Derived
    scale: float | None = None
    scale_name: str = "the reference"
    scalar: tuple[str, int, int] | None = None


@dataclass(frozen=True)
class Check:
    """Number that is measured without solving a scene, and judged against a reference.

    subject     object on which the number is measured, in words
    measure     function that computes the number
    scale       error scale, in the unit of the number; None: absolute value of the reference
    scale_name  description of the error scale
    """

    name: str
    meaning: str
    unit: str
    subject: str
    measure: Callable[[], float]
    reference: Reference
    tolerance: Required
    scale: float | None = None
    scale_name: str = "the reference"


@dataclass(frozen=True)
class Comparison:
    """Comparison of two runs that must agree, because they state one problem in two forms.

    runs         labels of the two runs; the difference is relative to the second run
    difference   function from both results to a dimensionless difference, 0 if they agree; it may
                 be the error of a quantity that follows from both results
    allowed      largest accepted difference
    kind         kind of the source that predicts the difference 0
    uncertainty  standard uncertainty of that prediction, relative to the scale of the difference
    """

    name: str
    meaning: str
    runs: tuple[str, str]
    difference: Callable[[Any, Any], float]
    allowed: float
    because: str
    source: str
    kind: ReferenceKind = ReferenceKind.IDENTITY
    uncertainty: float = 0.0


@dataclass(frozen=True)
class Finding:
    """Number that a report of a case shows with a remark, but does not judge.

    run      label of the run on which the number is measured
    measure  function from the result of the run to the number
    remark   interpretation of the number
    """

    name: str
    meaning: str
    unit: str
    run: str
    measure: Callable[[Any], float]
    remark: str


@dataclass(frozen=True)
class Case:
    """Verification case: runs to solve, and all quantities that are judged or reported.

    name         identifier for commands and files: letters, digits and underscores
    problem      description of the problem and of the source of its answer
    runs         solves of the case, by any solver
    quantities   numbers that are measured on runs and judged against references
    orders       orders of convergence that are judged
    findings     numbers that are reported and not judged
    comparisons  pairs of runs that must agree
    checks       numbers that are judged without a run; a case may consist of checks alone
    charts       function from the results, by label of the run, to the charts
    limits       limits of the conclusions from this case
    equations    governing equations of the reference, in LaTeX
    no_order     reason for which no order of convergence is judged; empty if one is judged
    """

    name: str
    title: str
    problem: str
    runs: tuple[AnyRun, ...]
    quantities: tuple[Quantity, ...]
    orders: tuple[OrderOfConvergence | OrderOfChange, ...] = ()
    findings: tuple[Finding, ...] = ()
    comparisons: tuple[Comparison, ...] = ()
    checks: tuple[Check, ...] = ()
    charts: Callable[[Mapping[str, Any]], tuple[Chart, ...]] | None = None
    limits: tuple[str, ...] = ()
    equations: tuple[str, ...] = ()
    no_order: str = ""

    def run(self, label: str) -> AnyRun:
        """Return the run of the case with the given label; raise KeyError for an unknown label."""
        return {run.label: run for run in self.runs}[label]
