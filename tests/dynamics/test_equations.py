"""What `Equations` hold, with and without constraints."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    gibbs_appell,
    ground,
    kane,
    lagrange,
    lagrange_equations,
    newton_euler,
    rotate,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ModelError
from symbody.models import rolling_disc
from symbody.symbolic import derivation

m, l, g, d, omega, zeta = symbols("m l g d omega zeta")
x, y, theta, F = functions_of_time("x y theta F")
FORMALISMS = [newton_euler, lagrange_equations, kane, gibbs_appell]
gravity = Vector(ground, 0, -g, 0)


def bead() -> System:
    """Return a point mass on a circle, in Cartesian coordinates, pushed by a force and braked."""
    body = Body(translate(x, y, 0), m)
    loads = [
        Force(ground, F, 0, 0, at=body.center_of_mass, on=body),
        Force(ground, 0, -d * time_derivative(y), 0, at=body.center_of_mass, on=body),
    ]
    return System([body], loads, [x, y], [x**2 + y**2 - l**2], gravity)


@pytest.mark.parametrize("formalism", FORMALISMS)
def test_constrained_equations(formalism: type) -> None:
    equations = formalism(bead())
    (multiplier,) = equations.multipliers
    xdd, ydd = equations.accelerations
    assert equations.residuals == (
        m * xdd - F - 2 * x * multiplier,
        m * ydd + m * g + d * time_derivative(y) - 2 * y * multiplier,
    )
    assert equations.constraints == (x**2 + y**2 - l**2,)
    assert equations.constraint_jacobian.tolist() == [[2 * x, 2 * y]]
    assert equations.mass_matrix.tolist() == [[m, 0], [0, m]]
    assert equations.forcing == (F, -m * g - d * time_derivative(y))


@pytest.mark.parametrize("formalism", FORMALISMS)
def test_the_residuals_by_their_parts(formalism: type) -> None:
    equations = formalism(bead())
    n = len(equations.coordinates)
    for i in range(n):
        inertia = sum(equations.mass_matrix[i, j] * equations.accelerations[j] for j in range(n))
        reaction = sum(
            equations.constraint_jacobian[k, i] * multiplier
            for k, multiplier in enumerate(equations.multipliers)
        )
        assert equations.residuals[i] == inertia - equations.forcing[i] - reaction


def test_what_is_read_first_and_where_changes_nothing() -> None:
    """Residuals, and mass matrix and bias, are derived when they are first read, by derivations of their own."""
    disc = rolling_disc().system
    first, second, third = (newton_euler(disc) for _ in range(3))
    assert "residuals" not in vars(first)
    known = ids(first.residuals), ids((*first.mass_matrix.entries, *first.bias))
    with derivation():
        kept = [2 * entry for entry in (*second.mass_matrix.entries, *second.bias)]
        assert (ids(second.residuals), ids(entry / 2 for entry in kept)) == known
    with derivation(fresh=True, order=0):  # which drops terms of all that is made in it
        assert ids(third.residuals) == known[0]


def test_the_system_is_checked_at_once() -> None:
    with pytest.raises(ModelError, match="the coordinate y appears in no frame"):
        newton_euler(System([Body(translate(x, 0, 0), m)], coordinates=[x, y]))


def ids(expressions: Iterable[Expr]) -> list[int]:
    return [expression.id for expression in expressions]


def test_who_is_who() -> None:
    equations = newton_euler(bead())
    assert equations.coordinates == (x, y)
    assert equations.speeds == (time_derivative(x), time_derivative(y))
    assert equations.parameters == (d, g, l, m)
    assert equations.inputs == (F,)
    assert list(equations.kinematics) == list(equations.speeds)
    assert repr(equations) == "Equations(2 equations of motion, 1 constraint, coordinates x, y)"


def test_one_of_each_is_no_plural() -> None:
    x, m = functions_of_time("x"), symbols("m")
    equations = newton_euler(System([Body(translate(x, 0, 0), m)], coordinates=[x]))
    assert repr(equations.system) == "System(1 body, 0 loads, 1 coordinate)"
    assert repr(equations) == "Equations(1 equation of motion, 0 constraints, coordinate x)"
    meanings = [routine.meaning for routine in equations.program().routines]
    assert "the equation of motion: zero along a motion" in meanings
    assert "aligned" in equations._repr_latex_()


def test_baumgarte() -> None:
    (stabilised,) = newton_euler(bead()).baumgarte(omega, zeta)
    phi = x**2 + y**2 - l**2
    assert stabilised == time_derivative(phi, 2) + 2 * zeta * omega * time_derivative(phi) + omega**2 * phi


def test_lagrange_of_a_lagrangian() -> None:
    L = m * l**2 * time_derivative(theta) ** 2 / 2 + m * g * l * cos(theta)
    assert lagrange(L, theta) == m * l**2 * time_derivative(theta, 2) + m * g * l * sin(theta)


@pytest.mark.parametrize("formalism", FORMALISMS)
def test_a_driven_frame(formalism: type) -> None:
    """A bead in a turning tube: m r'' - m W^2 r."""
    W = symbols("W")
    tube = rotate("Z", W * t)
    system = System([Body(tube * translate(x, 0, 0), m)], coordinates=[x])
    assert formalism(system).residuals == (m * time_derivative(x, 2) - m * W**2 * x,)


@pytest.mark.parametrize("formalism", FORMALISMS)
def test_weight_in_a_moving_frame_is_a_force(formalism: type) -> None:
    """Gravity that is given in a frame that turns with a coordinate is no potential; it acts as it is."""
    T = rotate("Z", theta)
    system = System([Body(Point(T, l, 0, 0), m)], coordinates=[theta], gravity=Vector(T, 0, -g, 0))
    assert formalism(system).residuals == (m * l**2 * time_derivative(theta, 2) + m * g * l,)


def test_natural_coordinates() -> None:
    """A planar rod by its axis u and its end: the mass matrix is constant."""
    ux, uy = functions_of_time("ux uy")
    rod = Frame([[ux, -uy, 0, x], [uy, ux, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])
    system = System(
        [Body(Point(rod, l, 0, 0), m)], coordinates=[x, y, ux, uy], constraints=[ux**2 + uy**2 - 1]
    )
    equations = lagrange_equations(system)
    assert equations.mass_matrix.tolist() == [
        [m, 0, m * l, 0],
        [0, m, 0, m * l],
        [m * l, 0, m * l**2, 0],
        [0, m * l, 0, m * l**2],
    ]
    assert equations.bias == (0, 0, 0, 0)
