"""Answers of a wrong solver to one challenge, and a function that solves another one wrongly."""

from pathlib import Path

from verification import Answer

ANSWERS = """level,load_step,quantity,value,unit,u,point
1,1,approach,9.6e-6,m,1e-6,
1,1,contact_radius,0.391,mm,,
1,1,moment_x,0.13,N m,,
1,1,moment_y,-0.1,N m,,
2,1,approach,9.51e-6,m,1e-6,
2,1,contact_radius,0.39,mm,,
2,1,moment_x,0.102,N m,,
2,1,moment_y,-0.09,N m,,
"""
LEVELS = """level,status,reason,h,h_unit,unknowns,cpu_seconds
1,solved,,20,um,1000,1
2,solved,,10,um,4000,5
"""
SOLVER = """[solver]
name = "wrong"
[convention]
sampling = "point"
[claims]
grade = "B"
order = { approach = 2 }
"""


def solve(problem, level):
    """Hertz's contact, with an error that halves with the level."""
    off = 1 + 0.004 / 2**level
    values = {("approach", 1): 8.37e-6 * off, ("contact_radius", 1): 3.882e-4 / off}
    return Answer(1e-5 / 2**level, values, unknowns=100 * 4**level)


if __name__ == "__main__":
    for name, text in {"answers.csv": ANSWERS, "levels.csv": LEVELS, "solver.toml": SOLVER}.items():
        Path("tilted", name).write_text(text, encoding="utf-8")
