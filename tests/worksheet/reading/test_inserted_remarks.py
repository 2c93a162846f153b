"""Remarks without ``#`` put into sheets: the statements stay, or the user is told."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from symbody.worksheet.reading import names_in_code, statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.sheet.source import Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import Empty, Statement
from tests.repeated import repeated

SHEETS = Path(__file__).parents[2] / "worksheets" / "valid"

REMARKS = """[kg]|[m/s^2]|{rad/s}|(see Fig. 3)|mass [kg]|see [1], p. 23|from the 2nd link|2nd body|-> forward|kg|?|(rad)
3 wheels in all|0.5 m long|the rear wheel's axis|first coordinate|offset here|position, of the point|unit: N/m
= mass of the car|cf. eqn 4|x coordinate of G|to be checked!|20 mm|length, width and height|e.g. 9.81 m/s^2
the sum of x and y|* not used|spring in x|mass of body 1 (kg)""".replace("\n", "|").split("|")


def read(text: str) -> tuple[list[Statement], list[Remark], int]:
    """Return the statements, the remarks, and the number of mistakes."""
    cells = source_cells(text)
    used = names_in_code(cells)
    found = [one for cell in cells for one in statements(cell, used) if not isinstance(one, Empty)]
    mistakes = sum(isinstance(one, SyntaxMistake) for one in found)
    return (
        [one for one in found if isinstance(one, Statement)],
        [one for one in found if isinstance(one, Remark)],
        mistakes,
    )


def with_remark(lines: list[str], draw: random.Random) -> list[str]:
    """Return a sheet with one more remark, at the end of a line or on a line of its own."""
    has_prompts = any(line.startswith(">") for line in lines)
    places = [
        index
        for index, line in enumerate(lines)
        if line.strip() and not {'"', "#"} & {*line} and (not has_prompts or line.startswith(">"))
    ]
    place, remark = draw.choice(places), draw.choice(REMARKS)
    if draw.random() < 0.2:
        return [*lines[: place + 1], f"  {remark}", *lines[place + 1 :]]
    gap = " " * draw.choice((1, 2, 4))
    return [*lines[:place], f"{lines[place].rstrip()}{gap}{remark}", *lines[place + 1 :]]


def keeps_statements(sheet: str, seed: int) -> None:
    """Check that all statements stay, or that one more is shown, or a mistake or a remark with code is told."""
    lines = (SHEETS / sheet).read_text(encoding="utf-8").split("\n")
    expected, _, mistakes = read("\n".join(lines))
    changed = with_remark(lines, random.Random(f"{sheet} {seed}"))
    found, remarks, more = read("\n".join(changed))
    lost = [one for one in expected if one not in found]
    is_told = more > mistakes or any(remark.notice for remark in remarks)
    assert not lost or is_told, [line for line in changed if line not in lines]


NAMES = sorted(path.name for path in SHEETS.iterdir() if path.suffix in {".txt", ".mpl"})


QUICK = [
    (sheet, range(6))
    for sheet in ("double_pendulum.txt", "four_bar.mpl", "lesson_frames.txt", "car_steady.mpl")
]
MORE = [(sheet, range(6, 46)) for sheet in NAMES if not sheet.startswith("saved_")]  # these break words


@pytest.mark.parametrize(("sheet", "seeds"), [*QUICK, *repeated(MORE)])
def test_remarks_in_sheets(sheet: str, seeds: range) -> None:
    for seed in seeds:
        keeps_statements(sheet, seed)
