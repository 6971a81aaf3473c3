"""Randomly generated contact scenes whose answers are known from another source.

The scenes test if the error estimates of the solvers cover the actual errors.
"""
