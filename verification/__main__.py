"""`python -m verification` is the command `slipstick`."""

from verification.cli import main

main()
