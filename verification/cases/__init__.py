"""Verification cases: problems with known answers, measured quantities and tolerances.

`catalogue` lists the cases and imports the module of a case on demand. `verification.judging`
defines and judges a case.
"""
