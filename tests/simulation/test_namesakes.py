"""Two variables of one name: wherever a value is looked up, the message says what makes them different."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import pytest
import sympy

from symbody import (
    Body,
    Equations,
    Event,
    Expr,
    Force,
    Matrix,
    Point,
    System,
    Vector,
    coeff,
    collect,
    consistent_state,
    diff,
    equilibrium,
    from_sympy,
    functions_of_time,
    gradient,
    ground,
    inverse_dynamics,
    jacobian,
    lambdify,
    newton_euler,
    rotate,
    simulate,
    simulate_many,
    sin,
    solve,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.codegen import source
from symbody.errors import (
    ArgumentError,
    ConstraintError,
    ExpressionError,
    ModelError,
    ModelNotice,
    ParameterError,
    ProgramError,
    SimulationError,
)
from symbody.symbolic import Argument, Program, Result, Routine

with warnings.catch_warnings():
    warnings.simplefilter("ignore", ModelNotice)  # the notice where the second one is made: see below
    positive = from_sympy(sympy.Symbol("m", positive=True))
    real, complex_ = symbols("m"), symbols("m", real=False)
    l, g = symbols("l g")
    x, plain_x = functions_of_time("x"), symbols("x")
    moving_l, force, plain_force = functions_of_time("l"), functions_of_time("F"), symbols("F")


def pendulum(mass: object = positive) -> Equations:
    bob = Body(rotate("Z", x) * translate(0, -l, 0), mass)  # type: ignore[arg-type]
    return newton_euler(System([bob], coordinates=[x], gravity=Vector(ground, 0, -g, 0)))


GIVEN = {real: 1.0, l: 1.0, g: 9.81}
RIGHT = {positive: 1.0, l: 1.0, g: 9.81}
MASS = (
    "; the m without a value is symbols('m', positive=True), the m given is symbols('m'): symbols with different "
    "assumptions are different symbols; use the same one in both places"
)
COORDINATE = (
    "; the x expected is functions_of_time('x'), the x given is symbols('x'): a symbol is not a function of time; "
    "use the same one in both places"
)
ENTRY = "no value for m: give evaluate a value of each, or substitute it"
INPUT = "no value for m: make each an input, or substitute it"
GIVE = "no value for m; give parameters={m: ...}"

MISTAKES: list[tuple[type[Exception], Callable[[], object], str]] = [
    (ParameterError, lambda: simulate(pendulum(), GIVEN, {x: 1}, t=(0, 1)), f"simulate: {GIVE}{MASS}"),
    (ParameterError, lambda: simulate_many(pendulum(), GIVEN, {x: 1}, t=(0, 1)), f"simulate_many: {GIVE}{MASS}"),
    (ParameterError, lambda: equilibrium(pendulum(), GIVEN), f"equilibrium: {GIVE}{MASS}"),
    (
        ParameterError,
        lambda: inverse_dynamics(pendulum(), {x: sin(t)}, GIVEN, t=[0, 1]),
        f"inverse_dynamics: {GIVE}{MASS}",
    ),
    (
        ParameterError,
        lambda: simulate(pendulum(), RIGHT, {plain_x: 1}, t=(0, 1)),
        f"simulate, initial: x is not a coordinate, a rate of one or a speed of this system{COORDINATE}",
    ),
    (
        ParameterError,
        lambda: simulate(pendulum(), {**RIGHT, x: 1}, {x: 1}, t=(0, 1)),
        "simulate, parameters: x is not a parameter of these equations; expected one of g, l, m",
    ),
    (
        ParameterError,
        lambda: equilibrium(pendulum(), RIGHT, guess={plain_x: 1}),
        f"equilibrium, guess: x is not a coordinate of this system{COORDINATE}",
    ),
    (
        ParameterError,
        lambda: simulate(pendulum(), RIGHT, {x: 1}, t=(0, 1))[real],
        (
            "motion: m has no value in this motion; give it with the parameters of simulate; the m asked for is "
            "symbols('m'), the m of the motion is symbols('m', positive=True): symbols with different assumptions "
            "are different symbols; use the same one in both places"
        ),
    ),
    (ParameterError, lambda: (positive + 1).evaluate({real: 1}), f"{ENTRY}{MASS}"),
    (ParameterError, lambda: lambdify([real], positive), f"{INPUT}{MASS}"),
    (
        ParameterError,
        lambda: lambdify([plain_x], Matrix([[x, 1]])),
        (
            "no value for x: make each an input, or substitute it; the x without a value is functions_of_time('x'), "
            "the x given is symbols('x'): a symbol is not a function of time; use the same one in both places"
        ),
    ),
    (
        ProgramError,
        lambda: Program(
            "demo",
            "",
            (Argument("p", "", (complex_,), "parameters"),),
            (Routine("f", "", ("p",), (Result("y", "", (positive,), ()),)),),
        ),
        (
            "the result y of f contains m, and is not a function of its arguments p; substitute a value, or make it a "
            "parameter or an input; the m in the result is symbols('m', positive=True), the m among the arguments is "
            "symbols('m', real=False): symbols with different "
            "assumptions are different symbols; use the same one in both places"
        ),
    ),
    (
        ProgramError,
        lambda: source(pendulum(positive + real)),
        (
            "the variables have the name m 2 times; the m in one place is symbols('m', positive=True), the m in "
            "another is symbols('m'): symbols with different "
            "assumptions are different symbols; use the same one in both places"
        ),
    ),
    (
        ModelError,
        lambda: simulate(newton_euler(forced()), RIGHT, {x: 1}, t=(0, 1), inputs={plain_force: 1}),  # type: ignore[dict-item]
        (
            "simulate, inputs: F is not a function of time that the equations contain besides coordinates and speeds; "
            "expected F; the F expected is functions_of_time('F'), the F given is symbols('F'): a symbol is not a "
            "function of time; use the same one in both places"
        ),
    ),
    (
        SimulationError,
        lambda: simulate(pendulum(), RIGHT, {x: 1}, t=(0, 1))[moving_l],
        (
            "motion: no values of l; this motion has values of time, the coordinates x, the speeds x', "
            "accelerations, multipliers and parameters; l is neither a coordinate nor a speed of this system: use "
            "those, or add it to the system before simulating; the l asked for is functions_of_time('l'), the l of "
            "the motion is symbols('l'): a symbol is not a function of time; use the same one in both places"
        ),
    ),
]  # fmt: skip


def forced() -> System:
    frame = rotate("Z", x) * translate(0, -l, 0)
    bob = Body(frame, positive)
    push = Force(ground, force, 0, 0, at=Point(frame, 0, 0, 0), on=bob)
    return System([bob], [push], coordinates=[x])


@pytest.mark.parametrize(("error", "mistake", "message"), MISTAKES, ids=range(len(MISTAKES)))
def test_the_message_names_the_assumption(
    error: type[Exception], mistake: Callable[[], object], message: str
) -> None:
    with pytest.raises(error) as caught:
        mistake()
    assert str(caught.value) == message


NOT_REPLACED = (
    "the m in the expression is symbols('m', positive=True), the m given is symbols('m'): symbols with different "
    "assumptions are different symbols; use the same one in both places"
)


@pytest.mark.parametrize(
    ("place", "work"),
    [
        ("subs", lambda: (positive * l).subs({real: 2})),
        ("subs", lambda: subs(positive * l, {real: 2})),
        ("subs", lambda: Matrix([[positive, l]]).subs({real: 2, l: 1})),
        ("subs", lambda: translate(positive, 0, 0).subs({real: 2})),
        ("subs", lambda: rotate("Z", positive * x).subs({real: 2})),
        ("diff", lambda: (positive * l).diff(real)),
        ("diff", lambda: diff(positive * l, real)),
        ("diff", lambda: Matrix([[positive, l]]).diff(real)),
        ("jacobian", lambda: jacobian([positive * l, l], [l, real])),
        ("gradient", lambda: gradient(positive * l, [l, real])),
        ("coeff", lambda: coeff(positive * l, real)),
        ("collect", lambda: collect(positive * l + l, real)),
    ],
)
def test_work_in_vain_is_noticed(place: str, work: Callable[[], object]) -> None:
    with pytest.warns(ModelNotice) as caught:
        work()
    assert [str(notice.message) for notice in caught] == [f"{place}: {NOT_REPLACED}"]
    assert caught[0].filename == __file__


def test_what_is_meant_is_not_noticed() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert (positive * real).subs({real: 2}) == 2 * positive
        assert (positive + real).subs({real: 2, positive: 1}) == 3
        assert (positive * l).subs({positive: real}) == real * l
        assert (positive * l).diff(l) == positive
        assert (x * plain_x).diff(plain_x) == x
        assert l.subs({real: 2}) == l
    with pytest.warns(ModelNotice, match="simulate: the parameter x does not occur in this model"):
        simulate(pendulum(), {**RIGHT, plain_x: 2}, {x: 1}, t=(0, 0.1))


@pytest.mark.parametrize("expression", [plain_x, plain_x * l])
def test_an_output_of_a_symbol_with_the_name_of_a_coordinate(expression: Expr) -> None:
    for request in ({"outputs": {"a": expression}}, {"events": [Event(expression - 1)]}):
        with pytest.raises(ParameterError) as caught:
            simulate(pendulum(), RIGHT, {x: 1}, t=(0, 1), **request)  # type: ignore[arg-type]
        assert str(caught.value) == (
            "simulate: no value for x; give parameters={x: ...}; the x without a value is symbols('x'), the x of the "
            "model is functions_of_time('x'): a symbol is not a function of time; use the same one in both places"
        )


def test_a_rate_of_a_function_of_time_is_no_rate_of_a_symbol() -> None:
    with pytest.warns(ModelNotice) as caught:
        assert (time_derivative(x) * l).subs({plain_x: 2}) == time_derivative(x) * l
    assert str(caught[0].message) == (
        "subs: the x' in the expression is a derivative of functions_of_time('x'), the x given is symbols('x'): a "
        "symbol is not a function of time; use the same one in both places"
    )


def test_inverse_dynamics_have_no_values_of_another_variable() -> None:
    result = inverse_dynamics(pendulum(), {x: sin(t)}, RIGHT, t=[0, 1])
    with pytest.raises(SimulationError, match=r"no values of m; .*; the m asked for is symbols\('m'\)"):
        result[real]


def test_equations_and_constraints_of_another_variable() -> None:
    with (
        pytest.warns(ModelNotice, match="solve: the m in the expression is") as caught_notices,
        pytest.raises(ExpressionError, match="no solution: equation 1"),
    ):
        solve(2 * positive - 1, real)
    assert caught_notices[0].filename == __file__
    with pytest.raises(ConstraintError) as caught:
        System([Body(translate(x, 0, 0), l)], coordinates=[x], constraints=[plain_x**2 - 1])
    assert str(caught.value) == (
        "System: constraint 1, x**2 - 1 = 0, holds none of the coordinates; leave it out, or correct it; the x among "
        "the coordinates is functions_of_time('x'), the x in the constraint is symbols('x'): a symbol is not a "
        "function of time; use the same one in both places"
    )


def test_consistent_states_too() -> None:
    y = functions_of_time("y")
    rod = System([Body(translate(x, y, 0), positive)], coordinates=[x, y], constraints=[x**2 + y**2 - l**2])
    with pytest.raises(
        ParameterError, match=r"consistent_state, .*: x is not .*; the x expected is functions_of_time"
    ):
        consistent_state(newton_euler(rod), {positive: 1, l: 1}, {plain_x: 1})


def test_a_value_that_is_no_number() -> None:
    for given, found in (("1", "'1' is a str"), (l, "l is an Expr")):
        with pytest.raises(ArgumentError) as caught:
            simulate(pendulum(), {**RIGHT, positive: given}, {x: 1}, t=(0, 0.1))
        assert str(caught.value) == (
            f"simulate, parameters: the value of m: {found}; expected a number, or a row of numbers"
        )
