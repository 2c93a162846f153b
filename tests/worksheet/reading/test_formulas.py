"""Input in two dimensions, as ``.mw`` files store it: encoded elements of MathML, read as text."""

from __future__ import annotations

import base64
from itertools import pairwise

import pytest
from lark import Token

from symbody.worksheet.reading import statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.formula_text import UnknownFormula, formula_text
from symbody.worksheet.reading.parse import tokens_of
from symbody.worksheet.reading.stored_formula import Element, UnknownEncoding, stored_formula
from symbody.worksheet.sheet.source import Cell, Line, SyntaxMistake
from tests.worksheets.sheet import VALID

OF_MAPLE = """
LUklbXJvd0c2Iy9JK21vZHVsZW5hbWVHNiJJLFR5cGVzZXR0aW5nR0koX3N5c2xpYkdGJzYuLUkjbWlHRiQ2JVEiQUYnLyUnaXRhbGljR1EldHJ1ZUYn
LyUsbWF0aHZhcmlhbnRHUSdpdGFsaWNGJy1JI21vR0YkNi1RKiZjb2xvbmVxO0YnL0YzUSdub3JtYWxGJy8lJmZlbmNlR1EmZmFsc2VGJy8lKnNlcGFy
YXRvckdGPS8lKXN0cmV0Y2h5R0Y9LyUqc3ltbWV0cmljR0Y9LyUobGFyZ2VvcEdGPS8lLm1vdmFibGVsaW1pdHNHRj0vJSdhY2NlbnRHRj0vJSdsc3Bh
Y2VHUSwwLjI3Nzc3NzhlbUYnLyUncnNwYWNlR0ZMLUkjbW5HRiQ2JFEiNEYnRjktRjY2LVEiO0YnRjlGOy9GP0YxRkBGQkZERkZGSC9GS1EmMC4wZW1G
J0ZNLUknbXNwYWNlR0YkNiYvJSdoZWlnaHRHUSYwLjBleEYnLyUmd2lkdGhHRlgvJSZkZXB0aEdGaG4vJSpsaW5lYnJlYWtHUShuZXdsaW5lRictRjY2
LVEifkYnRjlGO0Y+RkBGQkZERkZGSEZXL0ZORlgtRiw2JVEiQkYnRi9GMkY1LUZQNiRRIjdGJ0Y5RlMvJStleGVjdXRhYmxlR0Y9Rjk=
"""
"""What Maple 13 stores of ``A := 4;`` and ``B := 7;`` on two lines, with its references to earlier objects."""


def mi(name: str) -> Element:
    return Element("mi", (name,))


def mo(sign: str) -> Element:
    return Element("mo", (sign,))


def mn(number: str) -> Element:
    return Element("mn", (number,))


def row(*parts: Element) -> Element:
    return Element("mrow", parts)


def fenced(*parts: Element, left: str = "(", right: str = ")") -> Element:
    return Element("mfenced", (row(*parts),), {"open": left, "close": right})


def up(base: Element, exponent: Element) -> Element:
    return Element("msup", (base, exponent))


GAP = mo("&nbsp;")
X, Y, T = mi("x"), mi("y"), mi("t")


def encoded(element: Element) -> str:
    """Return an element in Maple's encoding, without references."""

    def number(value: int) -> str:
        if value < 58:
            return chr(33 + value)
        low, value = value % 16, value // 16
        digits = chr(91 + low)
        while value >= 16:
            digits, value = digits + chr(91 + value % 16), value // 16
        return digits + chr(107 + value)

    def text(given: str) -> str:
        data = given.encode()
        return number(len(data)) + "".join(
            "~" if code == 32 else "|" + number(code) if code < 33 or code > 122 else chr(code)
            for code in data
        )

    def written(part: Element | str) -> str:
        if isinstance(part, str):
            return f'Q{text(part)}6"'
        pieces = [written(each) for each in part.parts]
        pieces += [f'/%{text(key)}GQ{text(value)}6"' for key, value in part.attributes.items()]
        return f'-I{text(part.tag)}G6"6{number(len(pieces) + 1)}{"".join(pieces)}'

    return base64.b64encode(written(element).encode("latin-1")).decode()


def test_what_maple_has_stored() -> None:
    assert formula_text(stored_formula(OF_MAPLE)) == "A:=4;\nB:=7;"


