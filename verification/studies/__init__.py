"""Studies of the program: each computes many cases to measure one property, such as cost or
stability."""
