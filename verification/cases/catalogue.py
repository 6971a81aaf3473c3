"""All cases, in the order in which a report shows them."""

from collections.abc import Callable, Iterable

from verification.cases.case import Case, Level
from verification.cases.cattaneo_mindlin import cattaneo_mindlin
from verification.cases.classical_forms import classical_forms
from verification.cases.coated_paraboloid import coated_paraboloid
from verification.cases.cone_contact import cone_contact
from verification.cases.dissimilar_bodies import dissimilar_bodies
from verification.cases.film_stiffness import film_stiffness
from verification.cases.flat_punch import flat_punch
from verification.cases.fretting_loop import fretting_loop
from verification.cases.frf_laws import frf_laws
from verification.cases.frictional_indentation import frictional_indentation
from verification.cases.hertz_approach_control import hertz_approach_control
from verification.cases.hertz_elliptical import hertz_elliptical
from verification.cases.hertz_exact_sphere import hertz_exact_sphere
from verification.cases.hertz_point import hertz_point
from verification.cases.layered_identities import layered_identities
from verification.cases.layered_reference import layered_reference
from verification.cases.load_paths import load_paths
from verification.cases.near_sliding import near_sliding
from verification.cases.no_slip_indentation import no_slip_indentation
from verification.cases.paper_fretting_loop import paper_fretting_loop
from verification.cases.sampling_route import sampling_route
from verification.cases.sheared_cone import sheared_cone
from verification.cases.spence_example import spence_example
from verification.cases.subsurface_stress import subsurface_stress
from verification.cases.thin_layer import thin_layer

CASES: tuple[Callable[[Level], Case], ...] = (
    hertz_point,
    hertz_exact_sphere,
    hertz_approach_control,
    dissimilar_bodies,
    hertz_elliptical,
    cone_contact,
    flat_punch,
    cattaneo_mindlin,
    fretting_loop,
    paper_fretting_loop,
    sheared_cone,
    near_sliding,
    load_paths,
    coated_paraboloid,
    layered_identities,
    thin_layer,
    film_stiffness,
    frictional_indentation,
    no_slip_indentation,
    spence_example,
    subsurface_stress,
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
