"""Error estimates of the scalars of a contact result, from coarse solves and one error formula.

`error_formula` contains the formula, the convergence orders and the resolution limits. `on_cells`,
`on_elements` and `on_radii` describe the coarse solves of each solver. `coarse_solves` runs the
coarse solves and compares their scalars with those of the result. `adaptive_refinement` refines a
discretisation until the error estimates meet a requested accuracy.
"""
