"""Definition of verification cases, and judgement of the results of their runs.

A case has runs of solvers, measured quantities, references and tolerances. A verdict compares one
measured number with its reference.
"""
