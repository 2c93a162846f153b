"""The matrix form of equations that were given by M and f: nothing is called by a name that isn't known."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Equations,
    Force,
    Matrix,
    ModelNotice,
    System,
    Vector,
    equations_of,
    from_sympy,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    symbols,
    time_derivative,
    translate,
)

x, q, drive = functions_of_time("x q drive")
m, k, c, g, l = symbols("m k c g l")


def crane() -> Equations:
    """A cart on a spring and a damper, with a drive, and a pendulum on it."""
    cart = Body(translate(x, 0, 0), m)
    hanging = Body(translate(x, 0, 0) * rotate("Y", q) * translate(0, 0, -l), m)
    force = drive - k * x - c * time_derivative(x)
    push = Force(ground, force, 0, 0, at=cart.center_of_mass, on=cart)
    return newton_euler(System([cart, hanging], [push], [x, q], gravity=Vector(ground, 0, 0, -g)))


def given(equations: Equations) -> Equations:
    return equations_of(equations.mass_matrix, [-each for each in equations.bias], equations.coordinates)


def column(entries: object) -> Matrix:
    return Matrix([[entry] for entry in entries])  # type: ignore[attr-defined]


def test_all_forces_have_one_name() -> None:
    form = given(crane()).matrix_form()
    assert form.description().splitlines() == [
        "M*q'' = f",
        "    M11 = 2*m",
        "    M12 = M21 = -l*m*cos(q)",
        "    M22 = m*l**2",
        "    f1 = drive - l*m*sin(q)*q'**2 - c*x' - k*x",
        "    f2 = -g*l*m*sin(q)",
    ]
    assert all(each.is_zero for each in (*form.coriolis.entries, *form.gravity.entries, *form.loads.entries))
    assert r"\mathbf{f} &= \begin{bmatrix}" in form.latex()


def test_the_matrix_of_christoffel_follows_from_the_mass_matrix() -> None:
    equations = crane()
    own, form = equations.matrix_form(christoffel=True), given(equations).matrix_form(christoffel=True)
    assert form.is_christoffel
    assert form.coriolis == own.coriolis
    assert form.applied == own.applied - own.loads - own.gravity
    assert form.description().splitlines()[0] == "M*q'' + C*q' = f"


def test_the_parts_add_up_with_constraints() -> None:
    y = functions_of_time("y")
    pendulum = equations_of([[m, 0], [0, m]], [-c * x, -m * g], [x, y], constraints=[x**2 + y**2 - l**2])
    form = pendulum.matrix_form()
    left = form.mass_matrix @ column(pendulum.accelerations)
    assert left - form.applied - form.constraints == column(pendulum.residuals)
    assert form.description().splitlines()[0] == "M*q'' = f + R"


def test_equations_of_sympy() -> None:
    mechanics = pytest.importorskip("sympy.physics.mechanics")
    sympy = pytest.importorskip("sympy")
    place, speed = mechanics.dynamicsymbols("q u")
    mass, stiffness = sympy.symbols("m k")
    N, P = mechanics.ReferenceFrame("N"), mechanics.Point("P")
    P.set_vel(N, speed * N.x)
    kane = mechanics.KanesMethod(N, [place], [speed], [place.diff() - speed])
    kane.kanes_equations([mechanics.Particle("p", P, mass)], [(P, -stiffness * place * N.x)])
    form = from_sympy(kane).matrix_form()
    assert form.description().splitlines() == ["M*u' = f", "    M11 = m", "    f1 = -k*q"]


@pytest.mark.parametrize(
    ("equations", "reason"),
    [
        (
            lambda: equations_of([[m]], [-k * x], [x], speeds=[q], kinematics={time_derivative(x): q}),
            "the speeds q are not rates of coordinates, on which Christoffel's symbols depend",
        ),
        (
            lambda: equations_of([[m, 0], [c, m]], [-k * x, 0], [x, q]),
            "the mass matrix isn't symmetric",
        ),
    ],
)
def test_where_there_are_no_symbols_of_christoffel(equations: object, reason: str) -> None:
    with pytest.warns(ModelNotice) as notices:
        form = equations().matrix_form(christoffel=True)  # type: ignore[operator]
    assert not form.is_christoffel
    assert [str(notice.message) for notice in notices] == [
        f"matrix_form: f(q, q') is returned instead of the matrix C(q, q'), since {reason}"
    ]
