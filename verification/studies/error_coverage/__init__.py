"""Study of the errors that a run states: how often they cover the true error.

The scenes are drawn at random from families whose results are known.
"""
