"""Matrices and vectors of both kinds."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "displays": (
        "<1,2>; <1|2>; <<1|2>,<3|4>>; <<a,b>|<c,d>>;",
        [
            "Vector[column]([[1], [2]])",
            "Vector[row]([1, 2])",
            "Matrix([[1, 2], [3, 4]])",
            "Matrix([[a, c], [b, d]])",
        ],
    ),
    "of the last value": (
        "[a,b]: <%>; a,b: <%>;",
        ["Vector[column]([[a], [b]])", "Vector[column]([[a], [b]])"],
    ),
    "products": (
        "M := <<1|2>,<3|4>>: v := <x,y>: M.v; v.v; M^2; M^(-1);",
        [
            "Vector[column]([[x+2*y], [3*x+4*y]])",
            "x^2+y^2",
            "Matrix([[7, 10], [15, 22]])",
            "Matrix([[-2, 1], [3/2, -1/2]])",
        ],
    ),
    "transposed": (
        "M := <<1|2>,<3|4>>: M^%T; LinearAlgebra[Transpose](M); LinearAlgebra:-Transpose(<a,b>);",
        ["Matrix([[1, 3], [2, 4]])", "Matrix([[1, 3], [2, 4]])", "Vector[row]([a, b])"],
    ),
    "eigenvalues of two matrices": (
        (
            "with(LinearAlgebra): K := <2,1/2;1/2,1/2>: M := <8/3,5/6;5/6,1/3>: Eigenvalues(K, M); "
            "v, V := Eigenvectors(evalf(K), M): map(round, 10^6*(K . V - M . V . DiagonalMatrix(v))); "
            "linalg[eigenvals](matrix([[2,0],[0,3]]), matrix([[1,0],[0,2]])); IdentityMatrix(2, 3);"
        ),
        [
            "Vector[column]([[6/7*7^(1/2)+3], [3-6/7*7^(1/2)]])",
            "Matrix([[0, 0], [0, 0]])",
            "3/2, 2",
            "Matrix([[1, 0, 0], [0, 1, 0]])",
        ],
    ),
    "evalm": (
        "A := matrix(2,2,[[1,2],[3,k]]): evalm(A &* A - 1); evalm(2*A+A); evalm(A^2);",
        [
            "matrix([[6, 2*k+2], [3*k+3, k^2+5]])",
            "matrix([[3, 6], [9, 3*k]])",
            "matrix([[7, 2*k+2], [3*k+3, k^2+6]])",
        ],
    ),
    "evalm of lists": (
        "evalm(w*[a,b]+[c,d]); convert(%,list);",
        ["vector([a*w+c, b*w+d])", "[a*w+c, b*w+d]"],
    ),
    "an unevaluated product": (
        "A := matrix([[1,2],[3,4]]): A &* A; evalm(%);",
        ["A &* A", "matrix([[7, 10], [15, 22]])"],
    ),
    "several names": (
        "a||(1..3); c||(x,y);",
        ["a1, a2, a3", "cx, cy"],
    ),
    "slices": (
        "M := Matrix(3,3,(i,j)->10*i+j): M[1..2,3]; M[2,2..3]; M[1..2,1..2]; M[-1,-1];",
        ["Vector[column]([[13], [23]])", "Vector[row]([22, 23])", "Matrix([[11, 12], [21, 22]])", "33"],
    ),
    "assignment to slices": (
        "v := <1,2,3>: v[2..3] := <8,9>: v;",
        ["Vector[column]([[1], [8], [9]])"],
    ),
    "linear equations": (
        "LinearAlgebra[GenerateMatrix]([a*x+y=1,x-y=2],[x,y]);",
        ["Matrix([[a, 1], [1, -1]]), Vector[column]([[1], [2]])"],
    ),
    "cross product": (
        "LinearAlgebra[CrossProduct](<1,0,0>,<0,1,0>);",
        ["Vector[column]([[0], [0], [1]])"],
    ),
    "packages": (
        "with(LinearAlgebra): Determinant(<<1|2>,<3|4>>), Trace(<<1|2>,<3|4>>), Dimension(<<1|2>,<3|4>>);",
        ["-2, 5, 2, 2"],
    ),
    "linalg": (
        "with(linalg): det(matrix([[1,2],[3,4]])); jacobian([x*y,x],[x,y]); ",
        ["-2", "matrix([[y, x], [1, 0]])"],
    ),
    "norms": (
        "norm(<3,4>,2), norm([1,-5],infinity);",
        ["5, 5"],
    ),
    "of a function": (
        "matrix(2,2,(i,j)->i+j);",
        ["matrix([[2, 3], [3, 4]])"],
    ),
    "zeros and sizes": (
        "Matrix(2); Vector(2); Matrix(1,2,[[a]]); vector([a,b]);",
        ["Matrix([[0, 0], [0, 0]])", "Vector[column]([[0], [0]])", "Matrix([[a, 0]])", "vector([a, b])"],
    ),
    "sums with scalars": (
        "2*<a,b>+<c,d>; <a,b>/2;",
        ["Vector[column]([[2*a+c], [2*b+d]])", "Vector[column]([[1/2*a], [1/2*b]])"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_matrices(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
