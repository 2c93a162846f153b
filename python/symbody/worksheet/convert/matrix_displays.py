"""Matrices in angle brackets: ``<a, b>``, ``<a | b>``, ``<<a, b> | <c, d>>``, ``<A | B>``."""

from __future__ import annotations

from symbody.symbolic import Matrix
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["below", "beside", "columns", "rows"]


def columns(to: Writer, node: syntax.Columns) -> str:
    """Return a matrix given as ``<a,b;c,d>``, one below others, or a vector of a sequence, ``<comp_XYZ(P)>``."""
    if len(node.items) > 1 and not any(isinstance(each, syntax.Rows) for each in node.items):
        written = [to.text(each) for each in node.items]
        if any(isinstance(to.value(each), Matrix) for each in written):
            return below(to, written)
    lines = [each.items if isinstance(each, syntax.Rows) else (each,) for each in node.items]
    entries = items(to, node.items) if all(len(line) == 1 for line in lines) else ""
    return f"sb.Matrix.column([{entries}])" if entries.startswith("*") else _matrix(to, lines)


def rows(to: Writer, node: syntax.Rows) -> str:
    """Return a row, ``<a | b>``, or columns one beside the other."""
    heights = {len(each.items) if isinstance(each, syntax.Columns) else 1 for each in node.items}
    if heights == {1}:
        written = [to.text(each) for each in node.items]
        if all(isinstance(to.value(each), Matrix) for each in written):
            return beside(written)
    elif len(heights) == 1:
        listed = [each.items for each in node.items if isinstance(each, syntax.Columns)]
        return _matrix(to, list(zip(*listed, strict=True)))
    return _matrix(to, [node.items])


def beside(matrices: list[str]) -> str:
    """Return matrices side by side."""
    lines = ", ".join(f"{grouped(each)}.tolist()" for each in matrices)
    return f"sb.Matrix([sum(row, []) for row in zip({lines})])"


def below(to: Writer, written: list[str]) -> str:
    """Return matrices one below the other; a list of entries is a row."""
    parts = [f"*{grouped(each)}.tolist()" if isinstance(to.value(each), Matrix) else each for each in written]
    return f"sb.Matrix([{', '.join(parts)}])"


def _matrix(to: Writer, lines: list[tuple[syntax.Expression, ...]]) -> str:
    """Return a matrix by rows."""
    return f"sb.Matrix([{', '.join(f'[{items(to, line)}]' for line in lines)}])"
