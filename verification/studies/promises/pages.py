"""The page of a run whose title is somebody else's, opened in a browser."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from contact_results.directory.file_names import PAGE
from contact_results.figures.run_page import write_page
from semi_analytical import SurfaceGrid, solve
from verification.studies.promises.browser import PAYLOADS, RAN, chromium, opened
from verification.studies.promises.promise import Attempt
from verification.studies.promises.scenes import CONTACT, fretting, read


@cache
def _solved() -> Any:
    return solve(read(fretting()), SurfaceGrid((16, 16), (3e-3 * CONTACT, 3e-3 * CONTACT)), 1e-8)


def page_of_a_run(text: str) -> str:
    """The page of a run whose scene has this title."""
    solved = _solved()
    with TemporaryDirectory() as folder:
        scene = solved.scene.model_copy(update={"title": text})
        write_page(replace(solved, scene=scene), Path(folder))
        return (Path(folder) / PAGE).read_text(encoding="utf-8")


def shown(count: int) -> Iterator[Attempt]:
    """A payload as the title of a run: its page shows it, and does not run it. No tries without a
    browser."""
    tries = [*PAYLOADS]
    random.Random(23).shuffle(tries)
    for payload in tries[: count if chromium() else 0]:
        with TemporaryDirectory() as folder:
            seen = opened(page_of_a_run(payload), Path(folder))
        ran = f"<title>{RAN}" in seen.document
        quiet = not (ran or seen.console or seen.requests) and "</html>" in seen.document
        yield Attempt(quiet, f"{payload!r}: {seen.console} {seen.requests}")
