"""`slipstick plan`: what a solve would do, before it does it."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from slipstick.cli.scene_options import SceneArgument, SetOption
from slipstick.cli.solver_option import SolverName, SolverOption, method_of

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical
    from contact_scene import SceneFile

    Effect = semi_analytical.Effect | fem_reference.Effect


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

    contents = read_scene_file(scene, overrides or ())
    if solver.is_fem:
        _plan_on_section(contents, solver)
    else:
        _plan_on_grid(contents)


def _plan_on_grid(contents: "SceneFile") -> None:
    from semi_analytical import discretise
    from semi_analytical import plan as plan_of
    from slipstick.cli.plan_text import reasons, work
    from slipstick.cli.terminal import print_pairs, print_table

    decided = plan_of(contents.scene, contents.semi_analytical.path_accuracy)
    _print_effects(decided.effects)
    grid = discretise(contents.scene, contents.semi_analytical)
    print_pairs(work(decided, grid, contents.semi_analytical))
    if any(step.path_matters for step in decided.path):
        print_table(("step", "increments", "why"), reasons(decided))


def _plan_on_section(contents: "SceneFile", solver: SolverName) -> None:
    from fem_reference import plan as plan_of
    from slipstick.cli.section_text import section_work
    from slipstick.cli.terminal import print_pairs

    decided = plan_of(contents.scene)
    _print_effects(decided.effects)
    fineness = contents.fem_reference
    print_pairs(section_work(contents.scene, decided, fineness, method_of(solver)))


def _print_effects(effects: "Iterable[Effect]") -> None:
    from slipstick.cli.terminal import print_table

    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in effects)
    print_table(("effect", "", "why"), rows)
