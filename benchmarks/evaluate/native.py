"""Native code of a run: compiled into a temporary folder, loaded, called by address."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

FOLDER = Path(__file__).parent
OPTIMISED = ("-O3", "-march=native", "-DNDEBUG", "-shared", "-fPIC")


@cache
def workplace() -> Path:
    """Return a folder for what is compiled; it goes with the process."""
    import atexit  # noqa: PLC0415

    folder = Path(mkdtemp(prefix="evaluate-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def compiled(source: Path, *options: str, compiler: str = "cc") -> ctypes.CDLL:
    """Compile a file and load it."""
    library = workplace() / f"{source.stem}.so"
    command = [compiler, *OPTIMISED, str(source), "-o", str(library), *options]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}\n{run.stderr[-4000:]}")
    return ctypes.CDLL(str(library))


@cache
def loops() -> ctypes.CDLL:
    """Return the loops that are timed."""
    library = compiled(FOLDER / "loop.c")
    for name in ("loop_rows", "loop_columns", "loop_casadi"):
        getattr(library, name).restype = ctypes.c_double
    return library


def pointer(array: object) -> ctypes.c_void_p:
    """Return where an array of NumPy begins."""
    return ctypes.c_void_p(array.ctypes.data)  # type: ignore[attr-defined]


def available(*tools: str) -> bool:
    """Whether the machine has these programs."""
    return all(shutil.which(tool) for tool in tools)


def version(tool: str) -> str:
    """Return the first line of what a program says of itself."""
    lines: Sequence[str] = subprocess.run(
        [tool, "--version"], capture_output=True, text=True, check=False
    ).stdout.splitlines()
    return lines[0] if lines else tool
