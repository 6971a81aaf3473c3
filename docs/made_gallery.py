"""Pages of the gallery: each scene is solved, drawn and compared with published numbers.

An unexpected verdict stops the build of the documentation.
"""

from __future__ import annotations

import shutil
import tempfile
import time
from collections import Counter
from pathlib import Path

from gallery_claims import SCENES, Comparison, Entry, Verdict, compare
from gallery_entries import ENTRIES
from made_notebooks import notebook
from made_reference import table
from PIL import Image

from contact_results.figures.overview import DOTS_PER_INCH, PLACE
from slipstick import save

SYMBOLS = {
    Verdict.AGREES: "✓ agrees",
    Verdict.DIFFERS: "✗ differs",
    Verdict.INCONCLUSIVE: "? inconclusive",
}


class UnexpectedVerdict(Exception):
    """Exception: a verdict of the gallery differs from the one that its text states."""


def write_gallery(folder: Path) -> None:
    """Write all pages and figures of the gallery into a folder; raise UnexpectedVerdict."""
    folder.mkdir(parents=True, exist_ok=True)
    spent = {}
    for entry in ENTRIES:
        started = time.process_time()
        judged = [compare(entry, claim) for claim in entry.claims]
        _draw(entry, folder)
        spent[entry.scene] = time.process_time() - started
        refuse_unexpected(entry, judged)
        (folder / f"{entry.scene}.md").write_text(
            page(entry, judged, spent[entry.scene]), encoding="utf-8"
        )
        (folder / f"{entry.scene}.ipynb").write_text(notebook(entry), encoding="utf-8")
    (folder / "index.md").write_text(_index(spent), encoding="utf-8")


def refuse_unexpected(entry: Entry, judged: list[Comparison]) -> None:
    """Raise UnexpectedVerdict if the verdict of a number is not the expected one."""
    for one in judged:
        if one.verdict is not one.claim.verdict:
            raise UnexpectedVerdict(
                f"{entry.scene}: {one.claim.what}: ours {one.ours:.8g} ± {one.error:.1g}, "
                f"{one.claim.by} {one.claim.published:.8g} ± {one.claim.reading:.1g} "
                f"{one.claim.unit}: {one.verdict}, expected: {one.claim.verdict}"
            )


def page(entry: Entry, judged: list[Comparison], seconds: float) -> str:
    """Return the page of a scene: figure, numbers with verdicts, scene file and commands."""
    rows = [
        (
            one.claim.what,
            f"{one.claim.published:.9g} {one.claim.unit}",
            one.claim.by,
            f"{value_with_error(one)} {one.claim.unit}",
            SYMBOLS[one.verdict],
        )
        for one in judged
    ]
    scene = (SCENES / f"{entry.scene}.toml").read_text(encoding="utf-8").rstrip()
    solver = "" if entry.solver == "semi-analytical" else f" --solver {entry.solver}"
    changes = sorted({c for claim in entry.claims for c in claim.changes})
    more = "".join(f"    --set '{change}'\n" for change in changes)
    return "\n".join(
        (
            f"# {entry.title}\n",
            f"{entry.words}\n",
            f"![Tractions of the contact]({entry.scene}.png)\n",
            table(("number", "published", "by", "slipstick", "verdict"), rows),
            f"{entry.conclusion}\n",
            *([entry.more(entry)] if entry.more else []),
            f"*Source*: {entry.source}.\n",
            f"## Reproduce it, in {max(1, round(seconds))} s\n",
            f"    slipstick run docs/gallery/{entry.scene}.toml{solver} --output "
            f"out/{entry.scene}\n",
            f"or in a {{download}}`notebook <{entry.scene}.ipynb>`.\n",
            *([f"and for the other rows of the table with\n\n{more}"] if more else []),
            f"```toml\n{scene}\n```\n",
        )
    )


def value_with_error(one: Comparison) -> str:
    """Return our number with its error, to two digits of the error and at most nine in all."""
    if one.error < 1e-8 * abs(one.ours):
        return f"{one.ours:.9g}"
    places = 1
    while places < 9 and one.error * 10**places < 10:
        places += 1
    return f"{one.ours:.{places}f} ± {one.error:.{places}f}"


def _draw(entry: Entry, folder: Path) -> None:
    solved = entry.with_changes(entry.shown)
    with tempfile.TemporaryDirectory() as directory:
        run = Path(directory) / "run"
        save(solved.result, run, errors=solved.errors)
        shutil.copy(run / "overview.png", folder / f"{entry.scene}.png")
    _thumbnail(folder / f"{entry.scene}.png", solved.result.steps[-1].in_stick is not None)


def _thumbnail(overview: Path, sticks: bool) -> None:
    """Store one panel of an overview as a small picture: stick and slip zones, else stress, else
    pressure."""
    width, height = (DOTS_PER_INCH * side for side in PLACE)
    with Image.open(overview) as picture:
        stressed = picture.width > 2.5 * width
        left, top = (0.0, picture.height - height) if stressed and not sticks else (width, 0.0)
        top = top or picture.height - 2 * height
        panel = picture.crop((round(left), round(top), round(left + width), round(top + height)))
        panel.save(overview.with_stem(f"{overview.stem}_small"))


def _index(spent: dict[str, float]) -> str:
    cards = "\n".join(_card(entry, max(1, round(spent[entry.scene]))) for entry in ENTRIES)
    names = "\n".join(entry.scene for entry in ENTRIES)
    return (
        "# Gallery\n\n"
        "Published contacts, computed again. Each is one scene file in `docs/gallery`, which is "
        "solved, drawn and compared whenever these pages are built. Two numbers agree (✓) if their "
        "difference is within the sum of both errors. Otherwise they differ (✗), and the page "
        "gives the reason. A comparison is inconclusive (?) if our stated error is too large. An "
        "unexpected verdict stops the build.\n\n"
        f"::::{{container}} scenes\n{cards}\n::::\n\n"
        f"```{{toctree}}\n:hidden:\n\n{names}\n```\n"
    )


def _card(entry: Entry, seconds: int) -> str:
    """Return the card of a scene on the index page: picture, title, source, counts of verdicts, and
    seconds."""
    counts = Counter(claim.verdict for claim in entry.claims)
    verdicts = [
        f"{SYMBOLS[kind][0]} {counts[kind]} {_plural(kind, counts[kind])}"
        for kind in Verdict
        if counts[kind]
    ]
    page = f"{entry.scene}.md"
    return "\n".join(
        (
            ":::{container}",
            f"[![{entry.title}]({entry.scene}_small.png)]({page})\n",
            f"[{entry.title}]({page})\n",
            f"{entry.source}\n",
            f"{', '.join(verdicts)}; {seconds} s",
            ":::",
        )
    )


def _plural(kind: Verdict, number: int) -> str:
    """Return the verdict as a verb for one or several numbers."""
    return kind.removesuffix("s") if number > 1 else str(kind)
