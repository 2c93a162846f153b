"""The rules of the page, on classes of systems: what is shown, in which order, and within which limits."""

from __future__ import annotations

import random
import re
import time

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Matrix,
    ModelNotice,
    Point,
    System,
    Torque,
    Vector,
    cos,
    cost,
    describe,
    expand,
    factor_terms,
    floating_frame,
    functions_of_time,
    ground,
    lagrange_equations,
    log,
    moving_frame,
    newton_euler,
    parse,
    readable,
    rotate,
    simplify,
    sin,
    symbols,
    t,
    tan,
    tanh,
    torsion_spring,
    translate,
)
from symbody.errors import ModelError
from symbody.symbolic.calculus.reading import AWKWARD, awkward_terms
from symbody.symbolic.calculus.rewrite import short_form, textbook_form
from tests.laws.random_system import random_system
from tests.repeated import repeated
from tests.symbolic.random_expression import Maker

m, l, a, b, c, g, k, F = symbols("m l a b c g k F")
x, y, theta = functions_of_time("x y theta")


def arm(axes: str) -> System:
    """Return an arm of general bodies on axes through the ends of links."""
    q = functions_of_time([f"q{i}" for i in range(len(axes))])
    frame, bodies = ground, []
    for i, axis in enumerate(axes):
        l, b, m, Ix, Iy, Iz = symbols(f"l{i} b{i} m{i} Ix{i} Iy{i} Iz{i}")
        frame = frame * rotate(axis, q[i])
        bodies.append(Body(Point(frame, b, 0, 0), m, Ix, Iy, Iz))
        frame = frame * translate(l, 0, 0)
    return System(bodies, coordinates=list(q), gravity=Vector(ground, 0, 0, -g))


@pytest.mark.parametrize(
    "terms",
    [
        "2*b*c*cos(p - q), -b*cos(p - q)*q'**2, c*a**4*q', -a**3*p', -c*cos(p - q), -c*a**2*cos(q)*sin(2*q)",
        "3*l*q', -a*l**3*sin(p)*q', l, -a*l**2*sin(q), -a*l*k**2*cos(p - q)*p'**2, a**2*l**2*sin(q)*p'",
        "c**3*cos(p)*sin(2*q)*q', c**2*k**2*cos(p)*sin(2*p), 2*m**2*sin(q)*p', 3*m**2*sin(p)*q'**2, m*cos(p - q)",
    ],
)
def test_names_decide_among_arrangements_and_not_what_was_added_first(terms: str) -> None:
    p, q = functions_of_time("p q")
    names = {"a": a, "b": b, "c": c, "k": k, "l": l, "m": m, "p": p, "q": q}
    added = [parse(term, names) for term in terms.split(",")]
    forms = set()
    for seed in range(24):
        random.Random(seed).shuffle(added)
        total = added[0]
        for term in added[1:]:
            total += term
        forms.add(str(textbook_form(total)))
    assert len(forms) == 1


@pytest.mark.parametrize("seed", [*range(4), *repeated(range(4, 12))])
def test_forms_for_the_reader_keep_the_value(seed: int) -> None:
    rng = random.Random(seed)
    angles, parameters = functions_of_time("p q"), (m, l, c)

    def part(depth: int) -> Expr:
        kind = rng.randrange(6) if depth else 5
        if kind < 3:
            return part(depth - 1) * part(depth - 1)
        if kind < 5:
            return part(depth - 1) + rng.choice([-1, 1, 2]) * part(depth - 1)
        angle = rng.choice(
            [angles[0], angles[1], angles[0] + angles[1], angles[0] - angles[1], 2 * angles[0]]
        )
        return rng.choice([*parameters, sin(angle), cos(angle)])

    for count in range(10):
        expression = part(4)
        read = readable if count < 2 else short_form
        form = read(expression)
        assert form == expression
        assert read(expression).same_form(form)


@pytest.mark.parametrize("seed", [*range(80), 186, *repeated([*range(80, 186), *range(187, 300)])])
def test_what_is_readable_is_never_longer(seed: int) -> None:
    """Of random expressions, and of each given in a form that a reader would not choose."""
    given = Maker(random.Random(seed), only_common=True).expression(3)
    for expression in (given, factor_terms(given), expand(given)):
        form = readable(expression)
        assert form == expression
        opened = awkward_terms(expression) - awkward_terms(form)
        assert len(str(form)) <= len(str(expression)) + AWKWARD * max(0, opened)


def test_brackets_are_kept_if_they_are_shorter() -> None:
    """A page of equations has flat sums and single angles; what the user gives comes back no longer."""
    for given in (m * (m + 2), sin(2 * theta), (a + b) * (c + l)):
        assert len(str(textbook_form(given))) >= len(str(given))
        assert str(readable(given)) == str(given)


