"""Files with input only: ``.mpl``, ``.txt``, and what ``save`` writes."""

from __future__ import annotations

from symbody.worksheet.sheet.source import Cell, Line

__all__ = ["plain_text_cells"]


def plain_text_cells(text: str) -> tuple[Cell, ...]:
    r"""Return one cell with all lines; a line that ends in ``\`` goes on in the next one, also within a word."""
    lines: list[Line] = []
    goes_on = False
    for number, line in enumerate(text.split("\n"), start=1):
        if goes_on:
            last = lines.pop()
            # The words of the next line keep its place as well as one line can say it.
            lines.append(Line(last.text[:-1] + line.lstrip(), last.line, last.column))
        else:
            lines.append(Line(line, number))
        goes_on = line.endswith("\\") and not _is_remark(lines[-1].text)
    return (Cell(tuple(line for line in lines if line.text.strip())),)


def _is_remark(line: str) -> bool:
    return line.lstrip().startswith("#")
