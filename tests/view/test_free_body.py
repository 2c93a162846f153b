"""Free-body diagrams: what is drawn of a part that is cut off."""

import re
from pathlib import Path

import numpy as np
import pytest

from symbody import (
    Body,
    Force,
    Link,
    Point,
    System,
    Torque,
    Vector,
    assemble,
    bushing,
    contact,
    equilibrium,
    fixed,
    free,
    free_body_diagram,
    functions_of_time,
    gear,
    ground,
    motor,
    newton_euler,
    planar,
    point_on_curve,
    prismatic,
    project,
    reaction,
    revolute,
    rolling,
    rotate,
    simulate,
    spherical,
    spring,
    steady,
    symbols,
    time_derivative,
    torsion_spring,
    translate,
)
from symbody.errors import ViewError
from symbody.view.drawing_options import DrawingOptions
from symbody.view.free_body import _three_digits
from symbody.view.scene import scene
from symbody.view.solid import corners

HEIGHT = re.compile(r'viewBox="0 0 (\S+) (\S+)"')
LINE = re.compile(r'<line x1="(\S+)" y1="(\S+)" x2="(\S+)" y2="(\S+)" stroke="(#\w+)" stroke-width="2"')


@pytest.fixture(scope="module")
def motion():
    """A lift that holds a beam, at rest."""
    lift, beam = Link("lift", 2.0), Link("beam", 3.0, Iz=0.25, center=(1, 0, 0))
    made = assemble([prismatic("rail", ground, lift, axis="Y"), fixed("weld", lift, beam)])
    moment = Torque(ground, 0, 0, -10.0, on=made.body(beam), name="moment")
    return simulate(newton_euler(made.system([moment], gravity=Vector(ground, 0, -10, 0))), t=(0, 1))


def texts(path: Path) -> list[str]:
    return re.findall(r">([^<>]+)</text>", path.read_text(encoding="utf-8"))


def test_it_names_loads_weights_and_reactions_with_their_magnitudes(motion, tmp_path):
    """In free fall the weld carries no force, only the moment; the rail holds nothing along itself."""
    drawn = free_body_diagram(motion, "beam", tmp_path / "beam.svg")
    assert sorted(texts(drawn)) == ["beam", "moment 10 N m", "weight 30 N", "weld 10 N m"]
    whole = free_body_diagram(motion, ["lift", "beam"], tmp_path / "whole.svg", t=0.5)
    assert sorted(texts(whole)) == [
        *("beam", "lift", "moment 10 N m", "rail 10 N m", "weight 20 N", "weight 30 N")
    ]


def test_arrows_point_along_forces_to_one_scale(tmp_path):
    """A beam on two posts, with its mass at a quarter of the span."""
    beam, left, right = Link("beam", 4.0, Iz=1.0, center=(1, 0, 0)), Link("left", 0.1), Link("right", 0.1)
    pins = [
        revolute("L", ground, left, at=(0, -1, 0)),
        revolute("A", left, beam, at=(0, 1, 0)),
        revolute("R", ground, right, at=(4, -1, 0)),
        revolute("C", right, beam, at=(0, 1, 0), to=(4, 0, 0)),
    ]
    equations = newton_euler(assemble(pins).system(gravity=Vector(ground, 0, -10, 0)))
    motion = simulate(equations, t=(0, 0.1))
    drawn = free_body_diagram(motion, beam, tmp_path / "beam.svg")
    assert sorted(texts(drawn)) == ["A 30 N", "C 10 N", "beam", "weight 40 N"]
    arrows = {
        tuple(np.round(np.array([float(x2) - float(x1), float(y1) - float(y2)]), 0)): color
        for x1, y1, x2, y2, color in LINE.findall(drawn.read_text())
    }
    lengths = {color: [] for color in arrows.values()}
    for (_, up), color in arrows.items():
        lengths[color].append(up)
    (weight,) = lengths["#6b5b00"]
    assert weight < 0
    assert sorted(lengths["#2563a8"]) == pytest.approx([-weight / 4, -3 * weight / 4], abs=2)


def test_a_body_that_is_none_is_refused(motion, tmp_path):
    with pytest.raises(ViewError) as raised:
        free_body_diagram(motion, "rod", tmp_path / "rod.svg")
    assert (
        str(raised.value) == "free_body_diagram: rod is not a body of the system; expected one of lift, beam"
    )


