"""Command `slipstick table`: print reference numbers of contacts with their uncertainties."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.options import optional, refuse_unknown

if TYPE_CHECKING:
    from slipstick.tables.table import Table


def table(
    name: Annotated[
        str | None,
        typer.Argument(
            help="Name of the table. Without a name, the tables are listed.", show_default=False
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        optional(
            "--over",
            metavar="PARAMETER=V,V,...",
            help="Values of a parameter instead of those of the table; once per parameter.",
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of CSV.")] = False,
) -> None:
    """Print reference numbers with their uncertainties and their provenance.

    In CSV, lines with the provenance start with '#'.
    """
    from slipstick.tables.catalogue import TABLES

    if name is None:
        _print_tables(TABLES)
        return
    refuse_unknown("table", [name], TABLES, "slipstick table")
    chosen = TABLES[name]
    found = chosen.dataset(_parse_values(chosen, over or ()))
    typer.echo(found.json() if as_json else found.csv(), nl=False)


def _print_tables(tables: Mapping[str, Table]) -> None:
    for name, one in tables.items():
        typer.echo(f"{name}: {', '.join(one.quantities)} over {', '.join(one.axes)}")
        typer.echo(f"  {one.problem}.")


def _parse_values(chosen: Table, given: Sequence[str]) -> dict[str, list[float]]:
    """Read the parameter values of the option `--over`, by parameter name; raises BadParameter.

    chosen  table whose parameters are allowed
    given   arguments such as "nu=0.2,0.3"
    """
    found: dict[str, list[float]] = {}
    for text in given:
        name, _, numbers = text.partition("=")
        if name not in chosen.axes:
            names = ", ".join(chosen.axes)
            raise typer.BadParameter(f"--over {text!r}: '{chosen.name}' has {names}")
        if name in found:
            raise typer.BadParameter(
                f"--over {text!r}: {name} is named twice; name all its values at once, "
                f"{name}=V,V,..."
            )
        axis = chosen.axes[name]
        try:
            found[name] = [float(number) for number in numbers.split(",")]
        except ValueError:
            raise typer.BadParameter(
                f"--over {text!r}: expected numbers such as {name}=0.5,1"
            ) from None
        for value in found[name]:
            if not axis.least < value <= axis.most:
                raise typer.BadParameter(
                    f"--over {text!r}: got {value:g}, expected more than {axis.least:g} and at "
                    f"most {axis.most:g}"
                )
    return found
