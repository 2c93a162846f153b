"""Checks of types by mypy that begin where the last lint of the package ended."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def checked_types(
    home: Path, scratch: Path, *arguments: str, mypy_path: str = ""
) -> subprocess.CompletedProcess[str]:
    """Run mypy on a package; what it need not check again is in a copy of the cache that `mypy` has at the root.

    Args:
        home: the folder with pyproject.toml.
        scratch: an empty folder for the copy.
        arguments: the arguments of mypy.
        mypy_path: a folder of further modules.
    """
    cache = scratch / "types"
    if (ROOT / ".mypy_cache").exists():
        shutil.copytree(ROOT / ".mypy_cache", cache)
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir", str(cache), *arguments],
        cwd=home,
        env=os.environ | {"MYPYPATH": mypy_path},
        capture_output=True,
        text=True,
        check=False,
    )
