"""Which code computes influence coefficients: what other sources have stored is not theirs."""

from functools import cache
from hashlib import sha256
from pathlib import Path

import numpy as np
import scipy

PACKAGE = Path(__file__).resolve().parents[1]
# All that decides the bits of a coefficient, from the point response to its integral over a cell.
FOLDERS = ("frf", "influence")


@cache
def sources_digest(package: Path = PACKAGE) -> str:
    """Of the sources of FRF and influence coefficients as they are now, and of the libraries.

    package  the folder that holds FOLDERS
    """
    digest = sha256(f"numpy {np.__version__}, scipy {scipy.__version__}\n".encode())
    for folder in FOLDERS:
        for source in sorted((package / folder).rglob("*.py")):
            content = sha256(source.read_bytes()).hexdigest()
            digest.update(f"{source.relative_to(package).as_posix()} {content}\n".encode())
    return digest.hexdigest()
