"""Linear equations about rest and steady motions, on small systems whose equations are known."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Body,
    Force,
    Matrix,
    System,
    Vector,
    cos,
    describe,
    equations_of,
    functions_of_time,
    ground,
    latex,
    linearize,
    newton_euler,
    pi,
    rotate,
    sin,
    state_space,
    subs,
    symbols,
    t,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody.errors import ModelError
from symbody.models import bicycle

m, M, l, g, k, c, Omega = symbols("m M l g k c Omega")
x, theta, F = functions_of_time("x theta F")
GRAVITY = Vector(ground, 0, 0, -g)


def cart_pole() -> System:
    """Return a cart with a pole that stands on it: theta is its angle from the upward vertical."""
    cart = Body(translate(x, 0, 0), M)
    bob = Body(translate(x, 0, 0) * rotate("Y", theta) * translate(0, 0, l), m)
    push = Force(ground, F - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    return System([cart, bob], [push], coordinates=[x, theta], gravity=GRAVITY, inputs=[F])


def test_cart_pole() -> None:
    """M q'' + C q' + K q = F r, upright: Ogata, Modern Control Engineering, 5th ed. 2010, example 3-6."""
    linear = linearize(newton_euler(cart_pole()), outputs={"tip": x + l * theta})
    assert linear.states == (x, theta, time_derivative(x), time_derivative(theta))
    assert linear.M.tolist() == [[m + M, m * l], [m * l, m * l**2]]
    assert linear.second_order.C.tolist() == [[c, 0], [0, 0]]
    assert linear.K.tolist() == [[0, 0], [0, -m * g * l]]
    assert linear.second_order.F.tolist() == [[1], [0]]
    assert linear.A.tolist()[2:] == [[0, -m * g / M, -c / M, 0], [0, (M + m) * g / (M * l), c / (M * l), 0]]
    assert linear.B.tolist() == [[0], [0], [1 / M], [-1 / (M * l)]]
    assert linear.C.tolist() == [[1, l, 0, 0]]
    assert linear.ignorable == ()  # an output depends on x
    assert linearize(newton_euler(cart_pole())).ignorable == (x,)


def test_matrices_of_many_parameters() -> None:
    linear = linearize(newton_euler(cart_pole()), outputs=[time_derivative(x, 2)])
    lengths = np.linspace(0.5, 2, 7)
    many = state_space(linear, {m: 0.3, M: 2.0, g: 9.81, c: 0.1, l: lengths})
    assert many.A.shape == (7, 4, 4)
    assert_allclose(many.A[:, 3, 1], 2.3 * 9.81 / (2 * lengths), rtol=1e-14)
    assert_allclose(many.C[:, 0], many.A[:, 2], rtol=1e-14)
    assert_allclose(many.D[:, 0, 0], 0.5, rtol=1e-14)
    one = state_space(linear, {m: 0.3, M: 2.0, g: 9.81, c: 0.1, l: 0.5})
    assert_allclose(one.A, many.A[0], rtol=1e-15)


def test_about_hanging() -> None:
    linear = linearize(newton_euler(cart_pole()), about={theta: pi})
    assert linear.K.tolist() == [[0, 0], [0, m * g * l]]
    assert linear.M.tolist() == [[m + M, -m * l], [-m * l, m * l**2]]


def test_formulas() -> None:
    linear = linearize(newton_euler(cart_pole()))
    assert linear.latex() == (
        r"\begin{bmatrix} M + m & l m \\ l m & m l^{2} \end{bmatrix} "
        r"\begin{bmatrix} \ddot{x} \\ \ddot{\theta} \end{bmatrix} + "
        r"\begin{bmatrix} c & 0 \\ 0 & 0 \end{bmatrix} \begin{bmatrix} \dot{x} \\ \dot{\theta} \end{bmatrix} + "
        r"\begin{bmatrix} 0 & 0 \\ 0 & -g l m \end{bmatrix} \begin{bmatrix} x \\ \theta \end{bmatrix} = "
        r"\begin{bmatrix} 1 \\ 0 \end{bmatrix} \begin{bmatrix} F \end{bmatrix}"
    )
    assert linear._repr_latex_() == rf"$\displaystyle {linear.latex()}$"
    assert linear._repr_html_() is None
    assert repr(linear) == "Linear(states x, theta, x', theta'; inputs F; outputs none)"


def test_long_models_are_listed() -> None:
    model = bicycle()
    about = {time_derivative(model["rear_angle"]): -symbols("v") / model["rR"]}
    linear = linearize(newton_euler(model.system), about, outputs=[model["lean"]])
    assert linear._repr_latex_() is None
    html = linear._repr_html_()
    assert html is not None
    assert "T_lean, T_steer" in html
    assert "ignorable coordinates" in html


def test_states_without_a_form_of_second_order() -> None:
    """A force that follows a command with a lag: x'' = f/m, f' = (F - f)/T."""
    f, T = functions_of_time("f"), symbols("T")
    eqs = equations_of([[m]], [f], [x], inputs=[F], states={f: (F - f) / T})
    linear = linearize(eqs, outputs=[time_derivative(x, 2)])
    assert linear.states == (x, time_derivative(x), f)
    assert linear.A.tolist() == [[0, 1, 0], [0, 0, 1 / m], [0, 0, -1 / T]]
    assert linear.B.tolist() == [[0], [0], [1 / T]]
    assert linear.C.tolist() == [[0, 0, 1 / m]]
    assert r"\dot{f}" in linear.latex()


