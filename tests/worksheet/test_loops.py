"""Loops, and what they print."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "values of the first level": (
        "for i from 1 to 2 do i, i^2; od;",
        ["1, 1", "2, 4"],
    ),
    "a colon prints nothing": (
        "for i to 2 do i; od:",
        [],
    ),
    "a second level prints nothing": (
        "for i to 2 do for j to 2 do i*j; od; od;",
        [],
    ),
    "down": (
        "for i from 3 to 1 by -1 do i end do;",
        ["3", "2", "1"],
    ),
    "items": (
        "for v in [p,q] do v; end do;",
        ["p", "q"],
    ),
    "while": (
        "w := 0: while w<3 do w := w+1: end do: w;",
        ["3"],
    ),
    "the variable after the loop": (
        "for i from 1 to 3 do od: i;",
        ["4"],
    ),
    "break and next": (
        "for i to 9 do if i=2 then next fi; if i=4 then break fi; s||i := i: od: s1, s2, s3, i;",
        ["1, s2, 3, 4"],
    ),
    "an assignment to entries": (
        "for i to 3 do a[i] := i*x od: a[2], a[3];",
        ["2*x, 3*x"],
    ),
    "a deeper print level": (
        "printlevel := 2: for i to 1 do if true then i end if end do;",
        ["1"],
    ),
    "print inside": (
        "for i to 2 do print(i) od:",
        ["1", "2"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_loops(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
