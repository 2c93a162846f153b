"""Tables that a notebook shows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from symbody.symbolic.given.arguments import brief

__all__ = ["html_table"]

_ROWS = 30
"""The most rows that are shown."""


def html_table(title: str, header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table in HTML; long texts are shortened in the middle, and further rows are counted.

    >>> html_table("", ["name", "value"], [["x", 1]])
    '<table><tr><th>name</th><th>value</th></tr><tr><td>x</td><td>1</td></tr></table>'
    """
    listed = list(rows)
    caption = f"<caption>{escape(title)}</caption>" if title else ""
    shown = [_row("td", row) for row in listed[:_ROWS]]
    if len(listed) > _ROWS:
        shown.append(f'<tr><td colspan="{len(header)}">and {len(listed) - _ROWS} more</td></tr>')
    return f"<table>{caption}{_row('th', header)}{''.join(shown)}</table>"


def _row(cell: str, entries: Sequence[object]) -> str:
    return "<tr>" + "".join(f"<{cell}>{escape(brief(entry))}</{cell}>" for entry in entries) + "</tr>"
