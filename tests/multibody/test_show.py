"""What `show` prints: MBSymba's words."""

from __future__ import annotations

from functools import cached_property

import pytest

from symbody import (
    Body,
    Force,
    Point,
    System,
    Torque,
    Vector,
    cos,
    describe,
    functions_of_time,
    ground,
    newton_euler,
    power,
    project,
    rotate,
    show,
    sin,
    spring,
    symbols,
    t,
    translate,
)
from symbody.errors import LoadError
from symbody.multibody import Action, Load

m, a, F = symbols("m a F")
T = rotate("Z", functions_of_time("phi")).named("T")
A = Point(T, a, 0, 0, name="A")
body, other = Body(ground, m, 1, 2, 3, name="plate"), Body(ground, 2 * m)


def test_point() -> None:
    rows = "[[cos(phi), -sin(phi), 0, 0], [sin(phi), cos(phi), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"
    assert describe(A) == f"A = POINT(frame = {rows}, coords = [a, 0, 0])"
    assert describe(A, synthetic=True) == "A = POINT(frame = T, coords = [a, 0, 0])"


def test_vector_and_frame() -> None:
    assert describe(Vector(ground, 0, 0, a)) == "VECTOR(frame = ground, comps = [0, 0, a])"
    assert describe(ground) == "ground"
    assert describe(T, synthetic=True) == "T"


def test_body() -> None:
    inertia = "[[1, 0, 0], [0, 2, 0], [0, 0, 3]]"
    assert describe(body) == f"plate = BODY(frame = ground, mass = m, inertia = {inertia})"


def test_loads() -> None:
    force = Force(ground, F, 0, 0, at=A, on=body, reaction=other, name="F12")
    assert describe(force, synthetic=True) == (
        "F12 = FORCE(frame = ground, comps = [F, 0, 0], applied = A, acting = plate, reacting = BODY(mass = 2*m))"
    )
    torque = Torque(ground, 0, 0, F, on=body)
    assert describe(torque) == "TORQUE(frame = ground, comps = [0, 0, F], acting = plate)"


class Couple(Load):
    """Opposite forces at two points of a body, and a torque on another one."""

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        force, torque = Vector(ground, F, 0, 0), Vector(ground, 0, 0, F)
        return Action(body, force, A), Action(body, -force, Point(ground, 0, 0, 0)), Action(other, torque)


def test_a_load_of_another_kind_is_shown_by_its_actions() -> None:
    forces = (
        "FORCE(frame = ground, comps = [F, 0, 0], applied = A, acting = plate), FORCE(frame = ground, "
        "comps = [-F, 0, 0], applied = POINT(frame = ground, coords = [0, 0, 0]), acting = plate)"
    )
    torque = "TORQUE(frame = ground, comps = [0, 0, F], acting = BODY(mass = 2*m))"
    assert describe(Couple()) == f"COUPLE(actions = [{forces}, {torque}])"


def test_a_load_of_another_kind_is_projected_by_its_actions() -> None:
    couple = Couple()
    couple.name = "C"
    turned = project(couple, T)
    assert describe(turned, synthetic=True).startswith(
        "C = COUPLE(actions = [FORCE(frame = T, comps = [F*cos(phi), -F*sin(phi), 0], applied = A, acting = plate), "
    )
    assert describe(couple).startswith("C = COUPLE(actions = [FORCE(frame = ground, ")
    assert power(turned) == power(couple)


def test_expressions_are_shown_as_they_are() -> None:
    assert describe(2 * m) == "2*m"


def test_show_prints(capsys: pytest.CaptureFixture[str]) -> None:
    show(body, synthetic=True)
    assert capsys.readouterr().out == describe(body, synthetic=True) + "\n"


