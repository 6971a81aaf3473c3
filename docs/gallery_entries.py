"""Entries of the gallery: published contacts with the numbers that are computed again here."""

from __future__ import annotations

from math import pi

from gallery_claims import Claim, Entry, Ours, Verdict
from gallery_stress import coating, deflection, edge_tension, tensions_by_thickness

GPA = 1e9
MPA = 1e6
MM = 1e-3
UM = 1e-6
UJ = 1e-6
DIFFERS = Verdict.DIFFERS
HERTZ = "closed form of Hertz"


def scalar(name: str, step: int = -1) -> Ours:
    """Compare a reported scalar at the end of a load step."""
    return lambda solved: solved.value(name, step)


def ratio(name: str, by: float, step: int = -1) -> Ours:
    """Compare a reported scalar, divided by a constant."""

    def divided(solved):
        value, error = solved.value(name, step)
        return value / by, error / by

    return divided


def stick_ratio(solved):
    """Return the stick radius over the contact radius, and its error."""
    c, dc = solved.value("stick_radius")
    a, da = solved.value("contact_radius")
    return c / a, c / a * (dc / c + da / a)


def energy_of_cycle(solved):
    """Return the energy dissipated from the first reversal to the end, and its error [energy]."""
    (after, error), (before, _) = (solved.value("dissipated_energy", n) for n in (-1, -3))
    return after - before, error


def mean_pressure(solved):
    """Return the mean pressure, force over contact area, and its error [stress]."""
    force, _ = solved.value("normal_force")
    radius, error = solved.value("contact_radius")
    mean = force / (pi * radius**2)
    return mean, 2 * mean * error / radius


def inverse(name: str, factor: float) -> Ours:
    """Compare a constant divided by a reported scalar, for example a stiffness."""

    def inverted(solved):
        value, error = solved.value(name)
        return factor / value, factor * error / value**2

    return inverted


HERTZ_CLASSIC = 14.691225517e9  # of the ball on the bare substrate

BARE_STEEL = (
    'body.layers[1].thickness="1 mm"',
    'body.layers[1].material={ young_modulus = "230 GPa", poisson_ratio = 0.3 }',
)

