"""Install the programs that a target of the Makefile needs and that this machine lacks, where that is allowed.

Usage: sh scripts/python.sh scripts/tools.py [--no-install] build|lint|test

It is allowed to root, and to users who may become root without a password. Elsewhere a program without which nothing
can be built is an error that says how to get it; a program that only lints or tests need is left out, and they are
skipped. With CI in the environment nothing may be left out.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

Version = tuple[int, int]

LAST_LINES = 10
"""What is shown of a command that fails."""

RUST = (1, 89)  # as `rust-version` in Cargo.toml


@dataclass(frozen=True, eq=False)
class Tool:
    """A program that is not a package of Python.

    Attributes:
        name: what a person calls it.
        target: the target of the Makefile that needs it.
        purpose: what it does there.
        commands: any of them will do. One word is looked for; several are run, and must succeed.
        packages: by the command of a package manager: what to install, in order of preference.
        oldest: the oldest version of the program that will do.
        oldest_package: the oldest version of a package that will do.
        way_out: how a person gets it; only tools without which the target fails have one.
    """

    name: str
    target: str
    purpose: str
    commands: tuple[str, ...]
    packages: Mapping[str, tuple[str, ...]]
    oldest: Version | None = None
    oldest_package: Version | None = None
    way_out: str = ""


TOOLS = (
    Tool(
        "cc", "build", "links the Rust extension", ("cc",), {"apt-get": ("gcc libc6-dev",)},
        way_out="Install a C compiler, for instance gcc from your system's packages.",
    ),
    Tool(
        "cargo", "build", "builds the Rust extension", ("cargo --version",),
        {"apt-get": ("cargo ca-certificates", "cargo-web ca-certificates")}, RUST, RUST,
        way_out=(
            "Install Rust from https://rustup.rs (no root needed). If rustup is there already: "
            "rustup update stable && rustup default stable"
        ),
    ),
    Tool(
        "ensurepip", "build", "makes virtual environments", (f"{shlex.quote(sys.executable)} -c 'import ensurepip'",),
        {"apt-get": ("python3-venv",)},
    ),
    Tool(
        "rustfmt", "lint", "checks the format of the Rust sources", ("cargo fmt --version",),
        {"rustup": ("rustfmt",), "apt-get": ("rustfmt", "rustfmt-web")}, oldest_package=RUST,
    ),
    Tool(
        "clippy", "lint", "lints the Rust sources", ("cargo clippy --version",),
        {"rustup": ("clippy",), "apt-get": ("rust-clippy", "rust-web-clippy")}, oldest_package=RUST,
    ),
    Tool("g++", "test", "compiles the rivals of the benchmarks", ("g++",), {"apt-get": ("g++",)}),
    Tool("gfortran", "test", "compiles generated Fortran", ("gfortran",), {"apt-get": ("gfortran",)}),
    Tool("octave", "test", "runs generated MATLAB code", ("octave-cli",), {"apt-get": ("octave",)}),
    Tool(
        "chromium", "test", "draws animations", ("chromium", "chromium-browser", "google-chrome"),
        {"apt-get": ("chromium fonts-dejavu-core",)},
    ),
)  # fmt: skip

TARGETS = tuple(dict.fromkeys(tool.target for tool in TOOLS))
"""What programs are needed for: the targets of the Makefile."""


@dataclass(frozen=True)
class Manager:
    """A package manager; `TOOLS` lists its packages by its command.

    Attributes:
        command: what must be there.
        install: installs the packages that follow.
        update: fetches the lists of packages.
        candidate: prints which version of the package that follows would be installed.
        version: finds that version; a package without one is not on offer.
        needs_root: whether only root may install.
    """

    command: str
    install: str
    update: str = ""
    candidate: str = ""
    version: str = ""
    needs_root: bool = True


MANAGERS = (
    Manager("rustup", "rustup component add", needs_root=False),
    Manager(
        "apt-get",
        "env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "
        "-o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300",
        update="apt-get update -qq -o DPkg::Lock::Timeout=300",
        candidate="apt-cache policy",
        version=r"Candidate: (?:\d+:)?(\d+)(?:\.(\d+))?",
    ),
)
"""A tool comes from the first of them that is at hand and has it."""


class SetupError(Exception):
    """What is missing, and the way out."""


# --- what is there ---------------------------------------------------------------------------------------------------


def missing(target: str) -> list[Tool]:
    """Return the tools of a target that this machine lacks."""
    return [tool for tool in TOOLS if tool.target == target and not is_at_hand(tool)]


def is_at_hand(tool: Tool) -> bool:
    """Say whether one of the commands of a tool is there, works and is new enough."""
    return any(works(command, tool.oldest) for command in tool.commands)


def works(command: str, oldest: Version | None = None) -> bool:
    """Say whether a command of one word is there, or one of several words succeeds; and is new enough."""
    if " " not in command:
        return shutil.which(command) is not None
    printed = output(command)
    return printed is not None and (oldest is None or version(printed) >= oldest)


def output(command: str) -> str | None:
    """Return what a command prints, or None if it fails."""
    environment = os.environ | {"LC_ALL": "C"}
    try:
        done = subprocess.run(
            shlex.split(command), capture_output=True, text=True, check=False, env=environment
        )
    except OSError:
        return None
    return None if done.returncode else done.stdout


def version(text: str, pattern: str = r"(\d+)\.(\d+)") -> Version:
    """Return the version that a text holds, and (-1, 0) if it holds none."""
    found = re.search(pattern, text)
    return (int(found[1]), int(found[2] or 0)) if found else (-1, 0)


# --- who may install, and what ---------------------------------------------------------------------------------------


def as_root(manager: Manager) -> str | None:
    """Return what a command of a package manager begins with, or None if we may not install."""
    if not manager.needs_root or os.geteuid() == 0:
        return ""
    return "sudo -n " if works("sudo -n true") else None


def is_on_offer(manager: Manager, package: str, oldest: Version | None) -> bool:
    """Say whether a package manager has all packages of a choice; the first one is asked for its version."""
    if not manager.candidate:
        return True
    first, *others = (output(f"{manager.candidate} {name}") or "" for name in package.split())
    return version(first, manager.version) >= (oldest or (0, 0)) and all(
        version(other, manager.version) >= (0, 0) for other in others
    )


def choice(tool: Tool, manager: Manager) -> str | None:
    """Return the packages that a package manager has for a tool."""
    choices = tool.packages.get(manager.command, ())
    return next((one for one in choices if is_on_offer(manager, one, tool.oldest_package)), None)


def install_with(manager: Manager, tools: Iterable[Tool]) -> None:
    """Install what a package manager has for tools, and say in one line what and why."""
    lacking = [tool for tool in tools if manager.command in tool.packages and not is_at_hand(tool)]
    prefix = as_root(manager) if lacking and shutil.which(manager.command) else None
    if prefix is None:
        return
    if manager.update:
        succeeds(prefix + manager.update)
    chosen = {tool: packages for tool in lacking if (packages := choice(tool, manager))}
    if chosen:
        what = ", ".join(f"{packages} ({tool.purpose})" for tool, packages in chosen.items())
        print(f"Installing with {manager.command}: {what}", flush=True)
        install_all(f"{prefix}{manager.install}", list(chosen.values()))


def install_all(install: str, packages: list[str]) -> None:
    """Install packages at once; if that fails, one by one, so that one doesn't take the others with it."""
    if not succeeds(f"{install} {' '.join(packages)}") and len(packages) > 1:
        for one in packages:
            succeeds(f"{install} {one}")


