"""Study of the contacts that the solver can solve, over friction, load, coating, path and scale."""
