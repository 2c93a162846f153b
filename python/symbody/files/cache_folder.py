"""The folder of what is kept between processes because it takes long to make, and can be made again."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from pathlib import Path

__all__ = ["VARIABLE", "folder", "is_own"]

VARIABLE = "SYMBODY_CACHE"
"""The environment variable that holds the folder, or "off"."""


def folder() -> Path | None:
    """Return the folder of the cache; None if it is switched off, or others can write to the folder.

    They could put there what this process would run.
    """
    chosen = os.environ.get(VARIABLE, "")
    if chosen.strip().lower() in {"off", "0", "no", "false"} or not hasattr(os, "getuid"):
        return None
    try:
        place = Path(chosen).expanduser().absolute() if chosen else _standard()
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        return place if is_own(place.lstat(), stat.S_ISDIR) else None
    except (OSError, RuntimeError, ValueError):
        return None


def _standard() -> Path:
    """Return the folder by the XDG base directory specification."""
    given = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(given) if Path(given).is_absolute() else Path.home() / ".cache") / "symbody"


def is_own(found: os.stat_result, is_kind: Callable[[int], bool]) -> bool:
    """Whether a file belongs to this user, and nobody else can write to it."""
    return is_kind(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022
