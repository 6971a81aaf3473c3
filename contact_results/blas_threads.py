"""Number of threads of the BLAS library: 1, unless the environment sets another number."""

import os

ONE = "1"
VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def one_thread(*, always: bool = False) -> None:
    """Set the environment variables that limit BLAS and OpenMP to one thread per process.

    Call this function before the numerical libraries are imported. With one thread, every run on
    one processor gives equal bits; OPENBLAS_CORETYPE selects the instructions across processors.
    The dense systems of contact are small, and waiting threads would make them ten times slower.

    always  replace values that the environment already has
    """
    for name in VARIABLES:
        if always or name not in os.environ:
            os.environ[name] = ONE


def is_one_thread() -> bool:
    """Return True if every environment variable of `VARIABLES` sets the limit of one thread."""
    return all(os.environ.get(name) == ONE for name in VARIABLES)
