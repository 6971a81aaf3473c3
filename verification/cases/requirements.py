"""Requirements of the program that verification cases show: equations, figures and statements.

The equations, figures and statements are those of Spinu and Cerlinca (2018, part II). The other
requirements are parts of the theory pages. A case names the requirements that it shows.
"""

from __future__ import annotations

from collections.abc import Iterable

from verification.judging.case import Case
from verification.judging.outcome import CaseOutcome, Status

# Meaning of each requirement by its name, in groups.
REQUIREMENTS: dict[str, dict[str, str]] = {
    "Equations": {
        "(1)": r"$W$, $M_x$, $M_y$ from the pressure",
        "(2)": r"$T_x$, $T_y$, $M_z$ from the shear",
        "(3)": "gap after deformation",
        "(4)": "slip increment with rigid motions, as corrected in {doc}`literature`",
        "(5)": "complementarity of pressure and gap; recomputed from the result of every case",
        "(6)": "Coulomb friction, with slip opposed to shear; recomputed from the result of every "
        "case",
        "(7)": "displacements from tractions by FFT",
        "(8)": r"$\tilde f_{zz}$",
        "(9)": r"$\tilde f_{xz}$",
        "(10)": r"$\tilde f_{yz}$",
        "(11)": r"$\tilde f_{xx}$",
        "(12)": r"$\tilde f_{yx}$, as corrected in {doc}`literature`",
        "(13)": r"$\tilde f_{zx}$",
        "(14)": "symmetries of the response",
    },
    "Figures": {
        "figure 1": "load history of the fretting loop",
        "figure 2": "tractions in the loop, closed form",
        "figure 3": "pressure of coated contacts under tangential load; study `coated-tractions` "
        "has an error for each curve",
        "figure 4": "shear of the same contacts; study `coated-tractions`",
    },
    "Statements": {
        "p_H": r"$p_H$ = 3.1684 GPa, $a_H$ = 0.388 mm",
        "fretting loop": "the program reproduces the closed form of the fretting loop",
        "shear at T = 0": "at $T = 0$ there is self-equilibrating shear",
        "increments": "loads have to be applied in small increments",
        "stick zone up to µW": "without coupling the stick zone vanishes at µW",
    },
    "Theory": {
        "known solutions": "homogeneous bodies with known solutions",
        "coatings": "contact of coated bodies without friction; torsion",
        "coated friction": "stick and slip zones, pressure and shear of coated bodies",
        "load history": "history of forces and motions, fretting loop",
        "prescribed motion": "control by approach and shift",
        "unlike bodies": "coupling of pressure and shear of unlike bodies, and their exchange",
        "shapes": "shapes of indenters",
        "rig": "series spring of a rig, numbers of a load cycle",
        "contact stiffness": "derivatives of forces with respect to motions",
        "line contacts": "loads per length, shapes, unlike bodies, strain in phase",
        "bulk strain": "bulk strain of the lower body",
        "tilt and torsion": "moments, tilt and torsion",
        "stress": "subsurface stress",
        "effects": "effects that a scene does not need cost nothing",
        "hard contacts": "convergence of hard contacts; study `stability` has a map",
        "finite elements": "axisymmetric finite elements as reference",
        "penalty": "finite elements with a penalty",
        "radial solver": "discs and rings as reference",
        "other codes": "published numbers and external codes",
    },
}


def unmet(cases: Iterable[Case], outcomes: Iterable[CaseOutcome]) -> tuple[str, ...]:
    """Return the requirements, with their meaning, that no passing case shows.

    cases     declared cases
    outcomes  outcome of each case
    """
    met = {
        name
        for case, outcome in zip(cases, outcomes, strict=True)
        if outcome.status is Status.PASS
        for name in case.shows
    }
    return tuple(
        f"{name}: {meaning}"
        for group in REQUIREMENTS.values()
        for name, meaning in group.items()
        if name not in met
    )
