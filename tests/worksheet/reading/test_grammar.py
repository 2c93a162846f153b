"""The grammar of Maple's statements: what each construct becomes, and what a mistake says."""

from __future__ import annotations

import pytest

from symbody.worksheet.reading import statements
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell, Line, Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import (
    Assignment,
    Call,
    Columns,
    Concatenation,
    Decimal,
    Delayed,
    Ditto,
    Evaluation,
    Infix,
    Integer,
    ListDisplay,
    Member,
    Name,
    Parameter,
    Place,
    Postfix,
    Prefix,
    Rows,
    Selection,
    SequenceDisplay,
    SetDisplay,
    Text,
)

HERE = Place(1, 1, 1, 1)


def read(text: str) -> list[syntax.Statement | Remark | SyntaxMistake]:
    return list(statements(Cell(tuple(Line(line, k) for k, line in enumerate(text.split("\n"), start=1)))))


def expression(text: str) -> syntax.Expression:
    (found,) = read(text + ";")
    assert isinstance(found, Evaluation), found
    return found.expression


def name(text: str) -> Name:
    return Name(text, place=HERE)


def integer(value: int) -> Integer:
    return Integer(value, place=HERE)


def call(function: syntax.Expression, *arguments: syntax.Expression) -> Call:
    return Call(function, arguments, place=HERE)


def infix(operator: str, left: syntax.Expression, right: syntax.Expression, tilde: bool = False) -> Infix:
    return Infix(operator, left, right, tilde, place=HERE)


def minus(value: int) -> Prefix:
    return Prefix("-", integer(value), place=HERE)


A, B, X, T, I, K = (name(letter) for letter in "abxtik")
NOTHING = SequenceDisplay((), place=HERE)

EXPRESSIONS = [
    ("12", integer(12)),
    (".17e-1", Decimal(".17e-1", place=HERE)),
    ("1.", Decimal("1.", place=HERE)),
    ("1..3", infix("..", integer(1), integer(3))),
    ("x__G", name("x__G")),
    ("`x'`", name("x'")),
    ("`a``b`", name("a`b")),
    (r'"C:\LIBS \"a\""', Text(r'C:\LIBS "a"', place=HERE)),
    ("%%", Ditto(2, place=HERE)),
    ("'x'", Delayed(X, place=HERE)),
    ("''x''", Delayed(Delayed(X, place=HERE), place=HERE)),
    ("a[1][t]", Selection(Selection(A, (integer(1),), place=HERE), (T,), place=HERE)),
    (
        "a[..,1..]",
        Selection(A, (infix("..", NOTHING, NOTHING), infix("..", integer(1), NOTHING)), place=HERE),
    ),
    (
        "a[-4..-1]",
        Selection(
            A,
            (infix("..", Prefix("-", integer(4), place=HERE), Prefix("-", integer(1), place=HERE)),),
            place=HERE,
        ),
    ),
    ("x[i](t)", call(Selection(X, (I,), place=HERE), T)),
    ("D(x)(a)", call(call(name("D"), X), A)),
    ("x||i(t)", call(Concatenation(X, I, place=HERE), T)),
    ("x || 1", Concatenation(X, integer(1), place=HERE)),
    ("'x||k(t)'", Delayed(call(Concatenation(X, K, place=HERE), T), place=HERE)),
    ("a:-b(x)", call(Member(A, "b", place=HERE), X)),
    ("{a, b}", SetDisplay((A, B), place=HERE)),
    ("[]", ListDisplay((), place=HERE)),
    ("<a, b>", Columns((A, B), place=HERE)),
    ("<a | b>", Rows((A, B), place=HERE)),
    ("<a, b | x, t>", Rows((Columns((A, B), place=HERE), Columns((X, T), place=HERE)), place=HERE)),
    ("<%>", Columns((Ditto(1, place=HERE),), place=HERE)),
    ("-a^2", Prefix("-", infix("^", A, integer(2)), place=HERE)),
    ("a^-b", infix("^", A, Prefix("-", B, place=HERE))),
    ("a**b", infix("^", A, B)),
    ("a - b + x", infix("+", infix("-", A, B), X)),
    ("a / b . x", infix(".", infix("/", A, B), X)),
    ("a &* b - 1", infix("-", infix("&*", A, B), integer(1))),
    ("a union b minus x", infix("minus", infix("union", A, B), X)),
    ("a =~ 0", infix("=", A, integer(0), tilde=True)),
    ("a^%T", Postfix("%T", A, place=HERE)),
    ("x $ i = 1..k", infix("$", X, infix("=", I, infix("..", integer(1), K)))),
    ("not a = b and x or t", infix("or", infix("and", Prefix("not", infix("=", A, B), place=HERE), X), T)),
    ("a < b", infix("<", A, B)),
    ("()", NOTHING),
    ("a::b", infix("::", A, B)),
]


@pytest.mark.parametrize(("text", "expected"), EXPRESSIONS, ids=[text for text, _ in EXPRESSIONS])
def test_expressions(text: str, expected: syntax.Expression) -> None:
    assert expression(text) == expected