@pytest.mark.parametrize(
    ("given", "form"),
    [
        (c**2 + l * (l + 2 * c * cos(theta)), "c**2 + l**2 + 2*c*l*cos(theta)"),
        (c + x * (x * (a + x) + b), "c + x**3 + a*x**2 + b*x"),
        ((b + a / c) / k, "b/k + a/(c*k)"),
        (b + a * cos(x) * tan(x), "b + a*sin(x)"),
        (sin(x) ** 4 - cos(x) ** 4, "-cos(2*x)"),
        (m * l**2 * sin(x) * cos(x), "m*l**2*sin(x)*cos(x)"),
    ],
)
def test_nested_brackets_are_opened_and_waves_joined(given: Expr, form: str) -> None:
    assert str(readable(given)) == form


@pytest.mark.parametrize("names", ["q1 q2", "q1 q2 q3", *repeated(["alpha beta gamma", "hip knee ankle"])])
def test_an_equation_is_no_longer_than_its_simplest_form(names: str) -> None:
    frame, bodies = ground, []
    for i, angle in enumerate(functions_of_time(names)):
        frame = frame * rotate("Z", angle) * translate(0, -symbols(f"l{i}"), 0)
        bodies.append(Body(frame, symbols(f"m{i}")))
    pendulum = System(bodies, [], functions_of_time(names), gravity=Vector(ground, 0, -g, 0))
    for residual in newton_euler(pendulum).residuals:
        assert len(str(readable(residual))) <= len(str(simplify(expand(residual))))


def test_no_factor_occurs_again_in_its_brackets() -> None:
    assert (
        str(textbook_form(m * (c**2 + l * (l + 2 * c * cos(theta))))) == "m*(c**2 + l**2 + 2*c*l*cos(theta))"
    )
    assert str(textbook_form(m * c * (c + l * cos(theta)) + a)) == "a + m*(c**2 + c*l*cos(theta))"


@pytest.mark.parametrize("names", ["l r", "r l", "a x", "x a", "u w", "w u", "p q", "q p"])
def test_a_distance_has_one_form_whatever_the_names(names: str) -> None:
    """The sign of a sum in the graph depends on the values of its terms, and a reader doesn't see it."""
    lever, place = symbols(names.split(maxsplit=1)[0]), functions_of_time(names.split()[1])
    for sign in (1, -1):
        square = (place - sign * lever * cos(theta)) ** 2 + lever**2 * sin(theta) ** 2
        form = textbook_form(square)
        assert form == square
        assert len(str(form)) == len("l**2 - 2*l*r*cos(theta) + r**2")
        assert "sin" not in str(form)
    difference = m * lever * (place - lever)
    assert str(textbook_form(expand(difference))) == str(difference)


@pytest.mark.parametrize(
    ("given", "form"),
    [
        ((a + b) * l**2, "(a + b)*l**2"),
        ((a + b) * (c + l) ** 2 * k, "k*(a + b)*(c + l)**2"),
        (l * (a + b), "l*(a + b)"),
        (b + a * k**2 / l**2, "b + a*k**2/l**2"),
    ],
    ids=str,
)
def test_masses_stand_before_squares_of_lengths(given: Expr, form: str) -> None:
    assert str(given) == form


def test_a_place_is_squared_as_a_whole() -> None:
    """Diagonal entries of M are sums of squares of distances from the axis: none is a difference."""
    assert str(textbook_form(b + m * (a**2 + l**2 + c**2 * sin(x) ** 2 + 2 * a * c * sin(x)))) == (
        "b + m*(l**2 + (a + c*sin(x))**2)"
    )


def test_waves_stand_before_the_difference_that_is_a_place() -> None:
    given = l * m * cos(y) * (l * sin(x) ** 2 * sin(y) - l * sin(y) + a * cos(x))
    assert str(textbook_form(given)) == "l*m*cos(x)*cos(y)*(a - l*cos(x)*sin(y))"


PLACES = {
    m * cos(x) * (a * l * cos(y) - l**2 * sin(x)): "l*m*cos(x)*(a*cos(y) - l*sin(x))",
    m * sin(x) * (a * l + l**2 * sin(y)): "l*m*sin(x)*(a + l*sin(y))",
    m * (a**2 - a * b) * cos(x): "a*m*(a - b)*cos(x)",
    m * theta + a * k * cos(x) - b * c * cos(x): "m*theta + (a*k - b*c)*cos(x)",
    l * m * sin(x) * (sin(y) * (x - l * sin(y)) - l * cos(y) ** 2): "l*m*sin(x)*(x*sin(y) - l)",
}


@pytest.mark.parametrize(("given", "form"), PLACES.items(), ids=PLACES.values())
def test_what_all_terms_share_stands_outside(given: Expr, form: str) -> None:
    """Of places and first moments; a quadratic form of lengths stays flat."""
    assert str(textbook_form(given)) == str(textbook_form(expand(given))) == form


