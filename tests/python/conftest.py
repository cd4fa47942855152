"""Hypothesis profiles: `ci` is fixed and short, `HYPOTHESIS_PROFILE=long` is neither.

What needs a package besides pytest, Hypothesis and NumPy is in `extras/` or marked `extra`; what
needs one of `make test-recipes` or takes minutes is marked `recipes` or `evidence`.
"""

import os
from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("ci", derandomize=True, database=None, deadline=None, max_examples=300)
settings.register_profile("long", deadline=None, max_examples=5_000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))

EXTRAS = Path(__file__).parent / "extras"


def pytest_addoption(parser):
    parser.addoption("--no-skips", action="store_true", help="a skipped test is a failure")


def pytest_ignore_collect(collection_path, config):
    """Files in `extras/` import what may be missing."""
    is_left_out = collection_path.parent == EXTRAS and "not extra" in config.option.markexpr
    return True if is_left_out else None


def pytest_collection_modifyitems(items):
    for item in items:
        if item.path.parent == EXTRAS and not item.get_closest_marker("evidence"):
            item.add_marker("extra")


def pytest_terminal_summary(terminalreporter, config):
    if "not extra" in config.option.markexpr:
        count = sum(file.read_text().count("\ndef test_") for file in EXTRAS.glob("test_*.py"))
        marked = (file.read_text() for file in EXTRAS.parent.glob("test_*.py"))
        count += sum(text.count("\n@pytest.mark.extra\n") for text in marked)
        terminalreporter.line(f"{count} tests need further packages: make test-oracles")


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session):
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if session.config.option.no_skips and reporter and reporter.stats.get("skipped"):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
