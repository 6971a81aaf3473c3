"""The refusal to write results somewhere."""


class OutputRefused(Exception):
    """The directory cannot be written, is in use, or holds what is not ours to replace."""
