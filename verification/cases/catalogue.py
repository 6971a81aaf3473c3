"""All cases, in the order in which a report shows them."""

from collections.abc import Callable, Iterable

from verification.cases.cattaneo_mindlin import cattaneo_mindlin
from verification.cases.classical_forms import classical_forms
from verification.cases.coated_paraboloid import coated_paraboloid
from verification.cases.coated_unlike_ratios import coated_unlike_ratios
from verification.cases.cone_contact import cone_contact
from verification.cases.coupled_history import coupled_history
from verification.cases.cross_check import cross_check
from verification.cases.cross_check_tangential import cross_check_tangential
from verification.cases.dissimilar_bodies import dissimilar_bodies
from verification.cases.eccentric_ball import eccentric_ball
from verification.cases.external_codes import external_codes
from verification.cases.fem_classical import fem_classical
from verification.cases.fem_coated import fem_coated
from verification.cases.fem_harmonics import fem_harmonics
from verification.cases.fem_hertz import fem_hertz
from verification.cases.fem_increments import fem_increments
from verification.cases.fem_indentation import fem_indentation
from verification.cases.fem_partial_slip import fem_partial_slip
from verification.cases.fem_penalty_hertz import fem_penalty_hertz
from verification.cases.fem_penalty_indentation import fem_penalty_indentation
from verification.cases.fem_penalty_slip import fem_penalty_slip
from verification.cases.fem_torsion import fem_torsion
from verification.cases.film_stiffness import film_stiffness
from verification.cases.flat_punch import flat_punch
from verification.cases.forced_effects import forced_effects
from verification.cases.fretting_loop import fretting_loop
from verification.cases.frf_laws import frf_laws
from verification.cases.frictional_indentation import frictional_indentation
from verification.cases.goodman_indentation import goodman_indentation
from verification.cases.hertz_approach_control import hertz_approach_control
from verification.cases.hertz_elliptical import hertz_elliptical
from verification.cases.hertz_exact_sphere import hertz_exact_sphere
from verification.cases.hertz_point import hertz_point
from verification.cases.hertz_unloading import hertz_unloading
from verification.cases.indentation_refinement import indentation_refinement
from verification.cases.layered_identities import layered_identities
from verification.cases.layered_reference import layered_reference
from verification.cases.load_paths import load_paths
from verification.cases.near_sliding import near_sliding
from verification.cases.no_slip_indentation import no_slip_indentation
from verification.cases.paper_fretting_loop import paper_fretting_loop
from verification.cases.same_surface import same_surface
from verification.cases.sampling_route import sampling_route
from verification.cases.sheared_cone import sheared_cone
from verification.cases.sheared_increments import sheared_increments
from verification.cases.spence_example import spence_example
from verification.cases.subsurface_stress import subsurface_stress
from verification.cases.thin_layer import thin_layer
from verification.cases.tilted_punch import tilted_punch
from verification.cases.torsion import torsion
from verification.cases.torsion_coated import torsion_coated
from verification.judging.case import Case, Level

CASES: tuple[Callable[[Level], Case], ...] = (
    hertz_point,
    hertz_exact_sphere,
    hertz_approach_control,
    hertz_unloading,
    dissimilar_bodies,
    hertz_elliptical,
    cone_contact,
    flat_punch,
    tilted_punch,
    eccentric_ball,
    cattaneo_mindlin,
    fretting_loop,
    paper_fretting_loop,
    torsion,
    sheared_cone,
    near_sliding,
    load_paths,
    coupled_history,
    same_surface,
    forced_effects,
    coated_paraboloid,
    coated_unlike_ratios,
    layered_identities,
    torsion_coated,
    thin_layer,
    film_stiffness,
    frictional_indentation,
    indentation_refinement,
    sheared_increments,
    goodman_indentation,
    no_slip_indentation,
    spence_example,
    subsurface_stress,
    fem_hertz,
    fem_classical,
    fem_coated,
    fem_indentation,
    fem_increments,
    fem_partial_slip,
    fem_torsion,
    fem_harmonics,
    cross_check,
    cross_check_tangential,
    external_codes,
    fem_penalty_hertz,
    fem_penalty_indentation,
    fem_penalty_slip,
    layered_reference,
    frf_laws,
    classical_forms,
    sampling_route,
)


def catalogue(level: Level) -> dict[str, Case]:
    """All cases of a level, by name."""
    return {case.name: case for case in (build(level) for build in CASES)}


def choose(level: Level, names: Iterable[str]) -> tuple[Case, ...]:
    """The named cases, or all if none is named, in the order of the catalogue.

    Raises KeyError with the first name that is not in the catalogue.
    """
    wanted = set(names)
    cases = catalogue(level)
    for name in wanted - cases.keys():
        raise KeyError(name)
    return tuple(case for case in cases.values() if not wanted or case.name in wanted)
