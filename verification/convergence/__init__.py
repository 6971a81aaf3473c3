"""Orders of convergence and what refinement says of the error that is left."""
