"""A number beside the one that was recorded for it: the verdict on regression."""

from enum import StrEnum

from contact_scene.reading.description import Description

SHORT_COMMIT = 7


class ChangeKind(StrEnum):
    """How a number compares with the recorded one."""

    UNCHANGED = "unchanged"
    """Also what other processors and versions leave: a millionth of what errors are divided by, or
    a hundredth of what is allowed; of counts, a twentieth over a case."""

    DRIFT = "drift"
    """Differs, and is still within what its reference allows, or has none."""

    BETTER = "better"
    """The error has fallen far without a reason on record."""

    WORSE = "worse"
    """The error has grown by half or more, and by more than the noise of machines, though it is
    still allowed."""

    DEARER = "dearer"
    """More iterations, convolutions or factorisations for the same."""

    OUTSIDE = "outside"
    """Fails, and did not when it was recorded; or has moved away from its reference by more than is
    allowed at all. An order that can no longer be judged is held to what was allowed when it was
    recorded."""

    NEW = "new"

    GONE = "gone"
    """Recorded, and no longer measured: deletions are accepted with a reason, too."""

    @property
    def matters(self) -> bool:
        """Whether the baseline does not describe the number any more."""
        return self is not ChangeKind.UNCHANGED

    @property
    def regresses(self) -> bool:
        """Whether it must be accepted with a reason before the commit passes."""
        return self in (
            ChangeKind.OUTSIDE, ChangeKind.WORSE, ChangeKind.DEARER, ChangeKind.GONE
        )  # fmt: skip


class Change(Description):
    """A quantity or finding beside the recorded one."""

    kind: ChangeKind
    recorded: bool = True
    """Whether there is anything to compare with."""

    was: float | None = None
    """Null if nothing was recorded, or a number that is not finite."""

    moved: float | None = None
    """|value - was| as a part of the allowed error; null where nothing is allowed or known."""

    since: str
    """Commit that the recorded number is from, as a reader sees it."""

    remark: str = ""


class CounterChange(Description):
    """A count of a case's solves that differs from the recorded one."""

    name: str
    kind: ChangeKind
    was: int
    now: int
    remark: str = ""


class Gone(Description):
    """What was recorded and is not measured any more."""

    name: str
    run: str
    unit: str
    was: float | None


class GoneCase(Description):
    """A case that was recorded and is not in a report of all cases any more."""

    name: str
    since: str
    """Commit that its recording is from, as a reader sees it."""


class Origin(Description):
    """Where the recorded numbers of a case come from."""

    commit: str | None
    changed: bool
    """Whether the source differed from that commit."""

    date: str
    reason: str
    """Why they were accepted."""

    differs: tuple[str, ...] = ()
    """What is different now, of processor and versions."""

    @property
    def name(self) -> str:
        """The commit as a reader sees it."""
        return commit_text(self.commit, changed=self.changed)


def commit_text(commit: str | None, *, changed: bool) -> str:
    """A commit in a sentence."""
    text = "an unknown commit" if commit is None else commit[:SHORT_COMMIT]
    return f"{text} with changes" if changed else text
