"""Procedures, operators and their parameters."""

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "sums and products of functions": (
        "f := x -> x^2: g := D(f)+f: g(3); L := [sin, x->x^2]: (L[1]+L[2])(t), (2*f)(u); h := f*f-1: h(2);",
        ["15", "t^2+sin(t), 2*u^2", "15"],
    ),
    "names for the other part of a division": (
        (
            "irem(17,5,'q'), q; iquo(17,5,'r'), r; rem(x^3+1,x+2,x,'s'), s;"
            "p := proc() local k; irem(7,2,'k'); k end: p(), k;"
        ),
        ["2, 3", "3, 2", "-7, x^2-2*x+4", "3, k"],
    ),
    "local names that commands give a value": (
        (
            "p := proc(L) local pos; if member(3,L,'pos') then pos else 0 fi end: p([1,3]), pos;"
            "p := proc() local s, x, y; s := solve({x+y=3,x-y=1},{x,y}); assign(s); x*y end: p(), x;"
            "p := proc(e) local t; coeffs(e,z,'t'); [t] end: p(z^2+3);"
        ),
        ["2, pos", "2, x", "[1, z^2]"],
    ),
    "local names that lose their value, and entries": (
        (
            "p := proc(a) local b; b := a; unassign('b'); b end: p(3);"
            "p := proc() local A; A := Matrix(1,1); assign('A[1,1]'=5); A[1,1] end: p();"
            "p := proc() local a, b; a := 1; assigned('a'), assigned('b') end: p();"
        ),
        ["b", "5", "true, false"],
    ),
    "local tables beside those of the session": (
        (
            "T[1] := 5: p := proc() local T; T[1] := 9; T[1] end: p(), T[1];"
            "q := proc() local U; U[1] := 2; U[2] end: q();"
        ),
        ["9, 5", "U[2]"],
    ),
    "the last value": (
        "f := proc(x,y) local z; z := x+y; z^2 end proc: f(1,a);",
        ["(a+1)^2"],
    ),
    "return": (
        "f := proc(x) if x>0 then return 1 end if; 2 end proc: f(1), f(-1);",
        ["1, 2"],
    ),
    "recursive": (
        "f := proc(n) if n<=1 then 1 else n*f(n-1) end if end proc: f(10);",
        ["3628800"],
    ),
    "recursive by procname": (
        "f := proc(n) option remember; if n<=1 then 1 else n*procname(n-1) end if end proc: f(10);",
        ["3628800"],
    ),
    "nested": (
        "f := proc(x) local g; g := y -> x+y; g(2) end proc: f(a);",
        ["a+2"],
    ),
    "a default": (
        "f := proc(a,b:=5) a+b end proc: f(1), f(1,2);",
        ["6, 3"],
    ),
    "keywords": (
        'f := proc(a,{col:="x"}) col end proc: f(1), f(1,col="y");',
        ['"x", "y"'],
    ),
    "types of keywords": (
        "f := proc(x,{k::{1,-1}:=1, full::truefalse:=false}) [k*x, full] end: f(3,k=-1), f(3,full), f(k), f(3);",
        ["[-3, false], [3, true], [k, false], [3, false]"],
    ),
    "args and nargs": (
        "f := proc() nargs, args end: f(a,b); g := proc() add(args[i],i=1..nargs) end: g(1,2,3);",
        ["2, a, b", "6"],
    ),
    "types of objects": (
        "f := proc(B::BODY) B[mass] end proc: b1 := make_BODY(ground,m): f(b1);",
        ["m"],
    ),
    "local names are local": (
        "z := 7: f := proc() local z; z := 1 end proc: f(): z;",
        ["7"],
    ),
    "global names": (
        "f := proc() global z; z := 9; NULL end proc: f(): z;",
        ["9"],
    ),
    "an operator of two": (
        "f := (x,y) -> x*y: f(2,3);",
        ["6"],
    ),
    "composition": (
        "f := x->x^2: g := x->x+1: (f@g)(2), (f@@2)(3);",
        ["9, 81"],
    ),
    "an operator that is not named": (
        "map(x->x^2,[1,2]); (x->2*x)(a);",
        ["[1, 4]", "2*a"],
    ),
    "unapply": (
        "f := unapply(a*x^2,x): f(2); unapply(a*b,a);",
        ["4*a", "a -> a*b"],
    ),
    "an error that is caught": (
        'try error "bad %1", 3 catch "bad": 5 end try;',
        ["5"],
    ),
    "anti-bodies": (
        (
            "f := proc(B::BODY) local C; C := copy(B); C[mass] := -m; C end: B := make_BODY(ground,m): "
            "f(B)[mass];"
        ),
        ["-m"],
    ),
    "names of values are not those of parameters": (
        "e := x^2+y: f := proc(x) local y; y := 7; e+x end proc: f(2); e;",
        ["x^2+y+2", "x^2+y"],
    ),
    "a parameter t whose value is t": (
        "f := proc(t) diff(x(t),t) end proc: f(t);",
        ["diff(x(t),t)"],
    ),
    "packages inside a procedure": (
        "f := proc(M) uses LinearAlgebra; Transpose(M) end proc: f(<1,2>); Transpose(q);",
        ["Vector[row]([1, 2])", "Transpose(q)"],
    ),
    "operators as functions": (
        "`+`(a,b,c), `*`(op([a,b])), `if`(1<2,a,b);",
        ["a+b+c, a*b, a"],
    ),
    "a call that stays as it is written": (
        (
            "f := proc(x) if type(x,numeric) then x^2 else 'procname(args)' end if end: f(3), 2*f(a); subs(a=2,f(a)); "
            "g := proc(x) if type(x,numeric) then return x^2 end if; 'g'(x) end: g(a); eval(g(a),a=3); "
            "h := proc(x) if not type(x,numeric) then return 'procname'(args) end if; x^2 end: b := h(y)+1; y := 2: b;"
        ),
        ["9, 2*f(a)", "4", "g(a)", "9", "b := h(y)+1", "5"],
    ),
    "parameters in quotes": (
        (
            "f := proc(q) 'args', 'nargs', 'F(q)', diff('q',t) end: f(x(t)); "
            "g := proc(F,x) 'F(x)' end: g(u,2), g(sin,0); k := 7: f := proc() local k; 'k' end: f();"
        ),
        ["x(t), 1, F(x(t)), diff(x(t),t)", "u(2), 0", "k"],
    ),
    "RETURN, of old releases": (
        "f := proc(x) if x>0 then RETURN(1, x) fi; RETURN() end: f(a^0), [f(-1)]; g := proc(x) RETURN(x) end: g(5);",
        ["1, 1, []", "5"],
    ),
    "an alias hides a parameter": (
        "alias(c=cos): f := proc(x) c(x) end proc: f(0);",
        ["1"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_procedures(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_a_wrong_type_is_told() -> None:
    (message,) = failures("f := proc(n::integer) n end proc: f(a);")
    assert message == ("invalid input: f expects its 1st argument, n, to be of type integer, but received a")


def test_a_wrong_type_of_a_keyword_is_told() -> None:
    found = failures("f := proc(x,{k::{1,-1}:=1, m::positive:=2}) k*m*x end: f(3,k=a); f(3,m=-4);")
    assert found == [
        "invalid input: f expects value for keyword parameter k to be of type {-1, 1}, but received a",
        "invalid input: f expects value for keyword parameter m to be of type positive, but received -4",
    ]


def test_too_many_arguments_are_told_where_the_heading_ends() -> None:
    (message,) = failures("f := proc(n, $) n end proc: f(1,2);")
    assert "too many and/or wrong type of arguments passed to f; first unused argument is 2" in message


def test_an_error_of_the_sheet_is_told() -> None:
    (message,) = failures('f := proc(n) error "no %1", n end proc: f(3);')
    assert message == "(in f) no 3"
    for text in ('"no such case"', "`no such case`"):
        (message,) = failures(f"f := proc(n) ERROR({text}, n, n^2) end: f(3);")
        assert message == "(in f) no such case, 3, 9"


def test_a_missing_argument_that_is_used_is_told() -> None:
    text = "f := proc(a,b) if nargs > 1 then a + b else a end if end proc: g := (a,b) -> a*b: f(1), f(1,2);"
    assert printed(text) == ["1, 3"]
    (message,) = failures(text + "g(2);")
    assert message == "(in g) invalid input: g uses its argument 2, b, which is missing"


def test_names_that_a_procedure_is_given_get_values_where_it_was_called() -> None:
    text = """f := proc(a,b) b := a + 1; end proc: g := proc() local z; f(3,'z'); z end proc: k := proc(a,b) f(a,b) end:
    f(2,'y'): y; g(); z; k(6,'w'): w;"""
    assert printed(text) == ["3", "4", "z", "7"]
