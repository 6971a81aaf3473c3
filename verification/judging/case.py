"""A case: scenes on grids, the quantities measured on them, and the references that judge these."""

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
    """Amount of computation: quick at every push, standard before a merge, full at night."""

    QUICK = 0
    STANDARD = 1
    FULL = 2


@dataclass(frozen=True)
class Required:
    """Tolerance that is required or set by hand, relative to the quantity's scale."""

    allowed: float
    because: str


@dataclass(frozen=True)
class Derived:
    """2 √(u_num² + u_ref²), with u_num from refinement; relative to the quantity's scale.

    levels   labels of the runs, coarse to fine
    order    expected order of the value's convergence
    cap      no tolerance is wider than this, however poor the solver
    because  where order and cap come from
    """

    levels: tuple[str, ...]
    order: float
    cap: float
    because: str


@dataclass(frozen=True)
class Quantity:
    """A number measured on one run and judged against a reference.

    scale       what an error is divided by; None: the reference's absolute value
    scale_name  what the error is relative to, in words
    scalar      registered scalar, component and load step, whose stated error is judged, too; None
                for other numbers
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
    """A number that is measured without solving a scene, and judged against a reference.

    subject  what it is measured on
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
    """Two runs that must agree, because they state one problem in two forms.

    runs        labels; the difference is relative to the second
    difference  0 if they agree, dimensionless; or the error of what follows from both
    kind        where the value comes from that the difference vanishes for
    uncertainty standard uncertainty of that value, over the scale of the difference
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
    """A number that is reported and not judged, with what it means."""

    name: str
    meaning: str
    unit: str
    run: str
    measure: Callable[[Any], float]
    remark: str


@dataclass(frozen=True)
class Case:
    """A verification case.

    name     for commands and files: letters, digits and underscores
    problem  what is solved and why the answer is known, for a reader
    runs     by either solver; what is measured takes the result of the run it names
    checks   what is judged beside the runs; a case may have nothing else
    charts   figures drawn from the results, by label of the run
    limits   what this case does not show
    equations  governing equations of the reference, in LaTeX
    no_order   reason for which no order of convergence is judged; empty where one is
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
        """The run of this label; KeyError if there is none."""
        return {run.label: run for run in self.runs}[label]
