"""Systems: order, defaults, and how they are shown."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    System,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_equations,
    symbols,
    translate,
)

m, F = symbols("m F")
x, y = functions_of_time("x y")
bodies = [Body(translate(x, 0, k), (k + 1) * m) for k in range(4)]


def test_sets_are_put_in_an_order_of_their_own() -> None:
    ordered = System({*bodies}, coordinates=[x]).bodies
    assert list(ordered) == sorted(bodies, key=lambda body: body.key)
    assert System(bodies, coordinates=[x]).bodies == tuple(bodies)


def test_loads_of_a_set_are_put_in_order() -> None:
    loads = [Force(ground, k * F, 0, 0, at=bodies[k].center_of_mass, on=bodies[k]) for k in (1, 2)]
    assert list(System(bodies, {*loads}, [x]).loads) == sorted(loads, key=lambda load: load.key)
    expected = newton_equations([*bodies, *loads]).components
    assert newton_equations({*bodies, *loads}).components == expected


def test_multipliers_have_default_names() -> None:
    system = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - y])
    assert system.multipliers == (functions_of_time("lambda1"),)


def test_multipliers_of_the_users_choice() -> None:
    N = functions_of_time("N")
    system = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[y], multipliers=[N])
    assert lagrange_equations(system).residuals[1].diff(N) == -1


def test_a_system_tells_its_size() -> None:
    system = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[y], name="bead")
    assert repr(system) == "System(bead, 1 body, 0 loads, 2 coordinates, 1 constraint)"


def test_multipliers_keep_clear_of_names_in_use() -> None:
    """In coordinates, frames, loads and constraints, as functions of time or as symbols."""
    lambda1, lambda2 = functions_of_time("lambda1 lambda2")
    lambda3, lambda4 = symbols("lambda3 lambda4")
    body = Body(translate(lambda1, y, lambda3), m)
    push = Force(ground, lambda2, 0, 0, at=body.center_of_mass, on=body)
    system = System([body], [push], [lambda1, y], [lambda1 - lambda4 * y])
    assert system.multipliers == (functions_of_time("lambda5"),)
