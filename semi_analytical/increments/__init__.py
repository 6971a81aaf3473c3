"""One increment of the load history: pressure, then shear, and their energies."""
