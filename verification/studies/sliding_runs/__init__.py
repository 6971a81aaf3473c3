"""The computations of the sliding studies, each a case that runs in a process of its own."""
