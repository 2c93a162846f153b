"""Make the virtual environment of the project, on a machine that has Python and nothing else.

Usage: sh scripts/python.sh scripts/environment.py .venv

Debian splits ``ensurepip`` off Python into the package python3-venv, so ``python3 -m venv`` may fail on a
fresh machine. The ways to put pip into the environment are tried in turn; the last is pip's own installer.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import urllib.request
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

PYTHON_NEEDED = (3, 11)
PIP_NEEDED = "pip>=25.1"  # the first that installs dependency groups
PIP_INSTALLER = "https://bootstrap.pypa.io/get-pip.py"


class SetupError(Exception):
    """What is missing, and the way out."""


def run(*command: str | Path, **options: object) -> None:
    """Run a command and raise where it fails."""
    subprocess.run([str(part) for part in command], check=True, **options)  # type: ignore[call-overload]


def check_python() -> None:
    """Raise where this Python is too old."""
    if sys.version_info < PYTHON_NEEDED:
        found, needed = (".".join(map(str, version[:3])) for version in (sys.version_info, PYTHON_NEEDED))
        raise SetupError(
            f"Python {needed} or newer is needed, found {found} at {sys.executable}.\n"
            f"Name another one: make PYTHON=python{needed} demo"
        )


def with_ensurepip(folder: Path) -> None:
    """Make the environment as Python intends."""
    if find_spec("ensurepip") is None:
        raise SetupError("this Python has no ensurepip")
    run(sys.executable, "-m", "venv", "--clear", folder)


def with_system_pip(folder: Path) -> None:
    """Make the environment with the pip of the system (Debian's python3-pip)."""
    if find_spec("pip") is None:
        raise SetupError("this Python has no pip")
    run(sys.executable, "-m", "venv", "--clear", "--without-pip", folder)
    run(sys.executable, "-m", "pip", "--quiet", "--python", folder, "install", "pip")


def with_pip_installer(folder: Path) -> None:
    """Make the environment with pip's own installer."""
    run(sys.executable, "-m", "venv", "--clear", "--without-pip", folder)
    with urllib.request.urlopen(PIP_INSTALLER, timeout=60) as answer:
        run(folder / "bin" / "python", "-", "--quiet", input=answer.read())


WAYS: tuple[Callable[[Path], None], ...] = (with_ensurepip, with_system_pip, with_pip_installer)


def make_environment(folder: Path) -> None:
    """Make the environment in the first way that works and bring its pip up to date."""
    failures = []
    for way in WAYS:
        try:
            way(folder)
            run(folder / "bin" / "python", "-m", "pip", "--quiet", "install", "--upgrade", PIP_NEEDED)
        except (SetupError, OSError, subprocess.CalledProcessError) as failure:
            failures.append(f"  {way.__name__}: {failure}")
        else:
            return
    shutil.rmtree(folder, ignore_errors=True)
    raise SetupError(
        f"A virtual environment could not be made in {folder}:\n"
        + "\n".join(failures)
        + "\nOn Debian and Ubuntu: sudo apt-get install python3-venv, then again."
    )


def main() -> None:
    """Check Python and make the environment, or say what is missing."""
    parser = argparse.ArgumentParser(description="Make the virtual environment of the project.")
    parser.add_argument("folder", type=Path, help="where it is made; what is there is removed")
    folder = parser.parse_args().folder
    try:
        check_python()
        make_environment(folder)
    except SetupError as error:
        sys.exit(f"\n{error}\n")


if __name__ == "__main__":
    main()
