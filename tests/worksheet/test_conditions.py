"""if and not decide by equality of values."""

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.run import outcomes
from tests.worksheet.printed_by import printed

CASES = {
    "what can't be decided": (
        "evalb(a<b), is(a<b), is(3,integer); is(x>0) assuming x>0;",
        ["a < b, FAIL, true", "true"],
    ),
    "by value": (
        "if sin(x)^2+cos(x)^2=1 then yes else no end if;",
        ["yes"],
    ),
    "not": (
        "if not (a=b) then 1 else 2 fi;",
        ["1"],
    ),
    "lists entry by entry": (
        "evalb([a,(b+1)^2]=[a,b^2+2*b+1]);",
        ["true"],
    ),
    "matrices": (
        "if Matrix([[0,0],[0,0]])=0 then zero fi; if matrix([[1]])<>matrix([[2]]) then differ fi;",
        ["zero", "differ"],
    ),
    "a norm that is not zero": (
        "if norm([a,0,0],2)<>0 then long else null fi;",
        ["long"],
    ),
    "numbers": (
        "if Pi>3 and 2<=2 then ok fi; if 1>2 or 2>1 then ok fi;",
        ["ok", "ok"],
    ),
    "elif": (
        "for k to 3 do if k=1 then a elif k=2 then b else c fi od:",
        [],
    ),
    "what can't be decided stays": (
        "c := x > 0: true and not c; false or c; c and y > 0; not (3 > 2); false and c;",
        ["x <= 0", "0 < x", "(0 < x) and (0 < y)", "false", "false"],
    ),
    "names without a value stay in operators of logic": (
        (
            "not a; not not a; a and b; not (a or b) and c; true and b; a and false; a or true; a xor b; "
            "evalb(a and b); "
            "h := (x > 3) and deep: x := 5: h; deep := true: h; map(`not`, [true, false]);"
        ),
        [
            *("not a", "a", "a and b", "not (a or b) and c", "b", "false", "true", "a xor b", "a and b"),
            *("deep", "true", "[false, true]"),
        ],
    ),
    "assumptions": (
        (
            "e := sqrt(m^2)*abs(k): assume(m > 0): e; is(m > 0), is(-m > 0); sqrt(k^2) assuming k > 0; "
            "additionally(k, positive): e; sqrt(m^2*x); m := 'm': e; [sqrt(q^2), abs(p)] assuming q > 0, p::positive;"
        ),
        ["m*abs(k)", "true, false", "k", "k*m", "m*x^(1/2)", "k*abs(m)", "[q, p]"],
    ),
    "in an operator": (
        "s := x -> if x>0 then 1 else -1 end if: s(2), s(-2);",
        ["1, -1"],
    ),
    "member": (
        "member(b,[a,b]), a in {a,c};",
        ["true, true"],
    ),
    "types": (
        "type(3,integer), type(x,name), type([1],list), type(a=b,equation), type(2.5,float);",
        ["true, true, true, true, true"],
    ),
    "assigned": (
        "u := 1: assigned(u), assigned(v), assigned(T[1]);",
        ["true, false, false"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_conditions(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_assumptions_that_are_not_used_are_told() -> None:
    cells = source_cells("assume(m < 5): assume(n, integer): assume(k, real): assume(x(t) > 0):")
    assert [each.notices for each in outcomes(cells, Interpreter())] == [
        ("assume: m < 5 is not used; names count as real, or as positive if that is assumed",),
        ("assume: n::integer is not used; names count as real, or as positive if that is assumed",),
        (),
        ("assume: 0 < x(t) is not used; names count as real, or as positive if that is assumed",),
    ]
