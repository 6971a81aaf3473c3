"""Error estimates of the numbers of a result, from coarse solves and one formula.

`error_formula` contains the formula, the convergence orders and the resolution limits. `on_cells`,
`on_elements` and `on_radii` describe the coarse solves of each solver. `coarse_solves` makes them
and compares them with the result.
"""
