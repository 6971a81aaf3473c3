"""A code in a Python of its own: asked through its driver, answered in numbers."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from contact_results.blas_threads import VARIABLES
from verification.challenge.python_api import CannotDo
from verification.peers.environment import Peer

SECONDS_ALLOWED = 240
SOURCES = Path(__file__).parents[2]


def driven(python: Path, peer: Peer, request: Mapping[str, Any]) -> dict[str, Any]:
    """What the driver found, on one thread; raises CannotDo as it says so, RuntimeError with its
    last words."""
    done = subprocess.run(
        [str(python), "-m", peer.driver], input=json.dumps(request), capture_output=True,
        text=True, check=False, timeout=SECONDS_ALLOWED,
        env={**os.environ, **dict.fromkeys(VARIABLES, "1"), "PYTHONPATH": str(SOURCES)},
    )  # fmt: skip
    if done.returncode:
        raise RuntimeError(f"{peer.module}: {done.stderr.strip().splitlines()[-1:]}")
    found: dict[str, Any] = json.loads(done.stdout)
    if "cannot" in found:
        raise CannotDo(found["cannot"])
    return found
