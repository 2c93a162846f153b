"""Programs refuse what no code can be made of, with a message that names it."""

from collections.abc import Callable

import pytest

from symbody import functions_of_time, symbols
from symbody.errors import ProgramError
from symbody.symbolic import Argument, Program, Result, Routine

a, b = symbols("a b")
x, y = functions_of_time("x y")
p, q = Argument("p", "parameters", (a,), "parameters"), Argument("q", "coordinates", (x,), "positions")
height = Result("height", "", (a * x,), ())
routine = Routine("rise", "", ("p", "q"), (height,))


def program(*routines: Routine, arguments: tuple[Argument, ...] = (p, q)) -> Program:
    return Program("demo", "", arguments, routines)


MISTAKES: list[tuple[Callable[[], object], str]] = [
    (
        lambda: Argument("p", "", (a + b,), "parameters"),
        "the argument p holds a + b; expected symbols, functions of time or their rates",
    ),
    (
        lambda: Argument("p", "", (a,), "constants"),
        (
            "the argument p is of the stage 'constants'; expected one of parameters, time and inputs, positions, "
            "velocities, accelerations"
        ),
    ),
    (
        lambda: Routine("2fast", "", (), ()),
        "the name '2fast' of the routine can't be used in code; expected letters, digits and _ after a letter",
    ),
    (
        lambda: Result("M", "", (a, b), (3,)),
        (
            "the result M has 2 expressions and the shape (3,); expected a scalar (), a vector (n,) or a matrix "
            "(rows, columns)"
        ),
    ),
    (
        lambda: Routine("rise", "", ("p",), (height, height)),
        "the results of rise have the name height 2 times; give each a name of its own",
    ),
    (
        lambda: program(routine, routine),
        "the routines have the name rise 2 times; give each a name of its own",
    ),
    (
        lambda: program(routine, arguments=(p, q, Argument("r", "", (a,), "parameters"))),
        "the variables have the name a 2 times; give each a name of its own",
    ),
    (
        lambda: program(Routine("rise", "", ("p", "u"), (height,))),
        "the routine rise takes u; the program's arguments are p, q",
    ),
    (
        lambda: program(Routine("rise", "", ("p",), (Result("height", "", (a * x * b + y,), ()),))),
        (
            "the result height of rise contains b, x, y, and is not a function of its arguments p; substitute a value, "
            "or make it a parameter or an input"
        ),
    ),
]


@pytest.mark.parametrize(("mistake", "message"), MISTAKES)
def test_message(mistake: Callable[[], object], message: str) -> None:
    with pytest.raises(ProgramError) as caught:
        mistake()
    assert str(caught.value) == message


def test_arguments_come_in_the_order_of_the_routine() -> None:
    swapped = Routine("rise", "", ("q", "p"), (height,))
    assert program(swapped).arguments_of(swapped) == (q, p)
