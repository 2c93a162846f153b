"""Forces and torques: what they act on, where, and their power."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Force,
    ModelNotice,
    Point,
    Torque,
    Vector,
    euler_equations,
    functions_of_time,
    generalized_force,
    ground,
    newton_equations,
    power,
    project,
    resultant,
    rotate,
    symbols,
    time_derivative,
    translate,
)

m, F, M, R, a = symbols("m F M R a")
x, phi = functions_of_time("x phi")
v, w = time_derivative(x), time_derivative(phi)
cart = Body(translate(x, 0, 0), m, name="cart")
wheel = Body(translate(x, 0, R) * rotate("Y", phi), m, name="wheel")


def test_a_force_from_a_vector_or_from_components() -> None:
    one = Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart)
    two = Force(Vector(ground, F, 0, 0), at=cart.center_of_mass, on=cart)
    assert one.components == two.components == (F, 0, 0)
    assert one.reaction is None


def test_power_of_a_force_and_its_reaction() -> None:
    force = Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart, reaction=wheel)
    # The reaction acts at the same place: on the wheel's point at the height of the ground.
    assert power(force) == F * v - F * (v - R * w)


def test_power_of_a_torque() -> None:
    assert power(Torque(ground, 0, M, 0, on=wheel)) == M * w
    assert power(Torque(ground, 0, M, 0, on=wheel, reaction=cart)) == M * w
    assert power(Torque(ground, 0, M, 0, on=cart)) == 0


def test_a_force_acts_on_the_material_point() -> None:
    """The point of contact moves along with the hub, but the tyre's point there rolls: friction does no work."""
    contact = Point(translate(x, 0, 0), 0, 0, 0)
    friction = Force(ground, F, 0, 0, at=contact, on=wheel)
    assert power(friction) == F * (v - R * w)
    assert generalized_force(friction, [x, phi]) == [F, -F * R]
    assert euler_equations([wheel, friction], wheel.center_of_mass).components[1] == F * R


def test_projection_keeps_what_a_load_acts_on() -> None:
    T = rotate("Z", phi)
    force = project(Force(T, F, 0, 0, at=cart.center_of_mass, on=cart, reaction=wheel, name="F1"), ground)
    assert (force.frame, force.on, force.reaction, force.name) == (ground, cart, wheel, "F1")
    torque = project(Torque(T, 0, 0, M, on=cart, name="M1"), ground)
    assert (torque.components, torque.on, torque.name) == ((0, 0, M), cart, "M1")


@pytest.mark.parametrize("equations", [newton_equations, euler_equations])
def test_a_load_on_another_body_is_left_out_with_a_notice(equations: object) -> None:
    assert callable(equations)
    stray = Force(ground, F, 0, 0, at=wheel.center_of_mass, on=wheel, name="drag")
    with pytest.warns(ModelNotice, match="drag is left out: it acts on wheel, not in the set"):
        result = equations([cart, stray], gravity=None)
    assert result.components == equations([cart]).components


def test_only_the_reaction_acts_where_only_its_body_is() -> None:
    force = Force(ground, F, 0, 0, at=wheel.center_of_mass, on=wheel, reaction=cart)
    assert newton_equations([cart, force]).components[0] == m * time_derivative(x, 2) + F


def test_generalized_force_for_any_variable() -> None:
    s, alpha = symbols("s alpha")
    body = Body(translate(s, 0, 0) * rotate("Z", alpha), m)
    load = [Force(ground, F, 0, 0, at=Point(body.frame, 0, a, 0), on=body), Torque(ground, 0, 0, M, on=body)]
    forces = generalized_force(load, [s, alpha])
    assert forces[0] == F
    assert forces[1].subs({alpha: 0}) == M - F * a
    assert generalized_force(load, s) == F


def test_the_resultant_of_a_load_and_of_its_reaction_are_opposite() -> None:
    """About any point; that of several loads is the sum."""
    mast = Body(translate(x, 1, 0), 1, name="mast")
    loads = [
        Force(ground, F, 2 * F, 0, at=Point(cart.frame, 0, a, 0), on=cart, reaction=mast),
        Torque(ground, 0, 0, M, on=mast, reaction=cart),
    ]
    about = Point(ground, 0, 0, 1)
    one, other = (resultant(loads, about, on=body) for body in (cart, mast))
    assert one.force.components == (F, 2 * F, 0)
    assert one.moment.components == (2 * F, -F, 2 * F * x - F * a - M)
    for mine, yours in zip(one, other, strict=True):
        assert all(
            (left + right).is_zero for left, right in zip(mine.components, yours.components, strict=True)
        )
