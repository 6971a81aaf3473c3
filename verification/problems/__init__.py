"""Contact problems with known answers: scenes, exact or tabulated solutions, and their sources.

Verification cases compare the results of the solvers with these answers.
"""
