"""The laws of contact and friction and the first law, looked for in what solvers return."""
