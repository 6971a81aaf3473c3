"""Orders of convergence, and the remaining error estimated from refinement."""
