"""The names of the matrices of equations: no parameter looks like one, and named loads are told."""

from __future__ import annotations

import re

from symbody import (
    Body,
    Force,
    System,
    Vector,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    origin,
    parse,
    rotate,
    spring,
    symbols,
    translate,
)

g, m, M, l, k, c, s = symbols("g m M l k c s")
x, theta, F = functions_of_time("x theta F")
CAR = Body(translate(x, 0, 0), M)
POLE = Body(translate(x, 0, 0) * rotate("Z", theta) * translate(0, -l, 0), m)
WALL = spring(CAR.center_of_mass, origin(ground), k, damping=c, on=CAR, name="wall")
MOTOR = Force(ground, F, 0, 0, at=CAR.center_of_mass, on=CAR, name="motor")
DOWN = Vector(ground, 0, -g, 0)


def test_a_matrix_with_the_name_of_a_parameter_has_arguments() -> None:
    form = newton_euler(System([CAR, POLE], [WALL, MOTOR], [x, theta], gravity=DOWN)).matrix_form()
    lines = [line.strip() for line in form.description().splitlines()]
    assert lines[:4] == [
        "M(q)*q'' + c(q, q') + g(q) + k(q, q') = Q",
        "k(q, q'): wall",
        "Q: motor",
        "M11 = M + m",
    ]


def test_a_matrix_without_such_a_parameter_has_its_letter_alone() -> None:
    weight = System([Body(translate(x, 0, 0), m)], [], [x], gravity=Vector(ground, s, 0, 0))
    assert newton_euler(weight).matrix_form().description().splitlines()[0] == "M*x'' + g = 0"


def test_matrices_are_bold_below_their_equation() -> None:
    text = newton_euler(System([CAR, POLE], [WALL, MOTOR], [x, theta], gravity=DOWN)).matrix_form().latex()
    assert text.startswith(
        r"\begin{aligned} &\mathbf{M} \ddot{\mathbf{q}} + \mathbf{c} + \mathbf{g} + \mathbf{k} = \mathbf{Q} \\ "
        r"\mathbf{M} &= \begin{bmatrix} M + m &"
    )


def test_speeds_of_their_own_stand_in_the_equation() -> None:
    u, v, w = functions_of_time("u v w")
    car = System([Body(moving_frame(u, v, 0, 0, 0, w), M, Iz=c)], speeds=[u, v, w])
    form = newton_euler(car).matrix_form()
    assert form.description().splitlines()[0] == "M(q)*u' + c(q, u) = 0"
    assert r"\mathbf{M} \dot{\mathbf{u}} + \mathbf{c} = 0" in form.latex()


def test_a_label_is_no_parameter_of_a_named_force() -> None:
    """`k1 = F*x/l` with `F := k1*(l - l0)` defined k1 by itself."""
    y, k1, g2 = functions_of_time("y"), *symbols("k1 g2")
    mass = Body(translate(x, y, 0), m)
    hung = spring(mass.center_of_mass, origin(ground), k1, free_length=l, damping=g2, on=mass)
    text = newton_euler(System([mass], [hung], [x, y], gravity=DOWN)).matrix_form().description()
    assert "F := g2*d' + k1*(d - l)" in text
    assert "k[1] = F*x/d" in text
    assert "g[2] = g*m" in text


def test_entries_that_are_negative_have_names() -> None:
    """`M12*q1''`, not `-(..)*q1''`, in rows that are the equations."""
    angles, frame = functions_of_time("q1 q2 q3"), translate(x, 0, 0)
    bodies = [Body(frame, M)]
    for k, angle in enumerate(angles, 1):
        mass, inertia, length, arm = symbols(f"m{k} J{k} l{k} r{k}")
        frame = frame * rotate("Z", angle)
        bodies.append(Body(frame * translate(arm, 0, 0), mass, Iz=inertia))
        frame = frame * translate(length, 0, 0)
    system = System(bodies, coordinates=[x, *angles], gravity=DOWN)
    equations = newton_euler(system)
    lines = re.sub(r"\n {5,}", " ", equations.description()).splitlines()[1:]
    known = {str(leaf): leaf for leaf in system.leaves}
    for line in lines[:-4]:
        name, value = line.split(" := ")
        known[name.strip()] = parse(value, known)
    assert [parse(line.removesuffix(" = 0"), known) for line in lines[-4:]] == [*equations.residuals]
    assert [known["M12"], known["M13"]] == [equations.mass_matrix[0, 1], equations.mass_matrix[0, 2]]
    assert "+ M12*q1'' + M13*q2''" in lines[-4]
    assert "M12*x''" in lines[-3]
