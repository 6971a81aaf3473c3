"""Which code computes a compliance: what other sources have stored is not theirs."""

import hashlib
from functools import cache
from pathlib import Path

import numpy as np
import scipy
import skfem

PACKAGE = Path(__file__).resolve().parents[1]
# All that decides the bits of a compliance, from the mesh to the condensed matrix.
FOLDERS = ("mesh", "elasticity")


@cache
def sources_digest(package: Path = PACKAGE) -> str:
    """Of the sources of mesh and compliance as they are now, and of the libraries.

    package  the folder that holds FOLDERS
    """
    libraries = (np.__version__, scipy.__version__, skfem.__version__)
    digest = hashlib.sha256(repr(libraries).encode())
    for folder in FOLDERS:
        for source in sorted((package / folder).rglob("*.py")):
            content = hashlib.sha256(source.read_bytes()).hexdigest()
            digest.update(f"{source.relative_to(package).as_posix()} {content}\n".encode())
    return digest.hexdigest()
