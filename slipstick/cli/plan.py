"""`slipstick plan`: what a solve would do, before it does it."""

from slipstick.cli.scene_options import SceneArgument, SetOption
from slipstick.cli.solver_option import SolverOption
from slipstick.solvers.names import SolverName


def plan(
    scene: SceneArgument,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
) -> None:
    """Say which effects a scene needs and why, on which grid or mesh, and in how many increments.

    Nothing is solved, except on a coarse grid or mesh where the size of the contact is left open; a
    scene that the solver does not support is refused here as by 'run'.
    """
    from contact_scene import read_scene_file
    from slipstick.cli.terminal import print_pairs, print_table

    contents = read_scene_file(scene, overrides or ())
    chosen = solver.solver
    fineness = chosen.fineness(contents)
    decided = chosen.plan(contents.scene, fineness)
    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in decided.effects)
    print_table(("effect", "", "why"), rows)
    print_pairs(chosen.work(contents.scene, fineness, decided))
    if reasons := chosen.reasons(decided):
        print_table(("step", "increments", "why"), reasons)
