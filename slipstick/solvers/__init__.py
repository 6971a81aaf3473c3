"""Solvers by name, with one interface for the commands and for scripts."""
