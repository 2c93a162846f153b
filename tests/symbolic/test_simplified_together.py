"""`simplify` of a container: the same values, never dearer all together, and bounded."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Expr,
    System,
    Vector,
    cos,
    cost,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    simplify,
    sin,
    symbols,
    translate,
)

x, a, b, l, g, m = symbols("x a b l g m")


def crane_on_a_jib() -> System:
    r, s, p, q1, q2 = functions_of_time("r s p q1 q2")
    jib = rotate("Z", p)
    trolley, load = jib * translate(r, 0, a), jib * translate(r, 0, a) * rotate("X", q1) * rotate("Y", q2)
    bodies = [Body(jib, 0, 0, 0, b), Body(trolley, m), Body(load * translate(0, 0, -s), m)]
    return System(bodies, coordinates=[r, s, p, q1, q2], gravity=Vector(ground, 0, 0, -g))


def links_on_a_cart() -> System:
    q = functions_of_time("q0 q1 q2 q3")
    frame, bodies = rotate("Z", q[0]), []
    for axis, angle in zip("XZX", q[1:], strict=True):
        frame = frame * rotate(axis, angle)
        bodies.append(Body(frame * translate(0, 0, -l), m, a, a, b))
        frame = frame * translate(0, 0, -2 * l)
    return System(bodies, coordinates=list(q), gravity=Vector(ground, 0, 0, -g))


@pytest.mark.parametrize("system", [crane_on_a_jib(), links_on_a_cart()], ids=["crane", "links"])
def test_all_together_never_cost_more(system: System) -> None:
    equations = newton_euler(system)
    residuals = list(equations.residuals)
    one_by_one = [simplify(each) for each in residuals]
    assert cost(one_by_one).total > cost(residuals).total  # what each saves by itself, all of them lose
    found = simplify(residuals)
    assert cost(found).total <= cost(residuals).total
    assert found == residuals
    assert [str(each) for each in simplify(residuals)] == [str(each) for each in found]
    matrix = equations.mass_matrix
    assert cost(simplify(matrix)).total <= cost(matrix).total


def test_forms_that_cost_all_nothing_are_taken() -> None:
    shared = (a + b) * sin(x)
    sum_of_angles = sin(a) * cos(b) + cos(a) * sin(b)
    found = simplify([sum_of_angles, shared, m * sum_of_angles + shared])
    assert [str(each) for each in found] == ["sin(a + b)", "(a + b)*sin(x)", "m*sin(a + b) + (a + b)*sin(x)"]


def test_large_containers_are_simplified_in_part() -> None:
    """Each expression takes 7 operations by itself; those past 1000 keep their forms."""
    entries: list[Expr] = [sin(q) * cos(b) + cos(q) * sin(b) for q in functions_of_time("q:200")]
    found = simplify(entries)
    assert found == entries
    assert [not each.same_form(given) for each, given in zip(found, entries, strict=True)] == [
        7 * n < 1000 for n in range(200)
    ]
