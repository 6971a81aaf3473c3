"""A table of a report, as a person reads it."""

from contact_scene.description import Description


class Table(Description):
    """Rows of texts; the first column names the row."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    """What to see in it."""

    name: str = ""
    """By which it is found, where somebody looks for it."""
