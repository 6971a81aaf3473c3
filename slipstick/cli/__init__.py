"""The command `slipstick`, one file per command.

Solvers are imported by the commands that need them, so that `--help` and `check` start fast.
"""

from slipstick.cli.application import main

__all__ = ["main"]
