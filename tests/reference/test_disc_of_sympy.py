"""A rolling disc, of which three of SymPy's tests expect what is no motion of a disc: who is right, by SymPy itself.

* `test_kane::test_aux` takes the acceleration of the centre from `a2pt_theory`, with the point of contact as a point of
  the disc without acceleration. The particle of the disc that touches the ground has one, ``-w x c'``, where c' is the
  velocity with which the contact moves on.
* `test_lagrange::test_rolling_disc` substitutes rolling into the Lagrangian, so that its equations leave out the forces
  of a nonholonomic constraint [Greenwood 2003, sec. 2.3]; its weight acts upwards. An upright disc has
  ``q1'' = -(C/A) q3' q2'``, -2 q3' q2' if it is thin, and not -6.
* `test_linearize::test_linearize_rolling_disc_lagrange` is the linear model of the same equations.
"""

from __future__ import annotations

from functools import cache

import pytest

from symbody import (
    Body,
    Constraint,
    Equations,
    Expr,
    Matrix,
    System,
    Vector,
    angular_velocity,
    center_of_mass,
    cos,
    cross,
    dependent_speeds,
    dot,
    forward_dynamics,
    from_sympy,
    functions_of_time,
    gradient,
    ground,
    jacobian,
    lagrange,
    newton_euler,
    number,
    project,
    rotate,
    substitute,
    symbols,
    tan,
    time_derivative,
    translate,
    velocity,
)
from tests.reference.mechanisms.rolling_disc import (
    BODY_SPEEDS,
    contact_rates,
    rolling_disc,
    u1,
    u2,
    u3,
    u4,
    u5,
)
from tests.reference.mechanisms.sympy_expectation import expectation
from tests.reference.test_rolling_disc_by_speeds import kanes_rows

sympy = pytest.importorskip("sympy")
mechanics = pytest.importorskip("sympy.physics.mechanics")

m, r, g = symbols("m r g")
q = q1, q2, q3 = functions_of_time("q1 q2 q3")
d1, d2, d3 = map(time_derivative, q)
AUX, LAGRANGE = "test_kane::test_aux", "test_lagrange::test_rolling_disc"
LINEAR = "test_linearize::test_linearize_rolling_disc_lagrange"


def kanes_rows_of_the_test() -> tuple[Expr, ...]:
    """Return the sum of SymPy's Fr and Fr*."""
    pairs = zip(expectation(AUX, "fr"), expectation(AUX, "frstar"), strict=True)
    return tuple(active + inertial for active, inertial in pairs)


@cache
def own_rows() -> tuple[Expr, ...]:
    """Return the same of the disc that is derived here."""
    f1, f2 = functions_of_time("f1 f2")
    slips = [Constraint(u4, multiplier=f1), Constraint(u5, multiplier=f2)]
    system = rolling_disc(BODY_SPEEDS | contact_rates(u4, u5), constraints=slips)
    held = dict.fromkeys([u4, u5, *map(time_derivative, (u4, u5))], 0)
    return tuple(-row for row in substitute(newton_euler(system).residuals, held))


def test_active_forces_with_auxiliary_speeds() -> None:
    still = dict.fromkeys([u1, u2, u3, *map(time_derivative, (u1, u2, u3))], 0)
    assert substitute(own_rows(), still) == expectation(AUX, "fr")


def test_a_contact_without_acceleration_makes_the_expectation_of_sympy() -> None:
    """SymPy gives what its test expects with `a2pt_theory`, and what is derived here from the rate of the velocity."""
    assert tuple(from_sympy(row) for row in kanes_rows(by_contact=True)) == kanes_rows_of_the_test()
    assert tuple(from_sympy(row) for row in kanes_rows()) == own_rows()


def test_the_acceleration_of_the_contact_is_the_whole_difference() -> None:
    """The particle at the contact has ``-w x c'``; times the mass and partial velocities of the centre."""
    headed = rotate("Z", q1)
    leaned = headed * rotate("X", q2)
    turning, arm = Vector(leaned, u1, u2, u3), Vector(leaned, 0, 0, r)
    spin = u2 - u3 * tan(q2)
    acceleration = -cross(turning, Vector(leaned, r * spin, 0, 0))
    centre = Vector(leaned, u4, 0, 0) + Vector(headed, 0, u5, 0) + cross(turning, arm)
    components = project(centre, leaned).components
    partial = [Vector(leaned, *column) for column in jacobian(components, [u1, u2, u3, u4, u5]).T.tolist()]
    missing = [-m * dot(acceleration, each) for each in partial]
    pairs = zip(kanes_rows_of_the_test(), missing, strict=True)
    assert own_rows() == tuple(theirs + rest for theirs, rest in pairs)
    assert [rest.is_zero for rest in missing] == [False, True, True, True, False]


