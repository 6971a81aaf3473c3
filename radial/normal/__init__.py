"""The normal problem: pressure on a disc, as a polynomial."""
