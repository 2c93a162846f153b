"""A name is typeset alike in all formulas of a document, and no parameter like the rate of a coordinate."""

import re
from pathlib import Path

from symbody import (
    Body,
    Force,
    System,
    Vector,
    forward_dynamics,
    functions_of_time,
    ground,
    latex,
    linearize,
    newton_euler,
    origin,
    report,
    rotate,
    symbols,
    translate,
)


def test_a_parameter_does_not_look_like_a_rate_that_is_not_in_the_formula() -> None:
    x, (m, k, end) = functions_of_time("x"), symbols("m k x_dot")
    body = Body(translate(x, 0, 0), m)
    spring = Force(ground, -k * (x - end), 0, 0, at=origin(body.frame), on=body)
    equations = newton_euler(System([body], [spring], [x]))
    shown = (equations, equations.matrix_form(), equations.equation_of(x), forward_dynamics(equations))
    for each in shown:
        assert r"x - \mathtt{x\_dot}" in latex(each)
        assert r"x - \dot{x}" not in latex(each)


def test_a_linear_model_tells_its_parameters_apart() -> None:
    x, (m, k, name) = functions_of_time("x"), symbols("m k x_dot")
    body = Body(translate(x, 0, 0), m)
    spring = Force(ground, -k * name * x, 0, 0, at=origin(body.frame), on=body)
    shown = linearize(newton_euler(System([body], [spring], [x])), {x: 0}).latex()
    assert r"\begin{bmatrix} k \, \mathtt{x\_dot} \end{bmatrix}" in shown


def test_names_of_a_report_are_told_apart_in_all_of_it(tmp_path: Path) -> None:
    (q1, q_1, theta), (m, g) = functions_of_time("q1 q_1 theta"), symbols("m theta_ddot")
    body = Body(translate(q1, q_1, 0) * rotate("Z", theta), m, Iz=1)
    system = System([body], coordinates=[q1, q_1, theta], gravity=Vector(ground, 0, -g, 0))
    text = re.sub(r"!\[.*?\)", "", report(system, tmp_path / "names.md").read_text(encoding="utf-8"))
    assert r"| $q_{1}$, $\mathtt{q\_1}$ | coordinate, length | m |" in text
    assert r"| $\mathtt{theta\_ddot}$ | acceleration of gravity | m/s² |" in text
    assert text.count(r"\ddot{\theta}") == 1  # the equation of theta
    assert r"m \, \ddot{\mathtt{q\_1}} + m \, \mathtt{theta\_ddot} = 0" in text
