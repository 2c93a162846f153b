"""The report of ``python -m symbody doctor``: what this installation has, what is missing, and how to get it."""

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

__all__ = ["EXTRAS", "Check", "checks", "report"]

EXTRAS = {
    "sympy": "to_sympy and from_sympy",
    "casadi": "runs generated CasADi code",
    "jax": "runs generated JAX code",
    "control": "takes linear models: to_control",
    "dask": "runs simulate_many on the workers of a cluster",
    "cuda": "simulate_many(device='cuda'), on a graphics processor of NVIDIA",
    "study": "files of studies, and quantiles of many cases",
    "sundials": "the methods ida, ida2 and ida3 of simulate",
    "notebook": "Jupyter, which shows expressions, frames and equations as formulas",
}
"""The purpose of each extra; ``all`` is all of them but cuda."""

MODULES = {
    "llvmlite": "llvmlite.binding",
    "matplotlib": "matplotlib.figure",
    "scipy": "scipy.spatial.transform",
    "dask": "dask.distributed",
    "scikit-sundae": "sksundae.ida",
    "cupy-cuda12x": "cupy",
    "nvidia-cuda-nvrtc-cu12": "nvidia.cuda_nvrtc",
    "nvidia-cuda-runtime-cu12": "nvidia.cuda_runtime",
}
"""The module of a package that symbody loads, where it has another name: the part with libraries in it."""

PATIENCE = 20.0
"""The time in which a program must report its version, in s."""


@dataclass(frozen=True)
class Check:
    """The result of one check.

    Attributes:
        group: the heading under which it is listed.
        name: the name of what was checked.
        state: its version, ``ok``, or what is wrong.
        note: its purpose, or how to get it.
        is_fault: whether symbody does not work without it.
    """

    group: str
    name: str
    state: str
    note: str = ""
    is_fault: bool = False

    def __str__(self) -> str:
        return f"  {self.name:<14} {self.state:<12} {self.note}".rstrip()


def checks() -> list[Check]:
    """Check packages, extras and programs, and try expressions and machine code."""
    return [*_packages(), *_extras(), *_programs(), *_trials()]


def report(found: Iterable[Check]) -> str:
    """Return the results of checks, group by group, with a conclusion."""
    listed = list(found)
    machine = f"Python {platform.python_version()}, {platform.system()} {platform.machine()}"
    lines = [f"symbody {metadata.version('symbody')}, {machine}"]
    for group in dict.fromkeys(one.group for one in listed):
        lines += ["", group, *(str(one) for one in listed if one.group == group)]
    faults = ", ".join(one.name for one in listed if one.is_fault)
    conclusion = f"symbody can't work as it is: look at {faults}" if faults else "symbody has what it needs"
    return "\n".join([*lines, "", f"{conclusion}."])


def _packages() -> Iterator[Check]:
    for requirement in _requirements(""):
        state, advice = _state(requirement, f'pip install "{_text(requirement)}"')
        yield Check("Packages", requirement.name, state, advice, is_fault=bool(advice))


def _extras() -> Iterator[Check]:
    for extra, purpose in EXTRAS.items():
        for requirement in _requirements(extra):
            state, advice = _state(requirement, f'pip install "symbody[{extra}]"')
            yield Check("Extras", requirement.name, state, f"{purpose}: {advice}" if advice else purpose)


def _programs() -> Iterator[Check]:
    group = "Programs that compile and check generated code"
    for name, description in TOOLS.items():
        what, _, way_out = description.partition("; ")
        if shutil.which(name):
            yield Check(group, name, _program_version(name), what)
        else:
            yield Check(group, name, "missing", f"{what}: {way_out}")


def _trials() -> Iterator[Check]:
    x = symbols("x")
    is_right = sin(x) ** 2 + cos(x) ** 2 == 1
    yield Check("Trials", "expressions", "ok" if is_right else "wrong", is_fault=not is_right)
    try:
        is_right = abs(float(lambdify([x], sin(x), compile=True)(0.5)) - 0.479425538604203) < 1e-15
        yield Check("Trials", "machine code", "ok" if is_right else "wrong", is_fault=not is_right)
    except Exception as error:  # whatever it is, it is reported
        note = brief(f"{type(error).__name__}: {error}")
        yield Check("Trials", "machine code", "fails", note, is_fault=True)


def _requirements(extra: str) -> Iterator[Requirement]:
    """Yield the requirements of the package, or those that an extra adds."""
    for text in metadata.requires("symbody") or ():
        requirement = Requirement(text)
        by_extra = requirement.marker is not None and not requirement.marker.evaluate({"extra": ""})
        if by_extra == bool(extra) and (
            requirement.marker is None or requirement.marker.evaluate({"extra": extra})
        ):
            yield requirement


def _state(requirement: Requirement, way: str) -> tuple[str, str]:
    """Return the version of a package, or what is wrong with it, and what to do about that.

    Args:
        requirement: the package.
        way: how to get the package, or a newer version.
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
    """Return why a package can't be loaded; the empty text if it can."""
    try:
        import_module(MODULES.get(requirement.name, requirement.name))
    except Exception as error:  # whatever it is, it is reported
        return brief(f"{type(error).__name__}: {error}")
    return ""


def _text(requirement: Requirement) -> str:
    return f"{requirement.name}{requirement.specifier}"


def _program_version(name: str) -> str:
    """Return the version that a program reports, or ``fails`` if it reports none."""
    try:
        done = subprocess.run(
            [name, "--version"], capture_output=True, text=True, check=False, timeout=PATIENCE
        )
    except (OSError, subprocess.TimeoutExpired):
        return "fails"
    found = re.search(r"\d+(\.\d+)+", done.stdout)
    return found[0] if found and not done.returncode else "fails"
