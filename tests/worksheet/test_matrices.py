"""Matrices and vectors of both kinds."""

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "entries without a value": (
        "with(linalg): M := matrix(2,2): M[1,1] := k: det(M); evalm(2*M); v := vector(2): v[1], assigned(v[1]);",
        ["M[2,2]*k-M[1,2]*M[2,1]", "matrix([[2*k, 2*M[1,2]], [2*M[2,1], 2*M[2,2]]])", "v[1], false"],
    ),
    "of blocks on the diagonal": (
        (
            "with(LinearAlgebra): DiagonalMatrix([1,2],3,3); DiagonalMatrix([Matrix([[a,b],[c,d]]),5]);"
            "linalg[diag](matrix([[a,b],[c,d]]),e);"
        ),
        [
            "Matrix([[1, 0, 0], [0, 2, 0], [0, 0, 0]])",
            "Matrix([[a, b, 0], [c, d, 0], [0, 0, 5]])",
            "matrix([[a, b, 0], [c, d, 0], [0, 0, e]])",
        ],
    ),
    "of sizes that are ranges": (
        "Matrix(1..2,1..2,1); Vector(1..2,i->i^2); Vector(1..2);",
        ["Matrix([[1, 1], [1, 1]])", "Vector[column]([[1], [4]])", "Vector[column]([[0], [0]])"],
    ),
    "transposed by a sign, and with conjugates": (
        "M := Matrix([[1,I],[2,3]]): M^+; M^%H; x^+2;",
        ["Matrix([[1, 2], [I, 3]])", "Matrix([[1, 2], [-I, 3]])", "x^2"],
    ),
    "cross products as an operator": (
        "with(LinearAlgebra): <1,0,0> &x <0,1,0>; `&o` := (a,b) -> a+b: 1 &o 2; a &p b;",
        ["Vector[column]([[0], [0], [1]])", "3", "`&p`(a,b)"],
    ),
    "rows and columns as a whole": (
        "M := Matrix(2,2): M[2,..] := <5|6>; M[..,1] := <1,2>: M;",
        ["M[2, ..] := Vector[row]([5, 6])", "Matrix([[1, 0], [2, 6]])"],
    ),
    "of equations": (
        "<x=1,y=2>; lhs~(<x=1,y=2>);",
        ["Vector[column]([[x = 1], [y = 2]])", "Vector[column]([[x], [y]])"],
    ),
    "converted to arrays": (
        "convert([1,2],array), convert([[1,2],[3,4]],array), convert(<1,2>,array);",
        ["vector([1, 2]), matrix([[1, 2], [3, 4]]), vector([1, 2])"],
    ),
    "extrema of entries": ("max(Matrix([[1,5],[2,a]])), min(<3,1>), max([2,3],1);", ["max(a,5), 1, 3"]),
    "of both kinds": (  # a name of a matrix of the old kind is no scalar beside a Matrix
        "A := Matrix([[1,2],[3,4]]): B := matrix([[a,b],[c,d]]): v := <x,y>: A.B; B.A; A+B; B.v; A*vector([p,q]);",
        [
            "Matrix([[a+2*c, b+2*d], [3*a+4*c, 3*b+4*d]])",
            "matrix([[a+3*b, 2*a+4*b], [c+3*d, 2*c+4*d]])",
            "Matrix([[a+1, b+2], [c+3, d+4]])",
            "vector([a*x+b*y, c*x+d*y])",
            "Vector[column]([[p+2*q], [3*p+4*q]])",
        ],
    ),
    "complex vectors": (
        (
            "with(LinearAlgebra): DotProduct(<I,1>,<1,1>); <I,1>.<I,1>; HermitianTranspose(<I,1>); "
            "linalg[dotprod]([I,1],[1,1]);"
        ),
        ["1-I", "2", "Vector[row]([-I, 1])", "1+I"],
    ),
    "row operations change the matrix itself only in place": (
        (
            "with(LinearAlgebra): A := <<1|2>,<3|4>>: RowOperation(A,[2,1],-3); A; "
            "RowOperation(A,[2,1],-3,inplace=true): A;"
        ),
        ["Matrix([[1, 2], [0, -2]])", "Matrix([[1, 2], [3, 4]])", "Matrix([[1, 2], [0, -2]])"],
    ),
    "a quotient by a matrix is a product by its inverse": (
        "A := Matrix([[1,2],[3,4]]): 2/A - 2*A^(-1); (1/A) . A; evalm(1/matrix([[2,0],[0,4]]));",
        ["Matrix([[0, 0], [0, 0]])", "Matrix([[1, 0], [0, 1]])", "matrix([[1/2, 0], [0, 1/4]])"],
    ),
    "one augmented matrix of equations": (
        "LinearAlgebra[GenerateMatrix]([u+2*v-3, u=v], [u,v], augmented=true);",
        ["Matrix([[1, 2, 3], [1, -1, 0]])"],
    ),
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
    "shapes that are kept": (
        (
            "J := Matrix(3,3,shape=symmetric): J[3,1] := -p: J[1,2..3] := <q,r>: J; B := J.J: B[1,2] := 5: B[2,1]; "
            "A := array(1..2,1..2,symmetric): A[1,2] := c: A[1,1] := 1: A[2,2] := 2: evalm(A); "
            "S := Matrix(2,shape=antisymmetric): S[2,1] := w: S; copy(S)[1,2];"
        ),
        [
            "Matrix([[0, q, r], [q, 0, 0], [r, 0, 0]])",
            "0",
            "matrix([[1, c], [c, 2]])",
            "Matrix([[0, -w], [w, 0]])",
            "-w",
        ],
    ),
    "shapes": (
        (
            "Matrix(3,shape=diagonal,[a,b,c]); Matrix(<a,b>,shape=diagonal); Matrix(2,2,[a,b],scan=diagonal); "
            "Matrix(2,{(1,1)=a,(1,2)=b},shape=symmetric); Matrix(2,{(1,2)=b},shape=antisymmetric); "
            "Matrix(2,(i,j)->i+j,shape=triangular[upper]); array(identity,1..2,1..2); "
            "array(symmetric,1..2,1..2,[(1,2)=b]);"
        ),
        [
            "Matrix([[a, 0, 0], [0, b, 0], [0, 0, c]])",
            "Matrix([[a, 0], [0, b]])",
            "Matrix([[a, 0], [0, b]])",
            "Matrix([[a, b], [b, 0]])",
            "Matrix([[0, b], [-b, 0]])",
            "Matrix([[2, 3], [0, 4]])",
            "matrix([[1, 0], [0, 1]])",
            "matrix([[?[1,1], b], [b, ?[2,2]]])",
        ],
    ),
    "blocks": (
        (
            "A := <<a|b>,<c|d>>: v := <x,y>: Matrix([[A,v],[<0|0>,1]]); Matrix([v,A]); Matrix([<1|2>,<3|4>]); "
            "<<A|v>,<v[1]|0|1>>;"
        ),
        [
            "Matrix([[a, b, x], [c, d, y], [0, 0, 1]])",
            "Matrix([[x, a, b], [y, c, d]])",
            "Matrix([[1, 2], [3, 4]])",
            "Matrix([[a, b, x], [c, d, y], [x, 0, 1]])",
        ],
    ),
    "sizes, places and directions": (
        (
            "Matrix(2,[a,b]); Vector[row](3,i->i^2); Vector(2,[a,b],orientation=row); Vector(3,{2=a}); "
            "Vector(2,[(1)=a]); convert([a,b],Vector[row]);"
        ),
        [
            "Matrix([[a, b], [0, 0]])",
            "Vector[row]([1, 4, 9])",
            "Vector[row]([a, b])",
            "Vector[column]([[0], [a], [0]])",
            "Vector[column]([[a], [0]])",
            "Vector[row]([a, b])",
        ],
    ),
    "sums with scalars": (
        "2*<a,b>+<c,d>; <a,b>/2;",
        ["Vector[column]([[2*a+c], [2*b+d]])", "Vector[column]([[1/2*a], [1/2*b]])"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_matrices(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_parts_that_do_not_fit_are_reported() -> None:
    assert failures("<<1,2>|<3,4,5>>; <<1|2>,<3|4|5>>; Vector(2,{3=a}); Vector(2,{a});") == [
        "Matrix: blocks side by side have 2 and 3 rows; expected the same number of rows in each",
        "Matrix: blocks below each other have 2 and 3 columns; expected the same number of columns in each",
        "Vector: the index is 3; expected 1 .. 2",
        "Vector: the entry is a; expected an equation such as (1) = a",
    ]


def test_vectors_of_different_sizes_have_no_product() -> None:
    (found,) = failures("LinearAlgebra[DotProduct](<1,2>, <1,2,3>);")
    assert "DotProduct: vectors of 2 and 3 components; expected as many" in found


def test_operations_on_rows_and_special_matrices_say_what_they_expect() -> None:
    sheet = (
        "with(LinearAlgebra): with(linalg): A := matrix([[0,1],[2,3]]): addrow(A,1,2); mulrow(A,3,k); "
        "RowOperation(A,[1,2,2]); pivot(A,1,1); ConstantMatrix(c,x); band([1,2],3); blockmatrix(2,2,[A,A]); "
        "MatrixPower(A,n); GenerateEquations(A,[x,y],[1]); diverge([x,y],[x]); curl([x,y],[x,y]);"
    )
    assert failures(sheet) == [
        "addrow: 3 arguments; expected 4",
        "mulrow: expected an index from 1 to 2",
        "RowOperation: expected (A, i, factor), (A, [i, j]) or (A, [i, j], factor)",
        "pivot: the entry (1, 1) is zero; expected another place",
        "ConstantMatrix: expected the number of rows and columns",
        "band: 2 entries; expected an odd number of them",
        "blockmatrix: 2 blocks; expected 2 x 2",
        "MatrixPower: expected a square matrix and a whole number",
        "GenerateEquations: 2 rows and 1 right sides; expected as many",
        "diverge: 2 components and 1 variables; expected as many",
        "curl: 2 components; expected three",
    ]
