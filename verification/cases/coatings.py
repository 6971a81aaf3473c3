"""Cases of layered bodies: contact without friction, and the surface response of layers.

Contacts on tabulated coatings, equivalent coatings and thin layers are compared with semi-closed
solutions, by all solvers. Responses are compared with reference numbers and with laws for random
bodies.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from math import inf, isinf, pi
from typing import Any

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    InterfaceStiffness,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
)
from contact_scene.quantities.residuals import worst
from radial.normal.disc import disc
from radial.normal.surface import pressure
from radial.response.bodies import Bodies
from semi_analytical.frf.response_matrix import response_matrix
from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.layered import LayeredCoefficients
from verification.closed_forms.bonded_film import BondedFilm
from verification.closed_forms.coated_indentation import (
    LayeredIndentation,
    LayeredSurface,
    paraboloid,
    paraboloid_under,
)
from verification.judging.case import (
    Case,
    Level,
    Quantity,
    Required,
    Run,
    computed_error,
)
from verification.judging.declared_case import (
    APPROACH,
    ASKED,
    CENTRAL_PRESSURE,
    CONTACT_RADIUS,
    EDGE,
    ELEMENT_RADIUS,
    FORCE,
    JUDGED_BY,
    PRESSURE_L2,
    Falls,
    Judged,
    Refined,
    Row,
    Within,
    because,
    case,
    cells_label,
    error_norm,
    finest,
    judged,
    ladder,
    named,
    on_cells,
    on_elements,
    on_radii,
    part_of_side,
    refinement,
    scaled_tolerance,
)
from verification.judging.drawings import PRESSURE, convergence, profile
from verification.laws.limit_laws import LAWS, worst_violation
from verification.norms import max_norm
from verification.problems.indentation import (
    BARE,
    CONE,
    PUNCH,
    ROWS,
    coated_ball,
    mean_pressure,
    solved_here,
)
from verification.problems.problem import (
    FREDHOLM,
    FREDHOLM_EQUATION,
    HERTZ,
    NORMAL_FORCE,
    OVER_PEAK,
    RADIUS,
    SEMI_CLOSED_ERROR,
    UNLIKE,
    Problem,
    Reference,
    ReferenceKind,
    coated,
    exact_contact,
    film,
    hertz_grid,
    identity,
    pressed,
    rigid_ball,
    surface_of,
)
from verification.references import load_reference

STUDIED = 2.0  # E1/E2 of the row whose convergence is studied
COATINGS = {row["E1_over_E2"]: coated_ball(row) for row in ROWS}
EXACT = solved_here(COATINGS[STUDIED])
NAMES = [f"E1/E2 = {row['E1_over_E2']:g}, h = {row['h_over_aH']:g} a_H" for row in ROWS]
ON_128 = "accuracy target of coated bodies on 128 x 128 cells, as in coated_paraboloid"
ON_MESHES = (
    Within(APPROACH, scaled_tolerance(1e-4, 2), because(2)),
    Within(CENTRAL_PRESSURE, scaled_tolerance(1e-4, 2), because(2)),
    Within(CONTACT_RADIUS, 2e-3, ELEMENT_RADIUS),
)


def coated_paraboloid(level: Level = Level.QUICK) -> Case:
    """Create the verification case of coated bodies under a rigid ball, without friction, on cells.

    Approach, central pressure and contact radius are compared with semi-closed solutions. For one
    coating the convergence under refinement of the cells is judged.
    """
    most = 256 * 2**level
    cells = refinement(32, most)
    grids = dict.fromkeys(COATINGS, (128, 256)) | {STUDIED: cells}
    ladders = {
        ratio: on_cells(COATINGS[ratio], some, of=f"E1/E2 = {ratio:g}")
        for ratio, some in grids.items()
    }
    study, name = ladders[STUDIED], f"E1/E2 = {STUDIED:g}"
    followed = replace(study, problem=EXACT)
    shifted = on_cells(EXACT, refinement(32, most // 2), of=name, offsets=UNLIKE)
    allowed = {128: 2e-4, 256: 5e-5}
    rows = (
        Within(APPROACH, allowed, ASKED, name="required_approach"),
        Within(CENTRAL_PRESSURE, allowed, ASKED),
    )
    of_study = (
        Refined(
            APPROACH,
            2.0,
            5e-5,
            "order 2 as for the homogeneous body; the cap is the figure required at 256 x 256",
        ),
        Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
    )
    orders = (
        Falls(PRESSURE_L2, 1.0, "as for the homogeneous body: the square-root edge"),
        Falls(
            CENTRAL_PRESSURE,
            2.0,
            "as for the homogeneous body: the cells lie h/√2 from the axis",
        ),
    )
    mean = Falls(APPROACH, 2.0, "as for the homogeneous body: the errors at the edge cancel")
    return case(
        "coated_paraboloid",
        "Rigid ball on coated half-spaces",
        "A rigid paraboloid of the paper's radius is pressed by 1 kN without friction on a "
        "coated half-space (210 GPa, ν = 0.3), with coatings of 0.25 to 10 times its modulus, on "
        "windows of three contact radii. The references are solutions of an axisymmetric "
        "integral equation that shares nothing with the surface grid. Under the stiffest coating "
        "the largest pressure is not at the centre; the pressure at the centre is compared.",
        *(judged(one, rows) for one in ladders.values()),
        judged(study, of_study),
        judged(followed, orders),
        judged(shifted, (mean,)),
        charts=(
            profile(
                followed,
                "coated_profile",
                "Pressure next to y = 0 under a coating of E1/E2 = 2",
                f"Computed pressure on {cells_label(cells[-1])} cells, the semi-closed solution, "
                "and their difference, in units of the peak pressure without coating.",
                "p / p_H",
                HERTZ.peak_pressure,
                PRESSURE,
            ),
            convergence(
                followed,
                orders,
                "coated_convergence",
                "Convergence of the coated contact",
                "Relative errors against cell side, for the coating of E1/E2 = 2. Orders are those "
                "of the homogeneous body, because the coefficients of the coated body are as exact "
                "as the closed form.",
                also=(APPROACH,),
            ),
        ),
        shows=("(8)", "coatings"),
    )


def _semi_closed(scene: Any, exact: LayeredIndentation) -> Problem:
    return Problem(
        scene,
        (exact,),
        exact.contact_radius,
        FREDHOLM,
        ReferenceKind.SEMI_CLOSED,
        SEMI_CLOSED_ERROR,
        equations=(FREDHOLM_EQUATION,),
    )


def unlike_coating(
    ratio: float, film: float, base: float, normal: float = inf, shear: float = inf
) -> Problem:
    """Create the problem of a rigid ball on a coating with other constants than its substrate.

    The coating is half a Hertz radius thick. The exact answer takes its constants from the
    arguments, not from the scene, so that it detects an exchange of two constants in the program.

    ratio          Young's modulus of the coating over that of the substrate
    film, base     Poisson's ratio of the coating and of the substrate
    normal, shear  stiffnesses of the bond, relative to the substrate's Young's modulus over the
                   Hertz radius; infinite for a rigid bond
    """
    modulus, radius = 210e9, HERTZ.contact_radius
    normal, shear = (part * modulus / radius for part in (normal, shear))
    layer = Layer(
        thickness=0.5 * radius,
        material=IsotropicMaterial(young_modulus=ratio * modulus, poisson_ratio=film),
        interface_stiffness=None
        if isinf(normal)
        else InterfaceStiffness(normal=normal, shear=shear),
    )
    substrate = IsotropicMaterial(young_modulus=modulus, poisson_ratio=base)
    of_film, of_base = ratio * modulus / (2 * (1 + film)), modulus / (2 * (1 + base))
    exact = BondedFilm((of_film, film), (of_base, base), layer.thickness, normal, shear)
    surface = LayeredSurface(exact.normal_response, 2 * of_film / (1 - film), layer.thickness)
    body = Body(material=substrate, layers=(layer,))
    return _semi_closed(
        pressed("Rigid ball on an unlike coating", rigid_ball(), body),
        paraboloid_under(NORMAL_FORCE, surface, RADIUS),
    )


def compliant_bond(level: Level = Level.QUICK) -> Case:
    """Create the verification case of coatings with a compliant bond, or another Poisson's ratio.

    A rigid ball is pressed on the coated body, on cells, by the radial solver, and with rigid bonds
    by finite elements. Approach, contact radius and central pressure are compared with a
    semi-closed solution.
    """
    n = finest(level)
    on_grid = (
        Within(APPROACH, 2e-4, ON_128),
        Within(CONTACT_RADIUS, part_of_side(0.1), "a tenth of a cell"),
        Within(CENTRAL_PRESSURE, 2e-4, ON_128),
    )
    by_radial = (
        Within(APPROACH, 1e-7, "accuracy target of the radial solver without friction"),
        Within(CONTACT_RADIUS, 1e-6, "accuracy target of the radial solver without friction"),
    )
    unlike = {
        "ν = 0.1 on ν = 0.45": unlike_coating(1.0, 0.1, 0.45),
        "ν = 0.45 on ν = 0.1": unlike_coating(1.0, 0.45, 0.1),
    }
    bonds = {
        "opens": unlike_coating(2.0, 0.25, 0.3, 0.5, 5.0),
        "shifts": unlike_coating(2.0, 0.25, 0.3, 50.0, 0.02),
    }
    problems = unlike | bonds
    return case(
        "compliant_bond",
        "Coatings with a compliant bond or another Poisson's ratio",
        "The paper's ball, rigid, is pressed by 1 kN on a coating that is bonded to its substrate "
        "by springs, or has the Young's modulus of its substrate and another Poisson's ratio. One "
        "bond mainly opens, the other mainly shifts. The response of the coating in the reference "
        "is that of the Airy function with springs at each wavenumber, solved as a linear system; "
        "that of the program is a recursion of compliances.",
        *(judged(on_cells(one, (128,), of=name), on_grid) for name, one in problems.items()),
        *(
            judged(named(f"{name}, {n} elements", on_elements(one, (n,), of=name)), ON_MESHES)
            for name, one in unlike.items()
        ),
        *(judged(on_radii(one, f"{name}, radial"), by_radial) for name, one in problems.items()),
        no_order=JUDGED_BY.format("coated_paraboloid"),
        shows=("coatings",),
    )


def layered_identities(level: Level = Level.QUICK) -> Case:
    """Create the verification case of coatings on both bodies, and of several coatings.

    Pairs of bodies with coatings are compared with semi-closed solutions.
    """
    cells, hard = 128, IsotropicMaterial(young_modulus=300e9, poisson_ratio=0.25)
    ball = Paraboloid(radius=RADIUS, material=hard)
    pairs: dict[str, tuple[Paraboloid, Body]] = {
        "elastic ball on the coating": (ball, coated(film(2.0, 1.0))),
        "coated ball on another coating": (
            ball.model_copy(update={"layers": (film(0.5, 0.3),)}),
            coated(film(4.0, 0.5), film(0.25, 0.2)),
        ),
        "soft film on a hard one": (rigid_ball(), coated(film(0.5, 0.2), film(4.0, 0.3))),
    }
    grid = hertz_grid(cells)
    grids = {
        name: ladder(
            _semi_closed(
                pressed(name, one, body),
                exact_contact(body, Body(material=one.material, layers=one.layers)),
            ),
            [Run(name, pressed(name, one, body), grid, problem=name)],
        )
        for name, (one, body) in pairs.items()
    }
    rows = (
        Within(APPROACH, 2e-4, f"{ASKED}, for coated bodies"),
        Within(CENTRAL_PRESSURE, 2e-4, f"{ASKED}, for coated bodies"),
    )
    return case(
        "layered_identities",
        "Coatings on both bodies, and two coatings",
        "Pairs of bodies, of which one or both are coated, are compared with the semi-closed "
        "solution for the sum of their responses.",
        *(judged(one, rows) for one in grids.values()),
        no_order=JUDGED_BY.format("coated_paraboloid"),
        shows=("(8)", "(14)"),
    )


@dataclass(frozen=True)
class ThinLayer:
    """Hold the problem of a rigid ball on a thin elastic layer that is bonded to a rigid base.

    poisson_ratio  ν of the layer
    a_over_h       contact radius a over layer thickness h
    load_ratio     exact normal load over its leading term for a >> h, computed outside this program
    radius         contact radius a [length]
    modulus        Young's modulus of the layer [force/length²]
    """

    poisson_ratio: float
    a_over_h: float
    load_ratio: float
    radius: float = 2e-3  # of the contact [m]
    modulus: float = 10e6  # rubber

    @property
    def name(self) -> str:
        """Label of the solver runs of this layer: its ν and a/h."""
        return f"ν = {self.poisson_ratio:g}, a/h = {self.a_over_h:g}"

    @property
    def body(self) -> Body:
        """Description of the lower body: the elastic layer on a rigid base."""
        material = IsotropicMaterial(young_modulus=self.modulus, poisson_ratio=self.poisson_ratio)
        layer = Layer(thickness=self.radius / self.a_over_h, material=material)
        return Body(material=RIGID, layers=(layer,))

    @cached_property
    def exact(self) -> LayeredIndentation:
        """Semi-closed solution of the contact of the ball and the layer, for the given contact
        radius.
        """
        return paraboloid(surface_of(self.body), RADIUS, self.radius)

    @property
    def problem(self) -> Problem:
        """Verification problem in which the ball is moved by the approach of the semi-closed
        solution.
        """
        step = LoadStep(approach=self.exact.approach)
        title = f"Rigid ball on a thin layer on a rigid base, {self.name}"
        return _semi_closed(pressed(title, rigid_ball(), self.body, step), self.exact)

    @property
    def leading_load(self) -> float:
        """Leading term of the normal load for a >> h (Johnson 1985, section 5.8) [force].

        a is the contact radius and h the layer thickness. The incompressible layer (ν = 1/2) has
        another formula than compressible layers.
        """
        E, nu, a, R = self.modulus, self.poisson_ratio, self.radius, RADIUS
        h = a / self.a_over_h
        if nu == 0.5:
            return pi * E / 3 * a**6 / (32 * R * h**3)
        uniaxial = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return pi * uniaxial * a**4 / (4 * R * h)

    @property
    def rows(self) -> tuple[Row, ...]:
        """Rows of this layer in the case: each has one measured quantity and its tolerance.

        Judged are normal force, central pressure and contact radius.
        """
        why = (
            "twice the accuracy target of coatings at 128 x 128 cells: layer and contact have "
            "different length scales"
        )
        return (
            Within(FORCE, 4e-4, why),
            Within(CENTRAL_PRESSURE, 4e-4, why),
            Within(CONTACT_RADIUS, part_of_side(0.5), "half a cell"),
        )

    @property
    def check(self) -> Quantity:
        """Comparison of the semi-closed normal load with a number that was computed outside this
        program.

        Both loads are divided by the leading term for contact radius >> layer thickness.
        """
        digits = 1e-6
        return Quantity(
            "semi_closed_load",
            "load over the leading term, from the semi-closed solution",
            "",
            self.name,
            lambda: self.exact.load / self.leading_load,
            Reference(
                self.load_ratio,
                ReferenceKind.SEMI_CLOSED,
                "computed outside this program: two settings agree to the digits given",
                0.5 * digits,
            ),
            Required(digits, "the digits that are given"),
            runs=(),
        )


def thin_layer(level: Level = Level.QUICK) -> Case:
    """Create the verification case of a rigid ball on thin layers that are bonded to a rigid base.

    Normal force, central pressure and contact radius on cells are compared with semi-closed
    solutions. Two layers are compressible and behave nearly as an elastic foundation; one is
    incompressible.
    """
    cells = 256 if level is Level.QUICK else 512
    layers = (
        ThinLayer(0.3, 5.0, 1.104343),
        ThinLayer(0.3, 20.0, 1.024688),
        ThinLayer(0.5, 10.0, 2.233304),
    )
    return case(
        "thin_layer",
        "Thin layers on a rigid base",
        "A rigid ball is pressed by a prescribed approach on a layer much thinner than the "
        "contact, on a rigid base. A compressible layer becomes an elastic foundation. An "
        "incompressible layer yields only by flow along the base: its compliance vanishes with "
        "the square of the wavenumber, and ν = ½ is exact. Both limits are approached slowly, so "
        "that the loads of the full solution are compared.",
        *(
            judged(named(one.name, on_cells(one.problem, (cells,), 2.2)), one.rows)
            for one in layers
        ),
        Judged(quantities=tuple(one.check for one in layers)),
        equations=(
            r"W \to \frac{\pi a^4}{4 R h} \frac{E (1 - \nu)}{(1 + \nu)(1 - 2\nu)},\quad "
            r"W \to \frac{\pi E a^6}{96 R h^3} \ (\nu = \tfrac{1}{2})",
        ),
        no_order=f"on {cells_label(cells)} cells only; the orders are those of coated_paraboloid",
        shows=("coatings", "hard contacts"),
    )


WITHIN = 0.995  # radii up to which pressures are compared: at the edge they have no finite slope


def _pressure_error(result: Any, _: int, problem: Problem) -> float:
    """Compute the largest pressure error of the radial solver at the end of the last load step [1].

    The points are the rings inside the contact, or the radii of a tabulated reference. The error is
    divided by the peak pressure p_H of Hertz theory or, if the problem has none, by the mean
    pressure.

    result   result of the radial solver
    problem  problem with the exact pressure
    """
    end, exact = result.steps[-1], problem.ends[0]
    scale = problem.scales.get(OVER_PEAK) or mean_pressure(problem)
    r, found = end.radii, end.pressure
    if hasattr(exact, "radii"):
        r = exact.radii
        contact = disc(Bodies.of(problem.scene), problem.scene.indenter, end.contact_radius)
        found = pressure(contact, r / contact.radius)
    else:
        inside = r < WITHIN * problem.radius
        r, found = r[inside], found[inside]
    return float(max_norm(found - exact.pressure(r)) / scale)


def radial_pressing(level: Level = Level.QUICK) -> Case:
    """Create the verification case of frictionless indentation by the radial solver.

    Approach, contact radius and pressure of a ball, a cone, a flat punch and coated bodies are
    compared with closed forms and with solutions of integral equations. Above the quick level each
    contact is also solved with twice the number of polynomials and points.
    """
    why = "both have rounding errors, of which forty times are allowed; 1e-10 was the target"
    of_pressure = error_norm(
        "pressure",
        f"largest error of the pressure up to {WITHIN:g} a, or at the radii of a table",
        _pressure_error,
        "p_H, or the mean pressure of cone and punch",
    )
    rows = [Within(what, 1e-12, why, each=True) for what in (APPROACH, of_pressure)]
    of_edge = Within(CONTACT_RADIUS, 1e-12, why, each=True)
    problems = {"ball": BARE, "cone": CONE, "punch": PUNCH} | dict(
        zip(NAMES, map(coated_ball, ROWS), strict=True)
    )
    return case(
        "radial_pressing",
        "Radial solver: indentation",
        "The paper's ball, a cone and a flat punch on half-spaces, and the rigid ball on "
        f"{len(ROWS)} coatings are pressed by 1 kN without friction, by the radial solver. This "
        "solver shares the response of layers to a wavenumber with the semi-analytical solver; "
        "the references share neither that response nor the polynomials.",
        *(
            judged(
                on_radii(problem, name, (1,) if level is Level.QUICK else (2, 1)),
                rows if problem is PUNCH else [*rows, of_edge],  # a punch prescribes the radius
            )
            for name, problem in problems.items()
        ),
        no_order="polynomials converge faster than any power: all numbers of terms are exact to "
        "rounding",
        shows=("radial solver", "coatings"),
    )


COEFFICIENT_SOURCE = "references/influence_coefficients.json: inverse transform, 1e-12"
FRF_ROWS: list[dict[str, Any]] = load_reference("frf")["rows"]
COEFFICIENT_ROWS: list[dict[str, Any]] = load_reference("influence_coefficients")["rows"]
FREQUENCY_RESPONSE = (
    r"\tilde{\mathbf{u}}(\mathbf{k}) = \mathbf{F}(\mathbf{k}) \tilde{\mathbf{t}}(\mathbf{k}),\quad "
    r"\mathbf{K}(\mathbf{x}) = \frac{1}{4\pi^2} \int \mathbf{F}(\mathbf{k}) \tilde{c}(\mathbf{k}) "
    r"e^{i \mathbf{k} \cdot \mathbf{x}} d^2 k"
)


def _reference_stack(row: Mapping[str, Any]) -> Stack:
    base = None if row["base"] == "rigid" else (row["base"]["G"], row["base"]["nu"])
    return Stack([(film["G"], film["nu"], film["h"]) for film in row["layers_top_down"]], base)


@cache
def _frf_errors(number: int) -> tuple[float, float]:
    """Compute the errors of the surface FRF of a layered body against one row of reference numbers.

    FRF: frequency response function, surface displacement per unit traction of a wavenumber. The
    first result is the largest relative error of the FRF scalars (responses along and across the
    wave vector, along z, and coupling). The second is the largest error of an entry of the 3 × 3
    FRF matrix, over the largest entry.

    number  index of the row in the reference table
    """
    row = FRF_ROWS[number]
    c11, c12, c22, csh = (float(row[key]) for key in ("C11", "C12", "C22", "Csh"))
    got = np.array(scalars(_reference_stack(row), np.hypot(row["m"], row["n"])))
    scale = np.array([c11, np.sqrt(c11 * c22), c22, csh])
    F = {key: float(value) for key, value in row["F"].items()}
    xz, yz = 1j * F["im_xz"], 1j * F["im_yz"]
    expected = np.array([[F["xx"], F["xy"], xz], [F["xy"], F["yy"], yz], [-xz, -yz, F["zz"]]])
    difference = response_matrix(_reference_stack(row), row["m"], row["n"]) - expected
    return (
        float(np.max(np.abs(got - (c11, c12, c22, csh)) / scale)),
        max_norm(difference) / max_norm(expected),
    )


def _worst_frf_error(kind: int) -> float:
    return max(_frf_errors(number)[kind] for number in range(len(FRF_ROWS)))


@cache
def _influence_coefficients(G1: float, nu1: float, base: tuple[float, float], d: float) -> Any:
    return LayeredCoefficients(Stack([(G1, nu1, 1.0)], base), (d, d), (101, 8))


def _coefficient_error(row: Mapping[str, Any]) -> float:
    """Compute the largest error of the influence coefficients of a layered body, for one reference
    row.

    An influence coefficient is the displacement at a cell centre per unit traction on another cell.
    The error is relative to the larger of the normal and tangential displacement of the loaded
    cell.

    row  shear moduli and Poisson ratios of layer and base, cell side, distance, and reference
         values
    """
    K = _influence_coefficients(row["G1"], row["nu1"], (row["G2"], row["nu2"]), row["d"])
    i, j = round(row["x"] / row["d"]), round(row["y"] / row["d"])
    errors = [
        abs((np.sign(j) if j and name == "xy" else 1) * K[name][i, abs(j)] - expected)
        for name, expected in row["colloc"].items()
    ]
    return float(worst(*errors) / max(K["zz"][0, 0], K["xx"][0, 0]))


def layered_reference(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the surface response of layered bodies against reference
    numbers.

    Judged are frequency response functions (FRF: displacement per unit traction of a wavenumber)
    and influence coefficients (displacement per unit traction on a cell). All levels are equal.
    """
    frf = "references/frf.json: boundary-value problem in the layer amplitudes, 50 digits"
    required = Required(5e-15, "required of layered FRFs by the project's accuracy targets")

    def exact(source: str, uncertainty: float) -> Reference:
        return Reference(0.0, ReferenceKind.SEMI_CLOSED, source, uncertainty)

    return case(
        "layered_reference",
        "Layered response against other programs",
        "Surface frequency response of one to five layers on a half-space or a rigid base, ν up "
        "to exactly ½, α h from 1e-6 to 1e4, against a solution with 50 digits. Displacement by "
        "unit traction on a square cell of a coated body, against inverse transforms. Every row "
        "is shown.",
        Judged(
            quantities=(
                computed_error(
                    "scalars",
                    "largest error of C₁₁, C₂₂, C_sh, each relative to itself, and of C₁₂ "
                    "relative to √(C₁₁C₂₂)",
                    f"{len(FRF_ROWS)} rows",
                    partial(_worst_frf_error, 0),
                    exact(frf, 1e-24),
                    required,
                ),
                computed_error(
                    "matrix",
                    "largest error of an entry relative to the largest entry",
                    f"{len(FRF_ROWS)} rows",
                    partial(_worst_frf_error, 1),
                    exact(frf, 1e-24),
                    required,
                ),
                computed_error(
                    "influence_coefficients",
                    "largest error relative to the loaded cell's own displacement",
                    f"{len(COEFFICIENT_ROWS)} rows",
                    lambda: max(map(_coefficient_error, COEFFICIENT_ROWS)),
                    # Both programs, which share nothing, agree to rounding: the record is better
                    # than the 1e-12 that its integrals were asked for.
                    exact(COEFFICIENT_SOURCE, 1e-15),
                    Required(1e-14, "twenty times the rounding error"),
                ),
            )
        ),
        equations=(FREQUENCY_RESPONSE,),
        no_order="both sides are exact in the wavenumber, or quadratures to rounding",
        shows=("(7)", "(8)", "(9)", "(10)", "(11)", "(12)", "(13)"),
    )


