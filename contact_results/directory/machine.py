"""Versions of the program and its libraries, and properties of the machine, for `timing.json`."""

import os
import platform
import re
from importlib.metadata import PackageNotFoundError, distribution

LIBRARIES = ("numpy", "scipy", "scikit-fem", "gmsh", "meshio", "h5py", "matplotlib", "pydantic")


def program_version() -> str:
    """Return the installed version of slipstick, or "(not installed)"."""
    return version_of("slipstick") or "(not installed)"


def library_versions() -> dict[str, str | None]:
    """Return the versions of the libraries that affect numbers or files, by library name.

    A library that is not installed has the version None.
    """
    return {name: version_of(name) for name in LIBRARIES}


def machine() -> dict[str, str | int | None]:
    """Return the properties of the machine that affect the run time and round-off, by name."""
    return {
        "system": platform.platform(),
        "processor": _processor_name(),
        "arithmetic": arithmetic(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "threads": os.environ.get("OMP_NUM_THREADS"),
    }


def arithmetic() -> str:
    """Return the names of the BLAS kernels and of the vector instructions in use.

    Both affect round-off.
    """
    import numpy as np
    from threadpoolctl import threadpool_info

    cores = {
        f"{i['internal_api']} {i.get('architecture')}"
        for i in threadpool_info()
        if i["user_api"] == "blas"
    }
    targets = np.lib.introspect.opt_func_info(func_name="^sin$", signature="float64")
    vectors = {one["current"] for kinds in targets.values() for one in kinds.values()}
    return ", ".join((*sorted(cores), *sorted(vectors)))


def version_of(name: str) -> str | None:
    """Return the installed version of a Python distribution; None if it is not installed.

    Parsing the whole metadata would take ten times as long as reading this line.
    """
    try:
        found = re.search(r"(?m)^Version: (.*)$", distribution(name).read_text("METADATA") or "")
    except PackageNotFoundError:
        return None
    return found and found[1]


def _processor_name() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            names = [line.partition(":")[2].strip() for line in lines if "model name" in line]
    except OSError:
        names = []
    return names[0] if names else platform.processor()
