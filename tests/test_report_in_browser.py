"""The report opened in a Chromium: no error, no request, and nothing of a record is ever run."""

import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
from report_examples import case, report_of, run_record, study

from verification.exhibits.picture import Picture
from verification.report.page import render_page, render_sheets
from verification.running.report_record import Report

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-extensions", "--enable-logging=stderr", "--v=0", "--virtual-time-budget=2000",
    "--host-resolver-rules=MAP * ~NOTFOUND",  # whatever is asked for stays here
)  # fmt: skip
SECONDS = 600
RAN = "it-ran"
# Each would set the title of the page, and so show that it ran.
ACT = f"document.title='{RAN}'"
PAYLOADS = (
    f"<script>{ACT}</script>", f"</script><script>{ACT}</script>", f"<SCRIPT>{ACT}</SCRIPT>",
    f"<script src=data:,{ACT}></script>", f"</title><script>{ACT}</script>",
    f"</style><script>{ACT}</script>", f"</desc></svg><script>{ACT}</script>",
    f"--><script>{ACT}</script>", f"]]><script>{ACT}</script>",
    f"<img src=x onerror={ACT}>", f'"><img src=x onerror="{ACT}">',
    f"'><img src=x onerror='{ACT}'>", f"<svg onload={ACT}>", f"<svg><script>{ACT}</script></svg>",
    f"<svg><set attributeName=onload to={ACT}>", f"<body onload={ACT}>",
    f"<iframe srcdoc='<script>parent.{ACT}</script>'></iframe>",
    f'<iframe src="javascript:parent.{ACT}"></iframe>', f'<object data="javascript:{ACT}">',
    f'<embed src="javascript:{ACT}">', f'<a href="javascript:{ACT}">x</a>',
    f'<math><a xlink:href="javascript:{ACT}">x</a></math>', f"<details open ontoggle={ACT}>",
    f"<input autofocus onfocus={ACT}>", f"<video><source onerror={ACT}></video>",
    f"<audio src=x onerror={ACT}>", f"<marquee onstart={ACT}>", f"<style>@import '{ACT}'</style>",
    "<style>*{background:url(http://example.invalid/x)}</style>",
    "<link rel=stylesheet href=http://example.invalid/x.css>",
    "<meta http-equiv=refresh content='0;url=http://example.invalid/'>",
    "<base href=http://example.invalid/>", "<form action=http://example.invalid/><input></form>",
    "<img src=http://example.invalid/x.png>", f"{{{{ cycler.__init__ }}}}{{% set x %}}{ACT}",
    f'" onmouseover="{ACT}" x="', f"' onfocus='{ACT}' autofocus x='", f"&lt;script&gt;{ACT}",
    f"\u2028<script>{ACT}</script>", f"%3Cscript%3E{ACT}%3C/script%3E",
)  # fmt: skip


def browser() -> str:
    """The browser of this machine; a skip without one."""
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        pytest.skip("no Chromium here; on Debian: apt-get install chromium")
    return found


@dataclass(frozen=True)
class Opened:
    """What a browser made of a page.

    document  as it stands after loading
    console   lines that the page wrote, refusals of its policy included
    requests  addresses that were asked for, the page itself left out
    """

    document: str
    console: list[str]
    requests: list[str]


def opened(page: str, folder: Path, *flags: str) -> Opened:
    """Open a page and look."""
    chromium = browser()
    file, log = folder / "page.html", folder / "net.json"
    file.write_text(page, encoding="utf-8")
    done = subprocess.run(
        [chromium, *FLAGS, f"--user-data-dir={folder / 'profile'}", f"--log-net-log={log}",
         *flags, "--dump-dom", file.as_uri()],
        capture_output=True, text=True, timeout=SECONDS, check=True,
    )  # fmt: skip
    console = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
    return Opened(done.stdout, console, _requests(log))


def _requests(log: Path) -> list[str]:
    """Addresses in a log of the network that a page asked for; the browser's own have no origin."""
    text = log.read_text(encoding="utf-8", errors="replace")
    try:
        events = json.loads(text)["events"]
    except json.JSONDecodeError:  # cut short at the browser's end
        events = json.loads(text.rstrip().rstrip(",") + "]}")["events"]
    asked = [event["params"] for event in events if "initiator" in event.get("params", {})]
    of_pages = [one["url"] for one in asked if one["initiator"] != "not an origin"]
    return [url for url in of_pages if re.match(r"(https?|wss?|ftp):", url)]


@pytest.fixture(scope="module")
def full() -> Report:
    """A report with both solvers, a failure and studies."""
    cells = case("hertz_point", {"approach": (1.001e-6, 1e-6)}, run_record(64, None))
    elements = case("fem_hertz", {"approach": (1.2e-6, 1e-6)}, run_record(None, 32))
    laws = case("frf_laws", {"law": (1e-6, 1e-6)}, run_record(8, None))
    return report_of(
        (cells, elements, laws), (study("gross-sliding", "No."), study("stability", level="full"))
    )


def test_page_opens_without_error_and_without_request(full: Report, tmp_path: Path) -> None:
    for render in (render_page, render_sheets):
        seen = opened(render(full), tmp_path)
        assert seen.console == []
        assert seen.requests == []
        assert seen.document.count("<article") == render(full).count("<article")
        assert seen.document.rstrip().endswith("</html>")


def test_page_forbids_scripts_and_so_works_without_them(full: Report, tmp_path: Path) -> None:
    page = render_page(full)
    assert "<script" not in page
    seen = opened(page.replace("</body>", f"<script>{ACT}</script></body>"), tmp_path)
    assert f"<title>{RAN}" not in seen.document
    assert any("Content Security Policy" in line for line in seen.console)


def drawn(payloads: tuple[str, ...]) -> list[str]:
    """Pictures that hold them, and one that is nothing else."""
    root = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">'
    return [payloads[0], *(f"{root}{payload}</svg>" for payload in payloads[1:])]


def test_nothing_in_a_record_is_run(tmp_path: Path) -> None:
    outcomes = tuple(
        case(f"case_{n}", {payload: (1e-6, 1e-6)}, run_record(64, None), payload, drawn=n % 4 == 0)
        for n, payload in enumerate(PAYLOADS)
    )
    assert len(PAYLOADS) >= 30
    studies = (study("gross-sliding", PAYLOADS[0], text=PAYLOADS[1]),)
    pictures = tuple(
        Picture(name=f"p{n}", title=payload, caption=payload, svg=svg)
        for n, (payload, svg) in enumerate(zip(PAYLOADS, drawn(PAYLOADS), strict=True))
    )
    report = report_of(outcomes, studies).model_copy(update={"pictures": pictures})
    for render in (render_page, render_sheets):
        seen = opened(render(report), tmp_path)
        assert f"<title>{RAN}" not in seen.document
        assert seen.console == []
        assert seen.requests == []


def test_a_page_that_runs_or_asks_is_seen_to(tmp_path: Path) -> None:
    """The instruments of this file notice what they are to notice."""
    bad = f"<!DOCTYPE html><title>x</title><script>{ACT};console.error('seen')</script>"
    seen = opened(f"{bad}<img src='http://localhost:9/x.png'>", tmp_path)
    assert f"<title>{RAN}" in seen.document
    assert any("seen" in line for line in seen.console)
    assert any("localhost:9" in url for url in seen.requests)
