"""All files of a result, in one call."""

from pathlib import Path

from semi_analytical import Result
from verification.run_output.field_file import write_fields
from verification.run_output.increment_table import write_increments
from verification.run_output.profile_table import write_profiles
from verification.run_output.summary_file import write_summary


def write_result(result: Result, directory: Path, *, with_figures: bool = True) -> None:
    """Write summary, fields, tables and figures into a directory that has none of them."""
    write_summary(result, directory)
    write_profiles(result, directory)
    write_increments(result, directory)
    write_fields(result, directory)
    if with_figures:
        from verification.run_output.figure_files import write_figures

        write_figures(result, directory)
