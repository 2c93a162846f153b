"""`show` and `latex` take what the other functions take, and what notebooks show."""

from __future__ import annotations

import numpy as np
import pytest

import symbody as sb
from symbody import (
    Body,
    System,
    Vector,
    cost,
    describe,
    expand,
    functions_of_time,
    ground,
    latex,
    linearize,
    newton_euler,
    rotate,
    show,
    symbols,
    translate,
)
from symbody.multibody.show import Shown

a, b, m, l, g = symbols("a b m l g")
q = functions_of_time("q")
bob = Body(rotate("Z", q) * translate(0, -l, 0), m, name="bob")
equations = newton_euler(System([bob], coordinates=[q], gravity=Vector(ground, 0, -g, 0)))

SHOWN = {
    "[a, [2, b]]": [a, [2, b]],
    "(a, b)": (a, b),
    "(a,)": (a,),
    "x = a\nq = b": {"x": a, q: b},
    "[a, 1/2]": np.array([a, sb.number("1/2")], dtype=object),
    "[[a, b], [b, a]]": np.array([[a, b], [b, a]], dtype=object),
    "3": 3,
    "1.5": 1.5,
    "Matrix([[a, b], [b, a]])": sb.Matrix([[a, b], [b, a]]),
    "[VECTOR(frame = ground, comps = [a, 0, 0]), b]": [Vector(ground, a, 0, 0), b],
}


@pytest.mark.parametrize(("text", "thing"), SHOWN.items(), ids=repr)
def test_collections(text: str, thing: Shown, capsys: pytest.CaptureFixture[str]) -> None:
    show(thing)
    assert capsys.readouterr().out == text + "\n"


MODELS = [equations, equations.matrix_form(), equations.equation_of(q), linearize(equations, {q: 0})]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: type(model).__name__)
def test_models_in_collections(model: sb.Equations) -> None:
    text = describe({"model": model, "a": a})
    assert text.splitlines()[0] == "model:"
    assert [line[4:] for line in text.splitlines()[1:-1]] == model.description().splitlines()
    assert text.splitlines()[-1] == "a = a"
    assert model.latex() in latex({"model": model, "a": a})
    assert model.latex() in latex([a, [model, b]])
    assert len(repr(model)) < 100


def test_high_equations_are_one_formula_within_others() -> None:
    frame, bodies = ground, []
    for place, angle in enumerate(functions_of_time("q1:5")):
        frame = frame * rotate("YZ"[place > 0], angle) * translate(0, -symbols(f"l{place}"), 0)
        bodies.append(Body(frame, symbols(f"m{place}")))
    chain = newton_euler(System(bodies, coordinates=[*functions_of_time("q1:5")]))
    assert "align*" in latex(chain) == chain.latex()
    assert "align*" not in latex([chain, a]) + latex({"chain": chain})


def test_what_a_notebook_shows_as_a_table_is_shown_as_it_prints() -> None:
    assert describe(cost(a * b)) == str(cost(a * b))


def test_long_things_are_broken() -> None:
    long = expand((a + b) ** 30)
    for thing in (long, [long, a], {"x": long, "y": a}, sb.Matrix([[long, a], [a, b]])):
        lines = describe(thing).splitlines()
        assert max(map(len, lines)) <= 120
        assert len(lines) > 5
    assert "".join(line.strip() + " " for line in describe(long).splitlines()).strip() == str(long)
    assert describe([bob] * 3).count("bob = BODY(") == 3
