"""Other codes on the problems they can do, each in an environment of its own."""
