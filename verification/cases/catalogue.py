"""Catalogue of all verification cases by name; the module of a case is imported on demand."""

from __future__ import annotations

import os
import time
from collections.abc import Collection
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from contact_scene.reading.description import Description
from verification.judging.outcome import CaseOutcome
from verification.judging.verdicts import lost as without_result

if TYPE_CHECKING:
    from verification.judging.case import Case, Level


# In the order in which a report shows them.
CASES = (
    "hertz_point",
    "hertz_exact_sphere",
    "hertz_approach_control",
    "hertz_unloading",
    "dissimilar_bodies",
    "hertz_elliptical",
    "cone_contact",
    "flat_punch",
    "tilted_punch",
    "eccentric_ball",
    "cattaneo_mindlin",
    "fretting_loop",
    "paper_fretting_loop",
    "series_spring",
    "eccentric_contact",
    "strained_ball",
    "torsion",
    "sheared_cone",
    "near_sliding",
    "load_paths",
    "coupled_history",
    "same_surface",
    "forced_effects",
    "exchanged_bodies",
    "led_histories",
    "coated_paraboloid",
    "coated_unlike_ratios",
    "layered_identities",
    "torsion_coated",
    "thin_layer",
    "film_stiffness",
    "frictional_indentation",
    "indentation_refinement",
    "sheared_increments",
    "no_slip_indentation",
    "spence_example",
    "subsurface_stress",
    "radial_pressing",
    "radial_indentation",
    "radial_torsion",
    "radial_tangential",
    "radial_turning",
    "radial_stress",
    "edge_stress",
    "fem_hertz",
    "fem_classical",
    "fem_coated",
    "fem_indentation",
    "fem_increments",
    "fem_partial_slip",
    "fem_torsion",
    "fem_far_field",
    "fem_harmonics",
    "cross_check",
    "external_codes",
    "fem_penalty_hertz",
    "fem_penalty_indentation",
    "fem_penalty_slip",
    "layered_reference",
    "frf_laws",
    "worked_examples",
    "written_files",
)
# Modules that make several cases; another case is made by the module of its name.
MODULES = {
    "hertz": (
        *("hertz_point", "hertz_exact_sphere", "hertz_approach_control", "hertz_unloading"),
        *("dissimilar_bodies", "hertz_elliptical", "fem_hertz", "fem_penalty_hertz"),
    ),
    "indenters": (
        *("cone_contact", "flat_punch", "tilted_punch", "eccentric_ball", "fem_classical"),
    ),
    "partial_slip": ("cattaneo_mindlin", "sheared_cone", "near_sliding", "fem_harmonics"),
    "fretting": (
        *("fretting_loop", "paper_fretting_loop", "fem_partial_slip", "fem_penalty_slip"),
        "radial_tangential",
    ),
    "rig_and_strain": ("series_spring", "eccentric_contact", "strained_ball"),
    "torsion": ("torsion", "torsion_coated", "fem_torsion", "radial_torsion", "radial_turning"),
    "coatings": (
        *("coated_paraboloid", "coated_unlike_ratios", "layered_identities", "thin_layer"),
        *("film_stiffness", "fem_coated", "radial_pressing", "layered_reference", "frf_laws"),
    ),
    "frictional_pressing": (
        *("frictional_indentation", "indentation_refinement", "sheared_increments"),
        *("no_slip_indentation", "spence_example", "fem_indentation", "fem_increments"),
        *("fem_penalty_indentation", "radial_indentation"),
    ),
    "histories": (
        *("load_paths", "coupled_history", "same_surface", "forced_effects", "exchanged_bodies"),
        *("led_histories", "fem_far_field"),
    ),
    "cross_check": ("cross_check", "external_codes"),
    "stress": ("subsurface_stress", "edge_stress", "radial_stress"),
}
MODULE_OF = {name: module for module, names in MODULES.items() for name in names}


def case_of(name: str, level: Level) -> Case:
    """Create the verification case with the given name.

    level  amount of computation

    Raises KeyError for a name that is not in the catalogue.
    """
    if name not in CASES:
        raise KeyError(name)
    module = import_module(f"verification.cases.{MODULE_OF.get(name, name)}")
    made: Case = getattr(module, name)(level)
    return made


def choose(level: Level, names: Collection[str] = ()) -> tuple[Case, ...]:
    """Create the verification cases with the given names, or all cases, in the order of the
    catalogue.

    Raises KeyError with the first name that is not in the catalogue.
    """
    for name in names:
        if name not in CASES:
            raise KeyError(name)
    return tuple(case_of(name, level) for name in CASES if not names or name in names)


class JudgedCase(Description):
    """Outcome of a verification case, and the wall time of its solution and judgement [s]."""

    outcome: CaseOutcome
    seconds: float


@dataclass(frozen=True)
class CaseToJudge:
    """Name and level of a verification case, which can be sent to a worker process.

    The case itself cannot be sent.

    name   name in the catalogue
    level  name of the amount of computation, in capitals
    """

    name: str
    level: str

    def compute(self) -> JudgedCase:
        """Solve and judge the verification case without the disk cache, so that the present code is
        judged."""
        from verification.judging.case import Level
        from verification.judging.judgement import judge
        from verification.running.cold_cache import cache_directory

        case, started = case_of(self.name, Level[self.level]), time.perf_counter()
        with cache_directory(os.devnull):
            outcome = judge(case)
        seconds = time.perf_counter() - started
        return JudgedCase(outcome=outcome, seconds=seconds)


def lost(case: Case, reason: str) -> CaseOutcome:
    """Create the outcome of a verification case that could not be judged: one failed verdict.

    reason  cause of the failure
    """
    return CaseOutcome(
        name=case.name,
        title=case.title,
        problem=case.problem,
        scenes=(),
        runs=(),
        verdicts=(without_result("all", f"the case has no outcome: {reason}", "case"),),
        findings=(),
        charts=(),
        limits=case.limits,
    )
