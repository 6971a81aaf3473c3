"""Tables of reference numbers for contact problems, for the command `slipstick table`."""
