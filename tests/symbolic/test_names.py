"""Names of symbols: what SymPy makes of a text, and messages where there is nothing to make."""

from __future__ import annotations

from typing import Any

import pytest
import sympy

from symbody import Expr, functions_of_time, symbols
from symbody.errors import ArgumentError, ExpressionError

TEXTS: list[Any] = [
    "x", "x,", "x y", "x, y", " x  y ", "x,y,", "x0:3", "x:3", "x5:8", "q1:4", "x0:1", "a:d", "A:C", "w:C", "x(:3)",
    "x(1:3)y", "x:2(1:3)", "x(a:c)", "xa:c", "x(1:3)(:2)", "a:b:2", "a0:2b:d", "x_0:3", "x0:3_dot", "x08:11", "x0:3 y",
    "x0:3, y:2", "m l1:3,", "theta1:3", ":c", ["x"], ["x", "y"], ("x", "y"), ["x0:3", "y"], ("x",), [],
    ["x y", "z"], {"x"}, [["x"], "y"],
]  # fmt: skip


def spelt(made: Any) -> Any:
    """Return the structure with the names in the place of symbols."""
    if isinstance(made, list | tuple | set):
        return type(made)(spelt(each) for each in made)
    return str(made)


@pytest.mark.parametrize("names", TEXTS, ids=str)
def test_names_are_read_as_sympy_reads_them(names: Any) -> None:
    assert spelt(symbols(names)) == spelt(sympy.symbols(names))
    assert spelt(functions_of_time(names)) == spelt(sympy.symbols(names))


def test_what_is_made() -> None:
    assert all(e.assumption == "positive" for e in symbols("m1:4", positive=True))
    assert all(e.kind == "time_function" for e in functions_of_time("q1:4"))
    (z,) = functions_of_time("z,")
    assert isinstance(z, Expr)
    assert symbols(name for name in ("x", "y")) == list(symbols("x y"))


EXPECTED = "expected names separated by blanks, such as 'm g l1'"


@pytest.mark.parametrize(
    ("names", "message"),
    [
        ("", f"no name in ''; {EXPECTED}"),
        (" , ", f"no name in ' , '; {EXPECTED}"),
        ("x,,y", f"a name is missing between two commas in 'x,,y'; {EXPECTED}"),
        ("x:", "'x:' has a range without an end; expected one such as 'x0:3' or 'a:d'"),
        ("x:3:", "'x:3:' has a range without an end; expected one such as 'x0:3' or 'a:d'"),
        (
            "x5:5",
            "the range 5:5 in 'x5:5' is empty; expected one such as 'x0:3', which is x0 x1 x2, or 'a:d'",
        ),
        (
            "d:a",
            "the range d:a in 'd:a' is empty; expected one such as 'x0:3', which is x0 x1 x2, or 'a:d'",
        ),
        ("x1:9999999999", "'x1:9999999999' has 9999999998 names; expected at most 100000 in one range"),
        ("x:999:999", "'x:999:999' has 998001 names; expected at most 100000 in one range"),
        (":3", "'0' is not a name; expected letters, digits and underscores, not starting with a digit"),
        (
            "x((1:3))",
            "'x(1)' is not a name; expected letters, digits and underscores, not starting with a digit",
        ),
        ("s:u", "the name 't' stands for time, symbody.t; choose another name"),
    ],
)
def test_texts_without_names(names: str, message: str) -> None:
    for make in (symbols, functions_of_time):
        with pytest.raises(ExpressionError) as caught:
            make(names)
        assert str(caught.value) == message


def test_what_is_no_text() -> None:
    with pytest.raises(ArgumentError, match=r"symbols: None; expected names in a text, such as 'm g l1'"):
        symbols(["x", None])
