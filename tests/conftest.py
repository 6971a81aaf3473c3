"""Fixtures and hooks of all tests: Hypothesis profiles, seeded generator, and no skipped tests in
CI."""

import gc
import os
import struct

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

# Elasticity on a grid takes its time; a deadline per example would only measure the machine.
settings.register_profile("dev", max_examples=15, deadline=None)
settings.register_profile(
    "ci",
    max_examples=15,  # every night draws a hundred times as many
    deadline=None,
    derandomize=True,  # a submission is judged by its change, not by its luck
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile(
    "nightly",
    max_examples=2000,
    deadline=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile(
    os.environ.get("HYPOTHESIS_PROFILE") or ("ci" if os.environ.get("CI") == "true" else "dev")
)

# Files of more than ten CPU seconds begin first: who came last to one would let the others wait.
LONGEST = (
    "test_code_quality",
    "test_transcripts",
    "test_shipped_scenes",
    "test_examples",
    "test_judge_a_function",
    "test_against",
    "test_declared_cases",
    "test_seeded_defects",
    "test_stated_errors",
    "test_line_contact",
    "test_stress_errors",
    "test_hard_contacts",
    "test_cli_run",
    "test_verification_command",
    "test_friction_in_solvers",
    "test_memory_estimate",
    "test_checkpoint",
    "test_accuracy",
    "test_convergence_studies",
)


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Nothing that is imported goes again, and nobody need look through it for garbage."""
    gc.disable()
    found = yield
    gc.enable()
    gc.freeze()
    gc.set_threshold(20_000)  # of 700 objects it is a twentieth of the time of all tests
    return found


def pytest_collection_modifyitems(items):
    place = {name: number for number, name in enumerate(LONGEST)}
    items.sort(key=lambda item: place.get(item.path.stem, len(LONGEST)))


@pytest.fixture
def rng():
    """Random numbers that are the same in every run."""
    return np.random.default_rng(20)


def leave_figures_undrawn(patch: pytest.MonkeyPatch) -> None:
    """The figures of a run are called for and their files made, without the half second that each
    takes to draw: for tests of something else."""
    three_panels_wide = bytes(16) + struct.pack(">I", 1040)
    patch.setattr(
        "contact_results.figures.figure_files.save",
        lambda figure, path, dots: path.write_bytes(three_panels_wide),
    )


@pytest.fixture
def undrawn(monkeypatch):
    leave_figures_undrawn(monkeypatch)


@pytest.fixture(scope="module")
def one_process():
    """Cases of a sweep or verification are computed in the process of the test: for tests of
    something else than workers."""
    from verification.running.case_pool import ThisProcess

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            "verification.running.case_pool.LocalWorkers", lambda processes: ThisProcess()
        )
        yield


def _forbid_skip(report: pytest.TestReport | pytest.CollectReport) -> None:
    """Turn a skip into a failure when SLIPSTICK_NO_SKIP=1: there, every package is installed."""
    expected_failure = hasattr(report, "wasxfail")
    if os.environ.get("SLIPSTICK_NO_SKIP") == "1" and report.skipped and not expected_failure:
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else report.longrepr
        report.outcome = "failed"
        report.longrepr = f"skipped although SLIPSTICK_NO_SKIP=1: {reason}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport():
    report = yield
    _forbid_skip(report)
    return report


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report():
    report = yield
    _forbid_skip(report)
    return report


@pytest.fixture(autouse=True, scope="session")
def own_cache(tmp_path_factory):
    """Neither read nor fill the cache of whoever runs the tests; subprocesses inherit this.

    The workers of one run share it.
    """
    own = tmp_path_factory.getbasetemp()
    shared = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    os.environ["SLIPSTICK_CACHE_DIR"] = str(shared / "cache")
