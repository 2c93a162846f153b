"""Trials in processes of their own, so that nothing of an earlier one helps them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

PATIENCE = 600.0
"""Seconds after which a trial is given up."""


def in_own_process(module: str, *arguments: str) -> str | None:
    """Return what a module prints that is run with arguments; None if it takes too long."""
    command = [sys.executable, "-m", module, *arguments]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False, cwd=ROOT)
    except subprocess.TimeoutExpired:
        return None
    if run.returncode != 0:
        raise RuntimeError(f"{module} {', '.join(arguments)} failed:\n{run.stderr}")
    return run.stdout
