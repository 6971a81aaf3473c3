"""Normal problem of a frictionless contact on a disc, solved with polynomials."""
