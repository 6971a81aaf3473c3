"""Checks of a scene: contradictions, implausible numbers, limits of linear theory."""
