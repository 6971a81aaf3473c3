"""What came out of a case: plain values that go into `report.json` as they are."""

from enum import StrEnum

from contact_scene.description import Description
from contact_scene.summary import EffectSummary
from verification.cases.chart import Chart
from verification.cases.table import Table


class Status(StrEnum):
    """How a judgement ended."""

    PASS = "pass"
    FAIL = "fail"
    INCONCLUSIVE = "inconclusive"


class Verdict(Description):
    """One judged quantity. Errors are relative to `scale_name`; numbers that are not finite are
    null and fail."""

    name: str
    run: str
    meaning: str
    unit: str
    value: float | None
    reference: float
    reference_kind: str
    source: str
    error: float | None
    """|value - reference| / scale."""

    allowed: float
    scale: float
    scale_name: str
    tolerance_kind: str
    """required, derived, or order."""

    because: str
    status: Status
    interval: float | None = None
    """Half-width of the 95 % interval of an observed order."""

    @property
    def clearance(self) -> float | None:
        """Error as a part of what is allowed; above 1 is a failure."""
        return None if self.error is None else self.error / self.allowed


class FindingRecord(Description):
    """A number that is reported and not judged; null where it is not finite."""

    name: str
    run: str
    meaning: str
    unit: str
    value: float | None
    remark: str


class RunRecord(Description):
    """One solve and its deterministic cost."""

    label: str
    cells: tuple[int, int]
    window: tuple[float, float]
    tolerance: float
    increments: int
    iterations: int
    convolutions: int
    largest_residual: float | None


class SceneRecord(Description):
    """A scene in words, and the effects that its plan switches on or off."""

    title: str
    lines: tuple[tuple[str, str], ...]
    effects: tuple[EffectSummary, ...]


class CaseOutcome(Description):
    """Everything a case has to say."""

    name: str
    title: str
    problem: str
    scenes: tuple[SceneRecord, ...]
    runs: tuple[RunRecord, ...]
    verdicts: tuple[Verdict, ...]
    findings: tuple[FindingRecord, ...]
    charts: tuple[Chart, ...]
    limits: tuple[str, ...]
    tables: tuple[Table, ...] = ()

    def count(self, status: Status) -> int:
        """How many verdicts have this status."""
        return sum(verdict.status is status for verdict in self.verdicts)

    @property
    def status(self) -> Status:
        """The worst status of its verdicts."""
        if self.count(Status.FAIL):
            return Status.FAIL
        return Status.INCONCLUSIVE if self.count(Status.INCONCLUSIVE) else Status.PASS
