"""The tangential problem: shear for given pressure, from arrays and operators alone."""
