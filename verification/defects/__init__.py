"""Seeded defects: errors that are planted in the solvers to test if the verification detects
them."""