def test_what_is_no_motion_or_no_body_is_refused(motion, tmp_path):
    path = tmp_path / "beam.svg"
    with pytest.raises(ViewError, match=r"free_body_diagram: motion = 3 is an int; expected a motion, such"):
        free_body_diagram(3, "beam", path)
    with pytest.raises(ViewError, match=r"free_body_diagram: no body is cut off; give at least one"):
        free_body_diagram(motion, [], path)
    for part in (3, revolute("beam", ground, Link("rod", 1)), ["beam", 3]):
        with pytest.raises(
            ViewError, match=r"free_body_diagram: .* is not a body of the system; expected one of lift"
        ):
            free_body_diagram(motion, part, path)


def test_the_sketch_of_a_small_part_fills_the_picture(tmp_path):
    """Sizes are measured without rounding: a millimetre is drawn as large as a metre."""
    sizes = []
    for size in (1.0, 1e-3):
        bob = Link("bob", 1.0, center=(0, -size, 0))
        equations = newton_euler(
            assemble([revolute("A", ground, bob)]).system(gravity=Vector(ground, 0, -10, 0))
        )
        start = {equations.coordinates[0]: 0.5}
        motion = simulate(equations, {}, start, t=(0, 1e-6))
        drawn = free_body_diagram(motion, bob, tmp_path / "bob.svg").read_text()
        sizes.append([float(each) for each in HEIGHT.search(drawn).groups()])
    assert sizes[0] == pytest.approx(sizes[1], rel=1e-3)


def test_a_plane_part_is_seen_along_its_normal(tmp_path):
    """So the angles in the picture are those of the forces."""
    bob = Link("bob", 1.0, center=(0, -1, 0))
    equations = newton_euler(assemble([revolute("A", ground, bob)]).system(gravity=Vector(ground, 0, -10, 0)))
    motion = simulate(equations, {}, {equations.coordinates[0]: 0.5}, t=(0, 0.1))
    pull = [float(value[0]) for value in motion.evaluate(reaction(equations, "A").force.components[:2])]
    drawn = free_body_diagram(motion, bob, tmp_path / "bob.svg").read_text(encoding="utf-8")
    lines = [tuple(map(float, found[:4])) for found in LINE.findall(drawn) if found[4] == "#2563a8"]
    x1, y1, x2, y2 = max(lines, key=lambda line: np.hypot(line[2] - line[0], line[3] - line[1]))
    assert np.arctan2(y1 - y2, x2 - x1) == pytest.approx(np.arctan2(pull[1], pull[0]), abs=0.01)


@pytest.mark.parametrize("t", [50, -3, float("nan"), "now"])
def test_the_instant_is_one_of_the_motion(motion, tmp_path, t):
    with pytest.raises(ViewError, match=r"expected an instant of the motion, from 0 to 1$"):
        free_body_diagram(motion, "beam", tmp_path / "beam.svg", t=t)


def test_a_body_is_cut_off_once_and_drawn_as_svg(motion, tmp_path):
    with pytest.raises(ViewError, match=r"the body beam is given twice; give it once"):
        free_body_diagram(motion, ["beam", "beam"], tmp_path / "beam.svg")
    with pytest.raises(ViewError, match=r"beam\.png is no SVG file; expected a name such as beam\.svg"):
        free_body_diagram(motion, "beam", tmp_path / "beam.png")


@pytest.mark.parametrize(("x", "y"), [(-3, -1), (-3, 0)])
def test_the_name_of_an_arrow_to_the_left_is_not_on_its_shaft(tmp_path, x, y):
    """Names are written to the right: that of an arrow to the left and downwards is below its tip."""
    cart = Link("cart", 1.0, Iz=1.0)
    made = assemble([planar("P", ground, cart)])
    push = Force(ground, x, y, 0, at=made.point(cart, 0, 0, 0), on=made.body(cart), name="push")
    motion = simulate(newton_euler(made.system([push], gravity=Vector(ground, 0, -2, 0))), t=(0, 1))
    text = free_body_diagram(motion, cart, tmp_path / "cart.svg").read_text(encoding="utf-8")
    (tip,) = {float(line[3]) for line in LINE.findall(text) if abs(float(line[2]) - float(line[0])) > 1}
    (name,) = re.findall(r'<text x="\S+" y="(\S+)"[^>]*>push', text)
    assert float(name) > tip + 12


