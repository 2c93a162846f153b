"""What every process that runs tests begins with: Ctrl-C acts, and tests say which programs they need.

A test marked ``needs("gfortran")`` is skipped where that program is missing, and counted in one line at the end. With
CI in the environment it fails there, unless it is one of those that CI does not have, and no other test may be
skipped. Tests marked `repeated` run with SYMBODY_FUZZ=all in the environment, and are left out elsewhere, in CI too.
"""

from __future__ import annotations

import gc
import os
import shutil
import signal
from collections import Counter
from collections.abc import Generator
from tempfile import TemporaryDirectory

import pytest

from scripts.tools import TOOLS, is_at_hand
from symbody.codegen.llvm import jit
from symbody.codegen.llvm.assembly import Assembly

NOT_INSTALLED = {"julia", "omc", "pdflatex"}
"""Programs that CI does not have: no package offers them, or, as for LaTeX, it fills half a gigabyte."""

MISSING = "missing programs"
"""The property of a skipped test that lists what it misses."""


def pytest_configure(config: pytest.Config) -> None:
    """Let Ctrl-C act, which some tests press: shells start what runs in the background with it ignored.

    All processes of one run share a new cache, and nothing is left in the user's folder. JAX compiles what runs once
    without its optimisation, which takes longer than what it saves.
    """
    if "PYTEST_XDIST_WORKER" not in os.environ:
        kept = TemporaryDirectory(prefix="symbody-tests-")
        config.add_cleanup(kept.cleanup)
        os.environ["SYMBODY_CACHE"] = kept.name
    os.environ.setdefault("JAX_DISABLE_MOST_OPTIMIZATIONS", "1")
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Make a million objects that stay, without looking for garbage among them, now or in any test."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the tests marked `repeated`, unless all are wanted: pytest counts them as deselected."""
    wanted = os.environ.get("SYMBODY_FUZZ", "")
    if wanted not in ("", "all"):
        raise pytest.UsageError(f"SYMBODY_FUZZ is {wanted!r}; expected 'all', or no such variable")
    if wanted == "all":
        return
    left_out = [item for item in items if item.get_closest_marker("repeated")]
    config.hook.pytest_deselected(items=left_out)
    items[:] = [item for item in items if item not in set(left_out)]


@pytest.fixture
def compiled_functions(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the functions that are compiled from now on."""
    names: list[str] = []
    compile_now = jit.compile_assembly

    def counted(assembly: Assembly, name: str) -> jit.Compiled:
        names.append(name)
        return compile_now(assembly, name)

    monkeypatch.setattr(jit, "compile_assembly", counted)
    return names


def is_missing(program: str) -> bool:
    """Whether the machine lacks a program; one that the table of tools lists may have several names."""
    listed = [tool for tool in TOOLS if program in (tool.name, *tool.commands)]
    return not any(map(is_at_hand, listed)) and shutil.which(program) is None


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip a test whose programs are missing; in CI, fail where a package has them."""
    missing = sorted({name for mark in item.iter_markers("needs") for name in mark.args if is_missing(name)})
    if not missing:
        return
    if "CI" in os.environ and not NOT_INSTALLED.issuperset(missing):
        pytest.fail(f"missing: {', '.join(missing)}; scripts/tools.py installs what CI needs", pytrace=False)
    item.user_properties.append((MISSING, " ".join(missing)))
    pytest.skip(f"not found: {', '.join(missing)}")


def unexcused(reporter: pytest.TerminalReporter) -> list[str]:
    """Return what was skipped for another reason than a missing program, where nothing else may be."""
    skipped = reporter.stats.get("skipped", []) if "CI" in os.environ else []
    return [
        report.nodeid for report in skipped if MISSING not in dict(getattr(report, "user_properties", ()))
    ]


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Let a run in CI fail that skipped more than it may."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if reporter and session.exitstatus == pytest.ExitCode.OK and unexcused(reporter):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


@pytest.hookimpl(trylast=True)
def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Count the tests that were skipped because programs are missing, in one line."""
    skipped = terminalreporter.stats.get("skipped", [])
    properties = [dict(getattr(report, "user_properties", ())) for report in skipped]
    wanted = [found[MISSING].split() for found in properties if MISSING in found]
    if wanted:
        counts = sorted(Counter(name for names in wanted for name in names).items())
        listed = ", ".join(f"{name} ({count})" for name, count in counts)
        tests = "1 test" if len(wanted) == 1 else f"{len(wanted)} tests"
        packages = "`python -m symbody doctor` says how to get them, where that is possible"
        terminalreporter.write_line(f"{tests} skipped, programs not found: {listed}; {packages}")
    for test in unexcused(terminalreporter):
        terminalreporter.write_line(f"skipped, which CI does not allow: {test}")
