"""Where the cases of a verification or a study are computed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from slipstick.cli.optional import optional

if TYPE_CHECKING:
    from verification.running.case_pool import Workers

SchedulerOption: TypeAlias = Annotated[
    str | None,
    optional(
        "--scheduler",
        metavar="ADDRESS",
        help="Compute on the workers of the dask cluster at tcp://host:port or tls://host:port, "
        "whatever --workers says.",
    ),
]


def workers_at(scheduler: str | None, processes: int) -> int | Workers:
    """The workers of a cluster, or so many processes of this machine."""
    if scheduler is None:
        return processes
    from verification.running.cluster import ClusterUnavailable, ClusterWorkers

    try:
        return ClusterWorkers(scheduler)
    except ClusterUnavailable as error:
        raise typer.BadParameter(f"--scheduler: {error}") from None
