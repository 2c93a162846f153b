"""No text makes a run crash, hang, or write outside its folder; a run that fails says so."""

from __future__ import annotations

import os
import random
from pathlib import Path

import pytest

from symbody.errors import WorksheetError
from symbody.worksheet.check import verdicts
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.run import outcomes
from tests.worksheet.reading.test_hostile_text import PIECES

WORDS = (
    "show(a); rotate('X',a) make_BODY(a,b) x(t) := 3 ; solve({a=b},{a}); diff(x(t),t); [a,b] simplify( subs( op(%) "
    "%[1] matrix([[1,2],[3,4]]) evalm( seq(i,i=1..3) f(x) 1/0 sqrt(2) sin( convert( {a} map( nops( save a,'f'; x^2+1..."
)

#: How many sheets are tried; more with SYMBODY_FUZZ=all.
COUNT = 4000 if os.environ.get("SYMBODY_FUZZ") == "all" else 200


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("seed", range(2))
def test_random_sheets(seed: int, tmp_path: Path) -> None:
    chance = random.Random(seed)
    words = [*PIECES, *WORDS.split(" ") * 3, "\n\na := 3\n\n"]
    folder = tmp_path / "out"
    for _ in range(COUNT // 2):
        text = chance.choice(["", "> "]) + chance.choice([" ", ""]).join(
            chance.choices(words, k=chance.randint(2, 40))
        )
        session = Session(folder=folder, source=tmp_path)
        session.limits.seconds = 20
        try:
            cells = source_cells(text)
        except WorksheetError:
            continue
        done = list(outcomes(cells, Interpreter(session)))
        assert all(outcome.error == "" or "line" in outcome.error for outcome in done)
        assert not [outcome.error for outcome in done if "a fault of symbody" in outcome.error]
        verdicts(cells, done)
    assert {file.name for file in tmp_path.iterdir()} <= {"out"}
