"""Messages and exit codes of the exceptions that a command may raise."""

import errno
import os
import traceback
from enum import IntEnum
from importlib.util import find_spec


class ExitCode(IntEnum):
    """Exit codes of the commands of slipstick."""

    PASS = 0
    ACCURACY = 1
    INVALID = 2
    NOT_CONVERGED = 3
    RESOURCES_REFUSED = 4
    BASELINE_DRIFT = 5
    INCONCLUSIVE = 6
    WORSE = 7
    INTERNAL = 70  # a defect of slipstick (EX_SOFTWARE)
    NOBODY_READS = 141  # closed output, as by `| head`: 128 + SIGPIPE


DISK_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


def exit_code(error: Exception) -> ExitCode:
    """Return the exit code of a command that an exception has ended."""
    from contact_results.directory.atomic_file import Refused
    from contact_scene import SceneError, solver_errors

    unsolved = (
        solver_errors.NotConverged,
        solver_errors.ContactNotResolved,
        solver_errors.SurfacesOverlap,
    )
    if isinstance(error, unsolved):
        return ExitCode.NOT_CONVERGED
    full = isinstance(error, OSError) and error.errno in DISK_FULL
    if full or isinstance(error, MemoryError | solver_errors.ResourceRefused):
        return ExitCode.RESOURCES_REFUSED
    if isinstance(error, SceneError | Refused | OSError | solver_errors.SolverError):
        return ExitCode.INVALID
    return ExitCode.INTERNAL


def message(error: Exception) -> str:
    """Return the text that is printed for an exception that has ended a command."""
    from contact_scene import SceneError

    if isinstance(error, SceneError) and len(error.problems) > 1:
        return "\n  ".join([f"{len(error.problems)} mistakes:", *str(error).splitlines()])
    if isinstance(error, MemoryError):
        return f"not enough memory; use fewer cells or increments ({str(error) or 'no details'})"
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename or 'output'}: {error.strerror}"
    if package := _missing_package(error):
        return (
            f"the package {package!r} is not installed: the environment is older than the program; "
            "update it by './run' in the folder of the program, or by 'pip install -e .'"
        )
    if exit_code(error) is ExitCode.INTERNAL:
        return (
            f"internal error, please report it: {type(error).__name__}: {error}\n"
            "  (SLIPSTICK_DEBUG=1 shows where it happened)"
        )
    return str(error)


def _missing_package(error: Exception) -> str:
    """Return the name of the package that could not be imported; empty for other exceptions."""
    package = ((isinstance(error, ModuleNotFoundError) and error.name) or "").partition(".")[0]
    return package if package and find_spec(package) is None else ""


def print_traceback(error: Exception) -> None:
    """Print where an exception was raised, if the environment variable SLIPSTICK_DEBUG is set."""
    if os.environ.get("SLIPSTICK_DEBUG"):
        traceback.print_exception(error)


def explain(error: Exception) -> ExitCode:
    """Print the message of an exception to stderr, and return the exit code."""
    import typer

    print_traceback(error)
    typer.secho("error: ", fg="red", bold=True, nl=False, err=True)
    typer.echo(message(error), err=True)
    return exit_code(error)
