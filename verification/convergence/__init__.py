"""Orders of convergence under refinement, and estimates of the remaining discretisation error."""