@pytest.mark.parametrize("axes", ["ZYZ", "ZXZ", "ZYX", "XZX", "YXY"])
def test_diagonals_are_sums_of_squares(axes: str) -> None:
    """Distances from the axis, and moments of inertia times squares of cosines: nothing is subtracted."""
    matrix = newton_euler(arm(axes)).display.page.mass_matrix
    for i in range(len(axes)):
        assert " - " not in str(matrix[i, i])


@pytest.mark.parametrize("axes", ["ZZ", "ZZZ"])
def test_no_whole_number_behind_a_fraction_cancels(axes: str) -> None:
    """Rods with their centres in the middle: `m*l**2 + m*b**2/4`, not `m*(4*l**2 + b**2)/4`."""
    q = functions_of_time([f"q{i}" for i in range(len(axes))])
    frame, bodies = ground, list[Body]()
    for i, axis in enumerate(axes):
        length, mass, inertia = symbols(f"l{i} m{i} I{i}")
        frame = frame * rotate(axis, q[i])
        bodies.append(Body(Point(frame, length / 2, 0, 0), mass, Iz=inertia))
        frame = frame * translate(length, 0, 0)
    matrix = newton_euler(System(bodies, coordinates=q)).display.page.mass_matrix
    assert not any(re.search(r"\b4\*", str(entry)) for entry in matrix.entries)


def test_moments_stand_before_masses_by_squares_of_coordinates() -> None:
    J, Jb = symbols("J Jb")
    assert str(m * x**2 + J + Jb) == "J + Jb + m*x**2"
    assert str(k * x + F) == "k*x + F"


def test_single_angles_are_preferred() -> None:
    assert str(textbook_form(sin(2 * theta))) == "2*sin(theta)*cos(theta)"
    assert str(textbook_form(cos(x) * cos(y) - sin(x) * sin(y))) == "cos(x + y)"
    assert str(textbook_form((1 - cos(2 * theta)) / 2)) == "sin(theta)**2"


def test_a_difference_of_the_user_is_kept() -> None:
    R, r = symbols("R r")
    assert str(readable(m * (R - r) ** 2)) == "m*(R - r)**2"
    assert str(readable(g * m * (R - r) * sin(theta))) == "g*m*(R - r)*sin(theta)"


@pytest.mark.parametrize("places", [(b - a, 0), (a - b, c - k), (2 * a - b, c), (b - a, c - k)])
def test_differences_of_the_model_stay_together(places: tuple[Expr, Expr]) -> None:
    """Each term has the differences of the places of the body, and none of their parameters apart."""
    body = Body(rotate("Z", theta) * translate(*places, 0), m, 0, 0, F)
    equations = newton_euler(System([body], coordinates=[theta], gravity=Vector(ground, 0, -g, 0)))
    (row,) = describe(equations).splitlines()[1:]
    rest = row.replace(" ", "")
    for place in (p for p in places if " - " in str(p)):
        (left, right), (left_of_opposite, right_of_opposite) = (str(p).split(" - ") for p in (place, -place))
        rest = rest.replace(f"({left}-{right})", "").replace(f"({left_of_opposite}-{right_of_opposite})", "")
        assert not place.free_symbols & parse_names(rest), row


def parse_names(text: str) -> set[Expr]:
    """Return the symbols whose names occur in a text."""
    return set(symbols(" ".join({*re.findall(r"[A-Za-z]\w*", text)} - {"sin", "cos"} | {"q"})))


@pytest.mark.parametrize("names", ["I a b h", "F a b k", "a b c k"])
def test_entries_of_a_mass_matrix_are_as_short_as_from_their_terms(names: str) -> None:
    """The form does not suffer from brackets that a derivation has left."""
    inertia, u, v, w = symbols(names)
    link = rotate("Z", x) * translate(l, 0, 0) * rotate("Z", y)
    bodies = [Body(Point(link, u, 0, 0), m, 0, 0, inertia), Body(link * translate(w, v, 0), m)]
    matrix = newton_euler(System(bodies, coordinates=[x, y])).matrix_form().mass_matrix
    for entry in matrix.entries:
        assert len(str(entry)) <= len(str(textbook_form(expand(entry))))


def test_squares_of_distances_from_an_axis() -> None:
    """Two parallel axes across a vertical one: no double angles, though the frames multiply sines and cosines."""
    distance = a * sin(x) + b * (sin(x) * cos(y) + cos(x) * sin(y))
    for square in (m * distance**2, expand(m * distance**2)):
        assert str(readable(square)) == "m*(a*sin(x) + b*sin(x + y))**2"


@pytest.mark.parametrize("axes", ["ZYY", "ZXX", "YZZ", "XZZ", "ZYYZ"])
def test_entries_of_spatial_arms_have_no_double_angles(axes: str) -> None:
    matrix = newton_euler(arm(axes)).display.page.mass_matrix
    assert not re.search(r"(sin|cos)\([^()]*2\*", " ".join(map(str, matrix.entries)))


