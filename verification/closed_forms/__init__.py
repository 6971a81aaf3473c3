"""Analytical contact solutions, independent of all solvers.

Only numpy and scipy are imported, no package of this project: a shared function would hide its own
mistake. Even the contact modulus is therefore defined a second time (`hertz`). Arguments are
numbers and arrays in any consistent system of units; results are frozen records or arrays.
"""
