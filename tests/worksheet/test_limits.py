"""Nothing hangs: time, depth and size are limited, and the next statement runs."""

import pytest

from symbody.errors import WorksheetError
from symbody.worksheet.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.source import Remark, SyntaxMistake
from symbody.worksheet.syntax import Place
from tests.worksheet.printed_by import failures, run


@pytest.mark.parametrize(
    ("sheet", "message"),
    [
        ("f := proc(n) f(n+1) end proc: f(1);", "too many levels of recursion"),
        ("seq(i,i=1..10^9);", "1000000000 items; expected at most 1000000"),
        ("Matrix(10^5,10^5);", "10000000000 items; expected at most 1000000"),
        ("9^(9^9);", "a power of more than a million digits; it is not computed"),
        ("10000!;", "the factorial of 10000; expected an integer from 0 to 5000"),
        ("1/0;", "numeric exception: division by zero"),
        ("0^(-1);", "numeric exception: division by zero"),
        ('printf("%99999d",1);', "printf: the format %99999d is too wide"),
        ("[1,2][3];", "the index 3 is out of range; expected one from 1 to 2"),
        ("op(5,[1]);", "op: improper op or subscript selector: 5 of 1 operands"),
        ("if x < y then 1 fi;", "cannot determine if this expression is true or false: x < y"),
        ("Pi := 3;", "attempting to assign to Pi which is protected"),
        ("sin([1]);", "sin: [1] is no expression; map applies a function to each item"),
        ("a, b := 1;", "ambiguous multiple assignment: 2 names for 1 values"),
    ],
)
def test_what_can_not_be_done_is_told(sheet: str, message: str) -> None:
    (found,) = failures(sheet)
    assert found.removeprefix("(in f) ").removeprefix("f: ").startswith(message)


def test_a_loop_without_end_is_stopped() -> None:
    interpreter = Interpreter()
    interpreter.session.limits.seconds = 0.2
    lines, errors = run("do k := 1 od: 5;", None, interpreter)
    assert lines == ["5"]
    assert errors == ["the statement ran for more than 0.2 s; it was stopped, and the next statement runs"]


def test_an_error_has_a_place() -> None:
    (cell,) = source_cells("x := 1:\ny := 2 + [1,2][7];\n")
    interpreter = Interpreter()
    first, second = (each for each in statements(cell) if not isinstance(each, Remark | SyntaxMistake))
    interpreter.execute(first)
    with pytest.raises(WorksheetError) as caught:
        interpreter.execute(second)
    place = caught.value.place
    assert isinstance(place, Place)
    assert (place.line, place.column) == (2, 10)


def test_a_function_that_nobody_knows_comes_back_with_a_notice() -> None:
    interpreter = Interpreter()
    lines, errors = run("b := make_BODY(ground,m): e := gravity_energy(b): e+1;", None, interpreter)
    assert (lines, errors) == (["gravity_energy(b)+1"], [])
    assert interpreter.session.notices == [
        "gravity_energy is not a command; did you mean gravitational_energy?"
    ]
