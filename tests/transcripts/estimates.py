"""Print work and memory that the solvers estimate for the scenes of all transcripts, unsolved."""

from itertools import product
from pathlib import Path

from contact_results.solvers import SolverName
from contact_scene import SceneError, read_scene_file
from contact_scene.solver_errors import SolverError

REFINED = (1.0, 3.0, 40.0)  # on coarse cells, libraries and figures take most memory
PER_MEBIBYTE = 2.0**-20

for path, name in product(sorted(Path().glob("*.toml")), SolverName):
    try:
        solver = name.solver.of_file(read_scene_file(path))
        run = solver.run_fineness()
    except (SceneError, SolverError):
        continue
    print(path.stem, name, solver.first_space())
    for factor in REFINED:
        finer = solver.refine_fineness(run, dict.fromkeys(solver.parts, factor))
        memory = [PER_MEBIBYTE * solver.memory(finer), PER_MEBIBYTE * solver.stress_memory(finer)]
        print("estimate", factor, finer.space, *finer.increments, *solver.work(finer), *memory)
