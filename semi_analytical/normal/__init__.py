"""The normal problem: pressure for given shear, from arrays and operators alone."""