@pytest.mark.parametrize(
    "text",
    [
        "x/(a - b)",
        "p/(c - y) + b",
        "sqrt((p + x)**2 + x**2/(a - y)**2)",
        "b*(x - a)/((y - b)*p)",
        "log(a - b)*x",
    ],
)
def test_differences_are_divisors(text: str) -> None:
    """No two names are made equal on the way to a form."""
    given = parse(text)
    found = readable(given)
    assert found == given
    assert len(str(found)) <= len(str(given))


@pytest.mark.parametrize("names", ["R r k q", "z1 z2 z3 z4", "s r q p"])
def test_a_system_with_a_difference_as_divisor_is_shown(names: str) -> None:
    """The stiffness k/(R - r) is written as the user wrote it, whatever the names."""
    R, r, k, q = names.split()
    (x,), (outer, inner, stiffness) = (functions_of_time(q),), symbols(f"{R} {r} {k}")
    block = Body(translate(x, 0, 0), 1, name="block")
    equations = newton_euler(System([block], [torsion_spring(x, stiffness / (outer - inner), on=block)], [x]))
    assert f"{k}*{q}/({R} - {r}) = 0" in describe(equations)


def test_a_common_function_stands_outside() -> None:
    assert str(readable(a * m * cos(x) - b * k * cos(x))) == "(a*m - b*k)*cos(x)"


def test_a_quotient_of_waves_is_a_tangent() -> None:
    assert str(readable(m * l**2 * x * sin(theta) / cos(theta))) == "m*l**2*x*tan(theta)"


@pytest.mark.parametrize("given", [x - a, a - x, 2 * (x - a), x - F * sin(c * t)])
def test_a_coordinate_stands_before_what_is_given(given: Expr) -> None:
    assert "(x - " in str(k * given**2)


def coupled(*frames: Frame) -> list[System]:
    """Return systems of one mass whose coordinates are not in the order of their names."""
    coordinates = [q_theta, q_alpha, q_s]
    gravity = Vector(ground, 0, 0, -g)
    return [System([Body(frame, m)], coordinates=coordinates, gravity=gravity) for frame in frames]


q_theta, q_alpha, q_s = functions_of_time("theta alpha s")
COUPLED = pytest.mark.parametrize(
    "system",
    coupled(
        rotate("Z", q_theta) * rotate("X", q_alpha) * translate(0, 0, q_s),
        rotate("X", q_theta) * translate(0, q_s, 0) * rotate("Z", q_alpha) * translate(l, 0, 0),
        translate(q_s, 0, 0) * rotate("Y", q_theta) * rotate("Z", q_alpha) * translate(l, 0, c),
    ),
    ids=["polar", "offset", "sliding"],
)


@COUPLED
def test_speeds_are_in_the_order_of_the_coordinates(system: System) -> None:
    text = newton_euler(system).description()
    places = {"theta": 0, "alpha": 1, "s": 2}
    products = re.findall(r"(\w+)'\*(\w+)'", text)
    assert products
    for first, second in products:
        assert places[first] < places[second], text


@COUPLED
def test_fractions_lead_their_terms(system: System) -> None:
    """A rod instead of each mass makes thirds and halves; no term of a row has a number under a bar."""
    (body,) = system.bodies
    rods = [Body(body.frame, m, m * l**2 / 12, m * l**2 / 3, m * l**2 / 2)]
    equations = newton_euler(System(rods, coordinates=system.coordinates, gravity=system.gravity))
    assert re.search(r"\b\d+/\d+\*", equations.description())
    assert not re.search(r"[a-z)']/\d", equations.description())
    assert not re.search(r"\\frac\{[^{}]*[a-z]", equations.latex())


def test_loads_are_written_by_springs_and_dampers() -> None:
    z = functions_of_time("z")
    k1, k2, c1, c2 = symbols("k1 k2 c1 c2")
    plate = Body(translate(0, z, 0), m)
    front, rear = z - a * theta, z + b * theta
    push = -k1 * front - c1 * front.diff(t) - k2 * rear - c2 * rear.diff(t)
    tilting = Body(rotate("Z", theta), 0, Iz=l)
    moment = a * (k1 * front + c1 * front.diff(t)) - b * (k2 * rear + c2 * rear.diff(t))
    loads = [
        Force(ground, 0, push, 0, at=plate.center_of_mass, on=plate),
        Torque(ground, 0, 0, moment, on=tilting),
    ]
    first, second = describe(newton_euler(System([plate, tilting], loads, [z, theta]))).splitlines()[1:]
    for name in ("k1", "k2", "c1", "c2"):
        assert len(re.findall(rf"\b{name}\b", first)) == len(re.findall(rf"\b{name}\b", second)) == 1


