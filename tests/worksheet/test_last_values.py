"""% is the last value that isn't NULL; procedures have their own."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "of a statement that prints nothing": (
        "a+b: %^2;",
        ["(a+b)^2"],
    ),
    "of an assignment": (
        "u := 3*k: %;",
        ["3*k"],
    ),
    "the one before": (
        "p; q; %%;",
        ["p", "q", "p"],
    ),
    "three back": (
        "p: q: r: %%%;",
        ["p"],
    ),
    "NULL leaves it alone": (
        'p: NULL: printf("x\\n"): %;',
        ["x", "p"],
    ),
    "within one sequence": (
        "p+1: W = 2*%, W0 = 3*%;",
        ["W = 2*p+2, W0 = 3*p+3"],
    ),
    "set_frame_name leaves it alone": (
        "T := translate(x,0,0): 5: set_frame_name(T,'T1'): %;",
        ["5"],
    ),
    "declare leaves it alone": (
        "5: PDEtools[declare](y(t),quiet): %;",
        ["5"],
    ),
    "loading leaves it alone": (
        "5: with(LinearAlgebra): %;",
        ["5"],
    ),
    "show returns what it prints": (
        "P := make_POINT(ground,1,2,3): show(P); %;",
        [
            "P = POINT(frame = ground,coords = Matrix([[1], [2], [3], [1]]))",
            "P = POINT(frame = ground,coords = Matrix([[1], [2], [3], [1]]))",
        ],
    ),
    "an item of it": (
        "[a,b]: %[2];",
        ["b"],
    ),
    "its operands": (
        "{a}: op(%);",
        ["a"],
    ),
    "it is evaluated": (
        "k*2: k := 4: %%;",
        ["8"],
    ),
    "a procedure has its own": (
        "f := proc() 5; %+1 end proc: 7: f(); %;",
        ["6", "6"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_last_values(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
