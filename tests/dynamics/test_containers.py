"""Containers of expressions go through rewrites, substitution and derivatives as expressions do."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Force,
    Matrix,
    Point,
    System,
    Torque,
    Vector,
    collect,
    combine_trig,
    cos,
    diff,
    embedded,
    expand,
    expand_trig,
    factor_terms,
    floating_frame,
    functions_of_time,
    ground,
    latex,
    newton_euler,
    rotate,
    simplify,
    sin,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
    velocity,
)
from symbody.errors import ArgumentError, LoadError, ModelError
from symbody.geometry import Frame
from symbody.multibody import Action, Load
from tests.symbolic.random_expression import doubling

x, phi = functions_of_time("x phi")
a, b, m, k, g, l = symbols("a b m k g l")
LONG = a * sin(phi) ** 2 + a * cos(phi) ** 2 + (a + b) * x - b * x


class Pair(NamedTuple):
    first: Any
    second: Any


PLACE = translate(LONG, 0, 0) * rotate("Z", phi) * rotate((0, 0, 1), a * x) * translate(0, a * x + b * x, 0)
MATRIX = Frame([[1, 0, 0, x], [0, 1, 0, LONG], [0, 0, 1, 0], [0, 0, 0, 1]])
HERE = Point(PLACE, LONG, x, 0, name="P")
VECTOR = Vector(PLACE, LONG, x**2, 0, name="v")
BODY = Body(PLACE, (a + b) * m - b * m, Iz=(a + b) ** 2, name="body")
CONTAINERS: dict[str, Any] = {
    "list": [LONG, x],
    "tuple": (LONG, x),
    "named tuple": Pair(LONG, [x]),
    "dictionary": {"entry": LONG, x: {1: x}},
    "array": np.array([[LONG, x], [1, 2]], dtype=object),
    "matrix": Matrix([[LONG, x], [x**2, 1]]),
    "vector": VECTOR,
    "difference": HERE - Point(ground, x, 0, 0),
    "point": HERE,
    "frame": PLACE * MATRIX,
    "floating frame": floating_frame(),
    "body": BODY,
    "force": Force(VECTOR, at=HERE, on=BODY, reaction=Body(ground, 1)),
    "torque": Torque(VECTOR, on=BODY),
    "nested": [(VECTOR, {"k": MATRIX}), Matrix([[LONG]])],
}
REWRITES: dict[str, Callable[[Any], Any]] = {
    "simplify": simplify,
    "expand": expand,
    "expand_trig": expand_trig,
    "factor_terms": factor_terms,
    "combine_trig": combine_trig,
    "collect": lambda thing: collect(thing, [x]),
}


def values(thing: Any) -> Any:
    """What can be compared of a container."""
    match thing:
        case Vector():
            return thing.frame, thing.components, thing.name, thing.projected(ground).components
        case Point():
            return thing.frame, thing.coordinates, thing.name
        case Body():
            return thing.frame, thing.mass, thing.inertia, thing.name
        case Force() | Torque():
            return [(values(each.vector), values(each.body)) for each in thing.actions]
        case dict():
            return {key: values(value) for key, value in thing.items()}
        case np.ndarray():
            return thing.tolist()
        case list() | tuple():
            return [values(each) for each in thing]
    return thing


@pytest.mark.parametrize("kind", CONTAINERS)
@pytest.mark.parametrize("rewrite", REWRITES)
def test_rewrites_keep_kinds_and_values(kind: str, rewrite: str) -> None:
    made = REWRITES[rewrite](CONTAINERS[kind])
    assert type(made) is type(CONTAINERS[kind])
    assert values(made) == values(CONTAINERS[kind])


def test_entries_have_the_forms_that_they_have_alone() -> None:
    short = str(simplify(LONG))
    assert short == "a*(x + 1)"
    assert str(simplify([LONG])) == f"[{short}]"
    assert str(simplify(Vector(ground, LONG, 0, 0))) == f"Vector(ground, {short}, 0, 0)"
    assert str(simplify(translate(LONG, 0, 0))) == f"translate({short}, 0, 0)"
    assert str(expand(Body(ground, a * (b + m))).mass) == "a*b + a*m"


@pytest.mark.parametrize("kind", CONTAINERS)
def test_everything_is_substituted(kind: str) -> None:
    made = subs(CONTAINERS[kind], {a: 2, b: k})
    assert not {"a", "b"} & set(str(values(made)).replace("'", " ").replace("*", " ").split())
    assert values(subs(CONTAINERS[kind], {a: 2, b: 3})) == values(
        subs(subs(CONTAINERS[kind], {a: 2}), {b: 3})
    )


def test_subs_is_that_of_the_classes() -> None:
    for thing in (VECTOR, HERE, PLACE, PLACE * MATRIX, floating_frame()):
        assert values(subs(thing, {a: k**2})) == values(thing.subs({a: k**2}))


@pytest.mark.parametrize("kind", ["list", "tuple", "named tuple", "array", "matrix"])
@pytest.mark.parametrize("n", [0, 1, 2])
def test_derivatives_of_entries(kind: str, n: int) -> None:
    entries = CONTAINERS[kind]
    for made in (diff(entries, x, n), diff(entries, t, n), time_derivative(entries, n)):
        assert type(made) is type(entries)
    assert diff([LONG, [x]], x, n) == [diff(LONG, x, n), [diff(x, x, n)]]
    assert diff({"e": LONG}, a, n) == {"e": diff(LONG, a, n)}


def test_derivatives_are_seen_from_the_own_frame() -> None:
    rate = diff(VECTOR, x)
    assert (rate.frame, rate.components) == (VECTOR.frame, diff(VECTOR.components, x))
    displacement = diff(Point(ground, x, phi, 0), t)
    assert isinstance(displacement, Vector)
    assert displacement.components == velocity(Point(ground, x, phi, 0)).components


@pytest.mark.parametrize(
    ("thing", "expected"),
    [
        (
            translate(a, 0, 0),
            "diff: translate(a, 0, 0) is a Frame, which has no derivative; the matrix of a frame has one",
        ),
        (BODY, "diff: body is a Body, which has no derivative; its mass, inertia and frame.matrix have one"),
    ],
)
def test_what_has_no_derivative(thing: Any, expected: str) -> None:
    with pytest.raises(ArgumentError) as caught:
        diff(thing, a)
    assert str(caught.value).startswith(expected)


@pytest.mark.parametrize("kind", CONTAINERS)
def test_everything_has_latex(kind: str) -> None:
    text = latex(CONTAINERS[kind])
    assert text.count(r"\begin") == text.count(r"\end")
    assert text.count("{") == text.count("}")
    assert text.count(r"\left") == text.count(r"\right")


def test_latex_of_containers() -> None:
    m1, m_1 = symbols("m1 m_1")
    assert latex([m1, m_1]) == r"\left[m_{1}, \mathtt{m\_1}\right]"
    assert latex({a: 1, "b": x}) == r"\begin{aligned} a &= 1 \\ \text{b} &= x \end{aligned}"
    column = r"\begin{bmatrix} m_{1} \\ 0 \\ \mathtt{m\_1} \end{bmatrix}"
    assert latex(Vector(ground, m1, 0, m_1)) == latex(Point(ground, m1, 0, m_1)) == column
    assert latex(np.array([m1, 0, m_1], dtype=object)) == latex(Matrix.column([m1, 0, m_1])) == column
    note = r"\quad \text{in the axes of ground}"
    assert Vector(ground, m1, 0, m_1)._repr_latex_() == rf"$\displaystyle {column} {note}$"
    assert latex({"a_b": 1}) == r"\begin{aligned} \text{a}\_\text{b} &= 1 \end{aligned}"


def test_notebooks_show_forms_for_the_reader() -> None:
    """A form of the computation had five times the length of the equation."""
    p, q = functions_of_time("p q")
    link = rotate("Z", p) * translate(l, 0, 0)
    bodies = [Body(link, m), Body(link * rotate("Y", q) * translate(l, 0, 0), m)]
    equations = newton_euler(System(bodies, coordinates=[p, q], gravity=Vector(ground, 0, -g, 0)))
    for shown in (equations.residuals[0], equations.mass_matrix):
        assert (
            shown._repr_latex_() == rf"$\displaystyle {latex(shown)}$" != rf"$\displaystyle {shown.latex()}$"
        )


def model() -> Equations:
    bob = Body(rotate("Z", phi) * translate(0, -l, 0), m, name="bob")
    spring = Force(ground, -k * x, 0, 0, at=bob.center_of_mass, on=bob)
    gravity = Vector(ground, 0, -g, 0)
    return newton_euler(System([bob], [spring], [phi], gravity=gravity, inputs=[x], name="pendulum"))


def test_equations_are_rewritten_for_the_same_system() -> None:
    equations = model()
    made = expand(equations)
    assert made.system is equations.system
    assert made.residuals == equations.residuals
    assert str(made.residuals[0]) == "m*l**2*phi'' + k*l*x*cos(phi) + g*l*m*sin(phi)"
    assert (made.mass_matrix, made.bias) == (equations.mass_matrix, equations.bias)
    assert made.latex().count(r"\begin{aligned}") == 1
    assert latex(made) == made.latex()


def test_equations_with_numbers_are_those_of_the_system_with_numbers() -> None:
    numbers = {m: 3, l: 2, g: 10, x: 0}
    made = subs(model(), numbers)
    assert made.residuals == newton_euler(made.system).residuals == subs(model().residuals, numbers)
    assert made.mass_matrix == Matrix([[12]])
    assert (made.parameters, made.system.inputs, made.system.name) == ((), (), "pendulum")
    (load,) = made.system.loads
    assert isinstance(load, Force)
    assert load.on is made.system.bodies[0], "a body on which loads act stays one body"
    assert pickle.loads(pickle.dumps(made)).residuals == made.residuals


def test_equations_in_speeds_of_their_own_are_pickled() -> None:
    """Processes get them whole: of a floating body with a constraint, and with speeds eliminated."""
    frame = floating_frame("hull")
    hull = System([Body(frame, m, 1, 2, 3)])
    held = newton_euler(System([Body(frame, m, 1, 2, 3)], constraints=[hull.speeds[0] - 2 * hull.speeds[1]]))
    for made in (held, embedded(held)):
        assert made.system.rate(made.residuals)
        assert pickle.loads(pickle.dumps(made)).residuals == made.residuals


def test_constraints_go_along() -> None:
    y = functions_of_time("y")
    bead = Body(translate(x, y, 0), m)
    equations = newton_euler(System([bead], [], [x, y], [(x + a) ** 2 + y**2 - l**2]))
    assert expand(equations).constraints == equations.constraints
    assert str(expand(equations).constraints[0]).count("(") == 0
    assert subs(equations, {a: 0}).constraints == (x**2 + y**2 - l**2,)


def test_unknowns_stay() -> None:
    with pytest.raises(ModelError) as caught:
        subs(model(), {phi: 0})
    assert str(caught.value) == (
        "subs: phi is an unknown of System(pendulum, 1 body, 1 load, 1 coordinate); expected parameters and inputs. "
        "Substitute in expressions of the system, such as equations.residuals"
    )
    with pytest.raises(ArgumentError, match=r"which has no derivative; its residuals have one"):
        diff(model(), phi)


def test_what_has_no_formula() -> None:
    with pytest.raises(ArgumentError) as caught:
        latex([x, model().system])
    assert str(caught.value) == (
        "latex: System(pendulum, 1 body, 1 load, 1 coordinate) is a System, which has no formula; expected "
        "expressions, matrices, vectors, points, frames, bodies, forces, torques, equations or linear models"
    )
    with pytest.raises(ArgumentError, match=r"^diff: ground is a Frame, which has no derivative"):
        diff([a, ground], a)


class Spring(Load):
    """A load of a user, with actions that are kept."""

    def __init__(self, body: Body) -> None:
        self.body = body

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        return (Action(self.body, Vector(ground, LONG, 0, 0), self.body.center_of_mass),)


class Computed(Load):
    """A load whose actions are computed at each use."""

    @property
    def actions(self) -> tuple[Action, ...]:
        return (Action(BODY, Vector(ground, a, 0, 0)),)


def test_loads_of_own_classes() -> None:
    (action,) = subs(Spring(BODY), {a: 2}).actions
    assert action.vector.components[0] == subs(LONG, {a: 2})
    assert isinstance(simplify(Spring(BODY)), Spring)
    with pytest.raises(LoadError) as caught:
        simplify(Computed())
    assert str(caught.value) == (
        "convert: Computed.actions is computed at each use; expected a cached_property, whose value can be replaced by "
        "the converted actions"
    )


def test_entries_of_a_large_matrix_share_named_quantities() -> None:
    big = doubling(40)
    text = Matrix([[big, big * a], [1, big + b]]).latex()
    assert text.count(r"\begin{aligned}") == 1
    assert text.count("z_{1} &=") == 1
    assert latex([[doubling(10)]]).count("z_{1} &=") == 1