def test_what_acts_between_bodies_of_the_part_is_not_drawn(tmp_path):
    """A motor and a spring inside of two bars; a spring to the ground is outside."""
    one, other = (Link(name, 1.0, Iz=0.1, center=(0.5, 0, 0)) for name in ("one", "other"))
    P, Q = revolute("P", ground, one), revolute("Q", one, other, at=(1, 0, 0))
    made = assemble([P, Q])
    first, second = made.body(one), made.body(other)
    start, end = made.point(one, 0.2, 0.1, 0), made.point(other, 0.8, 0.1, 0)
    loads = [
        motor(Q.coordinate, 3, on=second, reaction=first, name="motor"),
        spring(start, end, 60, free_length=0.2, on=first, reaction=second, name="inner"),
        spring(end, Point(ground, 1, 1, 0), 40, on=second, name="outer"),
    ]
    equations = newton_euler(made.system(loads, gravity=Vector(ground, 0, -10, 0)))
    motion = simulate(equations, {}, {P.coordinate: 0.2, Q.coordinate: 0.6}, t=(0, 0.01))
    named = {
        part: {text.split()[0] for text in texts(free_body_diagram(motion, part, tmp_path / "bars.svg"))}
        for part in ("one", "other", ("one", "other"))
    }
    assert named["one"] == {"one", "P", "Q", "motor", "inner", "weight"}
    assert named["other"] == {"other", "Q", "motor", "inner", "outer", "weight"}
    assert named["one", "other"] == {"one", "other", "P", "outer", "weight"}


def test_no_name_lies_on_the_head_of_an_arrow(tmp_path):
    """Of two nearly parallel forces, the name of the left one would lie on the head of the right one."""
    block = Link("block", 2.0, 1.0, 1.0, 1.0)
    made = assemble([planar("P", ground, block)])
    pushes = {"the first push": (-1.7, 7.8), "second": (1.4, 10.3)}
    loads = [
        Force(ground, x, y, 0, at=made.point(block, 0, 0, 0), on=made.body(block), name=name)
        for name, (x, y) in pushes.items()
    ]
    motion = simulate(newton_euler(made.system(loads)), t=(0, 0.01))
    text = free_body_diagram(motion, block, tmp_path / "block.svg").read_text(encoding="utf-8")
    heads = [
        np.array([corner.split(",") for corner in corners.split()], dtype=float)
        for corners in re.findall(r'<polygon points="([^"]+)"[^>]*fill-opacity="1"', text)
    ]
    names = re.findall(r'<text x="(\S+)" y="(\S+)"[^>]*>([^<]+)', text)
    assert (len(heads), len(names)) == (2, 3)
    for x, y, name in names:
        left, base = float(x), float(y)
        for (west, north), (east, south) in ((head.min(axis=0), head.max(axis=0)) for head in heads):
            is_beside = left > east or left + 6 * len(name) < west
            assert is_beside or base - 9 > south or base < north, name


def test_what_holds_a_body_without_joints_is_drawn_as_its_support(tmp_path):
    """A pendulum of a frame and one of a constraint: what reaction tells of them, and no more."""
    theta, x, z = functions_of_time("theta x z")
    weight = Vector(ground, 0, 0, -9.81)
    bob = Body(rotate("Y", theta) * translate(0, 0, -1), 2, name="bob")
    point = Body(translate(x, 0, z), 2, name="point")
    cases = (
        (System([bob], (), [theta], gravity=weight), bob, {theta: 0.5}, {}),
        (System([point], (), [x, z], [x**2 + z**2 - 1], weight), point, {x: 0.5}, {z: -0.8}),
    )
    for system, body, initial, guess in cases:
        equations = newton_euler(system)
        motion = simulate(equations, {}, initial, t=(0, 0.1), guess=guess)
        force = motion.evaluate(reaction(equations, body).force.components)[:, 0]
        text = free_body_diagram(motion, body, tmp_path / "body.svg").read_text()
        assert f"support {np.linalg.norm(force):.3g} N<" in text


def arm():
    """A bar on a hinge, held by a spring; the equations and the pin."""
    bar = Link("bar", 2.0, Iz=0.1, center=(0.5, 0, 0))
    pin = revolute("J", ground, bar)
    made = assemble([pin])
    coil = torsion_spring(pin.coordinate, 30.0, on=made.body(bar), name="coil")
    return newton_euler(made.system([coil], gravity=Vector(ground, 0, -10, 0))), pin