def test_rolling_in_the_lagrangian_makes_the_expectation_of_sympy() -> None:
    spinning = rotate("Z", q1) * rotate("X", q2)
    turning = project(angular_velocity(spinning * rotate("Y", q3)), spinning)
    speed = project(cross(turning, Vector(spinning, 0, 0, r)), spinning)
    w, v = turning.components, speed.components
    moments = [m * r**2 / 4, m * r**2 / 2, m * r**2 / 4]
    kinetic = sum((J * each**2 / 2 for J, each in zip(moments, w, strict=True)), start=number(0))
    kinetic += m * sum((each**2 for each in v), start=number(0)) / 2
    rows = [lagrange(kinetic + m * g * r * cos(q2), each) for each in q]
    accelerations = [time_derivative(each, 2) for each in q]
    M = jacobian(rows, accelerations)
    forcing = [-each for each in substitute(rows, dict.fromkeys(accelerations, 0))]
    assert M.entries == expectation(LAGRANGE, "l.mass_matrix")
    assert tuple(forcing) == expectation(LAGRANGE, "l.forcing")
    rates = (M.inverse() @ Matrix([[each] for each in forcing])).entries
    assert (d1, d2, d3, *rates) == expectation(LAGRANGE, "RHS")
    assert linear_model(rates) == expectation(LINEAR, "A") == expectation(LINEAR, "sol")


def linear_model(accelerations: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return the entries of A about upright rolling."""
    rest = dict.fromkeys((q2, d1, d2), 0)
    rows = [gradient(rate, [*q, d1, d2, d3]) for rate in (d1, d2, d3, *accelerations)]
    return substitute([slope for row in rows for slope in row], rest)


def own_disc() -> Equations:
    """Return the disc by constraints on velocities."""
    x, y = functions_of_time("x y")
    plane = translate(x, y, 0) * rotate("Z", q1) * rotate("X", q2) * translate(0, 0, r)
    disc = Body(plane * rotate("Y", q3), m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    slip = velocity(center_of_mass(disc)) + cross(angular_velocity(disc.frame), Vector(plane, 0, 0, -r))
    rolling = project(slip, ground).components[:2]
    return newton_euler(System([disc], (), [*q, x, y], rolling, Vector(ground, 0, 0, -g)))


def sympys_disc() -> Equations:
    """Return the disc by SymPy's LagrangesMethod with multipliers."""
    a, b, c, x, y = mechanics.dynamicsymbols("q1 q2 q3 x y")
    mass, radius, gravity = sympy.symbols("m r g")
    N = mechanics.ReferenceFrame("N")
    Y = N.orientnew("Y", "Axis", [a, N.z])
    L = Y.orientnew("L", "Axis", [b, Y.x])
    R = L.orientnew("R", "Axis", [c, L.y])
    O = mechanics.Point("O")
    O.set_vel(N, 0)
    centre = O.locatenew("C", x * N.x + y * N.y + radius * L.z)
    centre.set_vel(N, centre.pos_from(O).dt(N))
    inertia = mechanics.inertia(L, mass * radius**2 / 4, mass * radius**2 / 2, mass * radius**2 / 4)
    disc = mechanics.RigidBody("disc", centre, R, mass, (inertia, centre))
    disc.potential_energy = mass * gravity * radius * sympy.cos(b)
    slip = centre.vel(N) + R.ang_vel_in(N).cross(-radius * L.z)
    method = mechanics.LagrangesMethod(
        mechanics.Lagrangian(N, disc), [a, b, c, x, y], nonhol_coneqs=[slip.dot(N.x), slip.dot(N.y)]
    )
    method.form_lagranges_equations()
    return from_sympy(method)  # type: ignore[no-any-return]


def test_multipliers_of_rolling_by_sympy_confirm_the_disc_that_is_derived_here() -> None:
    own, sympys = forward_dynamics(own_disc()), forward_dynamics(sympys_disc())
    assert own.accelerations == sympys.accelerations
    theirs = expectation(LAGRANGE, "RHS")[3:]
    assert [mine == other for mine, other in zip(own.accelerations, theirs, strict=False)] == [False] * 3


def test_upright_rolling_has_the_closed_form() -> None:
    disc = own_disc()
    rolling = dependent_speeds(disc, disc.speeds[3:])
    A = linear_model(substitute(forward_dynamics(disc).accelerations[:3], rolling))
    zero, one = number(0), number(1)
    assert (
        *(zero, zero, zero, one, zero, zero),
        *(zero, zero, zero, zero, one, zero),
        *(zero, zero, zero, zero, zero, one),
        *(zero, zero, zero, zero, -2 * d3, zero),
        *(zero, 4 * g / (5 * r), zero, 6 * d3 / 5, zero, zero),
        *([zero] * 6),
    ) == A
