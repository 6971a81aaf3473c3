"""Normal problem: pressure for a given shear, in terms of arrays and operators."""
