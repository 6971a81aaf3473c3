"""Virtual environment of the other contact codes, with pinned versions, which is created once.

A code whose installation fails is left out with the reason.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from contact_results.directory.atomic_file import atomic_file

FOLDER = "peers"
# Why peers could not be installed: a build that waits for what it may not download would take
# minutes of every run.
FAILED = "failed.json"
SECONDS_TO_INSTALL = 180
EIGEN = Path("/usr/include/eigen3")  # of the package libeigen3-dev: else the build downloads it


@dataclass(frozen=True)
class Peer:
    """Another contact code that solves the challenges, with the data of its installation.

    distribution  name and version of the package that is installed
    module        module that is imported, and name of its driver
    friction      True if problems with friction are requested from the code
    settings      environment variables for the build
    """

    distribution: str
    module: str
    friction: bool = False
    settings: tuple[tuple[str, str], ...] = ()


PEERS = (
    Peer(
        "aspher==0.1.3.post1", "aspher", friction=True,
        settings=(("CMAKE_ARGS", f"-DFETCHCONTENT_SOURCE_DIR_EIGEN3_SRC={EIGEN}"),),
    ),
    Peer("tamaas==2.9.0", "tamaas"),
    Peer("ContactMechanics==1.8.3", "ContactMechanics"),
)  # fmt: skip

Run = Callable[..., "subprocess.CompletedProcess[str]"]


@dataclass(frozen=True)
class Installed:
    """Python environment in which the other contact codes are installed.

    python   path of the Python interpreter
    missing  reasons for codes that could not be installed, by distribution
    """

    python: Path
    missing: dict[str, str]


def peers_directory() -> Path:
    """Return the directory of the Python environment in which the other contact codes are
    installed.

    The directory is in SLIPSTICK_CACHE_DIR, or in `slipstick` in the user's cache directory.
    """
    place = os.environ.get("SLIPSTICK_CACHE_DIR")
    if place:
        return Path(place) / FOLDER
    user = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(user) / "slipstick" / FOLDER


def made_environment(directory: Path, run: Run = subprocess.run) -> Installed:
    """Create or complete the Python environment of the other contact codes, and return it.

    A failed installation is not repeated until the file `failed.json` in the directory is removed.

    directory  directory of the environment
    run        replacement of `subprocess.run`, for tests
    """
    python = directory / "bin" / "python"
    if not python.exists():
        run([sys.executable, "-m", "venv", str(directory)], check=True)
    failed = directory / FAILED
    known = json.loads(failed.read_text(encoding="utf-8")) if failed.exists() else {}
    missing = {}
    for peer in PEERS:
        reason = _install_peer(python, peer, run, known.get(peer.distribution, ""))
        if reason:
            missing[peer.distribution] = reason
    if missing != known:
        with atomic_file(failed) as unfinished:
            text = json.dumps(missing, indent=1, ensure_ascii=False)
            unfinished.write_text(text, encoding="utf-8")
    return Installed(python, missing)


def _install_peer(python: Path, peer: Peer, run: Run, failed: str) -> str:
    """Install another contact code unless it is present or its installation has failed before.

    Returns the reason of a failure; empty if the code is installed.

    python  interpreter of the environment
    run     replacement of `subprocess.run`, for tests
    failed  reason of an earlier failure; empty if there was none
    """
    probe = [str(python), "-c", f"import {peer.module}"]
    if run(probe, capture_output=True, text=True, check=False).returncode == 0:
        return ""
    if failed:
        return failed
    settings = {name: value for name, value in peer.settings if EIGEN.exists()}
    install = [str(python), "-m", "pip", "install", "--quiet", peer.distribution]
    try:
        done = run(
            install, capture_output=True, text=True, check=False,
            env={**os.environ, **settings}, timeout=SECONDS_TO_INSTALL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return f"not installed within {SECONDS_TO_INSTALL} s"
    if done.returncode == 0:
        done = run(probe, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return ""
    lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
    return lines[-1] if lines else f"exit code {done.returncode}"
