"""Errors of files that a command refuses to read, write or replace."""


class Refused(Exception):
    """A file cannot be used by the command; the message has its name and the reason."""


class OutputRefused(Refused):
    """The directory cannot be written, is in use, or contains files of other programs."""
