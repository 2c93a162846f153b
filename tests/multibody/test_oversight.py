"""Oversights in a system: named once, when it is made, and nowhere else."""

from __future__ import annotations

import warnings

import pytest

from symbody import (
    Body,
    Force,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    equilibrium,
    forward_dynamics,
    functions_of_time,
    generate,
    ground,
    lagrange_equations,
    moving_frame,
    newton_euler,
    rotate,
    simulate,
    sin,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.errors import ModelError

x, y, phi, tau = functions_of_time("x y phi tau")
m, l, g, F = symbols("m l g F")
cart = Body(translate(x, 0, 0), m, name="cart")
bob = Body(translate(x, 0, 0) * rotate("Z", phi) * translate(0, -l, 0), m, name="bob")
WEIGHT = Vector(ground, 0, -g, 0)


def notices_of(*args: object, **more: object) -> tuple[System, list[str]]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        system = System(*args, **more)  # type: ignore[arg-type]
    assert all(issubclass(each.category, ModelNotice) and each.filename == __file__ for each in caught)
    return system, [str(each.message) for each in caught]


@pytest.mark.parametrize(
    ("load", "message"),
    [
        (
            Force(ground, F, 0, 0, at=bob.center_of_mass, on=bob, name="push"),
            "System: push is left out: it acts on bob, none of its bodies; add what is missing to bodies",
        ),
        (
            Torque(ground, 0, 0, F, on=bob, reaction=Body(ground, 1, name="wall"), name="motor"),
            (
                "System: motor is left out: it acts on bob and wall, not among its bodies; add what is missing to "
                "bodies"
            ),
        ),
        (
            Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart, reaction=bob, name="spring"),
            "System: spring acts on bob, none of its bodies, which is left out; add what is missing to bodies",
        ),
    ],
)
def test_a_load_on_a_foreign_body_is_named_once(load: Force | Torque, message: str) -> None:
    system, found = notices_of([cart], [load], [x])
    assert found == [message]
    for formalism in (newton_euler, lagrange_equations):  # warnings are errors here
        equations = formalism(system)
        assert equations.mass_matrix[0, 0] == m
        forward_dynamics(equations)


THERE = (
    "from which the body moves away; expected a point of the body, such as Point(body.frame, x, y, z); if the force "
    "shall stay there, give what exerts it"
)
jet = Body(ground, 0, name="jet")


def test_a_force_at_a_place_that_its_body_leaves_is_named() -> None:
    """A force at rest in space acts on ever other points of a body; that may be meant, or another frame was."""
    at = Point(ground, 0, l, 0)
    _, found = notices_of([bob], [Force(ground, F, 0, 0, at=at, on=bob, name="push")], [x, phi])
    assert found == [
        (
            f"System: push acts on bob at {at}, a place at rest, {THERE}: reaction=Body(ground, 0, name='jet'), which "
            "is one of the bodies"
        )
    ]
    held = Force(ground, F, 0, 0, at=at, on=bob, reaction=jet, name="push")
    assert notices_of([bob, jet], [held], [x, phi])[1] == []
    on_cart = cart.center_of_mass
    _, found = notices_of([cart, bob], [Force(ground, F, 0, 0, at=on_cart, on=bob, name="push")], [x, phi, y])
    assert found == []  # the pendulum's pin is a point of both
    other = Body(translate(y, 0, 0), m, name="other")
    _, found = notices_of(
        [other, bob], [Force(ground, F, 0, 0, at=other.center_of_mass, on=bob, name="push")], [x, phi, y]
    )
    assert found == [
        f"System: push acts on bob at {other.center_of_mass}, a place on other, {THERE}: reaction=that body"
    ]


def test_a_force_at_a_place_that_its_body_keeps_is_meant() -> None:
    """The lowest point of a wheel, a place that moves by itself, and a body at rest."""
    wheel = Body(translate(x, l, 0) * rotate("Z", phi), m, Iz=m, name="wheel")
    rest = Body(rotate("Z", phi), m, Iz=m, name="rest")
    for on, at in (
        (wheel, Point(ground, x, 0, 0)),
        (wheel, Point(translate(y, 0, 0), 0, 0, 0)),
        (rest, Point(ground, l, 0, 0)),
        (jet, Point(ground, l, 0, 0)),
    ):
        coordinates = [x, phi, y] if on is wheel else [phi, x, y]
        assert notices_of([wheel, rest, jet], [Force(ground, F, 0, 0, at=at, on=on)], coordinates)[1] == []


def test_a_constant_with_the_name_of_an_unknown_is_named() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        spring = Force(ground, -F * symbols("x"), 0, 0, at=cart.center_of_mass, on=cart, name="spring")
    assert notices_of([cart], [spring], [x])[1] == [
        (
            "System: x is two different variables; the x in spring is symbols('x'), the x among the unknowns is "
            "functions_of_time('x'): a symbol is not a function of time; use the same one in both places"
        )
    ]


def test_a_foreign_load_does_no_work_on_the_system() -> None:
    stray = Force(ground, F, 0, 0, at=bob.center_of_mass, on=bob, name="push")
    system, _ = notices_of([cart], [stray], [x])
    motion = simulate(newton_euler(system), {m: 1.0}, {time_derivative(x): 2.0}, t=(0, 1))
    assert motion.model.power is None
    assert motion.energy_drift < 1e-12


