"""Memory, threads and files of the machine."""
