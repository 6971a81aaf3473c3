"""Subcell geometry of contact edges, and displacements by tractions that vary within cells.

Towards the edge of a smooth contact the pressure falls like a power α of the distance. The function
φ = p^(1/α) passes smoothly through zero and can be fitted by quadratics. On layers thinner than a
few cells the pressure follows the law of `film`. The law is written as a ratio times the root √s of
the distance s. φ is then computed from the pressure over this ratio. Coordinates are indices: cells
are unit squares about integers. `semi_analytical.edge_correction` uses this package.
"""
