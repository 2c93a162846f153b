"""Printed values: equal by value, different, or not comparable with a reason."""

from __future__ import annotations

import pytest

from symbody.worksheet.check.compare import difference
from symbody.worksheet.check.printed import NotComparable

EQUAL = [
    ("l^2, l^2", "l^2, l*l"),
    ("a := x^`'`+2*`y''`", "a := diff(x(t),t)+2*diff(y(t),`$`(t,2))"),
    ("v := diff(x(t),t,t)", "v := D(D(x))(t)*0+diff(x(t), t$2)"),
    ("D(u)(t)", "diff(u(t),t)"),
    ("theta^`'`*theta", "theta(t)*diff(theta(t),t)"),
    ("x = y", "x = y"),
    ("cos(theta[1](t)+theta[2](t))", "cos(theta[1])*cos(theta[2])-sin(theta[1])*sin(theta[2](t))"),
    ("a+b = c", "a-c = -b"),
    ("{a, b, c}", "{c, a, b}"),
    ("T := matrix([[1, 0], [0, cos(q(t))]])", "T := Matrix([[1,0],[0,sin(q(t)+1/2*Pi)]])"),
    ("coords = matrix([[a], [b]])", "coords = [a, b]"),
    (
        "P = POINT(frame = ground,coords = matrix([[0], [1]]))",
        "P = POINT(coords = matrix([[0],[1]]),frame = ground)",
    ),
    (
        "P = POINT(frame = TT,coords = matrix([[0]]))",
        "P = POINT(frame = matrix([[1,0],[0,1]]),coords = matrix([[0]]))",
    ),
    ("x := .3333333333*F(a)+1.414213562*y(t)", "x := 1/3*F(a)+sqrt(2)*y(t)"),
    ("x := 1..3", "x := 1 .. 3"),
    (".3333333333*x(t)*cos(q(t))*sin(q(t))", "1/6*x(t)*sin(2*q(t))"),
    ("1.5*x/(y+z)-.2e-9*y", "3/2*x/(y+z)"),
    ("-.2e-9*x", "0"),
    ("D[1](f)(x,y)+D[2,2](f)(x,0)", "diff(f(x,y),x)+D[2$2](f)(x,0)"),
    ("cos(f(x))*D(f)(x)+(D@@2)(g)(x)+D(sin)(x)", "diff(sin(f(x)),x)+diff(g(x),x,x)+cos(x)"),
    ("P = POINT(frame = master_frame,coords = [0])", "P = POINT(coords = [0],frame = ground)"),
    ("P = POINT(coords = [0])", "P = POINT(coords = [0],frame = ground)"),
    ('"a b"', '"a b"'),
    ("g := (x, y) -> x^2*y", "g := (a, b) -> b*a^2"),
    ("x-1/6*x^3+O(x^4)", "x-x^3/6+O(x^4)"),
    ("s := series(1*x-1/6*x^3+O(x^4),x,4)", "s := x-x^3/6+O(x^4)"),
    ("[t = 0., x(t) = 1., y(t) = 2.]", "[t = 0, y(t) = 2., x(t) = 1.]"),
    ("``(2)^2*``(3)", "``(3)*``(2)^2"),
    ("p := proc(x) x^2 end proc", "p := proc (a) a*a end proc"),
    ("f := x -> x^2", "f := proc (x) options operator, arrow; x^2 end proc"),
    ("p := proc(x) local y; y := x; 2*y end proc", "p := proc (x) local y; y := x; 2*y end proc"),
    ("v := Vector[row]([1, 2])", "v := Vector[row]([1,2])"),
    ("v := Vector[column]([1, 2])", "v := Vector[column]([[1],[2]])"),
    ("M := Matrix(2, 2, {(1, 1) = 1, (1, 2) = 3, (2, 1) = 2, (2, 2) = 4})", "M := Matrix([[1,3],[2,4]])"),
    ("v := Vector(2, {(1) = 1, (2) = c})", "v := Vector[column]([[1], [c]])"),
    ("M := Matrix(2, 2, {(1, 1) = 1, (2, 2) = 1}, storage = diagonal)", "M := Matrix([[1, 0], [0, 1]])"),
    ("T := table([b = [1, 2], a = x(t)])", "T := table([a = x(t), b = [1,2]])"),
    ("x := 2 L cos(beta) - m1 g theta", "x := 2*L*cos(beta)-m1*g*theta"),
    # Cut, but something is complete.
    ("TN := matrix([[ux, vx], [uy, vy*cos(...", "TN := matrix([[ux,vx],[uy,vy+1],[0,0]])"),
    (
        "A = POINT(frame = TN,coords = matrix([[0], [0]...",
        "A = POINT(frame = TN,coords = matrix([[0],[0],[1]])), B = 3",
    ),
    ("s := {b = 2, a...", "s := {a = 1, b = 2}"),
    ("1, x*...", "1, y"),
]


@pytest.mark.parametrize(("theirs", "ours"), EQUAL, ids=[theirs for theirs, _ in EQUAL])
def test_equal(theirs: str, ours: str) -> None:
    assert not difference(theirs, ours)


