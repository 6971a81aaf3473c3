"""The command `slipstick`, one file per command.

Nothing heavy is imported here: `slipstick --help` and `slipstick check` answer at once.
"""

from slipstick.cli.application import main

__all__ = ["main"]
