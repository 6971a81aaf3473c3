"""Which contacts the solver masters: friction, load, coating, path, surface and scale varied."""
