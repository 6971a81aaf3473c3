"""Reading and writing of scene files: TOML, units, overrides and messages."""
