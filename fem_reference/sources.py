"""Which code computes a compliance: what other sources have stored is not theirs."""

import hashlib
from functools import cache
from pathlib import Path

import numpy as np
import scipy
import skfem

PACKAGE = Path(__file__).resolve().parent
# All that decides the bits of a compliance, from the mesh to the condensed matrix.
MODULES = (
    "assembly",
    "compliance",
    "elasticity",
    "elimination_order",
    "factored_section",
    "far_field",
    "motion",
    "numbering",
    "section_mesh",
    "section_outline",
)


@cache
def sources_digest(package: Path = PACKAGE) -> str:
    """Of the sources of MODULES as they are now, and of the libraries.

    package  the folder that holds them
    """
    libraries = (np.__version__, scipy.__version__, skfem.__version__)
    digest = hashlib.sha256(repr(libraries).encode())
    for module in MODULES:
        content = (package / f"{module}.py").read_bytes()
        digest.update(f"{module} {hashlib.sha256(content).hexdigest()}\n".encode())
    return digest.hexdigest()
