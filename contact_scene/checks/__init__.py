"""Checks of a scene: consistency, plausibility and the limits of linear theory."""
