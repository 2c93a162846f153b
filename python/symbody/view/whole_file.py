"""Pictures, pages and reports, written as a whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from symbody.errors import PictureError
from symbody.files.replacement import replacement


def file_of(path: str | os.PathLike[str], example: str = "motion.html") -> Path:
    """Return the path of a picture.

    Raises:
        PictureError: the argument is not a path.

    >>> file_of("motion.html").suffix
    '.html'
    """
    try:
        return Path(path)
    except TypeError:
        raise PictureError(f"view: {path!r} is not a path; expected one, such as {example!r}") from None


def write_whole(
    path: str | os.PathLike[str], write: Callable[[Path], object], *, where: str = "view"
) -> Path:
    """Write a file under a temporary name in the same folder, and rename it when it is complete.

    The folder is made if there is none.

    Args:
        path: the file.
        write: writes the contents to a path.
        where: what writes the file, for the message of an error.

    Raises:
        PictureError: the file can't be written; its previous content is still there.
    """
    file = file_of(path)
    try:
        with replacement(file) as temporary:
            write(temporary)
    except OSError as error:
        raise PictureError(
            f"{where}: {file} can't be written ({error.strerror or error}); nothing was changed there. "
            "Choose another path"
        ) from error
    return file
