"""Tables of reference numbers with uncertainties."""
