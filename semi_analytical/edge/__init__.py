"""The edge of a contact inside the cells.

Towards the edge of a smooth contact the pressure falls like a power of the distance, so
phi = p^(1/alpha), alpha the exponent, passes through zero with a finite slope: phi is smooth where
p is not. Everything here is in index coordinates: cells are unit squares about whole numbers.
"""
