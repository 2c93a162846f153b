"""Compilers and interpreters, which build and check generated code."""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from symbody.codegen.languages.target import Target
from symbody.codegen.layout.arrange import module_name
from symbody.codegen.sources.generate import source, target_of
from symbody.errors import CodegenError
from symbody.files.replacement import write_texts
from symbody.symbolic import Program
from symbody.symbolic.numeric.program import Programmable, program_of

__all__ = ["TOOLS", "check", "check_files", "missing_tools", "needed_tools"]

TOOLS = {
    "make": "GNU Make; on Debian and Ubuntu: apt-get install make",
    "cc": "a C compiler; on Debian and Ubuntu: apt-get install gcc",
    "gfortran": "the GNU Fortran compiler; on Debian and Ubuntu: apt-get install gfortran",
    "octave-cli": "GNU Octave; on Debian and Ubuntu: apt-get install octave",
    "rustc": "the Rust compiler; see https://rustup.rs",
    "julia": "Julia; see https://julialang.org/downloads",
    "omc": "the OpenModelica compiler; see https://openmodelica.org",
}
"""The tools that self-checks need: what they are, and where to get them."""

_LONGEST_REPORT = 4000
_TIME_LIMIT = 600.0


def check(model: Program | Programmable, target: str = "c", *, name: str | None = None) -> str:
    """Generate code in a temporary folder, compile it, compare its values with references, and return the report.

    Args:
        model: a program, or equations of motion, whose program is taken.
        target: the language: one of ``TARGETS``.
        name: another name for the program.

    Raises:
        CodegenError: a compiler is missing, the code doesn't compile, or its values differ from the reference.
        ProgramError: the model can't be a program.

    >>> from symbody.symbolic import Argument, Program, Result, Routine, sin, symbols
    >>> x = symbols("x")
    >>> wave = Routine("wave", "a sine wave", ("q",), (Result("y", "height", (sin(x),), ()),))
    >>> program = Program("demo", "An example.", (Argument("q", "position", (x,), "positions"),), (wave,))
    >>> print(check(program, "python").rstrip())
    demo: entries, largest relative error
      wave: y    1    ...  ok
    """
    chosen, program = target_of(target), program_of(model)
    texts = source(program, target, name=name)
    return check_files(chosen, module_name(name or program.name, chosen.language), texts)


def check_files(target: Target, name: str, texts: Mapping[str, str]) -> str:
    """Build and run the self-check of generated files in a temporary folder, and return its output.

    Args:
        target: the language.
        name: the name of the module, after which the files are named.
        texts: the files.

    Raises:
        CodegenError: a compiler is missing, the code doesn't compile, or its values differ from the reference.
    """
    missing = missing_tools(target)
    if missing:
        raise CodegenError(
            f"check: the code for {target.title} needs {missing[0]}, which isn't on the PATH: {TOOLS[missing[0]]}"
        )
    with tempfile.TemporaryDirectory(prefix="symbody-") as folder:
        write_texts(Path(folder), texts)
        return "".join(_run(command.format(name=name), folder, target) for command in target.check)


def needed_tools(target: Target) -> list[str]:
    """Return the tools that the self-check of a target needs."""
    words = [*(command.split()[0] for command in target.check), *target.tools]
    return [word for word in words if word in TOOLS]


def missing_tools(target: Target) -> list[str]:
    """Return the tools that the self-check of a target needs and that are missing here."""
    return [tool for tool in needed_tools(target) if shutil.which(tool) is None]


def _run(command: str, folder: str, target: Target) -> str:
    """Run a command in a folder and return what it printed."""
    words = shlex.split(command)
    if words[0] == "python":
        words[0] = sys.executable
    try:
        done = subprocess.run(
            words,
            cwd=folder,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_TIME_LIMIT,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise CodegenError(f"check: `{command}` took longer than {_TIME_LIMIT:g} s and was stopped") from None
    if done.returncode:
        output = (done.stdout + done.stderr)[-_LONGEST_REPORT:].strip()
        raise CodegenError(
            f"check: the code for {target.title} doesn't compile, or its values differ from the reference; "
            f"`{command}` ended with {done.returncode}:\n{output}"
        )
    return done.stdout
