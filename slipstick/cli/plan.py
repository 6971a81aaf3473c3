"""`slipstick plan`: what a solve would do, before it does it."""

from typing import TYPE_CHECKING, Annotated

from slipstick.cli.optional import optional
from slipstick.cli.scene_options import SceneArgument, SetOption, warn_of_odd_numbers
from slipstick.cli.solver_option import SolverOption
from slipstick.solvers.names import SolverName

if TYPE_CHECKING:
    from contact_scene import Scene


def plan(
    scene: SceneArgument,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    accuracy: Annotated[
        str | None,
        optional(
            "--accuracy",
            metavar="SHARES",
            help='Say what each of these would cost, such as "1%,0.1%,0.01%", or "approach 0.1%, '
            'contact_radius 0.1%" together, or requests of "run" with semicolons between them; '
            "solves on a coarse grid. Absent: nothing of it.",
        ),
    ] = None,
) -> None:
    """Say which effects a scene needs and why, on which grid or mesh, and what a run would take.

    The time is within a factor of two. It follows from a coarse solve, on at most 32 cells along a
    side or 8 elements over the contact radius and in at most 48 increments, which this command
    makes. A scene that the solver does not support is refused as by 'run'. With --accuracy, cells,
    increments, time and memory of 'run --accuracy' follow from a coarse solve, too.
    """
    from contact_scene import read_scene_file
    from slipstick.cli.terminal import print_pairs, print_table

    contents = read_scene_file(scene, overrides or ())
    warn_of_odd_numbers(contents)
    chosen = solver.solver
    fineness = chosen.fineness(contents)
    decided = chosen.plan(contents.scene, fineness)
    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in decided.effects)
    print_table(("effect", "", "why"), rows)
    print_pairs(chosen.work(contents.scene, fineness, decided))
    if reasons := chosen.reasons(decided):
        print_table(("step", "increments", "why"), reasons)
    if solver is not SolverName.RADIAL and (how := _by_radii(contents.scene)):
        print_pairs([("radial", f"--solver radial would do: {how}")])
    if accuracy is not None:
        from slipstick.cli.prices import print_prices

        print_prices(accuracy, chosen, contents)


def _by_radii(scene: "Scene") -> str | None:
    """What one dimension makes of a scene; None where it calls for more."""
    from contact_scene.solver_errors import UnsupportedScene
    from radial.circle import Circle
    from radial.plan import plan

    how = {
        None: "pressing, or torsion of what is pressed, nearly exact",
        Circle.ONE: "pressing and torsion together, on rings",
        Circle.HALF: "a push along one line, on rings and angles",
        Circle.WHOLE: "pushes that turn, or torsion beside them, on rings and angles",
    }
    try:
        decided = plan(scene)
    except UnsupportedScene:
        return None
    return how[decided.circle]
