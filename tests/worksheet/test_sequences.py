"""Sequences flatten everywhere, and NULL disappears."""

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "an index that has a value is quoted": (
        "i := 3: sum('i^2','i'=1..2); product('i','i'=1..3); f := proc(n) local i; sum(i^2,i=1..n) end: f(3);",
        ["5", "6", "14"],
    ),
    "of letters and names": (
        'seq("a".."c"); seq(p..r); [seq(k^2, k=u..w)];',
        ['"a", "b", "c"', "p, q, r", "[u^2, v^2, w^2]"],
    ),
    "conditions of all operands, or of one": (
        "andmap(type, [a,2], integer); ormap(type, {a,2}, integer); andmap(x -> x > 1, [2,3]);",
        ["false", "true", "true"],
    ),
    "read from a text, and printed as one": (
        'sscanf("3 4.5, ab", "%d %f, %s"); sscanf("12x", "%1d%dx%d"); sscanf("a", "%d"); sprintf("%q|", 1, a, "b");',
        ['[3, 4.5, "ab"]', "[1, 2]", "[]", '"1, a, \\"b\\"|"'],
    ),
    "the names that have values": (
        "a := 1: b := [2]: f(t) := 3: anames();",
        ["a, b"],
    ),
    "in a list": (
        "s := a,b: [s,c,NULL];",
        ["[a, b, c]"],
    ),
    "in a call": (
        "f(op([1,2]),3);",
        ["f(1,2,3)"],
    ),
    "seq": (
        "seq(i^2,i=1..4), seq(k,k={a,b}), seq(x*2,x in [p,q]);",
        ["1, 4, 9, 16, a, b, 2*p, 2*q"],
    ),
    "a step": (
        "seq(i,i=0..1,0.5);",
        ["0, .5, 1."],
    ),
    "dollar": (
        "x$3; k^2 $ k=1..3; [i*10 $ i=1..2];",
        ["x, x, x", "1, 4, 9", "[10, 20]"],
    ),
    "Translate takes several from one": (
        "Translate(comp_XYZ(make_VECTOR(ground,1,2,3)))[1,4];",
        ["1"],
    ),
    "several names": (
        "a||(1..3); c||(x,y);",
        ["a1, a2, a3", "cx, cy"],
    ),
    "slices": (
        "L := [a,b,c,d]: L[2..3]; L[-2..-1]; L[2..-1]; L[-1];",
        ["[b, c]", "[c, d]", "[b, c, d]", "d"],
    ),
    "several assignments": (
        "a, b := 1, 2: (c,d) := b, a: c, d;",
        ["2, 1"],
    ),
    "the index keeps its value": (
        "i := 7: seq(i,i=1..2): i;",
        ["7"],
    ),
    "add and mul": (
        "add(i,i=1..4), mul(i,i=1..4), add([a,b]);",
        ["10, 24, a+b"],
    ),
    "sum with a quoted index": (
        "c := [p,q]: sum('lambda||k(t)*c['k']','k'=1..2); sum('lambda||k(t)'*c['k'],'k'=1..2);",
        ["p*lambda1(t)+q*lambda2(t)", "p*lambda1(t)+q*lambda2(t)"],
    ),
    "union joins lists": (
        "[a,b] union [b]; {a,b} union {b,c}; {a,b} minus {b}; {a,b} intersect {b};",
        ["[a, b, b]", "{a, b, c}", "{a}", "{b}"],
    ),
    "a sum of a name": (
        "sum(k,k=1..n); sum(q[k],k=1..n);",
        ["1/2*n^2+1/2*n", "sum(q[k],k = 1 .. n)"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_sequences(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_several_functions_at_one_argument() -> None:
    sheet = "[(f,g)(x)]; [q||(1..3)(t)]; 'q||(1..2)(t)'; diff([q||(a,b)(t)],t); {f,g}(x); (sin,cos)(0); [q||(1..2)];"
    assert printed(sheet) == [
        "[f(x), g(x)]",
        "[q1(t), q2(t), q3(t)]",
        "q1(t), q2(t)",
        "[diff(qa(t),t), diff(qb(t),t)]",
        "{f(x), g(x)}",
        "0, 1",
        "[q1, q2]",
    ]


@pytest.mark.parametrize("sheet", ["i := 3: sum(i^2,i=1..n);", "i := 3: product(i,i=1..2);"])
def test_an_index_that_has_a_value_is_an_error(sheet: str) -> None:
    assert "the index i has the value 3 already" in failures(sheet)[0]