FORMULAS = [
    (row(mi("a"), mo("&coloneq;"), mn("2"), X), "a:=2*x"),
    (row(X, GAP, Y), "x*y"),
    (row(X, GAP, mo("+"), GAP, Y), "x+y"),
    (row(mi("f"), fenced(X)), "f(x)"),
    (row(mi("f"), GAP, fenced(X)), "f*(x)"),
    (row(mi("f"), GAP, fenced(X, mo(","), Y)), "f(x,y)"),
    (row(mi("sin"), mo("&ApplyFunction;"), fenced(mi("&theta;"), fenced(T))), "sin(theta(t))"),
    (row(mi("sin"), up(fenced(X), mn("2"))), "sin(x)^2"),
    (row(up(X, mn("2")), Y), "x^2*y"),
    (up(row(X, mo("+"), Y), row(mo("&minus;"), mn("1"))), "(x+y)^(-1)"),
    (up(mi("&ExponentialE;"), row(mo("&minus;"), T)), "exp(-t)"),
    (Element("mfrac", (row(X, mo("+"), mn("1")), Y)), "((x+1)/y)"),
    (Element("msqrt", (row(X, mo("+"), mn("1")),)), "sqrt(x+1)"),
    (Element("mroot", (X, mn("3"))), "x^(1/3)"),
    (Element("msub", (X, mn("1"))), "x[1]"),
    (row(X, fenced(mn("1"), left="[", right="]")), "x[1]"),
    (fenced(X, mo(","), Y, left="&lcub;", right="&rcub;"), "{x,y}"),
    (fenced(X, left="|", right="|"), "abs(x)"),
    (row(mi("&pi;"), mi("&Omega;")), "Pi*Omega"),
    (row(mi("f"), fenced(X, mo(","), Y), mo("&coloneq;"), X, GAP, Y), "f:=(x,y)->x*y"),
    (row(mi("f"), fenced(mn("0")), mo("&coloneq;"), X), "f(0):=x"),
    (
        row(mo("if"), GAP, X, mo("&lt;"), mn("0"), GAP, mo("then"), GAP, Y, GAP, mo("end if")),
        "if x<0 then y end if",
    ),
    (row(Element("ms", ('a "b"',)), mo(";")), '"a \\"b\\"";'),
    (Element("ms", ("\\n",)), '"\\n"'),
    (row(X, mo(";"), Element("mspace", (), {"linebreak": "newline"}), Y), "x;\ny"),
    (row(mo("("), X, mo(")"), GAP, Y), "(x)*y"),
    (row(X, mo("&union;"), Y), "x union y"),
    (row(up(mi("sin"), mn("2")), fenced(X)), "sin(x)^2"),
    (row(mn("2"), up(mi("cos"), mi("n")), mo("&ApplyFunction;"), fenced(X), Y), "2*cos(x)^n*y"),
    (row(up(mi("tan"), mn("2")), mo("("), row(X, mo("+"), Y), mo(")"), mo("-"), X), "tan(x+y)^2-x"),
    (row(up(mi("sin"), mn("2")), fenced(row(up(mi("cos"), mn("3")), fenced(X)))), "sin(cos(x)^3)^2"),
    (row(up(X, mn("2")), GAP, fenced(row(X, mo("+"), Y))), "x^2*(x+y)"),
    (row(), ""),
    (mi("x" * 1000), "x" * 1000),
]


@pytest.mark.parametrize(("formula", "text"), FORMULAS)
def test_formulas(formula: Element, text: str) -> None:
    assert formula_text(formula) == text
    assert formula_text(stored_formula(encoded(formula))) == text


@pytest.mark.parametrize(
    ("formula", "found"),
    [
        (Element("mfrac", (mi("d"), row(mi("d"), X))), "a derivative"),
        (Element("mfrac", (mo("&DifferentialD;"), row(mo("&DifferentialD;"), X))), "a derivative"),
        (Element("mover", (X, mo("."))), "something above"),
        (Element("munderover", (mo("&sum;"), X, Y)), "bounds"),
        (up(X, mo("&apos;")), "a power"),
        (row(mn("2"), fenced(X)), "a bracket behind a number"),
        (row(up(X, mn("2")), fenced(Y)), "a bracket behind a power of x"),
        (row(up(fenced(X), mn("2")), fenced(Y)), "a bracket behind a power of"),
        (row(Element("mroot", (X, mn("3"))), fenced(Y)), "a bracket behind a power of a root"),
        (row(up(mi("sin"), mn("2")), GAP, X), "a power sin.2 of a function"),
        (row(up(mi("sin"), fenced(mo("-"), mn("1"))), fenced(X)), "a power sin.*of a function"),
        (Element("mtable", ()), "a matrix"),
        (Element("msub", (X, mn("1")), {"msemantics": "atomic"}), "a name with an index"),
        (Element("maction", (X,)), "an element maction"),
        (mi("two words"), "a name"),
    ],
)
def test_what_has_no_text(formula: Element, found: str) -> None:
    with pytest.raises(UnknownFormula, match=found):
        formula_text(formula)


@pytest.mark.parametrize(
    "text", ["", "x", "LUk=", "LUkjbWlHNiI2IyQiIiQhIiI=", "Rio=", "LUkjbWlHNiI2I1Fab25l"]
)
def test_other_encodings(text: str) -> None:
    with pytest.raises(UnknownEncoding):
        stored_formula(text)


def test_any_cut_or_change_is_no_crash() -> None:
    code = base64.b64decode(OF_MAPLE)
    for place in range(0, len(code), 3):
        for changed in (code[:place], code[:place] + b"F" + code[place + 1 :], code[:place] + b"-" * 5000):
            try:
                formula_text(stored_formula(base64.b64encode(changed).decode()))
            except (UnknownEncoding, UnknownFormula):
                continue


