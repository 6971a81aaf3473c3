"""Verification cases: problems with known answers, measured quantities and tolerances.

A function makes a case at a level, the amount of computation: quick, standard or full.
`catalogue` lists the cases and imports the module of a case on demand. `verification.judging`
defines and judges a case.
"""
