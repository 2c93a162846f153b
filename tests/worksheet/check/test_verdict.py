"""Which output of the file belongs to which statement, and the verdict on it."""

from __future__ import annotations

import pytest

from symbody.worksheet.check import Verdict, verdicts
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.two_dimensions import is_layout
from symbody.worksheet.run import outcomes
from symbody.worksheet.sheet.outcome import Outcome


def check(text: str) -> list[Verdict]:
    cells = source_cells(text)
    return verdicts(cells, list(outcomes(cells, Interpreter())))


def test_each_statement_has_a_verdict() -> None:
    text = "> a := x+x;\n\na := 2*x\n\n> b := a^2;\n\nb := 3*x^2\n\n> c := 1;\n\nc := ...\n"
    assert check(text) == [
        Verdict(1, "equal"),
        Verdict(5, "differs", "the file has 3*x^2, the run 4*x^2"),
        Verdict(9, "not comparable", "cut before anything complete"),
    ]


def test_aliases_are_what_they_stand_for() -> None:
    text = "> alias(s=sin, w=omega(t)):\n> diff(w,t)*s(a-b);\n\n-s(b-a)*diff(omega(t),t)\n"
    assert check(text) == [Verdict(2, "equal")]
    assert [each.kind for each in check(text.replace("diff(omega(t),t)", "w"))] == ["differs"]


def test_a_statement_may_fail_in_the_file_too() -> None:
    text = '> error "bad";\n\nError, bad\n\n> b := 2;\n\nb := 2\n'
    assert check(text) == [Verdict(1, "equal", "it fails in the file too"), Verdict(5, "equal")]
    last = text + '\n> lastexception[2];\n\n"bad"\n'
    assert check(last)[-1] == Verdict(9, "equal")
    assert check(text.replace('error "bad"', "a := 1")) == [Verdict(5, "equal")]
    assert check(text.replace("Error, bad", "")) == [Verdict(5, "equal")]


def test_outputs_can_stand_further_down() -> None:
    text = "> a := 1: b := 2;\n\n> c := 3;\n\nof it\n\n> d := 4:\n\nb := 2\n\nc := 3\n"
    assert [(one.line, one.kind) for one in check(text)] == [(1, "equal"), (3, "equal")]


def test_outputs_that_are_broken_within_brackets_are_whole() -> None:
    text = "> a := 1:\n> b := [f(x),\n> g(y)*2];\nb := [f(x),\n2*\ng(y)]\n\n> c := {x, 2};\n\nc := {2,\nx}\n"
    assert check(text) == [Verdict(2, "equal"), Verdict(8, "equal")]
    assert [each.kind for each in check(text.replace("\n2*", "\n3*"))] == ["differs", "equal"]


def test_tables_have_no_order() -> None:
    text = "> T := table([a=x, b=y]): entries(T), [indices(T, 'nolist')];\n\n[y], [x], [b, a]\n"
    kinds = [
        check(text),
        check(text.replace("[y]", "[z]")),
        check(text.replace("entries(T), ", "").replace("[y], [x], ", "")),
    ]
    order = "in another order, because tables are unordered"
    assert [(one.kind, one.reason) for (one,) in kinds] == [
        ("equal", order),
        ("differs", "[1] [1] the file has z, the run x"),
        ("equal", order),
    ]


def test_loops_over_sets_have_no_order() -> None:
    text = "> s := {x^2+1, y-3}:\n> for i to 2 do i, s[i]; od;\n\n1, y-3\n\n2, x^2+1\n"
    (verdict,) = check(text)
    assert (verdict.kind, verdict.line) == ("equal", 2)
    swapped = text.replace("1, y-3\n\n2, x^2+1", "1, x^2+1\n\n2, y-3")
    assert check(swapped)[0].kind == "equal"


def test_pictures_and_missing_outputs() -> None:
    text = "> plain(1);\n\n[Maple Plot]\n\n> x := 3:\n\nx := 3\n"
    assert [verdict.reason for verdict in check(text)] == [
        "a picture, or in Maple's own encoding",
        "the run printed nothing for it: x := 3",
    ]


def test_counts_depend_on_the_form() -> None:
    (verdict,) = check("> nops(a+b+c);\n\n4\n")
    assert verdict == Verdict(
        1, "not comparable", "a count, which depends on the form: the file has 4, the run 3"
    )


@pytest.mark.parametrize("values", [(1, 4), (1, 4, 9, 16)])
def test_a_loop_prints_as_many_values_as_the_file_has(values: tuple[int, ...]) -> None:
    text = "> for i to 3 do i^2 od;\n\n" + "".join(f"{each}\n\n" for each in values)
    assert check(text) == [Verdict(1, "differs", f"the file has {len(values)} outputs, the run 3")]
    assert check(text.replace("4", "5"))[0].reason.startswith("the file has 5, the run 4; the file has")


def test_a_picture_may_be_a_value_of_a_loop() -> None:
    text = "> for i to 3 do i^2 od;\n\n1\n\n[Maple Plot]\n"
    assert [verdict.kind for verdict in check(text)] == ["equal", "not comparable"]


def test_rows_with_gaps_are_in_two_dimensions() -> None:
    text = "> v := <a,b>;\n      [a]\n v := [ ]\n      [b]\n> <a,b>;\n[a]\n[ ]\n[b]\n"
    assert [verdict.reason for verdict in check(text)] == ["printed in two dimensions"] * 2