def test_an_equilibrium_is_drawn_as_a_motion_is(tmp_path):
    equations, pin = arm()
    found = equilibrium(equations, {})
    drawn = free_body_diagram(found, "bar", tmp_path / "bar.svg")
    torque = found[30.0 * pin.coordinate]
    assert sorted(texts(drawn)) == ["J 20 N", "bar", f"coil {abs(torque):.3g} N m", "weight 20 N"]
    held = equilibrium(equations, {}, fixed={pin.coordinate: 0.0})
    drawn = free_body_diagram(held, "bar", tmp_path / "held.svg")
    assert sorted(texts(drawn)) == ["J 20 N", "bar", "support 10 N m", "weight 20 N"]
    assert (found.t, found.system) == (0.0, equations.system)


def test_a_steady_motion_is_drawn_at_its_first_instant(tmp_path):
    """A bob of 2 kg at the radius 1 m that turns with 3 rad/s: 18 N towards the axis."""
    bob = Link("bob", 2.0, Iz=0.1, center=(1, 0, 0))
    pin = revolute("J", ground, bob)
    equations = newton_euler(assemble([pin]).system())
    found = steady(equations, {}, given={time_derivative(pin.coordinate): 3.0})
    assert sorted(texts(free_body_diagram(found, "bob", tmp_path / "bob.svg"))) == ["J 18 N", "bob"]


def test_a_structure_is_drawn_with_numbers_for_its_symbols(tmp_path):
    l, m = symbols("l m")
    inner, outer = Link("inner", 3 * m, center=(l / 2, 0, 0)), Link("outer", m, center=(l / 2, 0, 0))
    joints = [fixed("clamp", ground, inner), fixed("weld", inner, outer, at=(l, 0, 0))]
    system = assemble(joints).system(gravity=Vector(ground, 0, -10, 0))
    path = tmp_path / "inner.svg"
    drawn = free_body_diagram(system, inner, path, parameters={l: 1.0, m: 1.0})
    expected = ["clamp 30 N m", "clamp 40 N", "inner", "weight 30 N", "weld 10 N", "weld 5 N m"]
    assert sorted(texts(drawn)) == expected
    with pytest.raises(ViewError) as raised:
        free_body_diagram(system, inner, path, parameters={m: 1.0})
    assert str(raised.value) == (
        "free_body_diagram, parameters: no value for l; expected numbers for the symbols of a structure, such as "
        "parameters={l: 1.0}"
    )
    with pytest.raises(ViewError, match="has its own values; expected parameters of a structure alone"):
        free_body_diagram(equilibrium(arm()[0], {}), "bar", path, parameters={m: 1.0})


def test_forces_of_teeth_and_of_the_ground_act_where_they_touch(tmp_path):
    """So they have no moment."""
    pinion, wheel = Link("pinion", 1.0, Iz=0.01), Link("wheel", 2.0, Iz=0.02)
    P, Q = revolute("P", ground, pinion), revolute("Q", ground, wheel, at=(0.08, 0, 0))
    G = gear("G", P, Q, 0.05, 0.03)
    made = assemble([P, Q, G])
    drive = Torque(ground, 0, 0, 0.3, on=made.body(pinion), name="drive")
    train = newton_euler(made.system([drive]))
    place = project(reaction(train, G).at, ground).coordinates
    assert place == (0.05, 0, 0)
    drawn = free_body_diagram(simulate(train, t=(0, 0.1)), pinion, tmp_path / "pinion.svg")
    assert sorted(texts(drawn)) == ["G 5.08 N", "P 5.08 N", "drive 0.3 N m", "pinion"]
    assert drawn.read_text().count("<polygon") == 4  # three heads of arrows, and the disc in the pitch circle

    ball = Link("ball", 2.0, 0.05, 0.05, 0.05)
    K = rolling("K", ground, ball, radius=0.3, crown=0.3)
    rolls = newton_euler(assemble([K]).system(gravity=Vector(ground, 1, 0, -10)))
    found = reaction(rolls, K)
    assert project(found.at, ground).coordinates == (*K.coordinates[:2], 0)
    assert found.moment.components == (0, 0, 0)
    friction = 2.0 / (1 + 2.0 * 0.3**2 / 0.05)
    drawn = free_body_diagram(simulate(rolls, t=(0, 0.1)), ball, tmp_path / "ball.svg")
    assert sorted(texts(drawn)) == [f"K {np.hypot(20, friction):.3g} N", "ball", "weight 20.1 N"]


@pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
def test_what_a_simulation_left_out_as_redundant_is_drawn_with_its_share(tmp_path):
    """Three posts carry a beam on slides, whose weight is above the one in the middle: each bears a third."""
    beam = Link("beam", 4.0, Iz=1.0, center=(1, 0, 0))
    joints = [planar("free", ground, beam)]
    joints += [
        point_on_curve(f"S{k}", ground, beam, curve=lambda s: (s, 0, 0), to=(k, 0, 0), axes="Z")
        for k in (0, 1)
    ]
    twice = point_on_curve("S2", ground, beam, curve=lambda s: (s, 0, 0), to=(2, 0, 0), axes="Z")
    equations = newton_euler(assemble([*joints, twice]).system(gravity=Vector(ground, 0, -10, 0)))
    motion = simulate(equations, t=(0, 0.1), guess={})
    names = texts(free_body_diagram(motion, beam, tmp_path / "beam.svg"))
    assert "weight 40 N" in names
    assert {name for name in names if name.startswith("S")} == {"S0 13.3 N", "S1 13.3 N", "S2 13.3 N"}


def test_forces_at_different_points_are_seen_apart(tmp_path):
    """A table on three feet: seen along the plane of the weight and a leg, two feet would lie on each other."""
    table = Link("table", 10.0, 1.0, 1.0, 1.5, center=(0.05, 0.1, 0.4))
    stand = free("F", ground, table)
    made = assemble([stand])
    feet = [
        contact(made.point(table, *place), 0, 1e6, on=made.body(table), name=f"c{k}")
        for k, place in enumerate(((0.5, 0, 0), (-0.3, 0.4, 0), (-0.3, -0.4, 0)))
    ]
    equations = newton_euler(made.system(feet, gravity=Vector(ground, 0, 0, -10)))
    x, y, z, psi, _, _ = stand.coordinates
    found = equilibrium(equations, {}, guess={z: -1e-3}, fixed={x: 0, y: 0, psi: 0})
    drawn = free_body_diagram(found, table, tmp_path / "table.svg").read_text(encoding="utf-8")
    ends = {(float(x), float(y)) for x, y, _, _, color in LINE.findall(drawn) if color == "#c0392b"}
    assert min(abs(a[0] - b[0]) + abs(a[1] - b[1]) for a in ends for b in ends if a != b) > 30
    assert len(ends) >= 3


def test_coordinates_of_joints_are_no_points_of_the_ground(tmp_path):
    """x_X, y_X and z_X are those of an axle in its car: no rod leads from it to this place of the ground."""
    car, axle = Link("car", 10.0, 1.0, 1.0, 1.0), Link("axle", 2.0, 1.0, 0.1, 1.0)
    made = assemble([free("F", ground, car), free("X", car, axle, at=(0, 0, -0.3))])
    frames = made.frame(axle), made.frame(car) * translate(0, 0, -0.3)
    mount = bushing(
        *frames, [1e4] * 6, damping=[10] * 6, on=made.body(axle), reaction=made.body(car), name="mount"
    )
    start = dict(zip(made.coordinates, (5.0, 0.0, 1.0), strict=False))
    equations = newton_euler(made.system([mount], gravity=Vector(ground, 0, 0, -10)))
    motion = simulate(equations, {}, start, t=(0, 0.01))
    text = free_body_diagram(motion, axle, tmp_path / "axle.svg", t=0.01).read_text(encoding="utf-8")
    rods = re.findall(
        r'<line x1="(\S+)" y1="(\S+)" x2="(\S+)" y2="(\S+)" stroke="#\w+" stroke-width="4"', text
    )
    assert all(np.hypot(float(a) - float(c), float(b) - float(d)) < 1 for a, b, c, d in rods)


def test_small_moments_are_small_arcs(tmp_path):
    """A moment of 0.1 N m beside forces of 1000 N at 1 m is a thousandth of an arc."""
    block = Link("block", 100.0, Iz=10.0)
    made = assemble([fixed("wall", ground, block, to=(1, 0, 0))])
    body = made.body(block)
    loads = [
        Torque(ground, 0, 0, 0.1, on=body, name="small"),
        Force(ground, 0, 1000, 0, at=made.point(block, 1, 0, 0), on=body, name="push"),
    ]
    drawn = free_body_diagram(made.system(loads), block, tmp_path / "block.svg")
    assert {"small 0.1 N m", "wall 0.1 N m", "wall 1000 N", "push 1000 N"} <= {*texts(drawn)}
    red = [tuple(map(float, line[:4])) for line in LINE.findall(drawn.read_text()) if line[4] == "#c0392b"]
    lengths = sorted(np.hypot(x2 - x1, y2 - y1) for x1, y1, x2, y2 in red)
    assert sum(lengths[:-1]) < 0.1 * lengths[-1]  # the arc and the arrow


