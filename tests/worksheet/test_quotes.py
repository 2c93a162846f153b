"""Quotes strip one level each evaluation."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "a name": (
        "x := 3: 'x'; x;",
        ["x", "3"],
    ),
    "a function": (
        "'sin(arctan(lambda))'; %;",
        ["sin(arctan(lambda))", "lambda/(lambda^2+1)^(1/2)"],
    ),
    "in an equation": (
        "W := 5: 'W' = W;",
        ["W = 5"],
    ),
    "two levels": (
        "x := 3: ''x''; %; %;",
        ["'x'", "x", "3"],
    ),
    "an axis without quotes": (
        "comp(X,make_VECTOR(ground,u,v,w));",
        ["u"],
    ),
    "a concatenation": (
        "n := 2: 'a||n';",
        ["a2"],
    ),
    "a string with more behind it": (
        'n := 2: "case "||n; "a"||(1..2)||".txt"; a||"b"; cat("res",n,".dat");',
        ['"case 2"', '"a1.txt", "a2.txt"', "ab", '"res2.dat"'],
    ),
    "an entry of an entry": (
        (
            "assign('T[1][b]' = 3); T[1][b]; W := 'T[1][b]': T[1][b] := 4: W; "
            "assigned('T[1][b]'), assigned('T[1][c]'); unassign('T[1][b]'): T[1][b]; "
            "L := [[1, 2], [3, 4]]: 'L[2][1]'; %;"
        ),
        ["3", "4", "true, false", "T[1][b]", "L[2][1]", "3"],
    ),
    "unassign by a quoted name": (
        "x := 3: unassign('x'): x;",
        ["x"],
    ),
    "an entry": (
        "T[1] := 4: 'T[1]';",
        ["T[1]"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_quotes(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
