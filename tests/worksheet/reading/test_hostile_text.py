"""No text makes the readers crash or hang."""

from __future__ import annotations

import os
import random
import time

import pytest

from symbody.errors import WorksheetError
from symbody.worksheet.reading import names_in_code, statements
from symbody.worksheet.reading.files import source_cells

TEXT = (
    "> \n\n a b x(t) := ; : , ( ) [ ] { } < > ' \" ` % %% 1 .. . ... + - * / ^ = <> -> :: :- || $ ~ # ! @ \\ é ∞ \t "
    "if then else end fi for to do od proc local return in union minus not and read save try catch the of wheel \x00 "
    "[Maple ![](a) <?xml <Worksheet <Group> </Group> <Input> </Input> &amp; &lt <Text-field (* *)"
)
PIECES = TEXT.split(" ")

#: How many texts are tried; more with SYMBODY_FUZZ=all.
COUNT = 3000 if os.environ.get("SYMBODY_FUZZ") == "all" else 150


def read(text: str) -> None:
    try:
        cells = source_cells(text)
    except WorksheetError:
        return
    used = names_in_code(cells)
    for cell in cells:
        for _ in statements(cell, used):
            pass


@pytest.mark.parametrize("text", ["proc()k,w", "(proc()for k do"])
def test_a_remark_at_the_end_of_a_procedure_that_is_never_closed(text: str) -> None:
    read(text)


@pytest.mark.parametrize("seed", range(4))
def test_random_texts(seed: int) -> None:
    chance = random.Random(seed)
    for _ in range(COUNT // 4):
        read(chance.choice(["", " ", "\n"]).join(chance.choices(PIECES, k=chance.randint(1, 60))))


DEEP = ["(" * 3000, "[" * 3000 + "]" * 3000, "f(" * 2000 + ")" * 2000 + ";", "-" * 5000 + "1;", "''" * 3000]
WIDE = [
    "1+" * 8000 + "1;",
    "a:" * 4000,
    "if a then " * 500,
    "x" * 100_000,
    '"' * 5001,
    "`" * 5001,
    "<a," * 1200,
    "9" * 10_000 + ";",
]


@pytest.mark.parametrize("text", [*DEEP, *WIDE], ids=range(len(DEEP + WIDE)))
def test_deep_and_long_texts(text: str) -> None:
    begin = time.monotonic()
    read(text)
    read("> a;\n\n" + text + "\n\n> b;\n")
    assert time.monotonic() - begin < 60
