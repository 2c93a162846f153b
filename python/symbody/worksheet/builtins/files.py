"""Files: read and save, and those that a sheet writes itself; all inside the output folder."""

from __future__ import annotations

import io
from pathlib import Path, PurePosixPath
from typing import IO

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.builtins.saved_text import saved_text
from symbody.worksheet.builtins.texts import formatted, unparsed
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import NULL, Boolean, Reference, String, Value

__all__ = ["COMMANDS", "PACKAGES", "file_to_read", "output_path", "read_file", "save_file"]

_LARGEST = 100_000_000


def _relative(session: Session, value: Value) -> PurePosixPath:
    """Return the path of a file as the sheet names it, without drive and without the root."""
    text = unparsed(session, value).replace("\\", "/")
    head, colon, rest = text.partition(":")
    if colon and len(head) == 1:
        text = rest
    parts = [part for part in text.split("/") if part not in ("", ".")]
    if not parts or ".." in parts or "\0" in text or len(text) > 1000:
        raise WorksheetError(f"the file {text[:60]!r} is not inside the output folder; expected a plain name")
    return PurePosixPath(*parts)


def output_path(session: Session, value: Value) -> Path:
    """Return where a file is written: inside the output folder, whatever folder the sheet names."""
    if session.any_folder:
        return session.folder / unparsed(session, value)
    folder = session.folder.resolve()
    path = folder / _relative(session, value)
    if not path.resolve().is_relative_to(folder):
        raise WorksheetError(f"the file {unparsed(session, value)[:60]!r} is not inside the output folder")
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def _existing(session: Session, value: Value) -> Path | None:
    """Return a file to read: in the output folder, then beside the sheet; there its name alone may count."""
    if session.any_folder and (session.folder / unparsed(session, value)).is_file():
        return session.folder / unparsed(session, value)
    relative = _relative(session, value)
    for folder in (session.folder.resolve(), session.source.resolve()):
        for path in (folder / relative, folder / relative.name):
            if path.resolve().is_relative_to(folder) and path.is_file():
                return path
    return None


def read_file(session: Session, name: Value) -> Value:
    """Read "f": execute the statements of a file."""
    session.run(*file_to_read(session, name))
    return NULL


def file_to_read(session: Session, name: Value) -> tuple[str, str]:
    """Return the name of a file and its text.

    Raises:
        WorksheetError: there is no such file, or it is too large.
    """
    path = _existing(session, name)
    if path is None:
        raise WorksheetError(
            f"unable to read {unparsed(session, name)!r}: it is neither in the output folder nor beside the worksheet"
        )
    if path.stat().st_size > _LARGEST:
        raise WorksheetError(f"the file {path.name} is too large: expected at most {_LARGEST} bytes")
    data = path.read_bytes()
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return path.name, text


_OF_MODES = {
    *("ground", "master_frame", "moving_frame", "VM", "omegaMV", "small_vars"),
    *("dependent_coordinates", "mframe_flag"),
}
"""Names that MBSymba and its modes set, which a file does not set again."""


def save_file(session: Session, *arguments: Value) -> Value:
    """Save a, b, "f": assignments that read takes back; of no names, those of all that have a value."""
    *given, file = arguments
    path = output_path(session, file)
    known = dict.fromkeys((*session.names, *(name for name, held in session.remembered.items() if held)))
    names = []
    for each in given:
        name = getattr(each, "name", None) if isinstance(each, Expr | Reference) else None
        if name is None:
            raise WorksheetError(
                f"save: {session.text(each)[:60]} is not a name; expected names, then a file"
            )
        if name in known:
            names.append(name)
        else:
            session.notice(f"save: {name} has no value; the file is written without it")
    if not given:
        names = [name for name in known if name not in _OF_MODES]
    lines = [saved_text(session, name) for name in names]
    path.write_text("".join(lines), encoding="utf-8")
    return NULL


def save_names(session: Session, *arguments: Value) -> Value:
    """save(a, b, "f"): the same as a command."""
    return save_file(session, *arguments)


def assigned_names(session: Session, *kinds: Value) -> Value:
    """anames('user'): the names that have values, in the order in which they were assigned; none that begin with _."""
    names = (each for each in session.names if each not in _OF_MODES and not each.startswith("_"))
    return sequence([symbol(each) for each in names])


# --- files that the sheet writes itself -------------------------------------------------------------------------------


