"""Tangential problem: shear for given pressure, in terms of arrays and operators."""
