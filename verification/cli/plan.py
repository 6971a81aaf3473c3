"""`slipstick plan`: what a solve would do, before it does it."""

from verification.cli.scene_options import SceneArgument, SetOption


def plan(scene: SceneArgument, overrides: SetOption = None) -> None:
    """Say which effects a scene needs and why, on which grid, and in how many increments.

    Nothing is solved, except on a coarse grid where the window is left open; a scene that the
    solver does not support is refused here as by 'run'.
    """
    from contact_scene import read_scene_file
    from semi_analytical import discretise
    from semi_analytical import plan as plan_of
    from verification.cli.plan_text import work
    from verification.cli.terminal import print_pairs, print_table

    contents = read_scene_file(scene, overrides or ())
    decided = plan_of(contents.scene)
    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in decided.effects)
    print_table(("effect", "", "why"), rows)
    grid = discretise(contents.scene, contents.semi_analytical)
    print_pairs(work(decided, grid, contents.semi_analytical))
