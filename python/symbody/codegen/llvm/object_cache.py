"""A cache of machine code on disk, shared by processes: a folder of this user, of bounded size, with verified files.

A file is named after a digest of all that its code depends on: the module's text, the versions of symbody, llvmlite and
LLVM, and the processor. It holds its code behind a digest of name and code, so that truncated, changed or
renamed files are detected. Code that isn't found is compiled; nothing here ever raises an error or changes a result.
"""

from __future__ import annotations

import hashlib
import os
import re
import stat
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from symbody.files.cache_folder import VARIABLE, folder, is_own
from symbody.files.replacement import TEMPORARY, replacements

__all__ = ["BOUND", "SHORTEST", "VARIABLE", "folder", "kept_or_made"]

BOUND = 256 << 20
"""The largest size of the folder, in bytes; the least recently used files are removed."""

SHORTEST = 8_000
"""The shortest text of a module to keep here, in characters: shorter ones compile within some ms."""

_DIGEST = hashlib.sha256().digest_size
_SUFFIX = ".symbody.o"
_OWN = re.compile(rf"([0-9a-f]{{{2 * _DIGEST}}}|\.\w{{8}}){re.escape(_SUFFIX)}")
"""The names of files that are written here, or were once: a user may keep other things in the same folder."""


def kept_or_made(identity: str, text: str, make: Callable[[], bytes]) -> bytes:
    """Return the machine code of a module from the folder, or make it and keep it there.

    Args:
        identity: what the code depends on besides the text.
        text: the module.
        make: compiles it.
    """
    place = _place(identity, text)
    if place is None:
        return make()
    found = _read(place)
    if found is not None:
        return found
    made = make()
    with suppress(OSError):
        _write(place, made)
        _trim(place.parent)
    return made


def _place(identity: str, text: str) -> Path | None:
    home = folder()
    name = hashlib.sha256(f"{identity}\0{text}".encode()).hexdigest()
    return None if home is None else home / (name + _SUFFIX)


def _proof(place: Path, code: bytes) -> bytes:
    return hashlib.sha256(place.name.encode() + code).digest()


def _read(place: Path) -> bytes | None:
    """Return the code in a file, and note its use; None if the file is damaged."""
    try:
        handle = os.open(place, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        with os.fdopen(handle, "rb") as file:
            if not is_own(os.fstat(handle), stat.S_ISREG):
                return None
            proof, code = file.read(_DIGEST), file.read()
    except OSError:
        return None
    if proof != _proof(place, code):
        return None
    with suppress(OSError):
        os.utime(place)
    return code


def _write(place: Path, code: bytes) -> None:
    """Write a file whole, which only this user can read; a link in its place is replaced, not followed."""
    with replacements(place.parent, [place.name]) as folder:
        (folder / place.name).touch(0o600)
        (folder / place.name).write_bytes(_proof(place, code) + code)


def _trim(home: Path) -> None:
    """Remove our least recently used files, down to three quarters of the bound.

    Those that a killed process left in a temporary folder are among them.
    """
    found = []
    for file in (*home.iterdir(), *home.glob(f"{TEMPORARY}*/*/*")):
        with suppress(OSError):
            state = file.lstat()
            if _OWN.fullmatch(file.name) and is_own(state, stat.S_ISREG):
                found.append((state.st_mtime_ns, file, state.st_size))
    size = sum(each for _, _, each in found)
    if size <= BOUND:
        return
    for _, file, each in sorted(found):
        with suppress(OSError):
            file.unlink()
            if file.parent != home:
                file.parent.rmdir()
                file.parent.parent.rmdir()
        size -= each
        if size <= BOUND * 3 // 4:
            return