def test_a_forgotten_coordinate_is_named_when_the_system_is_made() -> None:
    _, found = notices_of([cart, bob], coordinates=[x], gravity=WEIGHT)
    (notice,) = found
    assert notice == (
        "System: phi moves bodies and is not a coordinate, so that the motion must be given from outside; add what is "
        "unknown to coordinates=[...], what is given to inputs=[...]"
    )
    _, found = notices_of([bob], coordinates=[tau], gravity=WEIGHT)
    assert found[0].startswith("System: phi, x move bodies and are not coordinates, so that")


def test_a_forgotten_coordinate_in_a_constraint_is_named() -> None:
    (psi,) = functions_of_time("psi,")
    _, found = notices_of([cart, bob], (), [x, phi], [sin(phi) - psi])
    (notice,) = found
    assert notice == (
        "System: psi occurs in a constraint and is not a coordinate, so that the motion must be given from outside; "
        "add what is unknown to coordinates=[...], what is given to inputs=[...]"
    )
    assert notices_of([cart, bob], (), [x, phi], [sin(phi) - psi], inputs=[psi])[1] == []
    _, found = notices_of([cart, bob], (), [x], [x - sin(phi) - psi])
    assert [text[:30] for text in found] == [
        "System: phi moves bodies and i",
        "System: psi occurs in a constr",
    ]


def test_what_is_listed_as_an_input_is_meant() -> None:
    system, found = notices_of([cart, bob], coordinates=[x], gravity=WEIGHT, inputs=[phi])
    assert found == []
    equations = newton_euler(system)
    motion = simulate(equations, {m: 1.0, l: 0.5, g: 9.81}, t=(0, 1), inputs={phi: sin(t)})
    assert motion[phi][-1] == pytest.approx(0.8414709848)
    with pytest.raises(ModelError) as caught:
        simulate(equations, {m: 1.0, l: 0.5, g: 9.81}, t=(0, 1))
    assert str(caught.value) == (
        "simulate: the equations contain the functions of time phi, which are neither coordinates nor speeds; give "
        "them as inputs={phi: sin(t)}, or add those that are unknown to the coordinates of the System"
    )
    with pytest.raises(ModelError) as caught:
        equilibrium(equations, {m: 1.0, l: 0.5, g: 9.81, phi: 0.25})
    assert str(caught.value) == (
        "equilibrium: the equations contain the functions of time phi, which are neither coordinates nor speeds; phi "
        "is among the parameters; give them as inputs={phi: 0.25}, or add those that are unknown to the coordinates of "
        "the System"
    )


def test_inputs_of_loads_and_of_moving_frames_need_no_list() -> None:
    """Torques and the speeds of moving frames are given as often as not."""
    drive = Torque(ground, 0, 0, tau, on=bob)
    assert notices_of([cart, bob], [drive], [x, phi])[1] == []
    (speed, turn, y, psi) = functions_of_time("speed turn y psi")
    car = moving_frame(speed, 0, 0, 0, 0, turn, pose=translate(x, y, 0) * rotate("Z", psi))
    assert notices_of([Body(car, m, Iz=1)], speeds=[turn])[1] == []


def test_an_unknown_is_no_input() -> None:
    with pytest.raises(ModelError) as caught:
        System([cart, bob], coordinates=[x, phi], inputs=[phi])
    assert str(caught.value) == (
        "System: phi is an input and unknown; leave it out of inputs, or of coordinates, speeds and multipliers"
    )
    with pytest.raises(ModelError, match="System: the input l isn't a function of time"):
        System([cart, bob], coordinates=[x, phi], inputs=[l])


def test_code_of_a_declared_input(tmp_path: object) -> None:
    system, _ = notices_of([cart, bob], coordinates=[x], inputs=[phi])
    program = newton_euler(system).program()
    assert [a.variables for a in program.arguments if a.name == "r"] == [
        (phi, time_derivative(phi), time_derivative(phi, 2))
    ]
    assert generate(program, "c", str(tmp_path))


def test_different_variables_of_one_name_that_move_bodies_are_named() -> None:
    """A library may make its variables in a file of its own, so that no notice is given there."""
    other: dict[str, object] = {}
    text = "from symbody import symbols; phi = symbols('phi'); l = symbols('l', positive=True)"
    exec(compile(text, "a_library", "exec"), other)
    turned = Body(rotate("Z", other["phi"]) * translate(l, 0, 0), m)  # type: ignore[arg-type]
    _, found = notices_of([cart, bob, turned], (), [x, phi])
    assert found == [
        (
            "System: different variables move bodies under the name phi; the phi in one place is symbols('phi'), the "
            "phi in another is functions_of_time('phi'): a symbol is not a function of time; use the same one in both "
            "places"
        )
    ]
    longer = Body(translate(other["l"], x, 0), m)  # type: ignore[arg-type]
    _, found = notices_of([cart, bob, longer], (), [x, phi])
    assert [text[:61] for text in found] == ["System: different variables move bodies under the name l; the"]
