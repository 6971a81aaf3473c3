"""Error estimates of the scalars of a contact result, from coarse solves and one error formula.

`error_formula` contains the formula; `contact_scene.contact_features` has the convergence orders
and the resolution limits. The module `discretised` of each solver describes its coarse solves.
`coarse_solves` runs them and compares their scalars with those of the result. `adaptive_refinement`
refines a discretisation until the error estimates meet a requested accuracy.
"""
