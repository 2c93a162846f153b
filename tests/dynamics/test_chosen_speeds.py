"""Speeds of the user's choice: regular rates, short equations, and moving frames beside them."""

from __future__ import annotations

from symbody import (
    Body,
    Expr,
    Force,
    System,
    Vector,
    angular_velocity,
    cos,
    cost,
    floating_frame,
    forward_dynamics,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    rotate,
    sin,
    substitute,
    symbols,
    time_derivative,
    translate,
)

m, A, B, C, g = symbols("m A B C g")
x, y, th, q1, q2, q3 = functions_of_time("x y th q1 q2 q3")
u, v, w = functions_of_time("u v w")
AFLOAT = floating_frame("base")
X_AFLOAT = AFLOAT.pose.origin[0]


def test_angular_velocities_of_three_angles_give_eulers_equations() -> None:
    frame = rotate("X", q1) * rotate("Y", q2) * rotate("Z", q3)
    components = angular_velocity(frame).components
    system = System(
        [Body(frame, m, A, B, C)], (), [q1, q2, q3], kinematics=dict(zip((u, v, w), components, strict=True))
    )
    eqs = newton_euler(system)
    rates = [time_derivative(each) for each in (u, v, w)]
    assert eqs.residuals == (
        A * rates[0] + (C - B) * v * w,
        B * rates[1] + (A - C) * u * w,
        C * rates[2] + (B - A) * u * v,
    )
    assert [str(entry) for entry in eqs.mass_matrix.entries] == ["A", "0", "0", "0", "B", "0", "0", "0", "C"]
    for rate in system.kinematics.values():  # finite where the second angle is zero
        rate.evaluate({q1: 0.1, q2: 0.0, q3: 0.2, u: 1.0, v: 2.0, w: 3.0})


def test_each_definition_is_solved_for_the_rate_that_never_fails() -> None:
    """One definition of two rates: that of the angle can always be solved for, those of places can't."""
    xp, yp, turning = map(time_derivative, (x, y, th))
    body = Body(translate(x, y, 0) * rotate("Z", th), m, A, B, C)
    system = System([body], (), [x, y, th], kinematics={u: xp * cos(th) + yp * sin(th) + 2 * turning})
    assert system.speeds == (u, xp, yp)
    assert system.kinematics[turning] == (u - xp * cos(th) - yp * sin(th)) / 2


def test_skates_are_embedded() -> None:
    """Two rates by one speed leave out the constraint of a knife edge and its multiplier."""
    body = Body(translate(x, y, 0) * rotate("Z", th), m, A, B, C)
    kinematics = {time_derivative(x): u * cos(th), time_derivative(y): u * sin(th)}
    eqs = newton_euler(System([body], (), [x, y, th], speeds=[u], kinematics=kinematics))
    assert eqs.speeds == (u, time_derivative(th))
    assert eqs.residuals == (m * time_derivative(u), C * time_derivative(th, 2))
    assert cost(forward_dynamics(eqs).accelerations).total == 0


def test_coordinates_of_moving_frames_move_other_frames() -> None:
    """A lamp above a skate is the same as one on a frame of its own in the same place."""
    cart = moving_frame(u, 0, 0, 0, 0, w, pose=translate(x, y, 0) * rotate("Z", th))
    above = System([Body(cart, m, A, B, C), Body(translate(x, y, 3) * rotate("Z", th), m)], speeds=[u, w])
    fixed = System([Body(cart, m, A, B, C), Body(cart * translate(0, 0, 3), m)], speeds=[u, w])
    assert newton_euler(above).residuals == newton_euler(fixed).residuals
    assert newton_euler(above).mass_matrix == newton_euler(fixed).mass_matrix


def test_the_equations_of_several_moving_frames_are_those_of_each() -> None:
    def cart(k: int) -> tuple[Body, list[Expr]]:
        X, Y, angle, U, W = functions_of_time(f"x{k} y{k} th{k} u{k} w{k}")
        frame = moving_frame(U, 0, 0, 0, 0, W, pose=translate(X, Y, 0) * rotate("Z", angle))
        return Body(frame * translate(1, 0, 0), m, A, B, C), [U, W]

    parts = [cart(1), cart(2), (Body(AFLOAT * translate(0, 2, 0), m, A, B, C), [])]
    gravity = Vector(ground, 0, 0, -g)
    alone = [newton_euler(System([body], gravity=gravity, speeds=speeds)) for body, speeds in parts]
    together = newton_euler(
        System(
            [body for body, _ in parts], gravity=gravity, speeds=[s for _, speeds in parts for s in speeds]
        )
    )
    by_speed = dict(zip(together.speeds, together.residuals, strict=True))
    for one in alone:
        assert [by_speed[speed] for speed in one.speeds] == list(one.residuals)


def test_moving_frames_beside_chosen_speeds() -> None:
    """A wheel's speed is chosen beside the speeds of its cart: its row and the cart's add up by the chain rule."""
    cart = moving_frame(u, 0, 0, 0, 0, w, pose=translate(x, y, 0) * rotate("Z", th))
    wheel = Body(cart * rotate("Y", q1), m, A, B, A)
    plain = newton_euler(System([wheel], (), [q1], speeds=[u, w]))
    spin = time_derivative(q1)
    chosen = newton_euler(System([wheel], (), [q1], speeds=[u, w, v], kinematics={v: 2 * spin + u}))
    rows = substitute(
        plain.residuals, {time_derivative(q1, 2): (time_derivative(v) - time_derivative(u)) / 2}
    )
    rows = substitute(rows, {spin: (v - u) / 2})
    assert chosen.residuals == (rows[0] - rows[2] / 2, rows[1], rows[2] / 2)


def test_a_load_may_hold_accelerations_of_coordinates_whatever_the_speeds() -> None:
    """The second rate of a floating frame's position is written by the rates of its speeds."""
    body = Body(AFLOAT, m, A, B, C)
    drag = Force(ground, -A * time_derivative(X_AFLOAT, 2), 0, 0, at=body.center_of_mass, on=body)
    eqs = newton_euler(System([body], [drag]))
    upright = dict(zip(AFLOAT.motions[0].quaternion, (1, 0, 0, 0), strict=True))
    assert eqs.mass_matrix[0, 0].subs(upright) == m + A
    assert eqs.mass_matrix[1, 1].subs(upright) == m


def test_the_symbols_of_the_kinematics_belong_to_the_model() -> None:
    """So no default multiplier takes the name of one of them."""
    rates = {time_derivative(x): symbols("lambda1") * u, time_derivative(y): u}
    system = System([Body(translate(x, y, 0), m)], (), [x, y], [x - y], speeds=[u], kinematics=rates)
    assert symbols("lambda1") in system.leaves
    assert [str(each) for each in system.multipliers] == ["lambda2"]
