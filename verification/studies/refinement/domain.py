"""Refinement of the section's size: what it costs to cut an endless body off."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fem_reference import Method
from verification.exhibits.numbers import plain
from verification.running.row import Row
from verification.running.rules import judged
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.refinement import page
from verification.studies.refinement.expected import by_box
from verification.studies.refinement.refinement import Refinement, count_of, study_of
from verification.studies.refinement.section_level import SectionLevel
from verification.studies.refinement.section_start import SectionStart
from verification.studies.refinement.studied_scene import CannotRefine, StudiedScene

# The scene's own section over the smallest. Beyond its own nothing is to be seen: what is left
# there is as small as what the elements change, which become a little larger or smaller with it.
SPAN, LEAST_SPAN = 16.0, 8.0
SMALLEST = 5.0  # contact radii: the far field of a load is that of its resultant from there on
LAYERS = 2.0  # thicknesses: a section has to hold the layers, and some of the substrate
# What the section that the finite elements choose may leave of approach and shift.
LEFT = 1e-5
# Motions, or under motions the forces.
JUDGED = (
    *("approach", "tangential_shift_x", "tangential_shift_y"),
    *("normal_force", "tangential_force_x", "tangential_force_y"),
)


def domain_study(
    path: Path, overrides: Sequence[str], step: int | None, method: Method | None
) -> Study:
    """Refinement of the size of the section, by the method that is named.

    Raises SceneError, CannotRefine for a step that is not there or a body that ends at a base.
    """
    scene = StudiedScene.of(path, overrides, step)
    start = SectionStart.of(scene, method or Method.COMPLEMENTARITY)
    span = _span(start)

    def levels(settings: Settings) -> tuple[SectionLevel, ...]:
        steps = count_of(settings) - 1
        boxes = [start.box * span ** (number / steps - 1) for number in range(steps)] + [start.box]
        return tuple(
            start.level(start.radius / box, _words(box, start), box=box, fineness=settings.cells)
            for box in boxes
        )

    refinement = Refinement(
        "domain",
        levels,
        by_box(start.contents.scene, start.couples),
        "contact radius / size of the section",
        start.tolerance,
    )

    def chosen(settings: Settings, records: Records) -> Conclusion:
        """What the section of the scene's own size leaves, and what it costs."""
        found = refinement.found(settings, records)
        fits = [fit for fit in refinement.fitted(found) if fit.name in JUDGED and fit.expected]
        if not fits or found[-1].parameters["level"] != _words(start.box, start):
            return Conclusion(statements=())
        left = {page.label(fit.name): fit.remaining for fit in fits}
        coarse = {page.label(fit.name): fit.errors[0] for fit in fits}
        worst, smallest = list(left)[int(np.argmax(list(left.values())))], found[0]
        return Conclusion(
            statements=(_left(left, start), _cost(smallest, found[-1])),
            answer=f"A section of {_words(start.box, start)} leaves {plain(left[worst], 2)} of the "
            f"{worst}, one of {smallest.parameters['level']} {plain(coarse[worst], 2)}.",
        )

    return study_of(
        refinement,
        f"Section of {scene.title}",
        "How much of the result is due to the section's end? Outside, the displacements of a point "
        "load on the substrate are prescribed. The section becomes larger, up to the scene's own, "
        "at the same elements in the contact; outside it they grow by one ratio.",
        chosen,
    )


def _span(start: SectionStart) -> float:
    """The scene's own section over the smallest one; raises CannotRefine where it is too small."""
    scene = start.contents.scene
    thickness = max(
        sum(layer.thickness for layer in body.layers) for body in (scene.body, scene.indenter)
    )
    smallest = max(start.box / SPAN, SMALLEST * start.radius, LAYERS * thickness)
    if start.box < LEAST_SPAN * smallest:
        raise CannotRefine(
            f"a section of {_words(start.box, start)} is less than {LEAST_SPAN:g} times as large "
            f"as the smallest, {_words(smallest, start)}; give a larger fem_reference.box, or none"
        )
    return start.box / smallest


def _words(box: float, start: SectionStart) -> str:
    return f"{box / start.radius:.4g} contact radii"


def _left(left: dict[str, float], start: SectionStart) -> Statement:
    chosen = start.asked.box is None
    return Statement(
        claim=f"what a section of {_words(start.box, start)} leaves",
        outcome=judged(all(error <= LEFT for error in left.values())) if chosen else None,
        measured="; ".join(f"{name} {plain(error, 2)}" for name, error in left.items()),
        because=f"allowed {LEFT:g}: so large a section is chosen that the substrate's own far "
        "field stands in for that of the layers"
        if chosen
        else "the scene's file names this size: reported, not judged",
    )


def _cost(smallest: Row, own: Row) -> Statement:
    coarse = smallest.parameters["level"]
    many, few = own.counters["displacements"], smallest.counters["displacements"]
    return Statement(
        claim="what it costs",
        outcome=None,
        measured=f"{many} displacements, {many / few:.2f} times as many as {coarse}",
        because="elements grow by one ratio outwards: a section twice as large takes a few more "
        "rows and columns of them",
    )
