"""What this installation has, what is missing, and how to get it: the report of ``python -m symbody doctor``."""

from __future__ import annotations

import platform
import re
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib import import_module, metadata

from packaging.requirements import Requirement

from symbody.codegen import lambdify
from symbody.codegen.sources.toolchain import TOOLS
from symbody.symbolic import cos, sin, symbols
from symbody.symbolic.given.arguments import brief

__all__ = ["EXTRAS", "Finding", "findings", "report"]

EXTRAS = {
    "sympy": "to_sympy and from_sympy",
    "casadi": "runs generated CasADi code",
    "jax": "runs generated JAX code",
    "dask": "runs simulate_many on the workers of a cluster",
    "sundials": "the methods ida, ida2 and ida3 of simulate",
    "notebook": "Jupyter, which shows expressions, frames and equations as formulas",
}
"""What each extra is for; ``all`` is all of them."""

MODULES = {
    "llvmlite": "llvmlite.binding",
    "matplotlib": "matplotlib.figure",
    "scipy": "scipy.spatial.transform",
    "dask": "dask.distributed",
    "scikit-sundae": "sksundae.ida",
}
"""What symbody loads of packages, where that isn't the module of their name: the parts with libraries in them."""

PATIENCE = 20.0
"""s that a program may take to report its version."""


@dataclass(frozen=True)
class Finding:
    """One thing that was looked for.

    Attributes:
        group: the heading that it is listed under.
        name: what was looked for.
        state: its version, ``ok``, or what is wrong.
        note: what it is for, or how to get it.
        is_fault: whether symbody doesn't work without it.
    """

    group: str
    name: str
    state: str
    note: str = ""
    is_fault: bool = False

    def __str__(self) -> str:
        return f"  {self.name:<14} {self.state:<12} {self.note}".rstrip()


def findings() -> list[Finding]:
    """Look for packages, extras and programs, and try expressions and machine code."""
    return [*_packages(), *_extras(), *_programs(), *_trials()]


def report(found: Iterable[Finding]) -> str:
    """Return what was found, group by group, with a conclusion."""
    listed = list(found)
    machine = f"Python {platform.python_version()}, {platform.system()} {platform.machine()}"
    lines = [f"symbody {metadata.version('symbody')}, {machine}"]
    for group in dict.fromkeys(one.group for one in listed):
        lines += ["", group, *(str(one) for one in listed if one.group == group)]
    faults = ", ".join(one.name for one in listed if one.is_fault)
    conclusion = f"symbody can't work as it is: look at {faults}" if faults else "symbody has what it needs"
    return "\n".join([*lines, "", f"{conclusion}."])


def _packages() -> Iterator[Finding]:
    for requirement in _requirements(""):
        state, advice = _state(requirement, f'pip install "{_text(requirement)}"')
        yield Finding("Packages", requirement.name, state, advice, is_fault=bool(advice))


def _extras() -> Iterator[Finding]:
    for extra, purpose in EXTRAS.items():
        for requirement in _requirements(extra):
            state, advice = _state(requirement, f'pip install "symbody[{extra}]"')
            yield Finding("Extras", requirement.name, state, f"{purpose}: {advice}" if advice else purpose)


def _programs() -> Iterator[Finding]:
    group = "Programs that compile and check generated code"
    for name, description in TOOLS.items():
        what, _, way_out = description.partition("; ")
        if shutil.which(name):
            yield Finding(group, name, _program_version(name), what)
        else:
            yield Finding(group, name, "missing", f"{what}: {way_out}")


def _trials() -> Iterator[Finding]:
    x = symbols("x")
    is_right = sin(x) ** 2 + cos(x) ** 2 == 1
    yield Finding("Trials", "expressions", "ok" if is_right else "wrong", is_fault=not is_right)
    try:
        is_right = abs(float(lambdify([x], sin(x), compile=True)(0.5)) - 0.479425538604203) < 1e-15
        yield Finding("Trials", "machine code", "ok" if is_right else "wrong", is_fault=not is_right)
    except Exception as error:  # whatever it is, it is the finding
        note = brief(f"{type(error).__name__}: {error}")
        yield Finding("Trials", "machine code", "fails", note, is_fault=True)


def _requirements(extra: str) -> Iterator[Requirement]:
    """Return what the package requires, or what one of its extras adds."""
    for text in metadata.requires("symbody") or ():
        requirement = Requirement(text)
        by_extra = requirement.marker is not None and not requirement.marker.evaluate({"extra": ""})
        if by_extra == bool(extra) and (
            requirement.marker is None or requirement.marker.evaluate({"extra": extra})
        ):
            yield requirement


def _state(requirement: Requirement, way: str) -> tuple[str, str]:
    """Return the version of a package or what is wrong with it, and what to do about that.

    Args:
        requirement: the package.
        way: how to get it, or a newer one.
    """
    try:
        version = metadata.version(requirement.name)
    except metadata.PackageNotFoundError:
        return "missing", way
    if not requirement.specifier.contains(version, prereleases=True):
        return f"{version}, too old", way
    failure = _failure(requirement)
    return (
        ("fails", f'{failure}; pip install --force-reinstall "{_text(requirement)}"')
        if failure
        else (version, "")
    )


def _failure(requirement: Requirement) -> str:
    """Return what goes wrong where a package is loaded; nothing if it can be."""
    try:
        import_module(MODULES.get(requirement.name, requirement.name))
    except Exception as error:  # whatever it is, it is the finding
        return brief(f"{type(error).__name__}: {error}")
    return ""


def _text(requirement: Requirement) -> str:
    return f"{requirement.name}{requirement.specifier}"


def _program_version(name: str) -> str:
    """Return the version that a program reports, or that it reports none."""
    try:
        done = subprocess.run(
            [name, "--version"], capture_output=True, text=True, check=False, timeout=PATIENCE
        )
    except (OSError, subprocess.TimeoutExpired):
        return "fails"
    found = re.search(r"\d+(\.\d+)+", done.stdout)
    return found[0] if found and not done.returncode else "fails"
