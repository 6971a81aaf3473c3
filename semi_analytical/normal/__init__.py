"""Normal problem: pressure for given shear, in terms of arrays and operators."""
