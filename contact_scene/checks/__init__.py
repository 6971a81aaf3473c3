"""Checks of a scene: contradictions between tables, implausible numbers, limits of linear
theory."""
