"""The edge of a contact inside the cells.

Towards the edge of a smooth contact the pressure falls like a power of the distance, so
phi = p^(1/alpha), alpha the exponent, passes through zero with a finite slope: phi is smooth where
p is not. On layers thinner than a few cells it is a function of its own of the distance (`film`),
and phi is made of p over what that function has over the root. Everything here is in index
coordinates: cells are unit squares about whole numbers.
"""
