"""Tangential problem: shear for a given pressure, in terms of arrays and operators."""
