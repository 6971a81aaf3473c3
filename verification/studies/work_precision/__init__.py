"""Study of the cost of accuracy: error against CPU time, with one curve for each
solution method."""
