"""Random mutants of kernels, and whether the kernels' own tests notice."""
