"""if and not decide by equality of values."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
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
