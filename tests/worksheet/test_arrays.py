"""Arrays by the bounds of their indices."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.worksheet.printed_by import failures, printed


@pytest.mark.parametrize(
    ("statements", "lines"),
    [
        ("A := Array(0..2, [5,6,7]): A[0], A[1], A[2];", ["5, 6, 7"]),
        ("A := Array(0..2, [5,6,7]);", ["A := Array(0 .. 2, [5, 6, 7])"]),
        ("A := Array(0..2, [5,6,7]): A[1..2];", ["Vector[column]([[6], [7]])"]),
        ("A := Array(0..2, [5,6,7]): A[0] := 9: A;", ["Array(0 .. 2, [9, 6, 7])"]),
        ("A := Array(0..2, [5,6,7]): B := copy(A): B[0] := 1: A[0], B;", ["5, Array(0 .. 2, [1, 6, 7])"]),
        ("A := Array(0..1, [x,x^2]): diff(A, x); map(sin, A)[0];", ["Array(0 .. 1, [1, 2*x])", "sin(x)"]),
        ("A := Array(0..1, [5,6]): 2*A; A+A;", ["Array(0 .. 1, [10, 12])"] * 2),
        ("A := Array(0..1, [a,6]): subs(a=1, A); convert(A, list);", ["Array(0 .. 1, [1, 6])", "[a, 6]"]),
        ("A := Array(-1..1): for k from -1 to 1 do A[k] := k^3 od: A;", ["Array(-1 .. 1, [-1, 0, 1])"]),
        ("A := Array(0..1, [5,6]): indices(A);", ["[0], [1]"]),
        ("C := Array(0..1, 0..1, (i,j)->10*i+j): C[0,1], C[1,0]; C[0,..];", ["1, 10", "Vector[row]([0, 1])"]),
        ("C := Array(0..1, 2..3, {(1,3)=c}): C;", ["Array(0 .. 1, 2 .. 3, [[0, 0], [0, c]])"]),
        ("Array(1..2, 1..2, (i,j)->i+j);", ["Matrix([[2, 3], [3, 4]])"]),
        ("Array(1..2, fill=7);", ["Vector[column]([[7], [7]])"]),
        ("Array(1..3, [1,2]);", ["Vector[column]([[1], [2], [0]])"]),
        ("Array(2, 2);", ["Matrix([[0, 0], [0, 0]])"]),
        ("E := Array(1..2, 1..2, 1..2): E[1,2,1] := 5: E[1,2,1], E[2,2,2];", ["5, 0"]),
        ("B := array(0..2, [(0)=5, (1)=6]): B[0], B[1]+B[2];", ["5, B[2]+6"]),
        ("B := array(-1..1): B[-1] := 3: B[-1], B[0]; B[0] := 4: B[0];", ["3, B[0]", "4"]),
        ("B := array(1..2): B[2] := 4: B[1]*B[2];", ["4*B[1]"]),
    ],
)
def test_indices_are_those_of_the_bounds(statements: str, lines: list[str]) -> None:
    assert printed(statements) == lines


@pytest.mark.parametrize("made", ["Array(0..1, [a,b])", "array(0..1, -1..0, [[a,b],[c,d]])"])
def test_saved_arrays_are_read_with_their_bounds(made: str, tmp_path: Path) -> None:
    before = printed(f'A := {made}: print(A); save A, "a.m":', tmp_path)
    assert printed('read "a.m": print(A);', tmp_path)[-1:] == before


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ("Array(0..2)[3];", "the index 3 is out of range; expected one from 0 to 2"),
        ("Array(0..2)[-1];", "the index -1 is out of range; expected one from 0 to 2"),
        ("Array(0..2)[1..3];", "the range 1 .. 3 is out of range; expected one within 0 .. 2"),
        ("Matrix(2,2)[1,2,3];", "3 indices for a matrix of 2 x 2; expected two"),
        ("Array(1..2, [a,b,c]);", "Array: a value for the index 3; expected indices within 1 .. 2"),
        ("Array(0..n);", "Array: the bounds 0 .. n; expected two integers, such as 0 .. 2"),
        (
            "Array(1..1, 1..1, 1..1, [a]);",
            "Array: values for 3 indices; expected at most two, or a function of the indices",
        ),
    ],
)
def test_indices_and_values_outside_are_refused(statement: str, message: str) -> None:
    assert failures(statement) == [message]


def test_lists_of_matrices_are_by_columns() -> None:
    assert printed("convert(Matrix([[a,b],[c,d]]), list); convert(<a|b>, list);") == [
        "[a, c, b, d]",
        "[a, b]",
    ]
