"""A worksheet's file to cells: which reader takes it is decided by what is in it."""

from __future__ import annotations

import re
from pathlib import Path

from symbody.errors import WorksheetError
from symbody.worksheet.reading.mw import mw_cells
from symbody.worksheet.reading.plain_text import plain_text_cells
from symbody.worksheet.reading.text_export import text_export_cells
from symbody.worksheet.sheet.source import Cell

__all__ = ["read_source", "source_cells"]

_OF_TEXTS = bytes({*b"\t\n\v\f\r\x1a\x1b", *range(0x20, 0x100)})
"""Bytes of texts, also in Maple's old encodings; old exports contain a few others."""
_PROMPT = re.compile(r"^ *>", re.MULTILINE)


def read_source(path: Path | str) -> tuple[Cell, ...]:
    """Return the cells of a worksheet: a text export, Maple's XML, or a file with input only."""
    data = Path(path).read_bytes()
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return source_cells(data.decode("utf-16", errors="replace"))
    if len(data.translate(None, _OF_TEXTS)) > len(data) / 100:
        raise WorksheetError("it is no text, but a binary file; expected a worksheet as text, .mpl or .mw")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # what old versions of Maple wrote
    return source_cells(text)


def source_cells(text: str) -> tuple[Cell, ...]:
    """Return the cells of a worksheet's text."""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\N{NO-BREAK SPACE}", " ")
    if text.lstrip().startswith("<?xml") or text.lstrip().startswith("<Worksheet"):
        return mw_cells(text)
    if _PROMPT.search(text):
        return text_export_cells(text)
    return plain_text_cells(text)
