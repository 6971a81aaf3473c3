"""Catalogue of all verification cases by name.

A verification case is a set of solver runs whose results are judged against known answers. The
Python module that defines a case is imported only when the case is needed.
"""

from __future__ import annotations

import time
from collections.abc import Collection
from dataclasses import dataclass
from importlib import import_module

from contact_scene.disk_cache import without_cache
from contact_scene.reading.description import Description
from verification.judging.case import Case, Level
from verification.judging.judgement import judge
from verification.judging.judgement import lost as without_result
from verification.judging.outcome import CaseOutcome

# Cases by the module that declares them, in the order in which a report shows them.
MODULES = {
    "indenters": (
        "hertz_point",
        "hertz_exact_sphere",
        "hertz_approach_control",
        "hertz_elliptical",
        "cone_contact",
        "tilted_punch",
        "eccentric_ball",
        "fem_hertz",
        "fem_classical",
    ),
    "partial_slip": (
        "cattaneo_mindlin",
        "near_sliding",
    ),
    "fretting": (
        "fretting_loop",
        "paper_fretting_loop",
        "radial_tangential",
        "fem_partial_slip",
        "growing_loads",
    ),
    "rig_and_strain": (
        "series_spring",
        "eccentric_contact",
        "strained_ball",
    ),
    "line_contacts": (
        "line_push",
        "line_loop",
        "line_shapes",
        "line_unlike",
        "line_on_elements",
    ),
    "torsion": (
        "torsion",
        "radial_torsion",
        "radial_turning",
        "fem_torsion",
    ),
    "contact_stiffness": ("contact_stiffness",),
    "histories": (
        "coupled_history",
        "same_surface",
        "forced_effects",
        "exchanged_bodies",
        "led_histories",
        "fem_far_field",
    ),
    "coatings": (
        "coated_paraboloid",
        "compliant_bond",
        "layered_identities",
        "thin_layer",
        "radial_pressing",
        "layered_reference",
        "frf_laws",
    ),
    "frictional_pressing": (
        "frictional_indentation",
        "sheared_increments",
        "no_slip_indentation",
        "radial_indentation",
        "fem_indentation",
    ),
    "stress": (
        "subsurface_stress",
        "radial_stress",
        "edge_stress",
    ),
    "cross_check": (
        "cross_check",
        "external_codes",
    ),
}
MODULE_OF = {name: module for module, names in MODULES.items() for name in names}
CASES = tuple(MODULE_OF)


def case_of(name: str, level: Level) -> Case:
    """Create the verification case with the given name in the catalogue.

    level  amount of computation: quick, standard or full, with finer grids at higher levels

    Raises KeyError for a name that is not in the catalogue.
    """
    if name not in CASES:
        raise KeyError(name)
    module = import_module(f"verification.cases.{MODULE_OF[name]}")
    made: Case = getattr(module, name)(level)
    return made


def choose(level: Level, names: Collection[str] = ()) -> tuple[Case, ...]:
    """Create the verification cases with the given names, in the order of the catalogue.

    level  amount of computation: quick, standard or full
    names  names of the cases; all cases if empty

    Raises KeyError with the first name that is not in the catalogue.
    """
    for name in names:
        if name not in CASES:
            raise KeyError(name)
    return tuple(case_of(name, level) for name in CASES if not names or name in names)


class JudgedCase(Description):
    """Hold the outcome of one verification case (all verdicts) and the wall time of the case.

    outcome  verdicts, reported numbers and charts of the case
    seconds  wall time of solving and judging the case [s]
    """

    outcome: CaseOutcome
    seconds: float


@dataclass(frozen=True)
class CaseToJudge:
    """Hold the name and the level of a verification case that a worker process must judge.

    A case contains functions, which cannot be sent to another process. The worker therefore
    receives this description and creates the case.

    name   name of the case in the catalogue
    level  name of the amount of computation in capitals: QUICK, STANDARD or FULL
    """

    name: str
    level: str

    def compute(self) -> JudgedCase:
        """Solve all runs of the verification case and judge the results, without the disk cache.

        Stored results of earlier versions of the program could hide an error of the present
        version.
        """
        case, started = case_of(self.name, Level[self.level]), time.perf_counter()
        with without_cache():
            outcome = judge(case)
        return JudgedCase(outcome=outcome, seconds=time.perf_counter() - started)


def lost(case: Case, reason: str) -> CaseOutcome:
    """Create the outcome of a verification case that could not be computed: one failed verdict.

    Used if the process that judges the case fails, so that the report still lists the case.

    case    verification case that has no result
    reason  cause of the failure, for the text of the verdict
    """
    return CaseOutcome(
        name=case.name,
        title=case.title,
        problem=case.problem,
        scenes=(),
        runs=(),
        verdicts=(without_result("all", f"the case has no outcome: {reason}", "case"),),
        charts=(),
        limits=case.limits,
    )
