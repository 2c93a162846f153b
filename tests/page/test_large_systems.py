"""Systems of many bodies: what is shown is short, and has the forms of small systems."""

from __future__ import annotations

import re
from itertools import pairwise

from symbody import (
    Body,
    Force,
    Point,
    System,
    Vector,
    describe,
    forward_dynamics,
    functions_of_time,
    ground,
    hamilton,
    latex,
    linearize,
    newton_euler,
    origin,
    parse,
    rotate,
    spring,
    symbols,
    translate,
)
from symbody.models import rattleback

c, g, k, m, M, l = symbols("c g k m M l")
DOWN = Vector(ground, 0, -g, 0)


def test_thirty_links_keep_one_form() -> None:
    """No entry of a large mass matrix is left as it was derived, and names are put in order at once."""
    angles = functions_of_time(" ".join(f"q{i}" for i in range(30)))
    frame, bodies = ground, []
    for before, angle in zip((0, *angles), angles, strict=False):
        frame = frame * rotate("Z", angle - before) * translate(0, -l, 0)
        bodies.append(Body(frame, m))
    equations = newton_euler(System(bodies, [], angles, gravity=DOWN))
    row = equations.equation_of(angles[12]).description()
    assert "17*m*l**2*cos(q12 - q13)*q13''" in row
    assert ":=" not in row


def test_equations_of_large_systems_have_the_form_of_small_ones() -> None:
    """From forty wagons on, the equation of a load stood in one bracket: `l*m*(cos(th)*x'' + l*th'' + g*sin(th))`."""
    shown = []
    for count in (2, 60):
        wagons = functions_of_time(" ".join(f"x{i}" for i in range(count)))
        swings = functions_of_time(" ".join(f"th{i}" for i in range(count)))
        bodies = []
        for wagon, swing in zip(wagons, swings, strict=True):
            bodies += [Body(translate(wagon, 0, 0), M)]
            bodies += [Body(translate(wagon, 0, 0) * rotate("Z", swing) * translate(0, -l, 0), m)]
        equations = newton_euler(System(bodies, [], [*wagons, *swings], gravity=DOWN))
        shown.append(equations.equation_of(swings[1]).description())
    assert shown[0] == shown[1]
    assert shown[0].endswith("l*m*cos(th1)*x1'' + m*l**2*th1'' + g*l*m*sin(th1) = 0")


def test_springs_of_large_systems_have_the_names_of_small_ones() -> None:
    """From 1000 operations on, they were written out: `k*(x2 - x1 + l0*(x1 - x2)/sqrt((x1 - x2)**2 + ...`."""
    shown = []
    for count in (5, 30):
        places = functions_of_time(" ".join(f"{axis}{i + 1}" for i in range(count) for axis in "xyz"))
        joints = [origin(ground), *(Point(ground, *places[k : k + 3]) for k in range(0, len(places), 3))]
        masses = [Body(joint, m) for joint in joints[1:]]
        springs = [
            spring(second, first, k, free_length=l, damping=c, on=mass, reaction=before)
            for first, second, before, mass in zip(joints, joints[1:], [None, *masses], masses, strict=False)
        ]
        equations = newton_euler(System(masses, springs, [*places], gravity=DOWN))
        shown.append(equations.equation_of(places[3]).description())
    assert shown[0] == shown[1]
    assert shown[0].endswith("m*x2'' + F2*(x2 - x1)/d2 + F3*(x2 - x3)/d3 = 0")


def test_the_rest_of_what_is_shown_of_a_train_is_short() -> None:
    places = functions_of_time(" ".join(f"x{i}" for i in range(40)))
    springs = [symbols("k") * (after - before) for before, after in pairwise(places)]
    bodies = [Body(translate(place, 0, 0), m) for place in places]
    pulls = [
        Force(ground, pull, 0, 0, at=body.center_of_mass, on=body, reaction=after)
        for pull, (body, after) in zip(springs, pairwise(bodies), strict=True)
    ]
    train = System(bodies, pulls, places)
    equations = newton_euler(train)
    for shown in (linearize(equations), forward_dynamics(equations), hamilton(train)):
        assert len(describe(shown).splitlines()) < 15
        assert len(latex(shown)) < 1000


def test_a_wall_has_names_of_its_sums_by_what_they_are() -> None:
    """As of the rattleback: 14 702 characters before, more than two pages; its rows are the equations."""
    equations = newton_euler(rattleback().system)
    text = describe(equations)
    rows = [" ".join(row.split()) for row in re.split(r"\n    (?! )", text)[1:]]
    assert not equations.is_readable  # as a formula
    assert len(text) < 7000
    assert "R1 := s_alpha*s_gamma - c_alpha*s_beta*c_gamma" in rows
    assert "J1 := A - C + M*h**2" in rows
    names = {leaf.name: leaf for leaf in equations.system.leaves}
    names |= {each.name: each for each in (*equations.coordinates, *equations.system.multipliers)}
    shown = []
    for row in rows:
        left, right = row.split(" := " if " := " in row else " = ")
        if " := " in row:
            names[left] = parse(right, names)
        elif not row.startswith("constraint"):
            shown.append(parse(left, names) - parse(right, names))
    assert shown == [*equations.residuals]


def test_short_entries_of_a_long_chain_are_read_and_long_ones_counted() -> None:
    """Relative angles: large entries used up the work first, and the matrices filled eleven pages."""
    angles = functions_of_time(" ".join(f"q{i}" for i in range(1, 10)))
    frame, bodies = ground, []
    for angle in angles:
        frame = frame * rotate("Z", angle) * translate(0, -l, 0)
        bodies.append(Body(frame, m))
    form = newton_euler(System(bodies, [], angles, gravity=DOWN)).matrix_form()
    text = form.description()
    assert "    M69 = M96 = m*l**2*(1 + cos(q7 + q8 + q9) + cos(q8 + q9) + cos(q9))" in text
    assert re.search(r"longer entries and their numbers of lines: M11 \(\d+\), ", text)
    assert "cos(q1)*" not in text  # of weight, found part by part
    assert text.count("\n") < 70
    assert form._repr_latex_() is None
    assert form.description(whole=True).count("\n") > 200


def test_weight_of_a_long_chain_has_sums_of_angles() -> None:
    """It stood in rotations inside each other, of 140 operations and more."""
    angles = functions_of_time(" ".join(f"q{i}" for i in range(1, 9)))
    frame, bodies = ground, []
    for angle in angles:
        frame = frame * rotate("Z", angle) * translate(0, -l, 0)
        bodies.append(Body(frame, m))
    first = newton_euler(System(bodies, [], angles, gravity=DOWN)).display.page.balances[0]
    weight = str(first.gravity[0])
    assert weight.startswith("g*l*m*(8*sin(q1) + 7*sin(q1 + q2) + 6*sin(q1 + q2 + q3) + ")
    assert weight.endswith(" + sin(q1 + q2 + q3 + q4 + q5 + q6 + q7 + q8))")
