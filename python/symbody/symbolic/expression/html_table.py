"""Tables and long texts that a notebook shows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from symbody.symbolic.given.arguments import brief

__all__ = ["html_table", "scrolled"]

_ROWS = 30
"""The most rows that are shown."""


def html_table(title: str, header: Sequence[str], rows: Iterable[Sequence[object]], note: str = "") -> str:
    """Return a table in HTML: numbers to the right, long texts shortened in the middle, further rows counted.

    Args:
        title: the caption, above the table.
        header: the names of the columns.
        rows: their entries.
        note: a sentence below the table.

    >>> html_table("", ["name"], [["x"]])
    '<table><tr><th style="text-align: left">name</th></tr><tr><td style="text-align: left">x</td></tr></table>'
    """
    listed = [[brief(entry) for entry in row] for row in rows]
    columns = zip(*listed, strict=True) if listed else ((),) * len(header)
    sides = ["right" if column and all(map(_is_number, column)) else "left" for column in columns]
    look = 'style="text-align: left; white-space: nowrap; caption-side: top"'
    caption = f"<caption {look}>{escape(title)}</caption>" if title else ""
    shown = [_row("td", row, sides) for row in listed[:_ROWS]]
    if len(listed) > _ROWS:
        shown.append(f'<tr><td colspan="{len(header)}">and {len(listed) - _ROWS} more</td></tr>')
    below = f"<p>{escape(note)}</p>" if note else ""
    return f"<table>{caption}{_row('th', header, sides)}{''.join(shown)}</table>{below}"


def scrolled(text: str) -> str:
    """Return a long text in HTML: some thirty lines are seen, and the others are scrolled to.

    >>> scrolled("a < b")
    '<pre style="max-height: 36em; overflow: auto; text-align: left">a &lt; b</pre>'
    """
    return f'<pre style="max-height: 36em; overflow: auto; text-align: left">{escape(text)}</pre>'


def _row(cell: str, entries: Sequence[str], sides: Sequence[str]) -> str:
    cells = zip(entries, sides, strict=True)
    return (
        "<tr>"
        + "".join(f'<{cell} style="text-align: {side}">{escape(entry)}</{cell}>' for entry, side in cells)
        + "</tr>"
    )


def _is_number(text: str) -> bool:
    try:
        complex(text)
    except ValueError:
        return text == "..."
    return True
