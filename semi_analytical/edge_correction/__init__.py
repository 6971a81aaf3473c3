"""Edge correction of solved contact states, for edges of contact and stick zone that cut cells.

The solver assumes tractions that are uniform in each cell. This package adds the variation of
pressure and shear within the cells by deferred correction. It uses the fits of
`semi_analytical.edge`.
"""
