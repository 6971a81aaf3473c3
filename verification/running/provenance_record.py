"""Who made numbers, on what and when: the block that every record of ours carries."""

from contact_scene.description import Description
from verification.running.study import Conclusion

FAR_OVER = 2.0  # times the target


class Benchmark(Description):
    """A measured cost beside its target."""

    name: str
    meaning: str
    unit: str
    """s, or nothing for a ratio."""

    value: float
    target: float

    @property
    def outcome(self) -> str:
        """In words: within, over, or far over the target."""
        if self.value <= self.target:
            return "within"
        return "over" if self.value <= FAR_OVER * self.target else "far over"


class Provenance(Description):
    """Who made the numbers, when, on what, and how long it took."""

    program_version: str
    commit: str | None
    """Commit of the source; null outside a repository."""

    changed: bool
    """Whether the source differed from that commit."""

    modules: tuple[str, ...] = ()
    """Modules that made the numbers; none in older records."""

    sources: str | None = None
    """Digest of these modules and of all that they import from the project."""

    command: str
    date: str
    """Coordinated universal time, ISO 8601."""

    machine: dict[str, str | int | None]
    libraries: dict[str, str | None]
    seconds: dict[str, float]
    """Wall seconds by case."""

    benchmarks: tuple[Benchmark, ...] = ()
    """Costs of this machine at this moment; none if only some cases were run."""

    timed: Conclusion | None = None
    """What a study finds by its seconds; null for a report, and for studies that measure none."""
