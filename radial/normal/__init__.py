"""Normal problem: frictionless contact on a disc, expanded in Legendre polynomials."""
