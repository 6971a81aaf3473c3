"""What a command will not read, write or replace."""


class Refused(Exception):
    """Files are not what the command may take or make; the message names them."""


class OutputRefused(Refused):
    """The directory cannot be written, is in use, or holds what is not ours to replace."""