def test_centred_outputs_below_each_other_are_compared() -> None:
    """As Maple exports them: each in the middle of the page, without empty lines."""
    text = "> v := [1,2,3]; v[2];\n" + "\n".join(each.center(78) for each in ("v := [1, 2, 3]", "3"))
    text += "\n> for i to 3 do i^2 od;\n" + "\n".join(f"{'':36}{each}" for each in (1, 4, 8)) + "\n> a;\n"
    assert [str(verdict) for verdict in check(text)] == [
        "equal",
        "differs: the file has 3, the run 2",
        "differs: the file has 8, the run 9; 1 of 3 outputs",
    ]


@pytest.mark.parametrize(
    "formula", ["           2\n     a := x  + 1", "     a + b\n     -----\n       c", "   2\n  x"]
)
def test_formulas_in_two_dimensions_are_no_outputs_of_several_statements(formula: str) -> None:
    indented = "\n".join(f"          {line}" for line in formula.split("\n"))
    assert is_layout(indented)


def test_rates_and_lines_in_two_dimensions_have_a_verdict() -> None:
    text = """> PDEtools[declare](prime=t, quiet): diff(x(t),t);

`z'`

> W := 3*x(t);
                             W := 4 x(t)
> v := <1,2>;

v := Vector[column](%id = 18446744078)

> 3;

3
"""
    assert [str(verdict) for verdict in check(text)] == [
        "differs: the file has diff(z(t),t), the run diff(x(t),t)",
        "differs: the file has 4*x(t), the run 3*x(t)",
        "not comparable: a matrix in it is not printed in full",
        "equal",
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("> x := t^2:\n> diff(x,t);\n> diff(x,t,t);\n   2*t\n", ["3 differs: the file has 2*t, the run 2"]),
        (
            "> x := t^2:\n\n> diff(x,t);\n\n> diff(x,t,t);\n\n2*t\n",
            ["5 differs: the file has 2*t, the run 2"],
        ),
        (
            "> a+1;\n   note\n> 2*z;\n  3*z\n",
            [
                "1 not comparable: the text below it can't be read as a value: note",
                "3 differs: the file has 3*z, the run 2*z",
            ],
        ),
        ("> a+1;\n> 2*z;\n  a+1\n  2*z\n", ["1 equal", "2 equal"]),
        (
            "> a+1;\n> Matrix(2);\n  a+1\n  [Maple Math]\n",
            ["1 equal", "2 not comparable: a picture, or in Maple's own encoding"],
        ),
        (
            "> M := Matrix([[1,2],[3,4]]);\n> v := u;\n               [1 2]\n          M := [3 4]\n",
            ["1 not comparable: printed in two dimensions"],
        ),
    ],
    ids=[
        "a neighbour's value",
        "one of another cell",
        "below a remark",
        "together",
        "above a picture",
        "in two dimensions",
    ],
)
def test_what_stands_directly_below_a_statement_is_its_output(text: str, expected: list[str]) -> None:
    assert [f"{one.line} {one}" for one in check(text)] == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("> x;\n   y\n", ["1 not comparable: the text below it can't be read as a value: y"]),
        ("> whattype(3); cat(a, 1);\ninteger\n", ["1 equal"]),
        (
            "> whattype(3);\n   float\n",
            ["1 not comparable: the text below it can't be read as a value: float"],
        ),
        (
            "> a+1;\n\nb\n\n> 2*z;\n\n2*z\n",
            ["1 not comparable: the text below it can't be read as a value: b", "5 equal"],
        ),
        (
            "> restart:\n> a*c;\n   a^b^c\n> a*c;\n  a*d\n",
            [
                "2 not comparable: the text below it can't be read as a value: a^b^c",
                "4 differs: the file has a*d, the run a*c",
            ],
        ),
        ("> x := 3:\n  note\n> x;\n  3\n  note\n\n# heading\n", ["3 equal"]),
    ],
    ids=[
        "a name",
        "a printed word",
        "another word",
        "a name in a paragraph",
        "what can't be read",
        "remarks",
    ],
)
def test_what_may_be_output_has_a_verdict(text: str, expected: list[str]) -> None:
    assert [f"{one.line} {one}" for one in check(text)] == expected


def test_prose_is_no_text_that_a_statement_printed() -> None:
    text = """Numbers of the links

> printf("%d links\\n",4);

4 links

> printf("%d\\n",2);

![](links.png)

here are 2 pictures of it

> printf("crank = %f\\n",1.5);

rocker = 1.500000
"""
    assert [f"{one.line} {one}" for one in check(text)] == [
        "3 equal",
        "7 not comparable: a picture, or in Maple's own encoding",
        "7 not comparable: the text below it may be prose: here are 2 pictures of it",
        "13 differs: the file has 'rocker = 1.500000', the run 'crank = 1.500000'",
    ]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("> W := u;\n   W2 := u\n", "the file has W2, the run W"),
        ("> W := u;\n   u\n", "the file has a value, the run W"),
        ("> u = 2;\n   v = 2\n", "the file has v, the run u"),
    ],
)
def test_another_left_side_differs(text: str, reason: str) -> None:
    assert check(text) == [Verdict(1, "differs", reason)]


def test_objects_may_tell_what_they_are() -> None:
    text = "> restart: with(MBSymba_r6):\n> show(make_POINT(ground,a,0,0));\n"
    shown = "POINT(coords = Matrix(4,1,[[a],[0],[0],[1]]),obj = POINT,frame = ground)"
    assert check(f"{text}{shown}\n") == [Verdict(2, "equal")]
    assert check(f"{text}{shown.replace('[a]', '[b]')}\n")[0].kind == "differs"


def test_drawings_are_no_outputs() -> None:
    cells = source_cells("> a+1;\n> plot(x);\n  a+1\n")
    done = [Outcome(0, 1, printed=("a+1",)), Outcome(0, 2, printed=("[Plot: plot1.png]",))]
    assert verdicts(cells, done) == [Verdict(1, "equal")]
