"""Defects that are planted in the solvers on purpose, to see whether the verification sees them."""