def on_two_springs(order: str) -> str:
    """Return the equations of a plate on two legs, whose coordinates are in the given order."""
    z, z1, z2 = functions_of_time("z z1 z2")
    plate, tilting = Body(translate(0, 0, z), m), Body(rotate("Y", theta), 0, 0, l)
    legs = Body(translate(0, 0, z1), k), Body(translate(0, 0, z2), k)
    front, rear = z - a * theta - z1, z + b * theta - z2
    loads = [
        Force(ground, 0, 0, -F * (front + rear), at=plate.center_of_mass, on=plate),
        Torque(ground, 0, F * (a * front - b * rear), 0, on=tilting),
        Force(ground, 0, 0, F * front, at=legs[0].center_of_mass, on=legs[0]),
        Force(ground, 0, 0, F * rear, at=legs[1].center_of_mass, on=legs[1]),
    ]
    return describe(newton_euler(System([plate, tilting, *legs], loads, functions_of_time(order))))


@pytest.mark.parametrize(
    ("order", "deflections"),
    [
        ("z theta z1 z2", {"(z - a*theta - z1)", "(z + b*theta - z2)"}),
        ("theta z z1 z2", {"(a*theta - z + z1)", "(b*theta + z - z2)"}),
    ],
)
def test_a_deflection_has_one_form_in_all_equations(order: str, deflections: set[str]) -> None:
    """Its coordinates are in their order, and the first one is positive, whatever its sign in the equation."""
    assert deflections <= set(re.findall(r"\([^()]*\)", on_two_springs(order)))


@pytest.mark.parametrize("place", [c - a, -(a - c)], ids=["given", "turned"])
def test_differences_have_the_direction_with_fewer_signs(place: Expr) -> None:
    """A pendulum hangs by `a - c`, though its place below the support is `c - a`."""
    bob = Body(rotate("Z", theta) * translate(0, place, 0), m)
    system = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))
    (row,) = describe(newton_euler(system)).splitlines()[1:]
    assert row.strip() == "m*(a - c)**2*theta'' + g*m*(a - c)*sin(theta) = 0"


@pytest.mark.parametrize(
    ("place", "difference"),
    [((b - c, 0), "(b - c)"), ((c - b, 0), "(c - b)"), ((0, c - b), "(b - c)"), ((0, -(c - b)), "(c - b)")],
    ids=str,
)
def test_a_difference_of_lengths_is_that_of_the_model(
    place: tuple[Expr | int, Expr | int], difference: str
) -> None:
    """It keeps its direction also where that takes more signs, and what hangs below hangs by a positive length."""
    sled = Body(translate(x, 0, 0), k)
    bob = Body(translate(x, 0, 0) * rotate("Z", theta) * translate(*place, 0), m)
    text = describe(newton_euler(System([sled, bob], [], [x, theta], gravity=Vector(ground, 0, -g, 0))))
    assert {*re.findall(r"\([bc] - [bc]\)", text)} == {difference}


def test_the_differences_of_a_disc_in_a_ring_have_one_direction() -> None:
    R, r, J = symbols("R r J")
    hung = rotate("Z", theta) * translate(0, -(R - r), 0)
    disc = Body(hung * rotate("Z", (R * y - R * theta) / r), m, Iz=m * r**2 / 2)
    ring = Body(rotate("Z", y), k, Iz=J)
    text = describe(newton_euler(System([ring, disc], [], [y, theta], gravity=Vector(ground, 0, -g, 0))))
    assert "+ g*m*(R - r)*sin(theta) = 0" in text
    assert "- 1/2*m*R*(R - r)*theta''" in text


def test_differences_of_inertias_have_one_direction() -> None:
    """The wrist Z Y Z has `A - B` in all equations, and not `B - A` beside it; Euler's cycle keeps its signs."""
    q = functions_of_time("q1 q2 q3")
    frame, bodies = ground, []
    for i, (axis, angle) in enumerate(zip("ZYZ", q, strict=True)):
        frame = frame * rotate(axis, angle)
        bodies.append(Body(frame, 0, *symbols(f"A{i} B{i} C{i}")))
    text = describe(newton_euler(System(bodies, coordinates=list(q))))
    found = {*re.findall(r"\((\w+) - (\w+)\)", text)}
    assert found
    assert not any(pair[::-1] in found for pair in found)


def test_given_accelerations_have_one_coefficient_each() -> None:
    X, Y = functions_of_time("X Y")
    place = translate(X, Y, 0) * rotate("Z", theta)
    bodies = [Body(place * translate(0, -a, 0), m), Body(place * translate(0, -a, 0), k)]
    (row,) = describe(newton_euler(System(bodies, coordinates=[theta], inputs=[X, Y]))).splitlines()[1:]
    assert row.strip() == "(k + m)*a**2*theta'' + a*(k + m)*cos(theta)*X'' + a*(k + m)*sin(theta)*Y'' = 0"


