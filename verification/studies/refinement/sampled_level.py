"""One level of sampling: a scene solved by coefficients from the sampled frequency response."""

from __future__ import annotations

from dataclasses import asdict, dataclass

from semi_analytical import Result, plan
from semi_analytical.history import march
from semi_analytical.model import ContactModel
from verification.laws.sampling_route import errors_between
from verification.running.row import CaseRecord, Row, Value
from verification.studies.refinement.level_row import INCREMENTS
from verification.studies.refinement.surface_level import SurfaceLevel, recorded
from verification.studies.work_precision.usual_route import SampledModel, Sampling


@dataclass(frozen=True)
class SampledLevel:
    """A level whose influence coefficients come from samples."""

    solved: SurfaceLevel
    refinement: int
    extension: int

    @property
    def name(self) -> str:
        return f"sampled-r{self.refinement}-e{self.extension}-{self.solved.name}"

    def compute(self) -> CaseRecord:
        """Solve; raises what `semi_analytical.solve` raises. The one part of the record has the
        errors of the coefficients, by the names of `SamplingErrors`."""
        contents, grid = self.solved.scene.read(), self.solved.grid
        scene, tolerance = contents.scene, contents.semi_analytical.tolerance
        how = Sampling(self.refinement, self.extension)
        model = SampledModel.sampled(scene, grid, how)
        cut = plan(scene).cut_into(self.solved.increments)
        result = Result(scene, grid, tolerance, cut, tuple(march(model, cut, tolerance)))
        sampled, exact = model.coefficients, ContactModel.of(scene, grid).coefficients
        errors = errors_between((sampled.zz, sampled.zx), (exact.zz, exact.zx))
        found = recorded(result, self.solved)
        nx, ny = (how.count(len(row)) for row in (exact.zz, exact.zz.T))
        factors: dict[str, Value] = {"refinement": self.refinement, "extension": self.extension}
        coefficients: dict[str, float | None] = asdict(errors)
        return found.model_copy(
            update={
                "parameters": found.parameters | factors,
                "counters": {INCREMENTS: found.counters[INCREMENTS], "samples": nx * ny},
                "parts": (Row(measures=coefficients),),
            }
        )
