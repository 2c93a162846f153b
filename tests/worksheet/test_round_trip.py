"""What is printed can be read back, with the same value."""

import random

import pytest

from symbody.symbolic import (
    Expr,
    UndefinedFunction,
    atan2,
    cos,
    exp,
    number,
    pi,
    sin,
    sqrt,
    symbol,
    t,
    tan,
    time_derivative,
)
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.printing.print import text_of
from tests.repeated import repeated

_LEAVES = [
    symbol("a"),
    symbol("x__G"),
    symbol("gamma"),
    t,
    pi,
    number(3),
    number(-2),
    number("1/3"),
]
_FUNCTIONS = [UndefinedFunction(name)(t) for name in ("q", "psi", "omega")]


def _random(chance: random.Random, depth: int) -> Expr:
    if depth == 0:
        leaf = chance.choice([*_LEAVES, *_FUNCTIONS])
        return (
            time_derivative(leaf, chance.randrange(1, 3))
            if leaf in _FUNCTIONS and chance.random() < 0.4
            else leaf
        )
    a, b = _random(chance, depth - 1), _random(chance, depth - 1)
    way = chance.randrange(9)
    if way < 3:
        return [a + b, a - b, a * b][way]
    if way == 3:
        return a / b if not b.is_zero else a
    if way == 4:
        return a ** chance.choice([2, 3, -1]) if not a.is_zero else b
    if way == 5:
        return chance.choice([sin, cos, tan, exp])(symbol("u") + a) * b
    if way == 6:
        return sqrt(a**2 + symbol("w") ** 2)
    if way == 7:
        return atan2(a, symbol("w") + 1)
    return UndefinedFunction("f")(a, b) + UndefinedFunction("g")(symbol("u")).diff(symbol("u"))


@pytest.mark.parametrize("seed", [*range(30), *repeated(range(30, 80))])
def test_printed_scalars_are_read_back(seed: int) -> None:
    expression = _random(random.Random(seed), 4)
    text = text_of(expression)
    assert Interpreter().parsed(text) == expression, text