ENTRIES = (
    Entry(
        "paper_ball",
        "The paper's ball",
        "A ball of 18 mm radius and a half-space, both 420 GPa, under 1 kN: the contact to which "
        "Spinu and Cerlinca (2018) refer all lengths and pressures.",
        "Spinu and Cerlinca 2018, part II, text to figure 1",
        (
            Claim("contact radius", "printed", 0.388, 5e-4, scalar("contact_radius"), "mm", MM),
            Claim("peak pressure", "printed", 3.1684, 5e-5, scalar("peak_pressure"), "GPa", GPA),
            Claim("approach", HERTZ, 8.372042139, 1e-9, scalar("approach"), "µm", UM),
        ),
        "All digits hold.",
        solver="radial",
    ),
    Entry(
        "paper_loop",
        "The paper's fretting loop",
        "The same ball is pushed to and fro by 0.9 of the friction limit. Mindlin and "
        "Deresiewicz's loop neglects the shear across the load, which alike bodies have for ν ≠ 0.",
        "Mindlin and Deresiewicz 1953; Spinu and Cerlinca 2018, figure 2",
        (
            Claim(
                "shift at 0.9 µW",
                "closed form for ν = 0, within 0.5 %",
                0.797584,
                0.004,
                scalar("tangential_shift", 1),
                "µm",
                UM,
            ),
            Claim(
                "energy lost per cycle",
                "closed form for ν = 0, within 0.5 %",
                32.6321,
                0.16,
                energy_of_cycle,
                "µJ",
                UJ,
            ),
        ),
        "The loop of the closed form, to what it neglects; that is under one part in 200.",
    ),
    Entry(
        "coated_classic",
        "The classic coated ball",
        "A rigid ball on a coating as thick as Hertz's contact radius on the bare substrate. Its "
        "central pressure over Hertz's is the most copied figure of coated contact.",
        "O'Sullivan and King 1988, digitised from Bagault et al. 2013, figure 1 (read to 1 %); "
        "Fredholm equation of this project's references",
        (
            Claim(
                "coating twice as stiff",
                "Fredholm equation",
                1.47543690,
                1e-7,
                ratio("peak_pressure", HERTZ_CLASSIC),
            ),
            Claim(
                "coating twice as stiff",
                "digitised",
                1.52,
                0.015,
                ratio("peak_pressure", HERTZ_CLASSIC),
                verdict=DIFFERS,
            ),
            Claim(
                "coating half as stiff",
                "Fredholm equation",
                0.70468227,
                1e-7,
                ratio("peak_pressure", HERTZ_CLASSIC),
                changes=('body.layers[1].material.young_modulus="105 GPa"',),
            ),
            Claim(
                "coating half as stiff",
                "digitised",
                0.72,
                0.007,
                ratio("peak_pressure", HERTZ_CLASSIC),
                changes=('body.layers[1].material.young_modulus="105 GPa"',),
                verdict=DIFFERS,
            ),
        ),
        "The curve that is copied lies 2 to 3 % above an integral equation of another kind, and so "
        "above ours, which has its digits.",
        solver="radial",
    ),
    Entry(
        "gross_sliding",
        "Does a coated contact slide grossly at 0.76 µW?",
        "The paper reads gross sliding at 0.76 µW off its figures 3 and 4. At 0.8 µW we look "
        "whether anything sticks.",
        "Spinu and Cerlinca 2018, part II",
        (
            Claim(
                "stick radius at 0.8 µW",
                "none sticks, by the paper",
                0.0,
                0.005,
                scalar("stick_radius"),
                "mm",
                MM,
                verdict=DIFFERS,
            ),
        ),
        "A stick zone is there. Gross sliding below µW cannot be: "
        "{doc}`../../theory/literature` has the reason, {doc}`../../studies/gross_slip_onset` "
        "the number.",
    ),
    Entry(
        "hard_coatings",
        "Hard coatings below an alumina ball",
        "Fretting tests of TiC, TiN, VC and TiCN, 1.6 to 4 µm thick: what the coating does to the "
        "pressure, and which shift makes all of it slide.",
        "Fouvry, Paulin and Liskiewicz 2007 (the header of its table 3 contradicts its text by a "
        "factor of 1000)",
        (
            *(
                Claim(
                    f"peak pressure at {load} N, no coating",
                    HERTZ,
                    pressure,
                    5e-4,
                    scalar("peak_pressure"),
                    "GPa",
                    GPA,
                    changes=(*BARE_STEEL, f'loading[1].normal_force="{load} N"'),
                )
                for load, pressure in ((50, 1.128), (100, 1.422), (150, 1.627))
            ),
            Claim(
                "contact radius at 100 N, no coating",
                HERTZ,
                0.1833,
                5e-5,
                scalar("contact_radius"),
                "mm",
                MM,
                changes=BARE_STEEL,
            ),
            Claim(
                "peak pressure at 100 N on 4 µm of TiN",
                "Hertz, as if there were no coating",
                1.422,
                5e-4,
                scalar("peak_pressure"),
                "GPa",
                GPA,
                verdict=DIFFERS,
            ),
        ),
        "A hard coating of 4 µm raises the pressure by 0.6 %: Hertz will do for the pressure, not "
        "for the stress in the coating. All shifts of ±25 µm and more were gross slip: it begins "
        "at 3µW/16a Σ(2−ν)/G, 0.48 µm for µ = 0.15 and 1.91 µm for µ = 0.6.",
        solver="radial",
    ),
    Entry(
        "dlc",
        "DLC on bearing steel: which pressure was it?",
        "An abstract names 430 to 662 MPa for 5 to 57 N, without saying whether mean or peak.",
        "Alkelae and Jun 2021, abstract",
        (
            Claim(
                "peak pressure at 5 N", "printed", 430, 1.0, scalar("peak_pressure", 0), "MPa", MPA
            ),
            Claim(
                "peak pressure at 57 N",
                "printed",
                662,
                1.0,
                scalar("peak_pressure"),
                "MPa",
                MPA,
                verdict=DIFFERS,
            ),
            Claim(
                "mean pressure at 57 N",
                "printed",
                662,
                1.0,
                mean_pressure,
                "MPa",
                MPA,
                verdict=DIFFERS,
            ),
        ),
        "The first is the peak; the second is neither the peak (half as much again) nor the mean "
        "(2 % less). **Cannot tell** which pressure the wear was plotted over.",
        solver="radial",
    ),
    Entry(
        "shifted_spheres",
        "A force–displacement curve from a public program",
        "Two spheres, pressed by 10 µm, shifted to 95 % of what makes all slide. The reference "
        "file of the program has forces that a lumped model gave; Mindlin's are exact up to ν.",
        "tmd-lab/tmdsimpy, reference file; Mindlin 1949",
        (
            Claim("normal force", HERTZ, 286.800, 5e-4, scalar("normal_force", 0), "N"),
            *(
                Claim(
                    f"force at {3 * n}/38 of full slip",
                    "Mindlin, within 0.3 %",
                    mindlin,
                    0.003 * mindlin,
                    scalar("tangential_force", step),
                    "N",
                )
                for step, (n, mindlin) in enumerate(
                    ((n, 57.36 * (1 - (1 - 3 * n / 38) ** 1.5)) for n in (1, 2, 5, 10, 12)), 1
                )
            ),
            Claim(
                "force at 3/38 of full slip",
                "reference file",
                6.595,
                5e-4,
                scalar("tangential_force", 1),
                "N",
                verdict=DIFFERS,
            ),
        ),
        "The lumped model is 0.9 % soft where little slips, and 0.05 % at the end.",
    ),
    Entry(
        "stuck_punch",
        "Friction stiffens an indentation",
        "A flat punch whose end sticks while it is pressed is stiffer than a smooth one: "
        "(1−ν) ln(3−4ν)/(1−2ν) times, 1.02863 for ν = 0.3.",
        "Mossakovskii 1954; Spence 1968; Lubricants 2023, 11:265 finds the plateau numerically",
        (
            Claim(
                "stiffness over that without friction",
                "closed form",
                1.0286267,
                1e-7,
                inverse("approach", 714 * 0.91 / (2 * 200e9 * 1.8e-3)),
            ),
        ),
        "The plateau is there.",
        solver="fem-complementarity",
    ),
    Entry(
        "from_contact",
        "Coming from CONTACT: partial slip",
        "Kalker's program has this scene among its examples, on 19 × 19 elements.",
        "CONTACT, examples/cattaneo",
        (
            Claim("peak pressure", HERTZ, 4.3905, 5e-4, scalar("peak_pressure"), "MPa", MPA),
            Claim(
                "peak pressure",
                "CONTACT, 19 × 19",
                4.393,
                5e-4,
                scalar("peak_pressure"),
                "MPa",
                MPA,
                verdict=DIFFERS,
            ),
            Claim("stick radius / contact radius", "Cattaneo", 0.5, 0.003, stick_ratio),
            Claim(
                "shift",
                "Cattaneo and Mindlin, within 0.5 %",
                8.1724,
                0.04,
                scalar("tangential_shift"),
                "µm",
                UM,
            ),
            Claim(
                "shift",
                "CONTACT, 19 × 19",
                8.155,
                5e-4,
                scalar("tangential_shift"),
                "µm",
                UM,
            ),
        ),
        "The peak of CONTACT is 0.07 % off on its coarse grid. The two shifts differ by less than "
        "their errors, and are 0.2 % below the closed form, which neglects the shear across the "
        "load.",
    ),
    Entry(
        "cartilage",
        "A punch on cartilage",
        "κ, the stiffness of a punch on a bonded incompressible layer over that on a half-space, "
        "turns indentations of cartilage into moduli. One table circulates in public programs.",
        "Hayes et al. 1972, read in public programs only; the original could not be read",
        tuple(
            claim
            for over, exact, copied, verdict in (
                (0.2, 1.28063661, 1.281, Verdict.AGREES),
                (1, 3.61873585, 3.609, DIFFERS),
                (2, 9.14945045, 9.069, DIFFERS),
                (4, 31.52500989, 30.75, DIFFERS),
                (8, 146.32043372, 137.7, DIFFERS),
            )
            for claim in (
                Claim(
                    f"κ at a/h = {over}",
                    "integral equation",
                    exact,
                    1e-6 * exact,
                    inverse("approach", 10 / (8 * 1e6 * 5e-3)),
                    changes=(f'body.layers[1].thickness="{5 / over:g} mm"',),
                ),
                Claim(
                    f"κ at a/h = {over}",
                    "circulating table",
                    copied,
                    5e-4 * copied,
                    inverse("approach", 10 / (8 * 1e6 * 5e-3)),
                    changes=(f'body.layers[1].thickness="{5 / over:g} mm"',),
                    verdict=verdict,
                ),
            )
        ),
        "For a/h = 8 the table makes cartilage 6 % too stiff. Whether the original or the copies "
        "are wrong cannot be told from here.",
        solver="radial",
    ),
    Entry(
        "spence",
        "Coming from CONTACT: pressing with friction",
        "A rigid ball is pressed on a body of ν = 0; the surface is drawn inward and friction "
        "holds it back. Spence's solution is self-similar.",
        "Spence 1968; CONTACT, examples/spence (45 × 45 cells, 35 steps)",
        (
            # Cells extrapolated over cells and increments give 98.7529, too.
            Claim(
                "approach",
                "`radial`, 320 increments",
                98.75293,
                3e-4,
                scalar("approach"),
                "µm",
                UM,
            ),
            Claim(
                "approach", "CONTACT", 98.74, 5e-3, scalar("approach"), "µm", UM, verdict=DIFFERS
            ),
            Claim(
                "stick radius / contact radius", "Spence, by quadrature", 0.49972, 5e-6, stick_ratio
            ),
            Claim(
                "stick radius / contact radius", "CONTACT, counted cells", 0.494, 0.006, stick_ratio
            ),
        ),
        "Both programs find Spence's solution, CONTACT's approach to 1.3e-4: its tractions are "
        "constant on cells up to their edge.",
    ),
    Entry(
        "newcomer",
        "A newcomer's ball",
        "The ball of a public tutorial: 5 mm across, aluminium on aluminium, 100 N. The shear "
        "half a contact radius below is 505 MPa by closed form, more than aluminium bears.",
        "a public FreeCAD tutorial; closed form of Hertz",
        (Claim("peak pressure", HERTZ, 1666, 0.5, scalar("peak_pressure"), "MPa", MPA),),
        "The elastic answer is right, and plasticity would decide: that is for the reader to see.",
        solver="radial",
    ),
    Entry(
        "barrel",
        "A barrel ten times as curved across",
        "Hertz's ellipse with B/A = 10 needs elliptic integrals, and copies of tables lose digits.",
        "closed form of Hertz; Johnson 1985, section 4.2",
        (
            Claim("peak pressure", HERTZ, 1.713458890, 1e-8, scalar("peak_pressure"), "GPa", GPA),
            Claim("approach", HERTZ, 1.702824167, 1e-8, scalar("approach"), "µm", UM),
        ),
        "Cells need not be square, nor as many along both sides.",
    ),
    Entry(
        "twisted",
        "A ball twisted until half of its radius sticks",
        "Torsion with partial slip has a closed form for any ν, as its shear goes around.",
        "Lubkin 1951; Jäger 1995",
        (
            Claim("stick radius / contact radius", "closed form", 0.5, 1e-6, stick_ratio),
            Claim("twist", "closed form", 1.854404696, 1e-8, scalar("twist"), "mrad", 1e-3),
        ),
        "The twist and the edge of stick are those of the closed form.",
    ),
    Entry(
        "road",
        "Five layers of road",
        "A tyre presses 0.95 MPa on a disc of 0.3 m across. A public program prints how far the "
        "surface sinks below the middle and beside it; our frequency response of the layers "
        "says it by one integral. The figure has a rigid plate of the same weight instead.",
        "lewiswan/WuWan, a program for multilayered elasticity; integral of this project's "
        "references, 10 digits",
        tuple(
            claim
            for at, exact, printed in (
                (0.0, 0.4420892884, 0.44186744),
                (0.3, 0.3088718861, 0.30873646),
                (0.6, 0.2167442187, 0.21676407),
            )
            for claim in (
                Claim(
                    f"deflection at r = {at:g} m",
                    by,
                    number,
                    5e-9 if by == "printed" else 1e-9,
                    deflection(at, 0.15, 0.95e6),
                    "mm",
                    MM,
                    verdict=DIFFERS if by == "printed" else Verdict.AGREES,
                )
                for by, number in (("quadrature", exact), ("printed", printed))
            )
        ),
        "The program is 0.05 % low below the tyre and 0.01 % high at 0.6 m. A rigid plate sinks "
        "less than the middle of the disc, and lifts off there: the road bends below its rim.",
    ),
    Entry(
        "torn_coating",
        "Where a coating tears",
        "A ball slides over a coating: behind it the surface is pulled apart, at the interface it "
        "is sheared. How much depends on how thick and how stiff the coating is.",
        "this project: the edge by rays, the layer by its Hankel transforms, the pressure of an "
        "integral equation, none of it by cells",
        tuple(
            Claim(
                f"σ₁ on the trailing edge / p_H, E₁/E₂ = {ratio:g}, h = {thickness:g} a_H",
                "rays and transforms",
                tension,
                1e-6,
                edge_tension,
                changes=coating(ratio, thickness),
            )
            for ratio, thickness, tension in (
                (2.0, 1.0, 0.375456),
                (0.5, 1.0, 0.223980),
                (4.0, 0.3, 0.442676),
            )
        ),
        "The tension behind a ball on a stiff coating is least where that is about half of Hertz's "
        "radius thick, and grows towards thin films and thick ones; of a soft one it hardly "
        "depends on the thickness. The shear at the interface is largest about a quarter of that "
        "radius deep.",
        shown=(
            "friction={ coefficient = 0.1 }",
            'loading=[{ normal_force = "1 kN", increments = 10 }, '
            '{ tangential_force = ["95 N", 0], increments = 8 }]',
        ),
        more=tensions_by_thickness,
    ),
)
