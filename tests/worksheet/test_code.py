"""Operation counts, computation sequences and MATLAB code."""

import math
import re
from pathlib import Path

import pytest

from symbody.symbolic import cos, sin, symbols
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.mathematics.shared_parts import named_parts
from symbody.worksheet.printing.code_text import code_text
from tests.worksheet.printed_by import failures, printed


@pytest.mark.parametrize(
    ("expressions", "count"),
    [
        ("a*b+c^2", "2*multiplications+additions"),
        ("sin(d)/2", "multiplications+functions"),
        ("x^4", "2*multiplications"),
        ("a/b", "divisions"),
        ("[X[1]+X[2], X[1]*3]", "multiplications+additions+3*subscripts"),
        ("[u = a*b, v = u+1]", "multiplications+additions+2*assignments"),
        ("7", "0"),
    ],
)
def test_counts_are_those_of_expressions_as_they_are_written(expressions: str, count: str) -> None:
    assert printed(f"codegen[cost]({expressions});") == [count]


def test_a_computation_sequence_computes_the_same() -> None:
    a, b, c = symbols("a b c")
    expressions = [sin(a + b) * (a + b) + cos(a + b) ** 2, (a + b) / sin(a + b), c * cos(a + b) ** 2]
    definitions, results = named_parts(expressions)
    assert len(definitions) >= 3
    for name, definition in reversed(definitions):
        results = [each.subs({name: definition}) for each in results]
    assert results == expressions


def test_names_of_a_sequence_are_new() -> None:
    assert printed("codegen[optimize]([u=sin(t1+b)*(t1+b)]);") == ["t2 = b+t1, u = t2*sin(t2)"]


def test_no_more_operations_than_before() -> None:
    sheet = "e := [sin(a+b)*(a+b), (a+b)^2*cos(a+b)]: s := [codegen[optimize](e)]: codegen[cost](e); codegen[cost](s);"
    before, after = printed(sheet)
    assert sum(_numbers(after).values()) - _numbers(after)["assignments"] <= sum(_numbers(before).values())


def _numbers(text: str) -> dict[str, int]:
    return {name: int(count or 1) for count, name in re.findall(r"(?:(\d+)\*)?([a-z]+)", text)}


def test_matlab_text_has_the_value_of_the_expression() -> None:
    x, y = symbols("x y")
    expression = (x**2 / 3 - y) * sin(x) / (x + 2 * y) ** 2 - 1.5 * (x - y) ** 3 / (2 * y)
    text = code_text(expression).replace("^", "**")
    value = eval(text, {"sin": math.sin, "sqrt": math.sqrt, "x": 0.7, "y": 1.3})
    assert value == pytest.approx(expression.evaluate({x: 0.7, y: 1.3}), rel=1e-14)


def test_matlab_statements(tmp_path: Path) -> None:
    lines = printed(
        'CodeGeneration[Matlab](x^2/2+arctan(y,x), resultname="r"); '
        "CodeGeneration[Matlab]([u=sin(a+b)*(a+b), v__1=(a+b)^2], optimize); "
        "CodeGeneration[Matlab](<<a|b-c>,<X[2]|2>>);",
        tmp_path,
    )
    assert "\n".join(lines).splitlines() == [
        "r = 1 / 2 * x ^ 2 + atan2(y, x);",
        "t1 = a + b;",
        "u = t1 * sin(t1);",
        "v__1 = t1 ^ 2;",
        "cg = [a b-c; X(2) 2;];",
    ]


def test_matlab_statements_in_a_string_and_a_file(tmp_path: Path) -> None:
    assert printed("s := CodeGeneration[Matlab](a+b, output=string): length(s);", tmp_path) == ["12"]
    printed('with(CodeGeneration): Matlab(a+b, output="f.m"):', tmp_path)
    assert (tmp_path / "f.m").read_text() == "cg = a + b;\n"


def test_options_that_are_not_known_are_told() -> None:
    interpreter = Interpreter()
    printed("CodeGeneration[Matlab](a+b, colour=3);", interpreter=interpreter)
    assert interpreter.session.notices == [
        "CodeGeneration[Matlab]: the option colour is not known and is left out"
    ]


def test_a_shared_part_stands_behind_the_values_of_its_names() -> None:
    sheet = "CodeGeneration[Matlab]([r = sin(a), u = a/r^2+1/r, v = sin(1/r)], optimize);"
    steps = [line.split(" = ") for line in "".join(printed(sheet)).split("\n") if line]
    values: dict[str, float] = {"a": 0.7, "sin": math.sin}  # type: ignore[dict-item]
    for name, text in steps:
        values[name] = eval(text.rstrip(";").replace("^", "**"), {}, values)
    r = math.sin(0.7)
    assert math.isclose(values["u"], 0.7 / r**2 + 1 / r)
    assert math.isclose(values["v"], math.sin(1 / r))