def test_a_load_over_a_parameter_is_a_load() -> None:
    """Without the parameter it is undefined; it doesn't mix with the inertia of rotating axes."""
    turning = rotate("Z", F * t) * translate(x, 0, 0)
    body = Body(turning, m)
    load = Force(turning, -m * g * x / l, 0, 0, at=body.center_of_mass, on=body)
    (row,) = describe(newton_euler(System([body], [load], [x]))).splitlines()[1:]
    assert row.strip() == "m*x'' - m*F**2*x + g*m*x/l = 0"


def test_the_order_of_speeds_is_that_of_the_system() -> None:
    """Quasi-velocities that are listed before a coordinate's rate stand before it."""
    u, w = functions_of_time("u w")
    car = moving_frame(u, 0, 0, 0, 0, w)
    trailer = car * translate(-a, 0, 0) * rotate("Z", theta) * translate(-b, 0, 0)
    system = System([Body(car, m, Iz=F), Body(trailer, k, Iz=c)], coordinates=[theta], speeds=[u, w])
    text = describe(newton_euler(system))
    assert text.index("*w' ") < text.index("*theta'' ")
    assert "2*w*theta'" in text
    assert "theta'*w" not in text


def test_each_acceleration_has_one_coefficient() -> None:
    """In every row of a chain about one axis, also where the coefficients are equal."""
    frame, bodies, angles = ground, [], functions_of_time("q1 q2 q3")
    for angle, length, inertia in zip(angles, symbols("l1 l2 l3"), symbols("J1 J2 J3"), strict=True):
        frame = frame * rotate("Z", angle)
        bodies.append(Body(frame, m, Iz=inertia))
        frame = frame * translate(length, 0, 0)
    *_, last = newton_euler(System(bodies, coordinates=angles)).description().splitlines()
    assert last.strip() == "J3*q1'' + J3*q2'' + J3*q3'' = 0"


def car_on_wheels() -> System:
    heave, roll, pitch, yaw = functions_of_time("z phi theta psi")
    frame = translate(x, y, heave) * rotate("Z", yaw) * rotate("Y", pitch) * rotate("X", roll)
    bodies, coordinates = [Body(frame, m, *symbols("A B C"))], [x, y, heave, yaw, pitch, roll]
    for i, (place, side) in enumerate([(a, b), (a, -b), (-c, b), (-c, -b)]):
        travel, spin = functions_of_time(f"s{i} w{i}")
        bodies.append(Body(frame * translate(place, side, travel) * rotate("Y", spin), k, 0, l, 0))
        coordinates += [travel, spin]
    return System(bodies, coordinates=coordinates, gravity=Vector(ground, 0, 0, -g))


def test_what_is_one_quantity_has_one_name() -> None:
    """Of a car of 14 coordinates: no two definitions have the same value."""
    equations = newton_euler(car_on_wheels())
    rows = re.split(r"\n    (?! )", equations.description(whole=True))
    definitions = [row.split(" := ") for row in rows if " := " in row]
    names = {leaf.name: leaf for leaf in equations.system.leaves if leaf.kind == "symbol"}
    names |= {each.name: each for each in equations.coordinates}
    for name, value in definitions:
        names[name.strip()] = parse(value.replace("\n", " "), names)
    values = {names[name.strip()] for name, _ in definitions}
    assert len(values) == len(definitions) > 10


@pytest.mark.parametrize("axes", ["ZZZZ", "ZYYYX", *repeated(["ZYYZ"])])
def test_short_names_in_latex(axes: str) -> None:
    """They are those of the text, and make it shorter; repeated sums have names in the text alone."""
    equations = newton_euler(arm(axes))
    names = re.findall(r"^    ([csM]\w+) :=", equations.description(whole=True), re.MULTILINE)
    latex = equations.latex(whole=True)
    assert names
    for name in names:
        index = name[1:].lstrip("_").replace("_", "-")
        assert f"{name[0]}_{{{index}}} &= " in latex, name


def test_short_names_of_angles_without_numbers_in_latex() -> None:
    """On a long page whose angles have no numbers, the text and LaTeX have the same names."""
    theta, psi, phi = functions_of_time("theta psi phi")
    frame = rotate("Z", psi) * rotate("Y", theta) * rotate("X", phi)
    wing = frame * translate(a, b, c) * rotate("Z", x) * translate(l, 0, k)
    bodies = [Body(frame, m, *symbols("A B C")), Body(wing, m, *symbols("I J K"))]
    form = newton_euler(System(bodies, coordinates=[psi, theta, phi, x])).matrix_form()
    assert "c_theta := cos(theta)" in form.description(whole=True)
    assert r"c_{\theta} &= \cos(\theta)" in form.latex()


