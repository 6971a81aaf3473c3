"""Execution of studies and reports: cases on a pool of processes, records in files, and
provenance."""