def test_system_and_equations() -> None:
    """A line for each part, and one for each equation."""
    x, y = functions_of_time("x y")
    bead = Body(translate(x, y, 0), m, name="bead")
    push = Force(ground, F, 0, 0, at=bead.center_of_mass, on=bead, name="push")
    gravity = Vector(ground, 0, -a, 0)
    system = System([bead], [push], [x, y], [x - 2 * y], gravity, name="slope")
    frame = "translate(x, y, 0)"
    assert max(map(len, describe(system).splitlines())) <= 110
    assert describe(system).replace("\n        ", " ").splitlines() == [
        "slope = SYSTEM",
        "    coordinates: x, y",
        f"    body: bead = BODY(frame = {frame}, mass = m, inertia = [[0, 0, 0], [0, 0, 0], [0, 0, 0]])",
        (
            "    load: push = FORCE(frame = ground, comps = [F, 0, 0], "
            f"applied = POINT(frame = {frame}, coords = [0, 0, 0]), acting = bead)"
        ),
        "    gravity: VECTOR(frame = ground, comps = [0, -a, 0])",
        "    constraint: x - 2*y = 0, multiplier lambda1",
    ]
    equations = newton_euler(system)
    assert describe(equations).splitlines() == [
        "EQUATIONS OF MOTION of x, y",
        "    m*x'' = F + lambda1",
        "    m*y'' + a*m = -2*lambda1",
        "    constraint: x - 2*y = 0",
    ]
    assert equations.latex().count(r"\\") == 2


class Computed(Load):
    """A load whose actions are computed at each use."""

    @property
    def actions(self) -> tuple[Action, ...]:
        return (Action(body, Vector(ground, F, 0, 0), A),)


def test_actions_that_cannot_be_replaced_are_not_projected_in_silence() -> None:
    with pytest.raises(LoadError) as caught:
        project(Computed(), T)
    assert str(caught.value) == (
        "project: Computed.actions is computed at each use; expected a cached_property, whose value can be replaced by "
        "the projected actions"
    )