def test_given_forces_and_constraints_are_on_the_right() -> None:
    bob = Body(translate(x, y, 0), m)
    push = Force(ground, F - c * x.diff(t), 0, 0, at=bob.center_of_mass, on=bob)
    spring = Force(ground, 0, -k * y, 0, at=bob.center_of_mass, on=bob)
    system = System([bob], [push, spring], [x, y], [x**2 + y**2 - l**2], Vector(ground, 0, -g, 0))
    assert describe(newton_euler(system)).splitlines() == [
        "EQUATIONS OF MOTION of x, y",
        "    m*x'' + c*x' = F + 2*x*lambda1",
        "    m*y'' + g*m + k*y = 2*y*lambda1",
        "    constraint: x**2 + y**2 - l**2 = 0",
    ]


def test_loads_that_are_no_polynomials_stay_in_one_piece() -> None:
    slider = Body(translate(x, 0, 0), m)
    v = x.diff(t)
    friction = Force(ground, -F * tanh(v / a) - c * abs(v) * v, 0, 0, at=slider.center_of_mass, on=slider)
    (row,) = describe(newton_euler(System([slider], [friction], [x]))).splitlines()[1:]
    assert row.strip() == "m*x'' + F*tanh(x'/a) + c*Abs(x')*x' = 0"


@pytest.mark.parametrize("seed", [1, 2, 4, *repeated([0, 3, *range(5, 15)])])
def test_rows_of_random_systems_are_equal_to_the_residuals(seed: int) -> None:
    equations = newton_euler(random_system(seed))
    for balance, residual in zip(equations.display.page.balances, equations.residuals, strict=True):
        assert balance.residual == residual
    for text in (equations.description(), equations.description(whole=True)):
        assert max(map(len, text.splitlines())) <= 110


def test_entries_that_are_equal_or_opposite_are_joined() -> None:
    """C21 = -C12, as c_112 = -c_211 [Murray, Li & Sastry 1994, sec. 4.2]; each entry is on one line."""
    form = lagrange_equations(arm("ZYY")).matrix_form(christoffel=True)
    lines = [line.strip() for line in form.description().splitlines()]
    assert {"C21 = -C12", "C31 = -C13"} < set(lines)
    assert form.coriolis[1, 0] == -form.coriolis[0, 1]
    assert any(line.startswith("M23 = M32 = ") for line in lines)


def test_a_vector_instead_of_the_matrix_of_christoffel_is_noticed() -> None:
    """With quasi-velocities, and where a support moves; the notice stands at the line of the call."""
    top = newton_euler(System([Body(floating_frame(), m, a, b, c)]))
    with pytest.warns(ModelNotice, match="since the speeds u, v, w are not rates of coordinates") as caught:
        assert not top.matrix_form(christoffel=True).is_christoffel
    assert caught[0].filename == __file__
    bob = Body(translate(y, 0, 0) * rotate("Z", x) * translate(l, 0, 0) * rotate("Z", y), m)
    driven = newton_euler(System([bob], coordinates=[x], inputs=[y]))
    with pytest.warns(ModelNotice, match=r"c\(q, q'\) is returned instead of the matrix C\(q, q'\)"):
        assert not driven.matrix_form(christoffel=True).is_christoffel


@pytest.mark.parametrize("axes", ["Z", "ZZ", "ZY", "ZYY"])
def test_christoffel(axes: str) -> None:
    """M' - 2 C is skew-symmetric, and C q' is the force of the speeds [Murray, Li & Sastry 1994, sec. 4.2]."""
    equations = lagrange_equations(arm(axes))
    vector, form = equations.matrix_form(), equations.matrix_form(christoffel=True)
    n = len(axes)
    assert form.mass_matrix == equations.mass_matrix
    assert form.is_christoffel
    assert form.coriolis @ Matrix([[u] for u in equations.speeds]) == vector.coriolis or n == 1
    if n > 1:
        skew = (
            Matrix([[form.mass_matrix[i, j].diff(t) for j in range(n)] for i in range(n)]) - 2 * form.coriolis
        )
        assert all(skew[i, j] == -skew[j, i] for i in range(n) for j in range(n))
    assert r" \mathbf{M} &= \begin{bmatrix}" in form.latex()


def test_rows_parse_back() -> None:
    equations = newton_euler(arm("ZYY"))
    names = {leaf.name: leaf for leaf in equations.system.leaves if leaf.kind == "symbol"}
    names |= {q.name: q for q in equations.coordinates}
    rows = re.split(r"\n    (?! )", equations.description())[1:]
    if any(":=" in row for row in rows):
        for definition in [row for row in rows if ":=" in row]:
            name, value = definition.split(" := ")
            names[name] = parse(value.replace("\n", " "), names)
        rows = [row for row in rows if ":=" not in row]
    for row, residual in zip(rows, equations.residuals, strict=True):
        left, right = row.replace("\n", " ").split(" = ")
        assert parse(left, names) - parse(right, names) == residual


