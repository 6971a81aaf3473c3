"""Execution of a study: cases on a pool of processes, their records in files, and
the report page."""
