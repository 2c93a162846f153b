"""No statement crashes the interpreter or makes it hang: it prints, or reports a mistake."""

import random
import time
from contextlib import suppress
from pathlib import Path

import pytest

from symbody.errors import WorksheetError
from symbody.worksheet.builtins import FORMS, KERNEL, PACKAGES
from symbody.worksheet.commands.mbsymba import COMMANDS
from symbody.worksheet.interpreter.interpret import Interpreter, Stop
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.sheet.source import Remark, SyntaxMistake

_OPERANDS = [
    *(
        "x",
        "y(t)",
        "t",
        "3",
        "-1",
        "0",
        "2.5",
        "1/3",
        "a[1]",
        "T",
        "M",
        "V",
        "L",
        "f",
        "b1",
        "p1",
        "v1",
        "%",
        "NULL",
    ),
    *(
        "[1,2]",
        "{x,y}",
        "x=2",
        "1..3",
        '"text"',
        "'x'",
        "diff(y(t),t)",
        "[]",
        "{}",
        "x->x^2",
        "true",
        "()",
        "-4..-1",
    ),
]
_OPERATORS = [
    "+",
    "-",
    "*",
    "/",
    "^",
    ".",
    "&*",
    "=",
    "<>",
    "<",
    "union",
    "minus",
    "..",
    "$",
    "||",
    "and",
    ",",
]
_NAMES = sorted({*KERNEL, *FORMS, *COMMANDS} - {"time"})
_KEYWORDS = {"if", "union", "minus", "intersect", "read", "save"}
_BEGIN = (
    "T := table([1=x,k=2]): M := Matrix([[1,x],[y(t),2]]): V := <1,2>: L := [x,2,[3]]: f := proc(u,w) u+w end proc: "
    "b1 := make_BODY(translate(x,y(t),0),m): p1 := origin(b1[frame]): v1 := make_VECTOR(ground,1,0,0):"
)


def _expression(chance: random.Random, depth: int) -> str:
    way = chance.random()
    if depth == 0 or way < 0.2:
        return chance.choice(_OPERANDS)
    inner = [_expression(chance, depth - 1) for _ in range(chance.randrange(4))]
    if way < 0.65:
        name = chance.choice(_NAMES)
        plain = name.isidentifier() and name not in _KEYWORDS
        return f"{name if plain else f'`{name}`'}({','.join(inner)})"
    if way < 0.75:
        return f"({_expression(chance, depth - 1)})[{','.join(inner) or '1'}]"
    return (
        f"({_expression(chance, depth - 1)}) {chance.choice(_OPERATORS)} ({_expression(chance, depth - 1)})"
    )


def _execute(interpreter: Interpreter, text: str) -> None:
    for cell in source_cells(text):
        for statement in statements(cell):
            if isinstance(statement, SyntaxMistake | Remark):
                continue
            with suppress(WorksheetError, Stop):
                interpreter.execute(statement)


@pytest.mark.parametrize("seed", range(6))
def test_random_statements_print_or_report(seed: int, tmp_path: Path) -> None:
    chance = random.Random(seed)
    interpreter = Interpreter()
    interpreter.session.folder = tmp_path / "out"
    interpreter.session.folder.mkdir()
    interpreter.session.limits.seconds = 2
    _execute(interpreter, _BEGIN)
    for i in range(60):
        text = _expression(chance, 3)
        target = chance.choice(["", "", "z := ", "T[1] := ", "a[x] := ", "g(t) := ", "L[1] := ", "(u,w) := "])
        begin = time.monotonic()
        _execute(interpreter, f"{target}{text};")
        assert time.monotonic() - begin < 20, text
        if i % 20 == 19:
            _execute(interpreter, f"restart; {_BEGIN}")
    interpreter.session.close()
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_each_command_reports_calls_with_wrong_arguments(tmp_path: Path) -> None:
    interpreter = Interpreter()
    interpreter.session.folder = tmp_path
    interpreter.session.limits.seconds = 2
    names = [*(f"`{name}`" for name in _NAMES), *(f"{p}[{n}]" for p, held in PACKAGES.items() for n in held)]
    for name in names:
        for arguments in ("", "x", "[1]", "x,y(t),3", '"a",x=1', "{x},[y(t)],1..2"):
            _execute(interpreter, f"{name}({arguments}):")
    interpreter.session.close()
