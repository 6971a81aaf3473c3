"""Digest of the source code and of the numerical libraries, for cache keys and identities."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from contact_results.directory.machine import version_of

SOLVERS = ("contact_scene", "contact_solver", "semi_analytical", "fem_reference", "radial")
PACKAGES = (*SOLVERS, "contact_results", "contact_errors", "verification")
LIBRARIES = ("numpy", "scipy", "scikit-fem", "pydantic")


@cache
def code_digest(packages: tuple[str, ...] = PACKAGES) -> bytes:
    """Compute the SHA-256 of the sources of packages, their reference values, and library versions.

    Baselines of the regression tests are excluded, because they do not change a verdict.

    packages  names of importable packages
    """
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
    """Compute a digest that identifies a solve by its input and by the sources of the solvers.

    A checkpoint is read only by a solve with the digest under which the checkpoint was stored.

    asked  objects that define the input, compared by their `repr`
    """
    return hashlib.sha256(repr(asked).encode() + code_digest(SOLVERS)).hexdigest()
