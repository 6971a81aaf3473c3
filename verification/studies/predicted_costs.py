"""The study of prices: does a request take as long as `slipstick plan --accuracy` says?"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any
from zlib import crc32

import numpy as np

from contact_errors.climb import climb
from contact_errors.ladder import Ladder
from contact_errors.ladder_on_cells import CellLadder
from contact_errors.ladder_on_elements import ElementLadder
from contact_errors.price import Prices
from contact_scene import FiniteElementDiscretisation, SurfaceDiscretisation
from contact_scene.scene_file import read_accuracy
from contact_scene.solver_errors import SolverError
from fem_reference import Method
from verification.exhibits.table import table_of
from verification.judging.case import Level
from verification.problems.drawn import coated, coated_indented, homogeneous, refined
from verification.problems.drawn.drawing import Rng
from verification.problems.drawn.known_scene import CELLS, KnownScene
from verification.running.cold_cache import cold_cache
from verification.running.row import CaseRecord, found, parameters_of, value_of
from verification.running.rules import judged, solved
from verification.running.study import Conclusion, Records, Settings, Statement, Study
from verification.studies.error_coverage.coverage import Share

SEED = 31  # of draws by which nothing was set
FACTOR, PROMISED, ENOUGH = 2.0, 0.9, 60
# Whatever takes less is told as this: the program takes as long to begin.
LEAST_SECONDS = 1.0
PREDICTED, TOOK = "predicted", "took"
UNIFORM = ("1%", "0.3%")
# Where friction acts back on the pressure its peak is a cusp, which no few cells know to a percent.
BY_NAME = ("approach 0.3%, contact_radius 1%", "approach 0.1%, contact_radius 2%")
PUSHED = ("approach 0.3%, tangential_shift 2%", "approach 0.3%, tangential_shift 1%")
TOO_DEAR = 120.0  # seconds: a price above it is not paid


@dataclass(frozen=True)
class Drawn:
    """Scenes that are drawn alike, how many, and what is asked of each."""

    draw: Callable[[Rng], KnownScene]
    count: int
    requests: Sequence[str] = UNIFORM


FAMILIES = {
    "hertz": Drawn(homogeneous.hertz, 3),
    "ellipse": Drawn(homogeneous.ellipse, 2),
    "cattaneo": Drawn(homogeneous.cattaneo, 4),
    "coated": Drawn(coated.pressed, 5),
    "coated-twisted": Drawn(coated.twisted, 4),
    "coated-indented": Drawn(coated_indented.unsolved, 3, BY_NAME),
    "coated-pushed": Drawn(refined.unsolved, 2, PUSHED),
    "sections": Drawn(partial(homogeneous.hertz, sections=True), 2),
    "sections-cattaneo": Drawn(partial(homogeneous.cattaneo, sections=True), 3),
    "sections-indented": Drawn(partial(homogeneous.indented, sections=True), 2, BY_NAME),
    "sections-coated": Drawn(partial(coated.pressed, sections=True), 4),
    "sections-coated-twisted": Drawn(partial(coated.twisted, sections=True), 4),
}


@dataclass(frozen=True)
class PricedCase:
    """A request of a drawn scene, priced and paid."""

    family: str
    number: int
    request: int

    @property
    def name(self) -> str:
        return f"{self.family}-{self.number}-{self.request}"

    def compute(self) -> CaseRecord:
        """Seconds of the processor, with nothing in the cache either time."""
        drawn = FAMILIES[self.family]
        known = drawn.draw(np.random.default_rng([SEED, crc32(self.family.encode()), self.number]))
        text = drawn.requests[self.request]
        asked = read_accuracy(text, "--accuracy")
        record = CaseRecord(
            parameters=parameters_of(self) | {"solver": known.fineness.solver, "asked": text}
        )
        try:
            with cold_cache():
                price = Prices.of(_ladder(known)).of_request(asked)
            if price.seconds > TOO_DEAR:
                return record.model_copy(update={"words": {"refused": f"{price.seconds:.0f} s"}})
            with cold_cache():
                began = time.process_time()
                made = climb(_ladder(known), asked)
                took = time.process_time() - began
        except SolverError as error:
            return record.model_copy(update={"words": {"refused": str(error)}})
        return record.model_copy(
            update={
                "measures": {PREDICTED: price.seconds, TOOK: took},
                "counters": {"rounds_predicted": price.rounds, "rounds": made.accuracy.rounds},
                "seconds": took,
            }
        )


def _ladder(known: KnownScene) -> Ladder[Any]:
    if known.fineness.solver == CELLS:
        return CellLadder(known.scene, SurfaceDiscretisation())
    return ElementLadder(known.scene, FiniteElementDiscretisation(), Method.COMPLEMENTARITY)


def cases(settings: Settings) -> tuple[PricedCase, ...]:
    """One of every family at the quick level, and above all."""
    quick = settings.level is Level.QUICK
    return tuple(
        PricedCase(name, number, request)
        for name, drawn in FAMILIES.items()
        for number in range(1 if quick else drawn.count)
        for request in range(1 if quick else len(drawn.requests))
    )


def is_near(record: CaseRecord) -> bool:
    """Whether the price is within the factor of what was paid."""
    predicted, took = (max(LEAST_SECONDS, value_of(record, name)) for name in (PREDICTED, TOOK))
    return took / FACTOR <= predicted <= took * FACTOR


def conclude(settings: Settings, records: Records) -> Conclusion:
    """The share of prices that hold."""
    asked = cases(settings)
    known = tuple(found(asked, records).values())
    paid = [record for record in known if record.measures]
    near = Share(sum(map(is_near, paid)), len(paid)) if paid else None
    longer = sum(value_of(record, TOOK) > LEAST_SECONDS for record in paid)
    return Conclusion(
        answer=""
        if near is None
        else f"Of {near.of} prices {near.part:.0%} are within a factor "
        f"of {FACTOR:g} of what was paid.",
        statements=(
            solved("every request is priced", len(known), len(asked), "requests"),
            Statement(
                claim=f"within a factor of {FACTOR:g} in ≥ {PROMISED:g}",
                outcome=judged(
                    near is not None and near.part >= PROMISED, complete=len(paid) >= ENOUGH
                ),
                measured="nothing"
                if near is None
                else f"{near.text} of {near.of} prices, {longer} of more than {LEAST_SECONDS:g} s",
                because=f"at least {ENOUGH} prices decide",
            ),
        ),
        tables=(
            table_of(
                "Prices and what was paid, in seconds of the processor",
                {
                    "request": lambda r: (
                        f"{r.parameters['family']} {r.parameters['number']}, "
                        f"{r.parameters['asked']}"
                    ),
                    "predicted": lambda r: f"{value_of(r, PREDICTED):.2g}",
                    "took": lambda r: f"{value_of(r, TOOK):.2g}",
                    "rounds": lambda r: f"{r.counters['rounds_predicted']}, {r.counters['rounds']}",
                },
                paid,
                units={"predicted": "s", "took": "s"},
            ),
        ),
        remarks=(
            "Scenes are drawn from a seed of their own. Seconds are those of the processor, priced "
            "and paid with an empty cache; what takes less than a second counts as a second. A "
            "request that no grid can meet, or that is priced above two minutes, is not paid.",
        ),
    )


STUDY = Study(
    name="predicted-costs",
    title="Whether requests take as long as predicted",
    question="Before a scene is solved to an accuracy, `slipstick plan --accuracy` says how long "
    "that will take. How often is that within a factor of two?",
    cases=cases,
    conclude=conclude,
)
