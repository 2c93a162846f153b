"""Atomic replacement of files: of one file, or of a group of which all are replaced or none."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

__all__ = ["TEMPORARY", "replacement", "replacements", "write_texts"]

TEMPORARY = ".symbody-"
"""The prefix of temporary folders, in which files are written first; a process that is killed leaves one."""


@contextmanager
def replacement(file: Path, *, durable: bool = False) -> Iterator[Path]:
    """Give a temporary path next to a file; the file written there replaces it at the end, in one step.

    A link stays a link: its target is replaced. The folder is made if there is none.

    Args:
        file: the file to replace.
        durable: whether the contents are on the disk before they take the file's place.

    Raises:
        OSError: the file can't be written; what was there before is still there.

    >>> with tempfile.TemporaryDirectory() as home:
    ...     with replacement(Path(home) / "a.txt") as temporary:
    ...         size = temporary.write_text("one")
    ...     [file.name for file in Path(home).iterdir()]
    ['a.txt']
    """
    place = file.resolve()
    with replacements(place.parent, [place.name], durable=durable) as folder:
        yield folder / place.name


@contextmanager
def replacements(folder: Path, names: Sequence[str], *, durable: bool = False) -> Iterator[Path]:
    """Give a temporary folder inside another; files written there under some names are moved at the end, all or none.

    If a move fails, what was moved before is put back.

    Args:
        folder: where the files are to be; it is made if there is none.
        names: the files; names may have folders in them.
        durable: whether the contents are on the disk before they take their places.

    Raises:
        OSError: a file can't be written; the folder is as it was.
    """
    home = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    with tempfile.TemporaryDirectory(prefix=TEMPORARY, dir=home) as temporary, ExitStack() as undo:
        new, old = Path(temporary) / "new", Path(temporary) / "old"
        new.mkdir()
        yield new
        if durable:
            for name in names:
                _write_out(new / name)
        for name in names:
            _make_folder((folder / name).parent, undo)
            # Nothing fails after the last move, which needs no copy of what was there.
            _move(new / name, folder / name, None if name == names[-1] else old / name, undo)
        undo.pop_all()


def write_texts(folder: Path, texts: Mapping[str, str]) -> None:
    """Write texts by file name into a folder: all of them, or nothing is changed.

    Args:
        folder: where the files are to be; it is made if there is none.
        texts: what they hold; names may have folders in them.

    Raises:
        OSError: a file can't be written; the folder is as it was.

    >>> with tempfile.TemporaryDirectory() as home:
    ...     write_texts(Path(home) / "new", {"a.txt": "one", "inner/b.txt": "two"})
    ...     sorted(str(file.relative_to(home)) for file in Path(home).rglob("*.txt"))
    ['new/a.txt', 'new/inner/b.txt']
    """
    with replacements(folder, list(texts)) as new:
        for name, text in texts.items():
            (new / name).parent.mkdir(parents=True, exist_ok=True)
            (new / name).write_text(text, encoding="utf-8", newline="\n")


def _write_out(file: Path) -> None:
    """Wait until the contents of a file are on the disk."""
    with file.open("rb+") as opened:
        os.fsync(opened.fileno())


def _make_folder(folder: Path, undo: ExitStack) -> None:
    """Make a folder and those around it, if they aren't there."""
    if not folder.is_dir():
        _make_folder(folder.parent, undo)
        folder.mkdir()
        undo.callback(folder.rmdir)


def _move(file: Path, place: Path, copy: Path | None, undo: ExitStack) -> None:
    """Move a file to its place, in one step; what was there is kept as a copy, if one is wanted."""
    is_replaced = place.is_file()
    if copy and is_replaced:
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(place, copy)
    file.replace(place)
    if copy:
        undo.callback(partial(copy.replace, place) if is_replaced else place.unlink)
