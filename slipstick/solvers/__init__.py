"""Solvers by name, with one interface for commands and scripts."""
