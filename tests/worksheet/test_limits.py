"""Nothing hangs: time, depth and size are limited, and the next statement runs."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from symbody.errors import WorksheetError
from symbody.worksheet.evaluation.limits import Limits
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.sheet.source import Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import Place
from tests.worksheet.printed_by import failures, run

ROOT = Path(__file__).parents[2]


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
        (
            'printf("%{m}d",Vector([1]));',
            (
                "printf: the option {m} of %{m}d is not known; expected {c,}, where c is followed by the character"
                " between entries"
            ),
        ),
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


@pytest.mark.parametrize(
    "long",
    ["expand((1+x+y+z+u+v)^90):", "diff(sin(x*y)*exp(x^2)/(1+x^4), x$150):"],
)
def test_one_long_operation_is_stopped(long: str) -> None:
    interpreter = Interpreter()
    interpreter.session.limits.seconds = 0.1
    lines, errors = run(f"{long} 5;", None, interpreter)
    assert lines == ["5"]
    assert errors == ["the statement ran for more than 0.1 s; it was stopped, and the next statement runs"]


HOARDER = """
from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import run

interpreter = Interpreter()
interpreter.session.limits.memory = 2e7
lines, errors = run("k := 0: do k := k+1: L[k] := Matrix(300,300) od: 5;", None, interpreter)
print(*lines, *errors)
"""


def test_a_statement_that_takes_too_much_memory_is_stopped() -> None:
    """In a process of its own, since one that has freed much memory grows late."""
    done = subprocess.run(
        [sys.executable, "-c", HOARDER], cwd=ROOT, capture_output=True, text=True, check=False
    )
    stopped = "the statement took more than 0.02 GB of memory; it was stopped, and the next statement runs"
    assert done.stdout == f"5 {stopped}\n", done.stderr


def test_what_is_evaluated_outside_a_statement_has_no_limits() -> None:
    Limits(seconds=0, memory=0).check()


def test_a_long_motion_is_stopped() -> None:
    interpreter = Interpreter()
    sheet = "s := dsolve({diff(x(t),t) = cos(1000*t)*x(t), x(0) = 1}, numeric):"
    assert run(f"{sheet} s(0.1):", None, interpreter) == ([], [])
    interpreter.session.limits.seconds = 0.3
    _, errors = run("s(10^6):", None, interpreter)
    assert errors == ["the statement ran for more than 0.3 s; it was stopped, and the next statement runs"]


def test_what_is_done_is_kept_when_a_run_is_interrupted(tmp_path: Path) -> None:
    (tmp_path / "sheet.mpl").write_text("x := 1;\nprint(begun);\nexpand((1+a+b+c+d+e)^200):\ny := 2;\n")
    command = [sys.executable, "-u", "-m", "symbody", "run", str(tmp_path / "sheet.mpl")]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert [child.stdout.readline(), child.stdout.readline()] == ["x := 1\n", "begun\n"]
    child.send_signal(signal.SIGINT)
    lines, errors = child.communicate(timeout=60)
    assert lines == "2 statements, 0 failed, 0 compared, 0 different, 0 not comparable\n"
    assert "interrupted: what was printed and written so far is kept" in errors
    assert child.returncode == 130


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