def test_places_are_those_of_the_file() -> None:
    _, second = read("a := 1;\n  b := x +\n y;")
    assert isinstance(second, Assignment)
    assert second.place == Place(2, 3, 3, 3)
    assert second.value.place == Place(2, 8, 3, 3)


def test_a_colon_hides_what_a_semicolon_shows() -> None:
    assert [found.shown for found in read("a: b; c") if isinstance(found, Evaluation)] == [False, True]


def test_assignments() -> None:
    (one,) = read("a, b := x;")
    (same,) = read("(a, b) := x;")
    assert one == same == Assignment((A, B), X, place=HERE)
    (entry,) = read("f(t) := a:")
    assert entry == Assignment((call(name("f"), T),), A, place=HERE, shown=False)


def test_loops() -> None:
    (loop,) = read("for i from 1 by 2 to k while a do x; t: end do;")
    assert loop == syntax.For(
        (Evaluation(X, place=HERE), Evaluation(T, place=HERE, shown=False)),
        "i",
        integer(1),
        integer(2),
        K,
        condition=A,
        place=HERE,
    )
    (each,) = read("for x in a do next; break od:")
    assert each == syntax.For(
        (syntax.Next(place=HERE), syntax.Break(place=HERE)), "x", items=A, place=HERE, shown=False
    )


@pytest.mark.parametrize("end", ["end if", "end", "fi"])
def test_conditions(end: str) -> None:
    (found,) = read(f"if a then b elif x then t; else k {end};")
    a, b = (A, (Evaluation(B, place=HERE),)), (X, (Evaluation(T, place=HERE),))
    assert found == syntax.If((a, b), (Evaluation(K, place=HERE),), place=HERE)


def test_procedures() -> None:
    (found,) = read(
        "p := proc(a::{b, x}, m := 0, {k := 1}, $)::t; local i, j := 2; global b; option remember; uses plots;"
        " return a + i, j end proc:"
    )
    assert isinstance(found, Assignment)
    procedure = found.value
    assert isinstance(procedure, syntax.Procedure)
    assert procedure.parameters == (
        Parameter("a", SetDisplay((B, X), place=HERE), place=HERE),
        Parameter("m", None, integer(0), place=HERE),
        Parameter("k", None, integer(1), keyword=True, place=HERE),
        Parameter("$", rest=True, place=HERE),
    )
    assert (procedure.local, procedure.shared) == (("i", "j"), ("b",))
    assert (procedure.options, procedure.uses) == (("remember",), ("plots",))
    first, last = procedure.body
    assert first == Assignment((name("j"),), integer(2), place=HERE)
    assert isinstance(last, syntax.Return)


def test_an_operator_can_have_a_condition_as_its_body() -> None:
    found = expression("(x, t::a) -> if a then b end if")
    assert isinstance(found, syntax.Arrow)
    assert found.parameters == (Parameter("x", place=HERE), Parameter("t", A, place=HERE))
    assert isinstance(found.body, syntax.If)


def test_other_statements() -> None:
    found = read(
        'read "f"; save(a, b, "f"); error "a %1", x; try a catch "b": x finally t end try; local a; quit'
    )
    kinds = [syntax.Read, syntax.Save, syntax.Raise, syntax.Try, syntax.Declaration, syntax.Quit]
    assert [type(one) for one in found] == kinds
    assert found[1] == syntax.Save((A, B, Text("f", place=HERE)), place=HERE)


MISTAKES = [
    (
        "a := b c;",
        (
            "line 1, column 8: found 'c', expected an operator, ',' or ';' or ':'; a product is written with *, and a"
            " remark begins with #\n  a := b c;\n         ^"
        ),
    ),
    (
        "f(a;",
        "line 1, column 4: found ';', expected an operator, ',' or ')'\n  f(a;\n     ^",
    ),
    (
        "1 := a;",
        (
            "line 1, column 1: found something that cannot have a value before :=, expected a name, such as x, x[1] or"
            " f(t)\n  1 := a;\n  ^"
        ),
    ),
    (
        "for i to 3 do a;",
        (
            "line 1, column 17: the statement is not complete, expected an expression or 'end do'\n"
            "  for i to 3 do a;\n                  ^"
        ),
    ),
    (
        "m := module() end module;",
        (
            "line 1, column 15: found 'end', expected an operator, ',' or ';' or ':'; modules are not supported: write"
            " procedures, and a table for what they share\n  m := module() end module;\n                ^"
        ),
    ),
]


@pytest.mark.parametrize(("text", "message"), MISTAKES, ids=[text for text, _ in MISTAKES])
def test_mistakes(text: str, message: str) -> None:
    found = next(one for one in read(text) if isinstance(one, SyntaxMistake))
    assert found.message == message


def test_the_next_statement_runs() -> None:
    first, second = read("a := b c; d := 1;")
    assert isinstance(first, SyntaxMistake)
    assert second == Assignment((name("d"),), integer(1), place=HERE)


def test_a_loop_with_a_mistake_is_one_mistake() -> None:
    first, second = read("for i to 3 do a := b c; x; od; d := 1;")
    assert isinstance(first, SyntaxMistake)
    assert isinstance(second, Assignment)
