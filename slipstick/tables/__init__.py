"""Tables of reference numbers, each with its uncertainty."""
