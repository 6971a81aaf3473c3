"""Comparison of results with recorded baselines, to detect changes between program versions.

`baseline` defines, reads and accepts the recorded results, `comparison` compares every number of a
report with its recorded value, and `tolerances` holds tolerances that follow the errors. A recorded
number is no reference: a difference shows a change, not an error.
"""
