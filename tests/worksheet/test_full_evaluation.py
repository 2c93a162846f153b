"""A name that is assigned later changes all that was built with it, when that is used."""

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "a name that was local elsewhere": (
        "p := proc() local x; x := y; y := 3; x end: p(); y := 'y': s := {x=1,y=2}: assign(s): s;",
        ["y", "{1 = 1, 2 = 2}"],
    ),
    "an expression": ("a := w-b: b := 2: a;", ["w-2"]),
    "through a chain of names": ("a := b: b := c: c := 7: a; c := 8: a;", ["7", "8"]),
    "a name that loses its value": ("a := b+1: b := 2: a; b := 'b': a;", ["3", "b+1"]),
    "a list and an equation": ("L := [p, q = p]: p := 5: L; L[1];", ["[5, q = 5]", "5"]),
    "a part of a list": (
        (
            "L := [a*x, b, a*y]: a := u(t): subs(u(t)=V,L[2..3]); diff(L[1..1],t); has(L[1..2],u(t)); "
            "map(diff,[L[]],t); subs(u(t)=V,L[[1,3]]);"
        ),
        ["[b, V*y]", "[x*diff(u(t),t)]", "true", "[x*diff(u(t),t), 0, y*diff(u(t),t)]", "[V*x, V*y]"],
    ),
    "an entry of a table": ("T[1] := 2*p: p := 5: T[1];", ["10"]),
    "an entry of a matrix": ("A := matrix(1,1,[[p]]): p := 5: A[1,1]; evalm(A);", ["5", "matrix([[5]])"]),
    "inside a loop": (
        "q := evalf(Pi*n/4): for n from 1 to 2 do q; od;",
        [".7853981635", "1.570796327"],
    ),
    "a function of time that gets a value": ("e := 2*f(t): f(t) := V*t: e; diff(f(t),t);", ["2*V*t", "V"]),
    "at another argument it has none": ("x(t) := V*t: x(0);", ["x(0)"]),
    "a name made by concatenation": ("e := FzB(t): k := B: Fz||k(t) := 0: FzB(t);", ["0"]),
    "a function that becomes an operator": ("e := h(2)+h(t): h := x -> x^2: e;", ["t^2+4"]),
    "the head of a call": (
        "e := f(q)(z): q := 3: e; f := x -> y -> x*y: e; e := g(k)(z): g(2) := sin: k := 2: e;",
        ["f(3)(z)", "3*z", "sin(z)"],
    ),
    "the old value in a cycle": ("theta := 3*u: theta := subs(u=v, theta): theta;", ["3*v"]),
    "a frame and a point": (
        "T := translate(a,0,0): P := origin(T): a := 5: comp_X(P,ground);",
        ["5"],
    ),
    "an indexed name": ("e := 2*a[1]: a[1] := 4: e;", ["8"]),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_values_are_evaluated_when_they_are_used(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_a_name_that_would_hold_itself_is_an_error() -> None:
    (message,) = failures("x := x + 1;")
    assert message == "recursive assignment: x has no value that its new value could use"


def test_a_name_without_a_value_that_gets_itself_stays_without() -> None:
    assert printed("x := 5: x := 'x': x;") == ["x"]


def test_names_that_hold_each_other_do_not_hang() -> None:
    assert printed("a := b: b := a: a;") == ["b"]


def test_restart_forgets_everything() -> None:
    assert printed("x := 3: f(t) := 5: alias(c=cos): restart: x, f(t), c;") == ["x, f(t), c"]


def test_derivatives_of_functions_that_get_a_value_later() -> None:
    sheet = "g := h(x)+diff(h(x),x): k := diff(h(q(t)),t): h := z -> z^2: g; k; h := sin: g; h := 'h': h(x) := x^3: g;"
    assert printed(sheet) == ["x^2+2*x", "2*q(t)*diff(q(t),t)", "cos(x)+sin(x)", "x^3+3*x^2"]
    sheet = (
        "e := subs(f=sin,f(x)+diff(f(x),x)): e; diff(e,x); subs(f=cos,f(0)); subs(f=(z->z^2),diff(f(q(t)),t)); "
        "subs(f=g,f(x));"
    )
    assert printed(sheet) == ["cos(x)+sin(x)", "cos(x)-sin(x)", "1", "2*q(t)*diff(q(t),t)", "g(x)"]
