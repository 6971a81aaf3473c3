"""Which program, on which machine: facts that must not enter the summary."""

import os
import platform
from importlib.metadata import PackageNotFoundError, version

LIBRARIES = ("numpy", "scipy", "scikit-fem", "gmsh", "meshio", "h5py", "matplotlib", "pydantic")


def program_version() -> str:
    """The installed version, or what says that there is none."""
    return version_of("slipstick") or "(not installed)"


def library_versions() -> dict[str, str | None]:
    """Versions of the libraries that numbers or files may depend on."""
    return {name: version_of(name) for name in LIBRARIES}


def machine() -> dict[str, str | int | None]:
    """The machine as far as it explains a time."""
    return {
        "system": platform.platform(),
        "processor": _processor_name(),
        "arithmetic": arithmetic(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "threads": os.environ.get("OMP_NUM_THREADS"),
    }


def arithmetic() -> str:
    """What decides last digits, whatever a processor is called: the core that linear algebra is
    compiled for, and the vector instructions of elementary functions."""
    import numpy as np
    from threadpoolctl import threadpool_info

    cores = {f"{i['internal_api']} {i.get('architecture')}" for i in threadpool_info()
             if i["user_api"] == "blas"}  # fmt: skip
    targets = np.lib.introspect.opt_func_info(func_name="^sin$", signature="float64")
    vectors = {one["current"] for kinds in targets.values() for one in kinds.values()}
    return ", ".join((*sorted(cores), *sorted(vectors)))


def version_of(distribution: str) -> str | None:
    """The installed version of a distribution; None where it is not installed."""
    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


def _processor_name() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            names = [line.partition(":")[2].strip() for line in lines if "model name" in line]
    except OSError:
        names = []
    return names[0] if names else platform.processor()
