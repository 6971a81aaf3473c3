"""A case: scenes on grids, the quantities measured on them, and the references that judge these."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import TYPE_CHECKING, Any, ClassVar

from contact_scene import Scene
from semi_analytical.grid import SurfaceGrid
from verification.cases.order_of_convergence import OrderOfChange, OrderOfConvergence

if TYPE_CHECKING:
    from semi_analytical import Plan
    from verification.cases.chart import Chart
    from verification.cases.section_run import SectionRun
    from verification.cases.table import Table

SOLVER_TOLERANCE = 1e-8
ROUNDING = 1e-12  # relative uncertainty of a closed form in double precision


class Level(IntEnum):
    """How much is computed: quick at every push, standard before a merge, full at night."""

    QUICK = 0
    STANDARD = 1
    FULL = 2


class ReferenceKind(StrEnum):
    """Where a reference comes from."""

    CLOSED_FORM = "closed form"
    SEMI_CLOSED = "semi-closed"
    THEORY = "theory"
    EXTERNAL_CODE = "external code"
    OTHER_SOLVER = "other solver"
    OWN_REFINEMENT = "own refinement"  # the same solver on a coarser discretisation
    IDENTITY = "identity"  # holds exactly by a theorem or by the equations themselves


@dataclass(frozen=True)
class Run:
    """One solve: a scene on a grid to a tolerance. The label names it within its case.

    effects  from the plan of the scene to the one to solve with; None: as planned
    """

    label: str
    scene: Scene
    grid: SurfaceGrid
    tolerance: float = SOLVER_TOLERANCE
    effects: Callable[[Plan], Plan] | None = None

    solver: ClassVar[str] = "semi-analytical"

    @property
    def spacing(self) -> float:
        """The longer side of a cell [length]."""
        return max(self.grid.spacing)


@dataclass(frozen=True)
class Reference:
    """A number somebody else vouches for.

    uncertainty  standard uncertainty u_ref, in the unit of the value
    """

    value: float
    kind: ReferenceKind
    source: str
    uncertainty: float = 0.0


@dataclass(frozen=True)
class Required:
    """A tolerance that was asked for, or is set by hand; relative to the quantity's scale."""

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
    """Two runs that must give the same, because they are the same problem said differently.

    runs        labels; the difference is relative to the second
    difference  0 if they agree, dimensionless; or the error of what follows from both
    kind        where the value comes from that the difference vanishes for
    """

    name: str
    meaning: str
    runs: tuple[str, str]
    difference: Callable[[Any, Any], float]
    allowed: float
    because: str
    source: str
    kind: ReferenceKind = ReferenceKind.IDENTITY


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
    tables   more numbers than verdicts could show, likewise
    limits   what this case does not show
    """

    name: str
    title: str
    problem: str
    runs: tuple[Run | SectionRun, ...]
    quantities: tuple[Quantity, ...]
    orders: tuple[OrderOfConvergence | OrderOfChange, ...] = ()
    findings: tuple[Finding, ...] = ()
    comparisons: tuple[Comparison, ...] = ()
    checks: tuple[Check, ...] = ()
    charts: Callable[[Mapping[str, Any]], tuple[Chart, ...]] | None = None
    tables: Callable[[Mapping[str, Any]], tuple[Table, ...]] | None = None
    limits: tuple[str, ...] = ()

    def run(self, label: str) -> Run | SectionRun:
        """The run of this label; KeyError if there is none."""
        return {run.label: run for run in self.runs}[label]


def closed_form(value: float, source: str, scale: float | None = None) -> Reference:
    """A closed form, uncertain by rounding of itself or of the scale it is compared on."""
    uncertainty = ROUNDING * abs(value if scale is None else scale)
    return Reference(value, ReferenceKind.CLOSED_FORM, source, uncertainty)


def identity(value: float, source: str) -> Reference:
    """A value that follows from the equations themselves."""
    return Reference(value, ReferenceKind.IDENTITY, source)


def exact_zero(source: str) -> Reference:
    """The reference of an error norm: a closed form leaves no error."""
    return Reference(0.0, ReferenceKind.CLOSED_FORM, source)
