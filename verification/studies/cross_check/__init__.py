"""Both solvers on the same coated contacts."""
