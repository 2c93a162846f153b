"""Loops and procedures that prompts and prose interrupt are one statement; others aren't joined."""

from __future__ import annotations

import pytest

from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.sheet.source import Remark, SyntaxMistake

LOOP = "> for k from 1 to 3 do\n\n> a := k;\n\nthe second link\n\n> b := a;\n\n> end do:\n\n> show(b);"
HEAD = "> N := 3; ## links\nfor k from 1 to N do\na := k;\ntotal\nb := a;\nend do:\n> show(b);"
PROCEDURE = "> f := proc(x)\n\nlocal y;\n\n> y := x;\n\n> y^2;\n\n> end proc:\n\n> f(2);"
CONDITION = "> if a > 1 then\n\nthe large one\n\n> b := 1;\n> else\n> b := 2;\n\n> end if;"
CASES = {
    LOOP: ["For", "Evaluation"],
    HEAD: ["Assignment", "For", "Evaluation"],
    PROCEDURE: ["Assignment", "Evaluation"],
    CONDITION: ["If"],
    "> a := 1; do this first\n\n> b := 2;\n\n2\n\nthe end\n\n> c := 3;": ["Assignment"] * 3,
    "A sheet of nobody > restart: a := 1;\n\n> b := 2;": ["Evaluation", "Assignment", "Assignment"],
    "> while a > b do\n\n> a := a - 1;\n\n> od;": ["For"],
    '> for k to 2 do\na := k:\nprintf("%d\\n",a);\nod:\n1\n2\n> b := 1;': ["For", "Assignment"],
}


@pytest.mark.parametrize(("text", "kinds"), CASES.items())
def test_blocks_are_whole(text: str, kinds: list[str]) -> None:
    found = [one for cell in source_cells(text) for one in statements(cell)]
    assert [type(one).__name__ for one in found if not isinstance(one, Remark)] == kinds


def test_a_loop_without_an_end_is_told_and_the_rest_is_read() -> None:
    text = "> for k from 1 to 3 do\n\n> a := k;\n\n> b := 1;\n\nb := 1\n\n> c := 2;"
    found = [one for cell in source_cells(text) for one in statements(cell)]
    assert isinstance(found[0], SyntaxMistake)
    assert "not complete" in found[0].message
    assert type(found[-1]).__name__ == "Assignment"