def test_six_bodies_in_space_are_shown_in_half_a_second() -> None:
    equations = newton_euler(arm("ZYXZYX"))
    start = time.process_time()
    text = equations.description()
    assert time.process_time() - start < 0.5  # a third of it on an idle machine
    assert max(map(len, text.splitlines())) <= 110
    assert len(text.splitlines()) <= 100


def test_what_fills_more_than_two_pages_is_shown_in_parts() -> None:
    """Short equations, and the sizes of the others; each can be seen by itself, and equals its residual."""
    q, frame, bodies = functions_of_time("q1:17"), ground, []
    for before, angle in zip((0, *q), q, strict=False):
        frame = frame * rotate("Z", angle - before) * translate(0, -l, 0)
        bodies.append(Body(frame, m))
    equations = newton_euler(System(bodies, [], [*q], gravity=Vector(ground, 0, -g, 0)))
    text, system = equations.description(), equations.system
    assert not equations.is_readable
    assert len(text.splitlines()) < 70
    assert equations.latex().count("operations") > 2
    assert equations.latex(whole=True).count(r"\\ ") > 80
    for coordinate in system.coordinates[::3]:
        page = equations.equation_of(coordinate)
        lines = page.description().splitlines()
        assert lines[0] == f"EQUATION OF MOTION of {coordinate}"
        sizes = (f"equation of {coordinate}: {len(lines) - 1} line", f"equation of {coordinate}:\n")
        assert any(size in text for size in sizes)
        assert page.latex().startswith((r"\begin{aligned}", r"{\allowdisplaybreaks\begin{align*}"))
    last = equations.equation_of(equations.speeds[-1])
    unknowns = (*equations.accelerations, *equations.speeds, *equations.multipliers)
    names = {str(leaf): leaf for leaf in (*system.leaves, *unknowns)}
    for row in re.split(r"\n    (?! )", last.description())[1:]:
        name, _, value = row.replace("\n", " ").partition(" := " if " := " in row else " = ")
        if " := " in row:
            names[name.strip()] = parse(value, names)
        else:
            assert parse(f"{name} - ({value})", names) == equations.residuals[-1]


def test_the_equation_of_a_speed_that_is_none_is_refused() -> None:
    equations = newton_euler(arm("ZY"))
    with pytest.raises(ModelError, match=r"there is no equation of theta; expected one of q0, q1"):
        equations.equation_of(theta)


def test_a_hundred_bodies_are_shown_by_their_sizes() -> None:
    equations = newton_euler(arm("ZYX" * 33 + "Z"))
    start = time.process_time()
    lines = describe(equations).splitlines()
    assert time.process_time() - start < 2
    operations = cost(equations.residuals).total
    assert lines[0] == f"EQUATIONS OF MOTION of 100 speeds, 0 constraints: {operations} operations in all"
    assert len(lines) < 20
    assert equations._repr_latex_() is None
    assert f"{operations} operations in all" in equations.latex()
    assert len(equations.latex()) < 1000
    assert readable(equations.residuals[99]) == equations.residuals[99]


def test_short_names_tell_families_of_angles_apart() -> None:
    """Beside c1 = cos(theta1), cos(phi1 - phi2) is not c1_2."""
    t1, p1, t2, p2 = functions_of_time("theta1 phi1 theta2 phi2")
    l1, l2, m1, m2, g = symbols("l1 l2 m1 m2 g")
    first = rotate("Z", p1) * rotate("Y", -t1) * translate(0, 0, -l1)
    second = first * rotate("Y", t1) * rotate("Z", p2 - p1) * rotate("Y", -t2) * translate(0, 0, -l2)
    bodies = [Body(first, m1), Body(second, m2)]
    equations = newton_euler(
        System(bodies, coordinates=[t1, p1, t2, p2], gravity=Vector(ground, 0, 0, -g), name="spherical")
    )
    text = equations.description()
    assert "c1 := cos(theta1)" in text
    assert "c_phi1_2 := cos(phi1 - phi2)" in text
    assert r"c_{\phi_{1} - \phi_{2}} &= \cos(\phi_{1} - \phi_{2})" in equations.latex()


@pytest.mark.parametrize(
    "expression",
    [
        cos(3 * (1 - b) * (3 - a) * (2 - c)),
        sin(log(2 + b) * (tan(3) - (a + 2)) * cos(2 - a + c)),
        cos(40 * a) + sin(a + b) * cos(30 * (a + b + c)),
    ],
    ids=str,
)
def test_angles_of_very_many_terms_stay_as_they_are(expression: Expr) -> None:
    """Opened, they have hundreds of thousands of terms."""
    found = readable(expression)
    assert found == expression
    assert len(str(found)) <= len(str(expression)) + 1
