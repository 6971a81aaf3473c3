"""Comparison of verification results with baselines, to detect changes between program versions.

A baseline contains the accepted results of a case. `baseline` defines, reads and accepts baselines
and compares every number of a report with its recorded value. A recorded number is no reference: a
difference shows a change, not an error.
"""
