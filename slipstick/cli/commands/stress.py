"""Command `slipstick stress`: compute displacement and stress below the surface."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from pydantic import TypeAdapter, ValidationError

from contact_errors.coarse_solves import stated_errors
from contact_errors.stress_errors import stress_at, stress_errors
from contact_results.directory.run_directory import refuse_files_above
from contact_results.radial_method import radial_advice
from contact_results.solvers import SolverName
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import (
    RADIAL,
    LoadedBodies,
    state_of_result,
    state_of_run,
    states_of_result,
    states_of_run,
)
from contact_results.stress.points import StressField, StressIncrement
from contact_results.stress.radial_body import is_sheared, refuse_infinite, refuse_turned
from contact_results.stress.stress_maxima import extremes, maxima_columns, stress_doubts
from contact_results.stress_result import write_history, write_stress
from contact_scene import Body, Scene, SceneFile, read_scene_file
from contact_scene.quantities.field_metadata import CONVENTION, OF_THE_INDENTER
from contact_scene.quantities.stated_error import StatedError, StatedErrors
from contact_scene.reading import units
from contact_scene.reading.quantity import Length
from contact_scene.reading.text_table import TABLE_SUFFIXES, ColumnNames, read_columns
from contact_scene.solver_errors import ContactNotResolved, SolverError, UnsupportedScene
from semi_analytical.frf.stack import stack_of
from semi_analytical.stress import interfaces
from semi_analytical.stress.depths import levels_of
from slipstick.cli.accuracy_option import (
    AccuracyOption,
    MostSecondsOption,
    exit_unless_met,
    read_requested_accuracy,
    solve_to_accuracy,
)
from slipstick.cli.expect_option import ExpectOption, SaveExpectedOption, read_expectation
from slipstick.cli.options import (
    OptionalSolver,
    OutputOption,
    SetOption,
    optional,
    print_input_warnings,
    refuse_if,
    refuse_with_run,
)
from slipstick.cli.progress import accuracy_lines, show_coarse_solves, solve_progress
from slipstick.cli.terminal import print_message, print_pairs, print_table

if TYPE_CHECKING:
    from contact_results.surface import Result
    from slipstick.expected import Source


# Accepted heads of a table of points.
POINTS: ColumnNames = {
    "x": (units.LENGTH, frozenset({"x"})),
    "y": (units.LENGTH, frozenset({"y"})),
    "z": (units.LENGTH, frozenset({"z", "depth"})),
}


class Figures(StrEnum):
    """Figures that `slipstick stress` draws: none or all."""

    NONE = "none"
    ALL = "all"


def stress(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RUN_DIR|SCENE",
            help="Output of 'slipstick run', or a scene file to solve first.",
            show_default=False,
        ),
    ],
    output: OutputOption,
    step: Annotated[
        int | None,
        optional(
            "--step",
            metavar="N",
            min=1,
            help="Load step at whose end the stress is computed. Default: the last.",
        ),
    ] = None,
    depths: Annotated[
        str | None,
        optional(
            "--depths",
            metavar="Z,Z,...",
            help="Depths such as '0,0.1 mm,0.2 mm'; both sides of every interface are added. "
            "Default: from contact and layers.",
        ),
    ] = None,
    at: Annotated[
        list[str] | None,
        optional(
            "--at",
            metavar="X,Y,Z|FILE",
            help="Compute the stress at a point, such as '0.3 mm,0,20 um'; 'interface 1' as Z "
            "selects both sides of it. A text table has points in the columns x, y and z with "
            "units. The option may be repeated.",
        ),
    ] = None,
    history: Annotated[
        bool,
        typer.Option(
            "--history",
            help="With --at: compute all increments of a scene, or of a run with --all-fields.",
        ),
    ] = False,
    indenter: Annotated[
        bool, typer.Option("--indenter", help="Compute the stress in the indenter; z points up.")
    ] = False,
    volume: Annotated[
        bool, typer.Option("--volume", help="Write the volume as VTU as well, not only y = 0.")
    ] = False,
    figures: Annotated[
        Figures,
        typer.Option("--figures", metavar="NAME", help="all: draw figures; none: draw none."),
    ] = Figures.ALL,
    error: Annotated[
        bool,
        typer.Option(
            "--error/--no-error", help="State an error for every maximum, or omit the errors."
        ),
    ] = True,
    accuracy: AccuracyOption = None,
    most_seconds: MostSecondsOption = None,
    overrides: SetOption = None,
    solver: OptionalSolver = None,
    save_expected: SaveExpectedOption = None,
    expect: ExpectOption = None,
) -> None:
    """Compute the stress in layers and substrate.

    DIR receives stress.json, tables (CSV) of maxima, of the z axis and of both sides of interfaces,
    the section y = 0 for ParaView (VTU), figures, and the page stress.html.

    With --accuracy, or a table [accuracy] in the scene, the scene is refined as by 'run';
    "max_principal 1%" requests the accuracy of the largest tensile stress in the body.

    With --expect, a result with a stress that is worse than expected is written, too, and the
    command exits with code 7.

    With --at, DIR receives stress_history.csv and .png instead.
    """
    refuse_files_above(output)
    chosen_depths = None if depths is None else [_parse_length(text) for text in depths.split(",")]
    chosen = solver or SolverName.SEMI_ANALYTICAL
    contents = request = reached = None
    if source.is_dir():
        given: dict[str, object] = {"--set": overrides, "--solver": solver}
        refuse_with_run(given | {"--accuracy": accuracy, "--most-seconds": most_seconds})
    else:
        _refuse_beside_section(chosen, chosen_depths, volume, at)
    without_points = {
        "--depths": depths,
        "--volume": volume,
        "--accuracy": accuracy,
        "--save-expected": save_expected,
        "--expect": expect,
    }
    refuse_if(
        (
            (
                history and step is not None,
                "--history is of all load steps; leave --step out",
            ),
            (history and not at, "--history needs points; add --at X,Y,Z"),
            *(
                (at and value, f"{option} excludes --at; omit one of them")
                for option, value in without_points.items()
            ),
        )
    )
    if not source.is_dir():
        contents = read_scene_file(source, overrides or ())
        steps = len(contents.scene.loading)
        # Refuse before the solve.
        refuse_if(
            ((step and step > steps, f"there is no step {step}; the scene has steps 1 to {steps}"),)
        )
        _parse_points(at or [], contents.scene, indenter)
        _depth_levels(contents.scene, indenter, chosen_depths or (), "--depths")
    if at or history:
        drawn = figures is Figures.ALL
        given_points = at or []
        _write_points(
            source, contents, given_points, step, chosen, output, history, indenter, drawn, error
        )
        return
    expectation = read_expectation(
        expect,
        save_expected,
        lambda: _source(source, contents, chosen, step, depths, indenter),
        error=error,
    )
    with ExitStack() as until_written:
        if contents is None:
            state = state_of_run(source, step)
        else:
            print_input_warnings(contents)
            request = read_requested_accuracy(contents, accuracy, most_seconds, error=error)
            of_stress = request and request.binds_stress
            refuse_if(
                (
                    (
                        of_stress and indenter,
                        "an accuracy of max_principal applies to the body; omit --indenter",
                    ),
                    (
                        of_stress and chosen_depths is not None,
                        "an accuracy of max_principal needs all depths: omit --depths, or request "
                        "other quantities",
                    ),
                )
            )
            stated: StatedErrors | None
            if request is None:
                result, stated = _solve_scene(contents, chosen, error)
            else:
                output.parent.mkdir(parents=True, exist_ok=True)
                refined = until_written.enter_context(
                    solve_to_accuracy(
                        request,
                        chosen.solver.of_file(contents),
                        output,
                        most_seconds,
                        step=step,
                    )
                )
                result, stated = refined.level.result, refined.level.stated
                reached = refined.accuracy
            state = state_of_result(result, step, stated).with_bodies_of(contents.scene)
        which, _ = _elastic_body(state, indenter)
        field = _stress_field(state, chosen_depths, indenter=indenter, volume=volume)
        found = extremes(field)
        errors = None
        if error:
            chosen_alone = chosen_depths is not None
            errors = stress_errors(state, field, found, indenter=indenter, at_depths=chosen_alone)
        doubts = list(stress_doubts(found, errors))
        doubted = bool(doubts) or (reached is not None and not reached.met)
        if state.scene is not None:
            solver_name = RADIAL if state.pressed is not None else ""
            doubts += radial_advice(state.scene, solver_name, doubted=doubted)
        write_stress(
            state,
            which,
            field,
            found,
            output,
            with_figures=figures is Figures.ALL,
            errors=errors,
            accuracy=reached,
            doubts=doubts,
        )
    if reached is not None:
        print_pairs(accuracy_lines(reached))
    columns = maxima_columns(found, errors)
    print_table(columns, list(zip(*columns.values(), strict=True)), numbers=True)
    for text in [*doubts, *_omissions(state, field, errors)]:
        typer.echo(f"  {text}")
    typer.echo(f"results in {output}")
    worse = 0
    if expectation is not None:
        from slipstick.expected import stress_numbers

        worse = expectation.settle(stress_numbers(found, errors or (), f"step {state.step}"))
    exit_unless_met(reached)
    if worse:
        raise typer.Exit(worse)


def _omissions(
    state: LoadedBodies, field: StressField, errors: Sequence[StatedError] | None
) -> Iterator[str]:
    """Yield what the largest stresses do not contain, and what their errors do not."""
    edge: Any = field.how.get("edge")
    if edge is not None and not edge["fitted"]:
        yield f"no correction of the stress near the contact edge: {edge['because']}"
    # Without shear, the radial solver has no increment error.
    on_disc = state.pressed is not None and not is_sheared(state)
    if errors is None:
        yield "no errors, because of --no-error"
    elif not on_disc and state.by_increments is None:
        yield "errors without that of increments, which the run does not state"


def _source(
    given: Path,
    contents: SceneFile | None,
    chosen: SolverName,
    step: int | None,
    depths: str | None,
    indenter: bool,
) -> Source:
    """Return the origin of the largest stresses, for the comparison with expected numbers.

    given     output directory of a run, or scene file
    contents  contents of the scene file; None for a run
    step      load step, from 1; None for the last
    depths    text of the option `--depths`, or None
    """
    from contact_results.files.stored_run import load
    from slipstick.expected import Source, scene_keys

    if contents is None:
        run = load(given)
        scene, solver = run.scene, run.solver
    else:
        scene, solver = contents.scene, chosen.value
    more = {"--step": step or len(scene.loading), "--indenter": indenter, "--depths": depths}
    return Source("stress", scene_keys(scene, **more), solver)


def _write_points(
    source: Path,
    contents: SceneFile | None,
    at: list[str],
    step: int | None,
    chosen: SolverName,
    output: Path,
    history: bool,
    indenter: bool,
    drawn: bool,
    error: bool,
) -> None:
    """Compute the stress at points in a body, and write it as table and figure.

    The stress is computed at the end of one load step, or for all increments. A state that the
    solver cannot evaluate is omitted with a message.

    source    output directory of a run, or scene file
    contents  contents of the scene file, which is solved first; None for a run
    at        arguments of `--at`
    step      load step, from 1; None for the last
    chosen    solver of the scene
    output    output directory
    history   true for all increments
    indenter  true for points in the indenter, false for points in the lower body
    drawn     true to draw the figure
    error     false to omit the errors
    """
    made = []
    left_out: SolverError = ContactNotResolved("the bodies are separated and have no stress")
    if contents is None:
        states: Any = states_of_run(source) if history else [state_of_run(source, step)]
    else:
        result, _ = _solve_scene(contents, chosen, error=False)
        states = states_of_result(result) if history else [state_of_result(result, step)]
    for state in states:
        number, index = state.step, state.increment if history else None
        if contents is not None:
            state = state.with_bodies_of(contents.scene)
        title, (which, body) = state.title, _elastic_body(state, indenter)
        x, y, levels = _parse_points(at, state, indenter)
        end = f"step {number}" if index is None else f"step {number}, increment {index}"
        try:
            points, errors, unknown = stress_at(state, x, y, levels, indenter=indenter, error=error)
        except UnsupportedScene as too_small:  # a contact too small for rings
            left_out = too_small
            print_message(f"{end} is left out: {too_small}")
            continue
        made.append(StressIncrement(number, index, points, errors))
        if unknown:
            print_message(f"{end} has no errors: {unknown}")
    if not made:
        raise left_out
    title = f"{title or 'Stress'}: {which}"
    convention = OF_THE_INDENTER if indenter else CONVENTION
    write_history(made, body, output, convention, title, with_figures=drawn)
    typer.echo(f"results in {output}")


def _elastic_body(bodies: Scene | LoadedBodies, indenter: bool) -> tuple[str, Body]:
    which, body = ("indenter", bodies.indenter) if indenter else ("body", bodies.body)
    if not body.deforms:
        raise typer.BadParameter(f"the {which} is rigid and has no stress")
    return which, body


def _parse_points(
    at: list[str], bodies: Scene | LoadedBodies, indenter: bool
) -> tuple[Any, Any, list[Any]]:
    """Read the points of the option `--at`: coordinates x and y (n,), and the depth levels.

    A point at an interface gives two points, one on each side. Raises BadParameter for other texts,
    tables that cannot be read, and a rigid body.

    at        texts such as "0.3 mm,0,20 um" or "0,0,interface 1", and names of text tables
    indenter  true for points in the indenter, false for points in the lower body
    """
    _, body = _elastic_body(bodies, indenter)
    sides = {f"interface {k}": pair for k, pair in enumerate(interfaces(body), 1)}
    found = []
    for text in at:
        if Path(text).suffix.lower() in TABLE_SUFFIXES:
            found += _read_points(Path(text), bodies, indenter)
            continue
        parts = [part.strip() for part in text.split(",")]
        if len(parts) != 3:
            raise typer.BadParameter(
                f"got --at {text}, expected X,Y,Z such as '0.3 mm,0,20 um', or a table such as "
                "points.csv"
            )
        x, y = (_parse_length(part, "--at") for part in parts[:2])
        if parts[2].startswith("interface") and parts[2] not in sides:
            expected = " or ".join(sides) or "a depth: there is no layer"
            raise typer.BadParameter(f"--at {text}: expected {expected}")
        levels = sides.get(parts[2]) or _depth_levels(
            bodies, indenter, [_parse_length(parts[2], "--at")], f"--at {text}"
        )
        found += [(x, y, level) for level in levels]
    return np.array([p[0] for p in found]), np.array([p[1] for p in found]), [p[2] for p in found]


def _read_points(
    path: Path, bodies: Scene | LoadedBodies, indenter: bool
) -> list[tuple[float, float, Any]]:
    """Read points from a text table: coordinates x and y [length], and the depth level.

    Raises BadParameter for a table that cannot be read, and for points outside the body.
    """
    try:
        columns = read_columns(path, POINTS)
    except ValueError as error:
        raise typer.BadParameter(f"--at: {error}") from None
    missing = ", ".join(POINTS.keys() - columns.keys())
    if missing:
        raise typer.BadParameter(
            f"--at {path}: got no column {missing} with values, expected x, y and z"
        )
    return [
        (x, y, level)
        for x, y, z in zip(*(columns[name].tolist() for name in POINTS), strict=True)
        for level in _depth_levels(bodies, indenter, [z], f"--at {path}")
    ]


def _depth_levels(
    bodies: Scene | LoadedBodies, indenter: bool, depths: Sequence[float], option: str
) -> Sequence[Any]:
    try:
        return levels_of(stack_of(_elastic_body(bodies, indenter)[1]), depths)
    except ValueError as error:
        raise typer.BadParameter(f"{option}: {error}") from None


def _solve_scene(
    contents: SceneFile, name: SolverName, error: bool
) -> tuple[Result, StatedErrors | None]:
    """Solve the scene of a scene file, and estimate the errors of its scalars.

    error  false to omit the error estimates; the second return value is then None
    """
    chosen = name.solver.of_file(contents)
    decided = chosen.run_plan
    if name is SolverName.RADIAL:
        from radial.angular_grid import RingAngles
        from radial.largest_contact import expected_radius

        if decided.has_shear:
            refuse_infinite(contents.scene.indenter, expected_radius(contents.scene))
        if decided.circle is RingAngles.WHOLE:
            refuse_turned()
    with solve_progress(decided.increments) as observe:
        result = chosen.run(observe)
    if not error:
        return result, None
    with show_coarse_solves():
        return result, stated_errors(result)


def _refuse_beside_section(
    solver: SolverName, depths: list[float] | None, volume: bool, at: list[str] | None = None
) -> None:
    """Raise BadParameter for options of the stress outside the one plane that a solver computes."""
    refuse_if(
        (
            (
                solver.is_fem and (depths is not None or volume or at),
                "finite elements compute the stress at their nodes in one plane: omit --at, "
                "--depths and --volume",
            ),
            (
                solver is SolverName.RADIAL and volume,
                "the radial solver computes the stress in one plane through the axis: omit "
                "--volume",
            ),
        )
    )


def _stress_field(
    state: LoadedBodies, depths: list[float] | None, *, indenter: bool, volume: bool
) -> StressField:
    """Compute the stress field in a body, at depths [length] or those of the solver.

    Raises BadParameter for depths or a volume that the solver cannot compute.
    """
    if state.pressed is not None:
        _refuse_beside_section(SolverName.RADIAL, depths, volume)
    elif state.on_rings:
        _refuse_beside_section(SolverName.FEM, depths, volume)
    _depth_levels(state, indenter, depths or (), "--depths")
    return body_response(state, indenter=indenter).stress(depths, volume=volume)


def _parse_length(text: str, option: str = "--depths") -> float:
    """Convert the text of a length to metres; raises BadParameter.

    The text is a number in metres, or a number with a unit, such as "20 um".

    option  name of the option, for the message
    """
    try:
        return float(text)
    except ValueError:
        pass
    try:
        return TypeAdapter(Length).validate_python(text)
    except ValidationError as error:
        reason = error.errors()[0]["msg"]
        raise typer.BadParameter(f"{option}: {reason}") from None
