"""Comparison of verification results with baselines, to detect changes between program versions.

A baseline contains the accepted results of a case. `baseline` defines, reads and accepts baselines,
`comparison` compares every number of a report with its recorded value, `tolerances` has tolerances
that follow the errors, `change_row` shows changes as rows of a table, and `cpu_time` compares the
CPU time of commands. A recorded number is no reference: a difference shows a change, not an error.
"""
