"""Independent evaluation of the laws of contact and friction and of the energy balance.

The laws are evaluated from the fields that a solver returns, not from the numbers that the solver
states.
"""