def test_nothing_is_shared_across_a_new_value_of_a_name() -> None:
    sheet = "CodeGeneration[Matlab]([u = sin(r+1), r = a, v = sin(r+1)], optimize);"
    assert "".join(printed(sheet)) == "u = sin(r + 1);\nr = a;\nv = sin(r + 1);"


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("C", "r = pow(z[0], 2) + M[0][1] + sin(z[1]);"),
        ("Python", "r = z[0] ** 2 + M[0, 1] + math.sin(z[1])"),
        ("Matlab", "r = z(1) ^ 2 + M(1,2) + sin(z(2));"),
        ("Fortran", "      r = z(1) ** 2 + M(1,2) + sin(z(2))"),
    ],
)
def test_indices_are_those_of_the_language(language: str, text: str) -> None:
    (line,) = printed(f'CodeGeneration[{language}](z[1]^2 + sin(z[2]) + M[1,2], resultname="r");')
    assert sorted(line.replace(";", "").split(" + ")) == sorted(text.replace(";", "").split(" + "))


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("C", "r = ((x + 1.0 > 0.0) - (x + 1.0 < 0.0));"),
        ("Python", "r = ((x + 1 > 0) - (x + 1 < 0))"),
        ("Matlab", "r = sign(x + 1);"),
    ],
)
def test_languages_without_a_sign_compare(language: str, text: str) -> None:
    assert printed(f'CodeGeneration[{language}](signum(x+1), resultname="r");') == [text]


def test_procedures_are_functions_of_matlab_and_c() -> None:
    sheet = "f := proc(x, y) local a; a := sin(x); a^2*y + 3*a end: CodeGeneration[Matlab](f, optimize); "
    assert printed(f"{sheet} codegen[cost](x -> x^2 + 1);") == [
        "function freturn = f(x, y)\n  t1 = sin(x);\n  freturn = t1 ^ 2 * y + 3 * t1;",
        "multiplications+additions",
    ]
    assert printed(f"{sheet} CodeGeneration[C](f);")[-1] == (
        "double f (double x, double y)\n{\n  return(y * pow(sin(x), 2) + 3.0 * sin(x));\n}"
    )
    sheet_of_makers = (
        "g := codegen[makeproc]([a = sin(u), r = a^2*v], [u, v]); g(0, 1); codegen[makeproc]([p, q], [p, q])(3, 4); "
        "h := codegen[optimize]((x, y) -> sin(x)^2*y + sin(x)): h(b, c);"
    )
    assert printed(sheet_of_makers) == [
        "g := proc (u, v) local a, r; a := sin(u); r := a^2*v end proc",
        "0",
        "[3, 4]",
        "c*sin(b)^2+sin(b)",
    ]
    assert failures(f"y := 2: {sheet}") == [
        "codegen: the parameter y is a name that has a value; expected one without: unassign('y')"
    ]


def test_left_sides_and_parts_have_indices_too() -> None:
    lines = printed("CodeGeneration[C]([z[2] = sin(z[1])*z[1] + sin(z[1])], optimize);")
    assert lines == ["t1 = sin(z[0]);\nz[1] = t1 * z[0] + t1;"]


def test_an_index_before_the_first_is_refused() -> None:
    (message,) = failures("CodeGeneration[C](z[0] + 1);")
    assert message == (
        "codegen: z[0] is before the first entry of z: indices count from 0 in this language, and from 1 in the "
        "worksheet; expected indices from 1"
    )


def test_only_functions_of_python_are_those_of_its_module() -> None:
    assert printed("CodeGeneration[Python](f(x)*sin(x));") == ["cg = f(x) * math.sin(x)"]


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        (
            "piecewise(x < 0, -x, x)",
            (
                "codegen: piecewise has no counterpart in an expression; expected the cases one by one, or max, min, "
                "abs and signum"
            ),
        ),
        (
            "x < y",
            "codegen: x < y is a condition; expected an expression, or an equation name = e",
        ),
        *(
            (
                expression,
                (
                    f"codegen: {text} has no counterpart in this language; expected numbers, names, +, -, *, /, ^ and "
                    "elementary functions"
                ),
            )
            for expression, text in (("k*floor(x)", "floor(x)"), ("D(f)(x)", "diff(f(x),x)"), ("I*x", "I"))
        ),
    ],
)
def test_what_a_language_has_no_words_for_is_no_code(expression: str, message: str) -> None:
    assert failures(f"CodeGeneration[C]({expression});") == [message]


def test_constants_and_extrema_have_the_words_of_their_languages() -> None:
    assert printed("with(CodeGeneration): Matlab(I*x): C(max(a, b)): Python(infinity):") == [
        "cg = 1i * x;",
        "cg = fmax(a, b);",
        "cg = math.inf",
    ]


def test_lists_of_rows_are_matrices() -> None:
    sheet = 'CodeGeneration[Matlab]([[a,b],[c,d]], resultname = "M"); codegen[C]([[a],[b]]);'
    assert printed(sheet) == ["M = [a b; c d;];", "t0[0] = a;\nt0[1] = b;"]
