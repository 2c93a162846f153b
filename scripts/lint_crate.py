#!/usr/bin/env python3
"""Lint a crate of this project while it is compiled: the code by clippy, the documentation by rustdoc.

    RUSTC_WORKSPACE_WRAPPER=scripts/lint_crate.py cargo build --workspace --all-targets

Cargo calls it with the command that would compile the crate. `cargo clippy` and `cargo doc` find the same faults, but
read all crates of others anew; here they are those of the build. Warnings are errors.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory


def main(command: Sequence[str]) -> int:
    """Compile with clippy's lints, read the documentation of a library, and return the exit status."""
    compiled = run(["clippy-driver", *command])
    if compiled or not is_library(command):
        return compiled
    with TemporaryDirectory() as pages:
        return run(["rustdoc", *documentation(command[1:]), "--document-private-items", "--out-dir", pages])


def run(command: Sequence[str]) -> int:
    """Run a command whose warnings are errors, with the files that cargo has opened for it."""
    return subprocess.run([*command, "--deny", "warnings"], check=False, close_fds=False).returncode


def is_library(command: Sequence[str]) -> bool:
    """Say whether the command compiles a library, and not its tests nor a build script."""
    return "--test" not in command and any(Path(word).parts[-2:] == ("src", "lib.rs") for word in command)


def documentation(arguments: Sequence[str]) -> list[str]:
    """Return the arguments of the compiler without those that say what it writes, and where."""
    after_out_dir = [False, *(argument == "--out-dir" for argument in arguments)]
    return [
        argument
        for argument, is_folder in zip(arguments, after_out_dir, strict=False)
        if not (is_folder or argument == "--out-dir" or argument.startswith("--emit"))
    ]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
