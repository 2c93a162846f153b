"""Files that are whole or not there."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from symbody.errors import PictureError


def write_whole(path: str | os.PathLike[str], write: Callable[[Path], object]) -> Path:
    """Write a file under a temporary name beside its place, and rename it when all is written.

    Raises:
        PictureError: the file can't be written; what was there before is still there.
    """
    try:
        file = Path(path)
    except TypeError:
        raise PictureError(f"view: {path!r} is no path; expected one, such as 'motion.html'") from None
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".symbody-", dir=file.parent) as folder:
            temporary = Path(folder) / file.name
            write(temporary)
            temporary.replace(file)
    except OSError as error:
        raise PictureError(
            f"view: {file} can't be written ({error.strerror or error}); nothing was changed there. "
            "Choose another path"
        ) from error
    return file