def frf_laws(level: Level = Level.QUICK) -> Case:
    """Create the verification case of the laws that the surface response of any layered body obeys.

    The laws for the frequency response functions (FRF) are positive energy, limits, monotonicity
    and equal descriptions of one body. Each law is tested on random layered bodies; the largest
    violation is judged. All levels are equal.
    """
    return case(
        "frf_laws",
        "Laws of the frequency response of layered bodies",
        "Laws of mechanics for the surface response of any layered body: positive energy, "
        "limits, monotonicity, equal descriptions of one body. Each law is tested on random bodies "
        "of one to five layers on a half-space or a rigid base, with stiffness contrasts to 1e6, "
        "ν from -0.95 to exactly ½, thicknesses over four and wavenumbers over eight decades. "
        "The value is the largest violation, relative to the largest entry unless stated "
        "otherwise. The bodies are the same in every run; the tests search for larger "
        "violations.",
        Judged(
            quantities=tuple(
                computed_error(
                    law.name,
                    law.statement,
                    f"{law.draws} bodies",
                    partial(worst_violation, law),
                    identity(0.0, "elastic layered half-spaces"),
                    Required(
                        law.allowed,
                        "bound of the law"
                        if law.allowed == 1
                        else "rounding, or the law's own next order",
                    ),
                )
                for law in LAWS
            )
        ),
        equations=(r"\mathbf{t}^H \mathbf{F} \mathbf{t} > 0",),
        no_order="laws of the response itself, in which nothing converges",
        shows=("(7)", "(12)"),
    )
