"""Finite-element reference for the semi-analytical solver: not part of this version.

The package will hold an independent axisymmetric finite-element solution of the same scenes. It
will share `contact_scene` with `semi_analytical`, and no numerics. Until then it holds no code, and
nothing in the verification report rests on it: this version is judged by closed forms alone.
"""
