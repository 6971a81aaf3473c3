"""Cattaneo-Mindlin paths for a tangential contact law of granular codes.

python examples/granular_path.py

The substitute for the granular code is the law without slip history: the tangential stiffness 8
G* a (Di Renzo and Di Maio 2004). The reference is the path of `changing_loads`, where normal and
tangential load change together. It prints the error of the law. It fails if `radial` misses class
C in a shift, or if the law errs by less than 5 %.
"""

import slipstick
from verification import Answer, CannotDo, judge

PATH = "changing_loads/nu=0.3"
KNOWN = 0.05  # of the largest shift


def without_history(problem, level):
    """Shift after each step that the law prescribes; energies and the twist are omitted."""
    pair = [problem.scene["indenter"]["material"], problem.scene["body"]["material"]]
    if any(m == "rigid" for m in pair):
        raise CannotDo("two elastic bodies only")
    e_star = 1 / sum((1 - m["poisson_ratio"] ** 2) / m["young_modulus"] for m in pair)
    g_star = 1 / sum(
        (2 - m["poisson_ratio"]) * (2 + 2 * m["poisson_ratio"]) / m["young_modulus"] for m in pair
    )
    cuts, values = 100 * 2**level, {}
    before, shift = (0.0, (0.0, 0.0)), [0.0, 0.0]
    for step, (force, push) in enumerate(problem.loads, start=1):
        for cut in range(1, cuts + 1):
            now = before[0] + cut / cuts * (force - before[0])
            a = (3 * now * problem.scene["indenter"]["radius"] / (4 * e_star)) ** (1 / 3)
            for axis in (0, 1):
                shift[axis] += (push[axis] - before[1][axis]) / cuts / (8 * g_star * a)
        before = (force, push)
        for name, axis in (("shift_x", 0), ("shift_y", 1)):
            if (name, step) in problem.asked:
                values[name, step] = shift[axis]
    return Answer(1 / cuts, values)


def by_radial(problem, level):
    """Shift after each step by `radial`, in 10 increments of each step on level 0."""
    scene = slipstick.Scene.model_validate(problem.scene)
    loading = tuple(s.model_copy(update={"increments": 10 * 2**level}) for s in scene.loading)
    rings = slipstick.RadialDiscretisation(rings=32 * 2**level)
    steps = slipstick.solve(scene.model_copy(update={"loading": loading}), "radial", rings).steps
    asked = [key for key in problem.asked if key[0] in ("shift_x", "shift_y")]
    return Answer(
        steps[-1].contact_radius / rings.rings,
        {
            (name, n): float(steps[n - 1].tangential_shift["xy".index(name[-1])])
            for name, n in asked
        },
    )


if __name__ == "__main__":
    law = judge(PATH, without_history, levels=2)
    errors = {row.quantity: row.error for row in law.rows if row.error is not None}
    for quantity, error in errors.items():
        print(f"law without slip history, {quantity}: error {error:.2f} of the largest shift")
    reference = judge(PATH, by_radial, levels=1)
    print(f"radial: {reference.line}")
    missed = [row for row in reference.rows if row.status == "fail" and "shift" in row.quantity]
    if max(errors.values()) < KNOWN or missed:
        raise SystemExit("the path does not separate the law from the reference")