def test_parameters_as_inputs() -> None:
    """A change of the stiffness of a spring that bears a weight: K x = -x0 k."""
    k, x0 = symbols("k x0")
    eqs = equations_of([[m]], [m * g - k * x], [x])
    linear = linearize(eqs, {x: m * g / k}, inputs=[k])
    assert linear.B.tolist() == [[0], [-g / k]]
    held = linearize(eqs, {x: x0}, inputs=[k])
    assert held.B.tolist() == [[0], [-x0 / m]]
    assert [each.name for each in held.conditions] == ["the equation of motion of x'"]


def test_pulled_pendulum_by_coordinates_that_depend() -> None:
    """A bead on a circle, pulled aside: the force of the circle turns with it; ``omega^2 = size/(m l)``."""
    y, (a, b) = functions_of_time("y"), symbols("a b")
    bead = Body(translate(x, y, 0), m)
    pull = Force(ground, a, b, 0, at=bead.center_of_mass, on=bead)
    alpha = symbols("alpha")
    eqs = newton_euler(System([bead], [pull], coordinates=[x, y], constraints=[x**2 + y**2 - l**2]))
    size = symbols("size")
    at = {x: l * cos(alpha), y: l * sin(alpha)}
    made = subs(eqs, {a: size * cos(alpha), b: size * sin(alpha)})
    linear = linearize(made, at, independent=[x])
    assert linear.A[1, 0] == -size / (m * l)
    assert linear.about[made.multipliers[0]] == -size / (2 * l)
    assert linear.recovery[1, 0] == -cos(alpha) / sin(alpha)


def test_rates_of_inputs_are_inputs() -> None:
    """A pendulum whose support is moved: ``l theta'' = a'' cos(theta) - g sin(theta)``, with a'' alone."""
    a = functions_of_time("a")
    bob = Body(translate(a, 0, 0) * rotate("Y", theta) * translate(0, 0, -l), m)
    eqs = newton_euler(System([bob], coordinates=[theta], gravity=Vector(ground, 0, 0, -g), inputs=[a]))
    for about in (None, {a: 0}, {a: symbols("V") * t}, {time_derivative(a, 2): 0}):
        for inputs in (None, [a], [time_derivative(a, 2)]):
            linear = linearize(eqs, about, inputs=inputs)
            assert linear.inputs == (time_derivative(a, 2),)
            assert linear.A.tolist() == [[0, 1], [-g / l, 0]]
            assert linear.B.tolist() == [[0], [1 / l]]


def test_rates_of_inputs_in_outputs_are_inputs() -> None:
    """``o = F F'`` about F = F0: ``do = F0 dF'``."""
    k, F0 = symbols("k F0")
    linear = linearize(
        equations_of([[m]], [F - k * x], [x], inputs=[F]),
        {F: F0, x: F0 / k},
        outputs={"o": F * time_derivative(F), "rate": time_derivative(F)},
    )
    assert linear.inputs == (F, time_derivative(F))
    assert linear.B.tolist() == [[0, 0], [1 / m, 0]]
    assert linear.C.tolist() == [[0, 0], [0, 0]]
    assert linear.D.tolist() == [[0, F0], [0, 1]]


def test_an_input_that_moves_at_a_constant_rate() -> None:
    """``F = c (w' - x')``: a belt moves under a mass that rests on it, wherever the belt is."""
    x, w = functions_of_time("x w")
    m, c, V = symbols("m c V")
    body = Body(translate(x, 0, 0), m)
    load = Force(ground, c * (time_derivative(w) - time_derivative(x)), 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [load], coordinates=[x]))
    for about in ({time_derivative(w): V}, {w: 0, time_derivative(w): V}, {w: 3 + V * t}):
        assert Matrix([[0, 1], [0, -c / m]]) == linearize(eqs, {**about, time_derivative(x): V}).A


def test_an_input_that_moves_where_its_value_matters() -> None:
    x, w = functions_of_time("x w")
    m, k, V = symbols("m k V")
    body = Body(translate(x, 0, 0), m)
    load = Force(ground, k * (w - x) + time_derivative(w), 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [load], coordinates=[x]))
    with pytest.raises(ModelError, match=r"the motion is not steady.*changes with t"):
        linearize(eqs, {w: 0, time_derivative(w): V})


def test_a_linear_model_is_shown_as_text_and_in_latex() -> None:
    """Text has the matrices row by row; `latex` takes what has a formula of its own."""
    x, (m, k, c) = functions_of_time("x"), symbols("m k c")
    block = Body(translate(x, 0, 0), m)
    equations = newton_euler(System([block], [torsion_spring(x, k, damping=c, on=block)], [x]))
    model, form = linearize(equations), equations.matrix_form()
    assert describe(model) == "M q'' + C q' + K q = 0\n    q = (x)\n    M = [m]\n    C = [c]\n    K = [k]"
    assert (latex(model), latex(form)) == (model.latex(), form.latex())
