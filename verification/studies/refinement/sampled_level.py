"""One level of sampling: a scene solved by coefficients from the sampled frequency response."""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass
from typing import ClassVar

from contact_scene.description import Description
from semi_analytical import Result, plan
from semi_analytical.history import march
from semi_analytical.model import ContactModel
from verification.convergence.level_record import LevelRecord
from verification.laws.sampling_route import errors_between
from verification.studies.refinement.surface_level import SurfaceLevel, recorded
from verification.studies.work_precision.usual_route import SampledModel, Sampling


class SampledRecord(Description):
    """What the sampled response gave."""

    found: LevelRecord
    coefficients: dict[str, float]
    """Errors, by the names of `SamplingErrors`."""

    @property
    def seconds(self) -> float:
        """CPU time."""
        return self.found.seconds


@dataclass(frozen=True)
class SampledLevel:
    """A level whose influence coefficients come from samples."""

    record_type: ClassVar[type[Description]] = SampledRecord
    solved: SurfaceLevel
    refinement: int
    extension: int

    @property
    def name(self) -> str:
        return f"sampled-r{self.refinement}-e{self.extension}-{self.solved.name}"

    def compute(self) -> SampledRecord:
        """Solve; raises what `semi_analytical.solve` raises."""
        started = time.process_time()
        contents, grid = self.solved.scene.read(), self.solved.grid
        scene, tolerance = contents.scene, contents.semi_analytical.tolerance
        how = Sampling(self.refinement, self.extension)
        model = SampledModel.sampled(scene, grid, how)
        cut = plan(scene).cut_into(self.solved.increments)
        result = Result(scene, grid, tolerance, cut, tuple(march(model, cut, tolerance)))
        sampled, exact = model.coefficients, ContactModel.of(scene, grid).coefficients
        errors = errors_between((sampled.zz, sampled.zx), (exact.zz, exact.zx))
        found = recorded(result, self.solved, time.process_time() - started)
        nx, ny = (how.count(len(row)) for row in (exact.zz, exact.zz.T))
        found = found.model_copy(update={"work": {"samples": nx * ny}})
        return SampledRecord(found=found, coefficients=asdict(errors))
