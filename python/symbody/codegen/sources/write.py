"""Files in a folder: all of them are written, or nothing is changed."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

__all__ = ["write_all"]


def write_all(folder: Path, texts: Mapping[str, str]) -> None:
    """Write texts by file name into a folder, which is made if there is none.

    They are written beside it first and moved when all is written; if a move fails, what was moved is put back.

    Args:
        folder: where the files are to be.
        texts: what they hold; names may have folders in them.

    Raises:
        OSError: a file can't be written; the folder is as it was.

    >>> with tempfile.TemporaryDirectory() as home:
    ...     write_all(Path(home) / "new", {"a.txt": "one", "inner/b.txt": "two"})
    ...     sorted(str(file.relative_to(home)) for file in Path(home).rglob("*.txt"))
    ['new/a.txt', 'new/inner/b.txt']
    """
    home = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    with tempfile.TemporaryDirectory(prefix=".symbody-", dir=home) as temporary:
        new, old = Path(temporary) / "new", Path(temporary) / "old"
        for file, text in texts.items():
            (new / file).parent.mkdir(parents=True, exist_ok=True)
            (new / file).write_text(text, encoding="utf-8", newline="\n")
        with ExitStack() as undo:
            for file in texts:
                _make_folder((folder / file).parent, undo)
                _move(new / file, folder / file, old / file, undo)
            undo.pop_all()


def _make_folder(folder: Path, undo: ExitStack) -> None:
    """Make a folder and those around it, if they aren't there."""
    if not folder.is_dir():
        _make_folder(folder.parent, undo)
        folder.mkdir()
        undo.callback(folder.rmdir)


def _move(file: Path, place: Path, before: Path, undo: ExitStack) -> None:
    """Move a file to its place, in one step; what was there is kept at ``before``."""
    if place.is_file():
        before.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(place, before)
        file.replace(place)
        undo.callback(before.replace, place)
    else:
        file.replace(place)
        undo.callback(place.unlink)
