"""What scene files of several tests begin with; each adds its loading and its grid."""

RIGID_BALL = """
title = "Rigid ball on steel"
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = "rigid"
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
"""
