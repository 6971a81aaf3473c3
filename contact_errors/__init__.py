"""Error estimates of the numbers of a result, from coarse solves and one formula.

`error_formula` holds the formula, the convergence orders and the resolution limits. `on_cells`,
`on_elements` and `on_radii` make the coarse solves of one solver. `coarse_solves` decides which
load steps have an increment error.
"""