DIFFERENT = [
    ("a := x", "b := x", "the file has a, the run b"),
    ("a := x+1", "a := x", "the file has x+1, the run x"),
    ("[a, b]", "[a, b, c]", "the file has 2 items, the run 3"),
    ("[a, [b, c]]", "[a, [b, d]]", "[2] [2] the file has c, the run d"),
    ("{a, b}", "{a}", "the run doesn't have b"),
    ("{a}", "{a, b}", "the file doesn't have b"),
    ("P = POINT(coords = [0])", "P = POINT(coords = [1])", "coords: [1] the file has 0, the run 1"),
    ("P = POINT(coords = [0])", "P = VECTOR(coords = [0])", "the file has POINT(..), the run VECTOR(..)"),
    ("x := .33*a", "x := 1/3*a", "the file has .33*a, the run 1/3*a"),
    ("x < y", "x <= y", "< became <="),
    (
        "M := Matrix(1, 2, {(1, 1) = 1, (1, 2) = 5})",
        "M := Matrix([[1, 4]])",
        "[1] [2] the file has 5, the run 4",
    ),
    (
        "2.1e11*x+7800.*y",
        "2.1e11*x+7200.*y",
        "the file has .21e12*x+7800.*y, the run .21e12*x+7200.*y",
    ),
    ("2.1e11*x+.3*z", "2.1e11*x-.3*z", "the file has .21e12*x+.3*z, the run .21e12*x-.3*z"),
    ("3e-10*x", ".7e-9*x", "the file has .3e-9*x, the run .7e-9*x"),
    (
        "1e9*sin(2*x)+7.*y",
        "2e9*sin(x)*cos(x)+8.*y",
        "the file has 1000000000.*sin(2*x)+7.*y, the run 2000000000.*cos(x)*sin(x)+8.*y",
    ),
    ("D[1](f)(x,y)", "diff(f(x,y),y)", "the file has diff(f(x,y),x), the run diff(f(x,y),y)"),
    (
        "P = POINT(frame = ground,a = 0)",
        "P = POINT(frame = matrix([[1,2],[0,1]]),a = 0)",
        "frame: the file has ground, the run a matrix that isn't the identity",
    ),
    (
        "P = POINT(frame = matrix([[1,2],[0,1]]),a = 0)",
        "P = POINT(frame = ground,a = 0)",
        "frame: the file has a matrix that isn't the identity, the run ground",
    ),
    ("P = POINT(a = 0)", "P = POINT(frame = T,a = 0)", "the file has no field frame"),
    ("P = POINT(frame = ground)", "P = POINT(frame = T)", "frame: the file has ground, the run T"),
    ("P = POINT(frame = T,a = 1)", "P = POINT(frame = TT,a = 2)", "a: the file has 1, the run 2"),
    ("abs(x)", "x^2/2", "the file has abs(x), the run 1/2*x^2"),
    ("g := x -> x^3", "g := x -> x^2", "the file has x^3, the run x^2"),
    ("g := (u,v) -> u*v + u", "g := (x,y) -> x*y", "the file has u*v+u, the run x*y"),
    ("g := (u,v) -> u", "g := u -> u", "the number of parameters is 2 in the file, 1 in the run"),
    ("table([b = 1, a = 2])", "table([a = 1, b = 1])", "a: the file has 2, the run 1"),
    (
        "p := proc(x) x^3 end proc",
        "p := proc(x) x^2 end proc",
        "the file has x^3, the run x^2",
    ),
    ("v := Vector[row]([1, 2])", "v := Vector[column]([1, 2])", "the file has a row, the run a column"),
    ("x := 3", "x := matrix([[1, 2]])", "the file has an expression, the run a list"),
    ("[a, b, ...", "[a, c, d]", "[2] the file has b, the run c"),
]


@pytest.mark.parametrize(("theirs", "ours", "where"), DIFFERENT, ids=[theirs for theirs, _, _ in DIFFERENT])
def test_different(theirs: str, ours: str, where: str) -> None:
    assert difference(theirs, ours) == where


def test_long_sums() -> None:
    terms = "+".join(f"{k + 2}*a{k}" for k in range(900))
    assert not difference(terms, terms)
    assert not difference(terms, f"1+{terms}-1")
    assert difference(terms, f"{terms}+1").startswith("the file has 2*a0+3*a1+")


REASONS = [
    ("1/9*(m*l^2*diff(xA(t),`$`(t,2))+...", "3", "cut before anything complete"),
    ("276*multiplications+9*additions", "3*multiplications", "a count of operations"),
    ("a b c", "3", "it can't be read as a value"),
    ("[a]", "a", "the file has a list, the run an expression"),
    ("P = POINT(frame = T,a = 1)", "P = POINT(frame = TT,a = 1)", "the frame is called T in the file"),
    ("a and b", "a", "and in it has no value"),
    (
        "p := proc(x) local y; y := x; y end proc",
        "p := proc(x) x end proc",
        "a procedure of several statements",
    ),
]


@pytest.mark.parametrize(("theirs", "ours", "reason"), REASONS, ids=[theirs for theirs, _, _ in REASONS])
def test_not_comparable(theirs: str, ours: str, reason: str) -> None:
    with pytest.raises(NotComparable, match=reason):
        difference(theirs, ours)
