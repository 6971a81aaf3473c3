"""Who made numbers, on what and when: the block that every record of ours carries."""

from contact_scene.reading.description import Description


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
