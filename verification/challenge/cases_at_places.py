"""Challenges about numbers at places: stress below a sliding ball, and displacement of a coated
body under a patch of traction."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from contact_scene import Body, CoulombFriction, IsotropicMaterial, Layer, LoadStep, Scene
from verification.challenge.often_asked import SMALL
from verification.challenge.requested_quantities import (
    AskedPoints,
    Challenge,
    Grade,
    Patch,
)
from verification.closed_forms.hamilton_stress import hamilton_stress
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ, STEEL, pressing
from verification.references import load_reference

SLIDING = 0.3  # µ
SLID = 1e-3  # so far that all slip is along x but for 1e-3 of a radian [length]
PLACES = 1e-3 * np.array(
    [
        (0, 0, 0.1), (0, 0, 0.2), (0, 0, 0.4), (0.2, 0, 0.1), (-0.3, 0, 0.1), (-0.4, 0, 0.1),
        (0.2, 0.1, 0.2), (-0.1, 0.3, 0.15), (0.4, 0.2, 0.3), (0.1, -0.3, 0.2), (0.1, 0.1, 0.6),
    ]
)  # fmt: skip
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
PATCH_SOURCE = "references/influence_coefficients.json: inverse transform, 1e-12"
THICKNESS, TRACTION, SUBSTRATE = 1e-3, 1e6, 80e9  # of a layer; on the patch; shear modulus
# Of the rows: what moves, under which traction.
MOVED = {
    "zz": ("u_z_by_pressure", "displacement along z under pressure on the patch"),
    "xx": ("u_x_by_shear_x", "displacement along x under shear along x on the patch"),
    "yy": ("u_y_by_shear_y", "displacement along y under shear along y on the patch"),
    "xy": ("u_x_by_shear_y", "displacement along x under shear along y on the patch"),
    "zx": ("u_z_by_shear_x", "displacement along z under shear along x on the patch"),
}


def at_places() -> Iterator[Challenge]:
    """All of them."""
    yield sliding_stress()
    yield from layered_patches()


def sliding_stress() -> Challenge:
    """Hertz's pressure and µ times it along x, by sliding."""
    scene = Scene(
        title="Ball that slides on a half-space",
        indenter=paper.paraboloid(STEEL),
        body=Body(material=STEEL),
        friction=CoulombFriction(coefficient=SLIDING),
        loading=(pressing(1), LoadStep(tangential_shift=(SLID, 0.0), increments=1)),
    )
    p0 = HERTZ.peak_pressure
    x, y, z = PLACES.T
    stress = hamilton_stress(x, y, z, HERTZ.contact_radius, p0, SLIDING * p0, STEEL.poisson_ratio)
    return Challenge(
        "sliding_stress", "Hamilton: stress below a sliding ball",
        f"{scene.title}: pressed, then moved along x so far that every place slips that way. "
        "Stress in the lower body, tension positive, at places around the contact as it was "
        "before the ball moved: small strains leave it there.", scene,
        "Hamilton 1983, as one integral of the potentials", (), (), SMALL,
        points=tuple(
            AskedPoints(f"stress_{name}", 2, "Pa", f"σ_{name}", PLACES, stress[n], p0, "p_H",
                        Grade.B, uncertainty=1e-5)
            for n, name in enumerate(COMPONENTS)
        ),
    )  # fmt: skip


def layered_patches() -> Iterator[Challenge]:
    """By the rows of the reference, which are dimensionless: one layer of thickness one."""
    rows = load_reference("influence_coefficients")["rows"]
    for ratio in dict.fromkeys(row["G1"] / row["G2"] for row in rows):
        own = [row for row in rows if row["G1"] / row["G2"] == ratio]
        side = own[0]["d"] * THICKNESS
        places = THICKNESS * np.array([(row["x"], row["y"], 0.0) for row in own])
        moved = THICKNESS * TRACTION / SUBSTRATE
        values = {key: moved * np.array([row["colloc"][key] for row in own]) for key in MOVED}
        scale = float(np.max(values["zz"]))
        yield Challenge(
            f"layered_patch/G1_over_G2={ratio:g}",
            f"A patch of traction on a layer, G1/G2 = {ratio:g}",
            f"A layer of {THICKNESS:g} m on a half-space. No contact: on the square "
            f"|x|, |y| < {side / 2:g} m of its surface acts a uniform traction of {TRACTION:g} Pa, "
            "pressure along +z or shear along +x or +y, one at a time.",
            Patch(_body(own[0]), side, TRACTION), PATCH_SOURCE, (), (), SMALL, points=tuple(
                AskedPoints(name, 1, "m", meaning, places, values[key], scale,
                            "the largest u_z_by_pressure", Grade.B)
                for key, (name, meaning) in MOVED.items()
            ),
        )  # fmt: skip


def _body(row: dict[str, float]) -> Body:
    def material(modulus: float, nu: float) -> IsotropicMaterial:
        young = 2 * (1 + nu) * SUBSTRATE * modulus / row["G2"]
        return IsotropicMaterial(young_modulus=young, poisson_ratio=nu)

    layer = Layer(thickness=row["h"] * THICKNESS, material=material(row["G1"], row["nu1"]))
    return Body(material=material(row["G2"], row["nu2"]), layers=(layer,))
