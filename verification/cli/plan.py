"""`slipstick plan`: what a solve would do, before it does it."""

from verification.cli.scene_options import SceneArgument, SetOption


def plan(scene: SceneArgument, overrides: SetOption = None) -> None:
    """Say which effects a scene needs and why, on which grid, and in how many increments.

    Nothing is solved; a scene that the solver does not support is refused here as by 'run'.
    """
    from contact_scene import read_scene_file
    from semi_analytical import plan as plan_of
    from verification.cli.terminal import print_table

    contents = read_scene_file(scene, overrides or ())
    effects = plan_of(contents.scene).effects
    rows = ((effect.name, "on" if effect.on else "off", effect.why) for effect in effects)
    print_table(("effect", "", "why"), rows, numbers=False)
