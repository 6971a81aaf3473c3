"""Pages whose texts are somebody else's, opened in a browser."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from contact_results.directory.file_names import PAGE
from contact_results.figures.run_page import write_page
from semi_analytical import SurfaceGrid, solve
from verification.regression.history import Standing
from verification.report.history_page import render_history
from verification.report.study_page import render_study
from verification.running.provenance import provenance
from verification.running.record import StudyRecord
from verification.running.study import Conclusion
from verification.studies.promises.browser import PAYLOADS, RAN, chromium, opened
from verification.studies.promises.promise import Attempt
from verification.studies.promises.scenes import CONTACT, fretting, read


@cache
def _solved() -> Any:
    return solve(read(fretting()), SurfaceGrid((16, 16), (3e-3 * CONTACT, 3e-3 * CONTACT)), 1e-8)


def _of_a_run(text: str) -> str:
    """The page of a run whose scene has this title."""
    solved = _solved()
    with TemporaryDirectory() as folder:
        scene = solved.scene.model_copy(update={"title": text})
        write_page(replace(solved, scene=scene), Path(folder))
        return (Path(folder) / PAGE).read_text(encoding="utf-8")


def _of_a_study(text: str) -> str:
    record = StudyRecord(
        name="study", title=text, question=text, level=text, lost=(),
        conclusion=Conclusion(statements=(), answer=text), provenance=provenance(text, {}),
    )  # fmt: skip
    return render_study(record)


def _of_a_history(text: str) -> str:
    return render_history([Standing(text, text, text, {}), Standing("now", "", "", {})], text)


PAGES: dict[str, Callable[[str], str]] = {
    "a run": _of_a_run, "a study": _of_a_study, "a history": _of_a_history,
}  # fmt: skip


def shown(count: int) -> Iterator[Attempt]:
    """A payload in the texts of a page: it is shown, not run. No tries without a browser."""
    tries = [*product(PAGES, PAYLOADS)]
    random.Random(23).shuffle(tries)
    for of, payload in tries[: count if chromium() else 0]:
        with TemporaryDirectory() as folder:
            seen = opened(PAGES[of](payload), Path(folder))
        ran = f"<title>{RAN}" in seen.document
        quiet = not (ran or seen.console or seen.requests) and "</html>" in seen.document
        yield Attempt(quiet, f"{of} with {payload!r}: {seen.console} {seen.requests}")
