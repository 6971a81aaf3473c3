"""Command line `slipstick`, with one module per command.

The commands import the solvers that they need, so that `--help` and `check` start fast.
"""

from slipstick.cli.application import main

__all__ = ["main"]
