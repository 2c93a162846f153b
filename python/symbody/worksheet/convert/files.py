"""Files of a worksheet as Python opens, writes and reads them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.text_calls import formatted
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["FILES"]

Call: TypeAlias = Callable[[Writer, Arguments], str]
_MODES = {"WRITE": "w", "READ": "r", "APPEND": "a"}


def _opened(text: Writer, arguments: Arguments) -> str:
    mode = _MODES.get(getattr(arguments[1], "name", ""), "r") if len(arguments) > 1 else "r"
    return f'open({text.text(arguments[0])}, "{mode}")'


def _printed(text: Writer, arguments: Arguments) -> str:
    """Return ``fprintf`` as a format of Python."""
    file, form, *rest = arguments
    if not isinstance(form, syntax.Text):
        raise NoText("fprintf")
    if "%a" in form.text and any(isinstance(text.value(text.text(each)), Expr) for each in rest):
        raise NoText("%a of an expression")  # Python writes x**2
    return f"{text.text(file)}.write({formatted(text, form.text, rest)})"


def _path(method: str) -> Call:
    return lambda text, arguments: f"Path({text.text(arguments[0])}).{method}"


def _lines(text: Writer, arguments: Arguments) -> str:
    file, *lines = [text.text(each) for each in arguments]
    if hasattr(text.value(file), "write"):
        return f'{file}.write("\\n".join([{", ".join(lines)}]) + "\\n")'
    return f'Path({file}).write_text("\\n".join([{", ".join(lines)}]) + "\\n")'


FILES: Mapping[str, Call] = {
    "fopen": _opened,
    "fprintf": _printed,
    "fclose": lambda text, arguments: f"{text.text(arguments[0])}.close()",
    "writeline": _lines,
    "MakeDirectory": _path("mkdir(parents=True, exist_ok=True)"),
    "Exists": _path("exists()"),
    **dict.fromkeys(("Remove", "fremove"), _path("unlink()")),
    "RemoveDirectory": _path("rmdir()"),
}
"""Writers by the names of commands; what they do is what a statement is for."""
