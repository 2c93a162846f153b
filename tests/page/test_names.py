"""Systems that differ in their names alone have the same terms on the page."""

from __future__ import annotations

import os
import random
import re
from collections.abc import Callable, Sequence

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    describe,
    friction,
    functions_of_time,
    ground,
    latex,
    newton_euler,
    rotate,
    spring,
    subs,
    symbols,
    time_derivative,
    translate,
)
from symbody.symbolic.calculus.standard_names import standard_names

Make = Callable[[Sequence[Expr], Sequence[Expr]], System]

LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSUVWXYZ"


def chain(q: Sequence[Expr], p: Sequence[Expr], axes: str = "ZZZZ") -> System:
    """Return point masses at the ends of links."""
    frame, bodies = ground, []
    for axis, angle, mass, length in zip(axes, q, p[1::2], p[2::2], strict=False):
        frame = frame * rotate(axis, angle) * translate(0, -length, 0)
        bodies.append(Body(frame, mass))
    return System(bodies, coordinates=[*q], gravity=Vector(ground, 0, -p[0], 0))


def arm(q: Sequence[Expr], p: Sequence[Expr]) -> System:
    return chain(q, p, "YZZ")


def rods_on_a_cart(q: Sequence[Expr], p: Sequence[Expr]) -> System:
    """Return two rods on a cart that is held by a spring with a damper."""
    frame = translate(q[0], 0, 0)
    bodies = [Body(frame, p[1])]
    for angle, (mass, length, centre, inertia) in zip(q[1:], (p[2:6], p[6:10]), strict=True):
        frame = frame * rotate("Z", angle)
        bodies.append(Body(frame * translate(0, -centre, 0), mass, Iz=inertia))
        frame = frame * translate(0, -length, 0)
    force = spring(
        Point(translate(q[0], 0, 0), 0, 0, 0), Point(ground, 0, 0, 0), p[10], damping=p[11], on=bodies[0]
    )
    return System(bodies, [force], coordinates=[*q], gravity=Vector(ground, 0, -p[0], 0))


def ball_in_a_ring(q: Sequence[Expr], p: Sequence[Expr]) -> System:
    outer, inner = p[3], p[4]
    centre = rotate("Z", q[0]) * translate(0, inner - outer, 0)
    ball = Body(centre * rotate("Z", -q[0] * outer / inner), p[1], Iz=p[2])
    return System([ball], coordinates=[*q], gravity=Vector(ground, 0, -p[0], 0))


SYSTEMS: list[tuple[Make, int, int]] = [
    (chain, 4, 9),
    (arm, 3, 7),
    (rods_on_a_cart, 3, 12),
    (ball_in_a_ring, 1, 5),
]


def namings(n: int, m: int) -> list[tuple[list[str], list[str]]]:
    """Return names of coordinates and parameters: numbered, words, and random ones of any length and order."""
    made = [
        ([f"q{k}" for k in range(n)], [f"p{k}" for k in range(m)]),
        (["yaw", "shoulder", "elbow", "wrist"][:n], [f"length_{m - k}" for k in range(m)]),
    ]
    for seed in range(4 if os.environ.get("SYMBODY_FUZZ") == "all" else 2):
        draw = random.Random(seed)
        names = list[str]()
        while len(names) < n + m:
            name = "".join(draw.choices(LETTERS, k=draw.randint(1, 7))) + draw.choice(["", "", "1", "12"])
            if name not in {*names, "pi", "t", "re", "im"}:
                names.append(name)
        made.append((names[:n], names[n:]))
    return made


def renamed_forms(equations: Equations, names: dict[Expr, Expr]) -> list[str]:
    """Return the entries of the matrix form in other names, as texts."""
    form = equations.matrix_form()
    matrices = [form.mass_matrix, form.coriolis, form.gravity, form.loads]
    return [str(subs(entry, names)) for matrix in matrices for entry in matrix.entries]


def tokens(text: str, names: dict[str, str]) -> list[str]:
    """Return names, numbers and signs of a text, sorted, with other names."""
    found = re.findall(r"\w+'*|[^\w\s]", text.partition("\n")[2])
    return sorted(re.sub(r"\w+", lambda name: names.get(name[0], name[0]), token) for token in found)


@pytest.mark.parametrize(("make", "n", "m"), SYSTEMS)
def test_names_do_not_change_the_terms(make: Make, n: int, m: int) -> None:
    forms, pages = list[list[str]](), list[list[str]]()
    reference: list[Expr] = []
    for of_coordinates, of_parameters in namings(n, m):
        q = [functions_of_time(name) for name in of_coordinates]
        p = [symbols(name) for name in of_parameters]
        reference = reference or [*q, *p]
        equations = newton_euler(make(q, p))
        forms.append(renamed_forms(equations, dict(zip([*q, *p], reference, strict=True))))
        page = describe(equations)
        if ":=" not in page:
            texts = {str(own): str(other) for own, other in zip([*q, *p], reference, strict=True)}
            pages.append(tokens(page, texts))
    assert all(form == forms[0] for form in forms)
    assert all(page == pages[0] for page in pages)


@pytest.mark.parametrize("names", ["q1 q2 q3 q4", "hip knee ankle toe", "delta alpha beta gamma"])
def test_gravity_of_a_chain_is_that_of_the_books(names: str) -> None:
    """Murray, Li & Sastry 1994, sec. 4.3: a sine for each link, of the sum of its angles."""
    q, p = functions_of_time(names), symbols("g m1 l1 m2 l2 m3 l3 m4 l4")
    gravity = newton_euler(chain(q, p)).matrix_form().gravity
    assert [str(entry).count("sin") for entry in gravity.entries] == [4, 3, 2, 1]
    assert not any("cos" in str(entry) for entry in gravity.entries)


def test_variables_are_told_apart_by_their_places() -> None:
    a, b, c = symbols("a b c")
    for first, second in ((a, b), (b, a)):
        names = standard_names([], [first - 2 * second, c])
        assert str(names.standard(first - 2 * second)) == str(
            standard_names([], [b - 2 * a]).standard(b - 2 * a)
        )
        assert names.original(names.standard(first * c)) == first * c
    q = functions_of_time("q")
    assert str(standard_names([q], []).standard(time_derivative(q))) == "A0'"


def test_short_names_in_one_equation_are_no_parameters_of_others() -> None:
    """Dampers c1 to c4 of an arm: c2 is no cosine in the equation of the first joint, which holds c1 alone."""
    q, g = functions_of_time("q1 q2 q3 q4"), symbols("g")
    frame, bodies, loads = ground, list[Body](), []
    for i, angle in enumerate(q):
        A, B, C, d, m, c = symbols(f"A{i} B{i} C{i} d{i + 1} m{i} c{i + 1}")
        frame = frame * rotate("ZYYX"[i], angle)
        body = Body(frame * translate(0, 0, d), m, A, B, C)
        before = {"reaction": bodies[-1]} if bodies else {}
        loads.append(friction(angle, viscous=c, on=body, **before))
        bodies.append(body)
        frame = frame * translate(0, 0, d)
    equations = newton_euler(System(bodies, loads, q, gravity=Vector(ground, 0, 0, -g)))
    for notation in (describe, latex):
        text = notation(equations.equation_of(q[0]))
        assert not re.search(r"\bc_?\{?[1-4]\}? (:=|&=)", text)
        assert len(text) > 1200
