"""Both solvers on the same coated contacts: what is solved, compared, left out and shown."""