def gearbox():
    small, large, stepped = (Link(name, Iz=1e-3) for name in ("small", "large", "stepped"))
    P, Q = revolute("P", ground, small), revolute("Q", ground, stepped, at=(0.08, 0, 0))
    R = revolute("R", ground, large, at=(0.08, 0.12, 0))
    made = assemble([P, Q, R, gear("one", P, Q, 0.02, 0.06), gear("two", Q, R, 0.03, 0.09)])
    drive = motor(P.coordinate, 0.2, on=made.body(small), name="drive")
    return simulate(newton_euler(made.system([drive])), t=(0, 0.1))


def test_wheels_are_discs_up_to_the_points_where_teeth_touch(tmp_path):
    """Each wheel has the radius at which it meshes, about its axis; a stepped one has two."""
    content = scene(gearbox(), DrawingOptions(), "")
    radii = {body["name"]: sorted(part["radius"] for part in body["parts"]) for body in content["bodies"]}
    assert list(radii) == ["small", "stepped", "large"]
    for name, expected in (("small", [0.02]), ("stepped", [0.03, 0.06]), ("large", [0.09])):
        np.testing.assert_allclose(radii[name], expected, rtol=1e-12)
    for part in (part for body in content["bodies"] for part in body["parts"]):
        along = np.subtract(part["to"], part["from"])
        np.testing.assert_allclose(along[:2], 0.0, atol=1e-15)


@pytest.mark.parametrize(
    ("crown", "width"), [(0.0, None), (0.1, 0.1), (0.3, 0.3)], ids=["disc", "torus", "ball"]
)
def test_wheels_that_roll_touch_the_ground(crown, width):
    """They have the radius of the joint, not that of a solid with their inertia, and the width of their crown."""
    wheel = Link("wheel", 2.0, 1.0, 2.0, 3.0)
    K = rolling("K", ground, wheel, radius=0.3, crown=crown)
    rolls = simulate(newton_euler(assemble([K]).system()), {}, {K.coordinates[2]: 0.4}, t=(0, 0.1))
    content = scene(rolls, DrawingOptions(), "")
    ((part,),) = (body["parts"] for body in content["bodies"])
    sizes = np.abs(corners(part)).max(axis=0)
    np.testing.assert_allclose(sizes, [0.3, content["thickness"] / 2 if width is None else width, 0.3])


@pytest.mark.parametrize(
    ("size", "text"),
    [
        (4321.0, "4320"),
        (0.012345, "0.0123"),
        (44.0, "44"),
        (1.5e8, "1.5e+08"),
        (9.9996, "10"),
        (2e-5, "2e-05"),
    ],
)
def test_magnitudes_have_three_digits(size, text):
    assert _three_digits(size) == text


def test_a_part_is_seen_from_one_direction_at_all_instants(tmp_path):
    """So a force that is constant in ground keeps its direction, also where the rods are in a plane for an instant."""
    upper, lower = Link("upper", 1.0, 0.1, 0.1, 0.1, center=(0, 0, -1)), Link("lower", 1.0, 0.1, 0.1, 0.1)
    made = assemble(
        [spherical("A", ground, upper, axes="XYZ"), spherical("B", upper, lower, at=(0, 0, -1), axes="XYZ")]
    )
    push = Force(ground, 3, 2, 9, at=made.point(lower, 0, 0, -1), on=made.body(lower), name="push")
    equations = newton_euler(made.system([push], gravity=Vector(ground, 0, 0, -10)))
    motion = simulate(equations, {}, {equations.coordinates[3]: 0.3}, t=(0, 2))
    angles = []
    for t in (0, 0.3, 0.9, 1.3, 2):
        drawn = free_body_diagram(motion, lower, tmp_path / "lower.svg", t=t).read_text(encoding="utf-8")
        (line,) = (found[:4] for found in LINE.findall(drawn) if found[4] == "#c0392b")
        x1, y1, x2, y2 = map(float, line)
        angles.append(np.arctan2(y1 - y2, x2 - x1))
    assert angles == pytest.approx([angles[0]] * 5, abs=0.02)
