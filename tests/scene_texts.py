"""Beginnings of scene files that several tests complete by load steps and discretisation."""

STEEL_ON_STEEL = """
[indenter]
shape = "sphere"
radius = "10 mm"
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
"""

STEEL_BALL_PRESSED = """
[indenter]
shape = "sphere"
radius = "18 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
"""
COARSE = """
[semi_analytical]
cells = [32, 32]
window = ["1.2 mm", "1.2 mm"]
"""
