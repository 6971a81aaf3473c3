"""A friction test for a contact code: a correct and an incorrect example, both judged.

python examples/friction_test.py

The substitutes for the code are closed forms of partial slip. The incorrect one uses the stick
zone of a line contact below a ball. It fails if the judge accepts the error, or rejects the
correct form.
"""

import numpy as np

from verification import Answer, Field, judge

# Exponents n of the stick radius c = a (1 - T/µW)^(1/n).
SPHERE = 3
CYLINDER = 2


def partial_slip(exponent):
    """A solver of `cattaneo_mindlin` whose stick radius follows the law with this exponent."""

    def solve(problem, level):
        scene, n = problem.scene, 64 * 2**level
        ball, body = scene["indenter"], scene["body"]
        pair = [ball["material"], body["material"]]
        e_star = 1 / sum((1 - m["poisson_ratio"] ** 2) / m["young_modulus"] for m in pair)
        g = [m["young_modulus"] / (2 + 2 * m["poisson_ratio"]) for m in pair]
        g_star = 1 / sum((2 - m["poisson_ratio"]) / shear for m, shear in zip(pair, g, strict=True))
        mu, force = scene["friction"]["coefficient"], problem.loads[0][0]
        a = (3 * force * ball["radius"] / (4 * e_star)) ** (1 / 3)
        h = 2 * a / n
        x = (np.arange(n) + 0.5) * h - a
        r = np.hypot(x[:, None], x)
        inside = r < a
        xs, ys = (part[inside] for part in np.meshgrid(x, x, indexing="ij"))
        values, fields = {("approach", 1): a**2 / ball["radius"]}, {}
        for step, (_, (push, _)) in enumerate(problem.loads[1:], start=2):
            c = a * (1 - push / (mu * force)) ** (1 / exponent)
            q = np.sqrt(np.maximum(a**2 - r**2, 0)) - np.sqrt(np.maximum(c**2 - r**2, 0))
            q *= push / (q.sum() * h**2)  # the tractions carry the load in both examples
            values["shift_x", step] = 3 * mu * force / (16 * g_star * a) * (1 - (c / a) ** 2)
            values["stick_radius", step] = c
            fields["shear_x", step] = Field(xs, ys, q[inside], np.full(xs.size, h**2))
        return Answer(h, values, fields, unknowns=n * n)

    return solve


if __name__ == "__main__":
    for name, exponent, accepted in (("correct", SPHERE, True), ("incorrect", CYLINDER, False)):
        judgement = judge("cattaneo_mindlin", partial_slip(exponent))
        failed = [row.quantity for row in judgement.rows if row.status == "fail"]
        print(f"{name}: {judgement.line}\n  failed: {', '.join(failed) or 'nothing'}")
        if (judgement.exit_code() == 0) != accepted:
            raise SystemExit(f"the {name} example was {'rejected' if accepted else 'accepted'}")
