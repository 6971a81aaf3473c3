"""Data of a verification case: runs, measured quantities, references, tolerances and orders."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import TYPE_CHECKING, Any

from verification.convergence.observed_order import ORDER_WIDTH
from verification.judging.run import AnyRun
from verification.problems.problem import Reference, ReferenceKind

if TYPE_CHECKING:
    from verification.exhibits.chart import Chart


class Followed(StrEnum):
    """Quantities of a contact for which an order of convergence can be determined from refinement
    levels.
    """

    PRESSURE = "pressure"
    PEAK_PRESSURE = "peak pressure"
    APPROACH = "approach"
    CONTACT_RADIUS = "contact radius"
    SHEAR = "shear"
    SHIFT = "tangential shift"
    TWIST = "twist"
    ENERGY = "dissipated energy"


class Refinement(StrEnum):
    """Discretisation parameter that a sequence of runs refines: the mesh or the number of
    increments.
    """

    MESH = "mesh"
    INCREMENTS = "increments"


@dataclass(frozen=True)
class NotYetAsymptotic:
    """Allowance for an order of convergence that is observed on levels too coarse for the theory.

    allowance  accepted difference from the expected order
    because    cause of the difference

    The tolerance of the order is the larger of the allowance and the interval of the observed
    order, not their sum. Raises ValueError for an allowance that any order would meet.
    """

    allowance: float
    because: str

    def __post_init__(self) -> None:
        if not 0 < self.allowance < ORDER_WIDTH:
            raise ValueError(f"got {self.allowance}; an order judged to {ORDER_WIDTH} needs less")


@dataclass(frozen=True)
class Order:
    """Declaration of an order of convergence: the expected exponent p with which errors fall as
    h^p.

    Where the exact answer is not known, the changes between refinement levels replace the errors;
    changes fall with the same exponent.

    of        quantity whose order is determined
    meaning   description of the error or change
    levels    labels of the runs, coarse to fine; runs of equal size form one level, with the root
              mean square of their errors
    error     function from the result of a run to its error, of either sign; for changes, function
              from the results of two levels to their difference > 0
    expected  exponent p according to theory
    because   reason for the expected order
    not_yet   allowance for levels that are not asymptotic; None if there is no known reason
    refined   discretisation parameter that is refined
    size      function from a result to its discretisation parameter h; None: cell or element side
    apart     distance between the two compared levels in the list of levels; 0 for errors
    """

    name: str
    of: Followed
    meaning: str
    levels: tuple[str, ...]
    error: Callable[..., float]
    expected: float
    because: str
    not_yet: NotYetAsymptotic | None = None
    refined: Refinement = Refinement.MESH
    size: Callable[[Any], float] | None = None
    apart: int = 0


class Level(IntEnum):
    """Amount of computation of the verification: number of runs and fineness of their
    discretisation.

    Quick runs at every push, standard before a merge, full at night.
    """

    QUICK = 0
    STANDARD = 1
    FULL = 2


@dataclass(frozen=True)
class Required:
    """Prescribed tolerance of a judged quantity; it does not depend on results.

    allowed  largest accepted error, relative to the error scale of the quantity
    because  reason for this tolerance
    """

    allowed: float
    because: str


@dataclass(frozen=True)
class Derived:
    """Tolerance of a judged quantity that is computed from its values on several refinement levels.

    The tolerance is 2 √(u_num² + u_ref²), relative to the error scale of the quantity. u_num is the
    numerical uncertainty from the refinement levels, u_ref the uncertainty of the reference.

    levels   labels of the runs, coarse to fine
    order    expected order of convergence of the value
    cap      upper bound of the tolerance; without it a poor solver would get a wide tolerance
    because  reason for order and cap
    """

    levels: tuple[str, ...]
    order: float
    cap: float
    because: str


@dataclass(frozen=True)
class Quantity:
    """Number that a case judges against a reference.

    The number is measured on one run, on two runs that must agree, or without a run, such as the
    frequency response of a body.

    name        name of the verdict
    meaning     description of the number
    unit        SI unit; empty for a ratio
    run         label of the run; without a single run, the object of the measurement in words
    measure     function from the results of the runs to the number
    reference   reference value with its uncertainty
    tolerance   largest accepted error
    scale       error scale, in the unit of the number; None: absolute value of the reference
    scale_name  description of the error scale
    scalar      name, component and load step of a registered scalar, whose stated error is judged
                in addition; None for other numbers
    runs        labels of the runs whose results are measured; None: the single run
    """

    name: str
    meaning: str
    unit: str
    run: str
    measure: Callable[..., float]
    reference: Reference
    tolerance: Required | Derived
    scale: float | None = None
    scale_name: str = "the reference"
    scalar: tuple[str, int, int] | None = None
    runs: tuple[str, ...] | None = None

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of the runs on whose results the number is measured; empty without a run."""
        return (self.run,) if self.runs is None else self.runs


def compare_runs(
    name: str,
    meaning: str,
    runs: tuple[str, str],
    difference: Callable[[Any, Any], float],
    allowed: float,
    because: str,
    source: str,
    kind: ReferenceKind = ReferenceKind.IDENTITY,
    uncertainty: float = 0.0,
) -> Quantity:
    """Create the judged difference of two runs that must agree, because both describe one problem.

    runs         labels of the two runs; the difference is relative to the second run
    difference   function from both results to a dimensionless difference, 0 if they agree; it may
                 be the error of a quantity that follows from both results
    allowed      largest accepted difference
    because      reason for this tolerance
    source       source that predicts the difference 0
    kind         kind of this source
    uncertainty  standard uncertainty of the prediction, relative to the scale of the difference
    """
    zero = Reference(0.0, kind, source, uncertainty)
    return Quantity(
        name, meaning, "", " and ".join(runs), difference, zero, Required(allowed, because), 1.0,
        "the second run's", runs=runs,
    )  # fmt: skip


@dataclass(frozen=True)
class Finding:
    """Number that the report of a case shows for information, with a remark and without a verdict.

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
    quantities   numbers that are judged against references; a case may consist of these alone
    orders       orders of convergence that are judged
    findings     numbers that are reported and not judged
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
    orders: tuple[Order, ...] = ()
    findings: tuple[Finding, ...] = ()
    charts: Callable[[Mapping[str, Any]], tuple[Chart, ...]] | None = None
    limits: tuple[str, ...] = ()
    equations: tuple[str, ...] = ()
    no_order: str = ""

    def run(self, label: str) -> AnyRun:
        """Return the run of the case with the given label.

        Raises KeyError for an unknown label.
        """
        return {run.label: run for run in self.runs}[label]
