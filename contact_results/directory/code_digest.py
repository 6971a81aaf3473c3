"""Which code computes a number: equal digests mean equal sources and equal numerical libraries."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from contact_results.directory.machine import version_of

SOLVERS = ("contact_scene", "semi_analytical", "fem_reference", "radial")
PACKAGES = (*SOLVERS, "contact_results", "contact_errors", "verification")
LIBRARIES = ("numpy", "scipy", "scikit-fem", "pydantic")


@cache
def code_digest(packages: tuple[str, ...] = PACKAGES) -> bytes:
    """Of the sources of these packages as they are now, the references that cases are judged by,
    and the libraries. Recorded baselines judge no case and do not count."""
    digest = hashlib.sha256(platform.python_version().encode())
    for library in LIBRARIES:
        digest.update(f"{library} {version_of(library)}\n".encode())
    for package in packages:
        spec = find_spec(package)
        assert spec is not None
        assert spec.origin is not None
        root = Path(spec.origin).parent
        sources = [*root.rglob("*.py"), *root.glob("references/*.json")]
        for source in sorted(sources):
            content = hashlib.sha256(source.read_bytes()).digest()
            digest.update(f"{package}/{source.relative_to(root)}\n".encode() + content)
    return digest.digest()


def solve_identity(*asked: object) -> str:
    """Digest of what a solver is asked for, by what it says of itself, and of the solvers."""
    return hashlib.sha256(repr(asked).encode() + code_digest(SOLVERS)).hexdigest()
