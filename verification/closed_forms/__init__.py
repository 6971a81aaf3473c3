"""Analytical contact solutions, independent of both solvers.

Only numpy and scipy are imported here, never a sibling package: a shared helper would share its
mistake, so even the contact modulus is written down a second time (`moduli`). Arguments are plain
numbers and arrays in any consistent system of units; results are frozen records or arrays.
"""
