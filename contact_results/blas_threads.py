"""One thread for linear algebra, unless the environment says otherwise."""

import os

ONE = "1"
VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def one_thread(*, always: bool = False) -> None:
    """Give each process one thread; to be called before the numerical libraries are loaded.

    The same bits from run to run: two threads add in another order. (On another kind of processor
    they differ by rounding all the same, unless OPENBLAS_CORETYPE says whose instructions to use.)
    And the dense systems of contact are small: threads that wait for a busy core by spinning make
    them ten times slower.

    always  whatever the environment says
    """
    for name in VARIABLES:
        if always or name not in os.environ:
            os.environ[name] = ONE


def is_one_thread() -> bool:
    """Whether the environment says so."""
    return all(os.environ.get(name) == ONE for name in VARIABLES)