def succeeds(command: str) -> bool:
    """Run a command, show the end of what it printed if it fails, and say whether it succeeded."""
    done = subprocess.run(
        shlex.split(command),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if done.returncode:
        print("\n".join([f"{command} failed:", *done.stdout.splitlines()[-LAST_LINES:]]), flush=True)
    return done.returncode == 0


# --- the set-up of a target ------------------------------------------------------------------------------------------


def set_up(target: str, *, may_install: bool = True, is_ci: bool = False) -> None:
    """Install what a target needs.

    Raises:
        SetupError: something is still missing without which the target fails; with CI, anything.
    """
    lacking = missing(target)
    for manager in MANAGERS if may_install else ():
        install_with(manager, lacking)
    lacking = [tool for tool in lacking if not is_at_hand(tool)]
    needed = [tool for tool in lacking if tool.way_out or (is_ci and target != "build")]
    if needed:
        raise SetupError("\n".join(map(description, needed)))
    if lacking and target != "build":
        print(f"Missing here, and left out: {listed(lacking)}")


def description(tool: Tool) -> str:
    """Say what is missing, what for, and the way out."""
    old = output(tool.commands[0]) if tool.oldest else None
    state = f"is too old ({old.strip()})" if old else "is missing"
    needed = f"; {tool.oldest[0]}.{tool.oldest[1]} or newer is needed" if tool.oldest else ""
    return f"{tool.name}, which {tool.purpose}, {state}{needed}.\n{way_out(tool)}"


def way_out(tool: Tool) -> str:
    """Say how a person gets a tool."""
    return tool.way_out or "Packages: " + ", ".join(
        f"{manager}: {choices[0]}" for manager, choices in tool.packages.items()
    )


def listed(tools: Iterable[Tool]) -> str:
    """Return the tools with their purposes."""
    return ", ".join(f"{tool.name} ({tool.purpose})" for tool in tools)


def main(words: Sequence[str] | None = None) -> None:
    """Set a target up, or say what is missing."""
    parser = argparse.ArgumentParser(description="Install the programs that a target of the Makefile needs.")
    parser.add_argument("--no-install", action="store_true", help="leave the system as it is")
    parser.add_argument("target", choices=TARGETS, help="what the programs are for")
    asked = parser.parse_args(words)
    try:
        set_up(asked.target, may_install=not asked.no_install, is_ci=bool(os.environ.get("CI")))
    except SetupError as error:
        sys.exit(f"\n{error}\n")


if __name__ == "__main__":
    main()
