"""The levels of verification and studies, as they are named on the command line."""

from enum import StrEnum


class LevelName(StrEnum):
    """How much is computed."""

    QUICK = "quick"
    STANDARD = "standard"
    FULL = "full"
