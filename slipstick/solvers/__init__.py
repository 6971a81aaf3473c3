"""The solvers as commands and scripts use them: by name, and one like the other."""
