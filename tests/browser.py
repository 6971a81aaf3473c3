"""Helper of tests that opens HTML pages in Chromium and returns errors, executed scripts and
requests."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-extensions",
    "--enable-logging=stderr",
    "--v=0",
    "--virtual-time-budget=2000",
    "--host-resolver-rules=MAP * ~NOTFOUND",  # whatever is asked for stays here
)
SECONDS = 600
RAN = "it-ran"
# Each would set the title of the page, and so show that it ran.
ACT = f"document.title='{RAN}'"
PAYLOADS = (
    f"<script>{ACT}</script>",
    f"</script><script>{ACT}</script>",
    f"<SCRIPT>{ACT}</SCRIPT>",
    f"<script src=data:,{ACT}></script>",
    f"</title><script>{ACT}</script>",
    f"</style><script>{ACT}</script>",
    f"</desc></svg><script>{ACT}</script>",
    f"--><script>{ACT}</script>",
    f"]]><script>{ACT}</script>",
    f"<img src=x onerror={ACT}>",
    f'"><img src=x onerror="{ACT}">',
    f"'><img src=x onerror='{ACT}'>",
    f"<svg onload={ACT}>",
    f"<svg><script>{ACT}</script></svg>",
    f"<svg><set attributeName=onload to={ACT}>",
    f"<body onload={ACT}>",
    f"<iframe srcdoc='<script>parent.{ACT}</script>'></iframe>",
    f'<iframe src="javascript:parent.{ACT}"></iframe>',
    f'<object data="javascript:{ACT}">',
    f'<embed src="javascript:{ACT}">',
    f'<a href="javascript:{ACT}">x</a>',
    f'<math><a xlink:href="javascript:{ACT}">x</a></math>',
    f"<details open ontoggle={ACT}>",
    f"<input autofocus onfocus={ACT}>",
    f"<video><source onerror={ACT}></video>",
    f"<audio src=x onerror={ACT}>",
    f"<marquee onstart={ACT}>",
    f"<style>@import '{ACT}'</style>",
    "<style>*{background:url(http://example.invalid/x)}</style>",
    "<link rel=stylesheet href=http://example.invalid/x.css>",
    "<meta http-equiv=refresh content='0;url=http://example.invalid/'>",
    "<base href=http://example.invalid/>",
    "<form action=http://example.invalid/><input></form>",
    "<img src=http://example.invalid/x.png>",
    f"{{{{ cycler.__init__ }}}}{{% set x %}}{ACT}",
    f'" onmouseover="{ACT}" x="',
    f"' onfocus='{ACT}' autofocus x='",
    f"&lt;script&gt;{ACT}",
    f"\u2028<script>{ACT}</script>",
    f"%3Cscript%3E{ACT}%3C/script%3E",
)


def chromium() -> str | None:
    """The browser of this machine."""
    return next(filter(None, map(shutil.which, NAMES)), None)


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


def opened(page: str, folder: Path) -> Opened:
    """Open a page and look; FileNotFoundError without a browser."""
    file, log = folder / "page.html", folder / "net.json"
    file.write_text(page, encoding="utf-8")
    done = subprocess.run(
        [
            chromium() or NAMES[0],
            *FLAGS,
            f"--user-data-dir={folder / 'profile'}",
            f"--log-net-log={log}",
            "--dump-dom",
            file.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=SECONDS,
        check=True,
    )
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
