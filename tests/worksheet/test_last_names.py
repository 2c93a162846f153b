"""Tables, procedures and old matrices are evaluated to their last name: what is assigned is shared."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "a table": (
        "T := table([mass=2]): U := T: U[mass] := 5: T[mass]; U;",
        ["5", "T"],
    ),
    "copy shares nothing": (
        "T := table([mass=2]): U := copy(T): U[mass] := 5: T[mass], U[mass];",
        ["2, 5"],
    ),
    "an old matrix": (
        "A := matrix(2,2,[[a,b],[c,d]]): B := A: B[1,1] := 9: A[1,1]; A; evalm(A);",
        ["9", "A", "matrix([[9, b], [c, d]])"],
    ),
    "a new matrix is shared and prints in full": (
        "M := Matrix([[1,2],[3,4]]): N := M: N[1,1] := 0: M;",
        ["Matrix([[0, 2], [3, 4]])"],
    ),
    "sets and lists of bodies hold names": (
        "B1 := make_BODY(ground,m1): B2 := make_BODY(ground,m2): S := {B1,B2}; L := [B2,B1];",
        ["S := {B1, B2}", "L := [B2, B1]"],
    ),
    "and see a body that is redefined": (
        "B := make_BODY(ground,m): S := {B}: B := make_BODY(ground,2*m): op(S)[mass];",
        ["2*m"],
    ),
    "a parameter that is a table changes the caller's": (
        "P := proc(T) T[mass] := 8; NULL end proc: B := table([mass=2]): P(B): B[mass];",
        ["8"],
    ),
    "a table inside a procedure": (
        "P := proc() local T; T := table(); T[1] := 4; T end proc: U := P(): U[1];",
        ["4"],
    ),
    "names of bodies in what is rewritten": (
        (
            "B := make_BODY(ground,m): S := simplify({B}); F := make_TORQUE(ground,u,0,0,B): "
            "map(simplify,F)[acting];"
        ),
        ["S := {B}", "B"],
    ),
    "a procedure": (
        "f := proc(x) x^2 end proc: g := f: g; g(3);",
        ["f", "9"],
    ),
    "a table that no one declared": (
        "s[3] := a: s[3]; s;",
        ["a", "s"],
    ),
    "an entry of an entry": (
        "T[1] := table([k=2]): T[1][k] := 3: T[1][k];",
        ["3"],
    ),
    "an object's field": (
        "B := make_BODY(ground,m,Ix,Iy,Iz): B[mass] := 2*m: B[mass]; B[inertia][1,1];",
        ["2*m", "Ix"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_last_names(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