def fopen(session: Session, name: Value, mode: Value, *options: Value) -> Value:
    """fopen("f", WRITE): a number for fprintf and fclose."""
    way = unparsed(session, mode).upper()
    if len(session.files) >= 100:
        raise WorksheetError("fopen: more than 100 files are open")
    file: IO[str]
    if way == "READ":
        path = _existing(session, name)
        if path is None:
            raise WorksheetError(f"fopen: there is no file {unparsed(session, name)!r}")
        file = io.StringIO(path.read_text(encoding="utf-8", errors="replace"))
    else:
        file = output_path(session, name).open("a" if way == "APPEND" else "w", encoding="utf-8")
    descriptor = len(session.files)
    while descriptor in session.files:
        descriptor += 1
    session.files[descriptor] = file
    return number(descriptor)


def _opened(session: Session, descriptor: Value) -> IO[str] | None:
    place = as_integer(descriptor)
    return session.files.get(place) if place is not None else None


def fprintf(session: Session, file: Value, template: Value, *values: Value) -> Value:
    """fprintf(file, format, ..)."""
    text = formatted(session, template, values)
    if unparsed(session, file) in ("default", "terminal"):
        session.write(text)
        return NULL
    opened = _opened(session, file)
    if opened is not None:
        opened.write(text)
    else:
        _append(session, file, text)
    return number(len(text))


def _append(session: Session, file: Value, text: str) -> None:
    if as_integer(file) is not None:
        raise WorksheetError(
            f"file descriptor {session.text(file)} is not in use; open a file by fopen first"
        )
    path = output_path(session, file)
    known = session.files.setdefault(("written", str(path)), True)
    with path.open("a" if known is None else "w", encoding="utf-8") as opened:
        opened.write(text)
    session.files["written", str(path)] = None


def writeline(session: Session, file: Value, *texts: Value) -> Value:
    """writeline(file, s, ..): lines."""
    text = "".join(f"{unparsed(session, each)}\n" for each in texts) or "\n"
    if unparsed(session, file) in ("default", "terminal"):
        session.print(text.rstrip("\n"))
        return NULL
    opened = _opened(session, file)
    if opened is not None:
        opened.write(text)
    else:
        _append(session, file, text)
    return number(len(text))


def readline(session: Session, file: Value) -> Value:
    """readline(file): the next line, or 0 at the end."""
    opened = _opened(session, file)
    if opened is None:
        opened = session.files.get(("read", unparsed(session, file)))
    if opened is None:
        descriptor = as_integer(fopen(session, file, String("READ")))
        opened = session.files["read", unparsed(session, file)] = session.files.pop(descriptor)
    line = opened.readline()
    return String(line.rstrip("\n")) if line else number(0)


def fclose(session: Session, *files: Value) -> Value:
    """fclose(file)."""
    for file in files:
        place = as_integer(file)
        opened = session.files.pop(("read", unparsed(session, file)) if place is None else place, None)
        if opened is not None:
            opened.close()
    return NULL


# --- FileTools --------------------------------------------------------------------------------------------------------


def exists(session: Session, name: Value) -> Value:
    """FileTools[Exists](f): whether a file or folder is there, in the output folder or beside the sheet."""
    relative = _relative(session, name)
    return Boolean((session.folder.resolve() / relative).exists() or _existing(session, name) is not None)


def make_directory(session: Session, name: Value, *options: Value) -> Value:
    """FileTools[MakeDirectory](d)."""
    output_path(session, name).mkdir(exist_ok=True)
    return NULL


def remove_directory(session: Session, name: Value, *options: Value) -> Value:
    """FileTools[RemoveDirectory](d): an empty folder, or with ``recurse`` all files in it."""
    path = output_path(session, name)
    if path == session.folder.resolve() or not path.is_dir():
        return NULL
    for inner in sorted(path.rglob("*"), reverse=True):
        if inner.is_symlink() or inner.is_file():
            inner.unlink()
        else:
            inner.rmdir()
    path.rmdir()
    return NULL


def remove_file(session: Session, *names: Value) -> Value:
    """FileTools[Remove](f)."""
    for name in names:
        output_path(session, name).unlink(missing_ok=True)
    return NULL


def current_folder(session: Session, *names: Value) -> Value:
    """currentdir(): the output folder; another one isn't taken."""
    if names:
        session.notice("currentdir: files stay in the output folder")
    return String(".")


COMMANDS: dict[str, Command] = {
    "anames": assigned_names,
    "read": read_file,
    "save": save_names,
    "fopen": fopen,
    "fprintf": fprintf,
    "writeline": writeline,
    "readline": readline,
    "fclose": fclose,
    "close": fclose,
    "currentdir": current_folder,
    "fremove": remove_file,
}

PACKAGES: dict[str, dict[str, Command]] = {
    "FileTools": {
        "Exists": exists,
        "MakeDirectory": make_directory,
        "RemoveDirectory": remove_directory,
        "Remove": remove_file,
    }
}