def test_deep_formulas_take_little_time() -> None:
    formula = X
    for _ in range(30):
        formula = up(fenced(formula), mn("2"))
    assert formula_text(formula).count("^2") == 30
    with pytest.raises(UnknownEncoding):
        stored_formula(encoded(Element("mrow", (formula,) * 2)).replace("=", "") + "LUk")
    for _ in range(30):
        formula = up(fenced(formula), mn("2"))
    with pytest.raises(UnknownEncoding, match="too deep"):
        stored_formula(encoded(formula))


def test_references_do_not_make_formulas_of_any_size() -> None:
    """Each element holds the next one twice, the second time by its number."""
    depth = 40
    text = '-I%mrowG6"6$' * depth + '-I#miG6"6#Q"x6"'
    # The element at level k begins at object 1 + 4 k: an element, its name, the name's attributes, its sequence.
    for level in range(depth, 0, -1):
        number = 1 + 4 * level
        digit = chr(33 + number) if number < 58 else chr(91 + number % 16) + chr(107 + number // 16)
        text += f"F{digit}"
    with pytest.raises(UnknownEncoding, match="more than 100000 elements"):
        stored_formula(base64.b64encode(text.encode()).decode())


SHEET = (
    '<Worksheet><Group><Input><Text-field prompt="&gt; " style="2D Input"><Equation executable="true" style="{}" '
    'input-equation="{}" display="{}">{}</Equation></Text-field></Input></Group></Worksheet>'
)


@pytest.mark.parametrize("style", ["2D Input", "Code"])
@pytest.mark.parametrize("known", ["", "A := 4;"])
def test_input_is_read_as_it_is_drawn(style: str, known: str) -> None:
    """Maple 13 keeps the first line of several as text."""
    (cell,) = source_cells(SHEET.format(style, known, OF_MAPLE, "Qw=="))
    assert [line.text for line in cell.input] == ["A:=4;", "B:=7;"]


def test_input_that_is_known_as_text_alone() -> None:
    (cell,) = source_cells(SHEET.format("2D Input", "A := 4;", "LUk=", "LUk="))
    assert [line.text for line in cell.input] == ["A := 4;"]


def test_input_that_is_not_read_is_a_mistake_with_a_way_out() -> None:
    (cell,) = source_cells(SHEET.format("2D Input", "", "", encoded(Element("mover", (X, mo("."))))))
    (mistake,) = statements(cell)
    assert isinstance(mistake, SyntaxMistake)
    assert (
        "input in two dimensions that is not read (something above a sign); expected names" in mistake.message
    )
    assert "convert it to 1-D Math Input" in mistake.message


def test_formulas_without_terminators_in_one_cell() -> None:
    field = (
        '<Text-field style="Text">so <Equation executable="true" style="2D Input" input-equation="" display="{}"/>'
        "</Text-field>"
    )
    fields = [field.format(encoded(row(name, mo(":="), mn("1")))) for name in (X, Y)]
    (cell,) = source_cells(f"<Worksheet><Group><Input>{chr(10).join(fields)}</Input></Group></Worksheet>")
    assert len([*statements(cell)]) == 2
    assert not any(isinstance(each, SyntaxMistake) for each in statements(cell))
    assert cell.prose == ("so", "so")


def as_formula(tokens: list[Token]) -> Element:
    """Return tokens as Maple stores what is typed in two dimensions: blanks as signs, and brackets as one element."""
    stack: list[list[Element]] = [[]]
    for before, token in pairwise([tokens[0], *tokens]):
        if token.column != (before.column if token is before else before.end_column):
            stack[-1].append(GAP)
        if token.type in {"LPAR", "LSQB", "LBRACE"}:
            stack.append([])
        elif token.type in {"RPAR", "RSQB", "RBRACE"}:
            inside = stack.pop()
            left, right = {"RPAR": "()", "RSQB": "[]", "RBRACE": "{}"}[token.type]
            stack[-1].append(fenced(*inside, left=left, right=right))
        else:
            tag = {"NAME": "mi", "BACKQUOTED": "mi", "INTEGER": "mn", "DECIMAL": "mn", "STRING": "ms"}
            text = token[1:-1] if token.type == "STRING" else str(token)
            stack[-1].append(Element(tag.get(token.type, "mo"), (text,)))
    return row(*stack[0])


@pytest.mark.parametrize("name", ["pendulum_newton.mpl", "four_bar.mpl", "car.mpl", "satellite_wheels.mpl"])
def test_a_sheet_typed_in_two_dimensions_has_the_same_statements(name: str) -> None:
    """Its lines follow one another as tokens; the entries of functions, ``x(t) := e``, would be definitions."""
    (cell,) = source_cells((VALID / name).read_text(encoding="utf-8"))
    wanted = [*statements(cell)]
    tokens = [token for line in cell.input for token in tokens_of(line)]
    text = formula_text(stored_formula(encoded(as_formula(tokens))))
    found = [*statements(Cell((Line(text, 1),), remarks_lost_marks=False))]
    assert found == wanted
