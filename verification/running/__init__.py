"""How a study runs: cases on a pool of processes, their records in files, and the page."""