def test_components_are_shown_in_the_form_for_the_reader() -> None:
    x, y = functions_of_time("x y")
    end = Point(rotate("Z", x) * translate(F, 0, 0) * rotate("Z", y), a, 0, 0)
    assert describe(project(end, ground)).endswith(
        "coords = [a*cos(x + y) + F*cos(x), a*sin(x + y) + F*sin(x), 0])"
    )
    idle = Vector(ground, a * sin(x) ** 2 + a * cos(x) ** 2, 0, 0)
    assert describe(idle) == "VECTOR(frame = ground, comps = [a, 0, 0])"
    system = System(
        [Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[(x + y) ** 2 - x**2 - y**2 - a]
    )
    assert "constraint: 2*x*y - a = 0, multiplier lambda1" in describe(system)


def test_components_keep_a_form_that_is_as_short() -> None:
    x, y = functions_of_time("x y")
    assert describe(Vector(ground, a * (x + y), a * x + a * y, 0)) == (
        "VECTOR(frame = ground, comps = [a*(x + y), a*x + a*y, 0])"
    )


def test_a_spring_has_the_ends_of_its_line() -> None:
    """Not the components of its force, which are long."""
    q, k, l0 = functions_of_time("q"), *symbols("k l0")
    bob = Body(rotate("Z", q) * translate(a, 0, 0), m, name="bob")
    band = spring(Point(rotate("Z", q), a, 0, 0), Point(ground, 0, a, 0), k, free_length=l0, on=bob)
    assert describe(band) == (
        'ELEMENT(kind = spring, stiffness = k, free_length = l0, ends = [POINT(frame = rotate("Z", q), '
        "coords = [a, 0, 0]), POINT(frame = ground, coords = [0, a, 0])], bodies = [bob])"
    )


def test_a_system_by_chosen_speeds() -> None:
    x, phi, u = functions_of_time("x phi u")
    bead = Body(translate(x * cos(phi), x * sin(phi), 0), m, name="bead")
    system = System([bead], coordinates=[x, phi], kinematics={u: a * x.diff(t) + phi.diff(t)})
    assert "    quasi-velocities: u\n    kinematics: x' = -(phi' - u)/a\n" in describe(system)
    assert "by the speeds" in system._repr_html_()
    assert ">-(phi&#x27; - u)/a</td>" in system._repr_html_()


def test_a_system_of_a_hundred_bodies_is_shown_by_the_coordinates_of_its_frames() -> None:
    """Frames and components that are too long are told by what they depend on, and `show` of a body has all of it."""
    angles = functions_of_time("q1:101")
    frame, bodies = ground, []
    for k, angle in enumerate(angles):
        frame = frame * rotate("ZYX"[k % 3], angle) * translate(m, 0, 0)
        bodies.append(Body(frame, m))
    pull = Force(frame, F, 0, 0, at=bodies[-1].center_of_mass, on=bodies[-1])
    rows = describe(System(bodies, [project(pull, ground)], list(angles))).splitlines()
    text = " ".join(row.strip() for row in rows)
    assert len(text) < 20_000
    assert max(map(len, rows)) <= 110
    assert (
        'BODY(frame = rotate("Z", q1) * translate(m, 0, 0) * rotate("Y", q2) * translate(m, 0, 0), mass'
        in text
    )
    assert "BODY(frame = FRAME(q1, q2, q3, q4, q5, q6, q7, q8, q9, q10, q11" in text
    assert "operations)" in text
    assert describe(bodies[3]).startswith("BODY(frame = [[")


@pytest.mark.parametrize(("count", "is_long"), [(14, False), (40, True)])
def test_a_system_of_many_parts_is_shown_by_counts_with_the_way_to_each(count: int, is_long: bool) -> None:
    """Of eighty bodies, 55 000 characters were printed."""
    places = functions_of_time(" ".join(f"x{k}" for k in range(count)))
    bodies = [Body(translate(place, 0, 0), m, name=f"wagon {k}") for k, place in enumerate(places)]
    loads = [Force(ground, F, 0, 0, at=each.center_of_mass, on=each) for each in bodies]
    train = System(bodies, loads, places, constraints=[places[0] - a * t], name="train")
    head, *lines = describe(train).splitlines()
    shown = sum(line.startswith(("    wagon", "    body")) for line in lines)
    if not is_long:
        assert head == "train = SYSTEM"
        assert shown == count
        return
    assert head == "train = SYSTEM: 40 bodies, 40 loads, 1 constraint"
    assert shown == 8
    assert "    ... 32 more bodies: show(system.bodies[4])" in lines
    assert "    ... 32 more loads: show(system.loads[4])" in lines
    assert f"    constraint: x0 - a*t = 0, multiplier {train.multipliers[0]}" in lines
    assert describe(train.bodies[4]).startswith("wagon 4 = BODY")


def test_a_named_frame_is_shown_once_in_a_system() -> None:
    """Each body and load had repeated the 4x4 matrix of its frame."""
    p, q = functions_of_time("p q")
    arm = rotate("Z", p).named("arm")
    fore = (arm * translate(a, 0, 0) * rotate("Z", q)).named("fore")
    upper, lower = Body(arm * translate(a, 0, 0), m, name="upper"), Body(fore, m, name="lower")
    pull = Force(fore, F, 0, 0, at=upper.center_of_mass, on=upper, name="pull")
    rows = [row.strip() for row in describe(System([upper, lower], [pull], [p, q])).splitlines()]
    assert rows[2:4] == [
        'frame: arm = rotate("Z", p)',
        'frame: fore = arm * translate(a, 0, 0) * rotate("Z", q)',
    ]
    text = " ".join(rows)
    assert "upper = BODY(frame = arm * translate(a, 0, 0), mass" in text
    assert "lower = BODY(frame = fore, mass" in text
    assert (
        "FORCE(frame = fore, comps = [F, 0, 0], applied = POINT(frame = arm * translate(a, 0, 0), coords"
        in text
    )
    twice = System([Body(arm, m), Body(fore.named("arm"), m)], coordinates=[p, q])
    assert describe(twice).count("arm") == 0


def test_an_unnamed_frame_of_a_load_is_its_motions() -> None:
    """The force of a spring filled lines with 4x4 matrices."""
    link = rotate("Z", functions_of_time("theta")) * translate(a, 0, 0)
    bob = Body(link, m, name="bob")
    at = 'POINT(frame = rotate("Z", theta) * translate(a, 0, 0), coords = [0, 0, 0])'
    assert describe(Force(link, F, 0, 0, at=bob.center_of_mass, on=bob)) == (
        'FORCE(frame = rotate("Z", theta) * translate(a, 0, 0), comps = [F, 0, 0], '
        f"applied = {at}, acting = bob)"
    )
    assert describe(Force(T, F, 0, 0, at=Point(T, a, 0, 0), on=bob)) == (
        "FORCE(frame = T, comps = [F, 0, 0], applied = POINT(frame = T, coords = [a, 0, 0]), acting = bob)"
    )
