"""Joints, links, constraints and reactions as `show`, `latex` and notebooks show them."""

from __future__ import annotations

from symbody import (
    Constraint,
    Event,
    Frame,
    Link,
    Vector,
    assemble,
    describe,
    floating_frame,
    friction,
    functions_of_time,
    gear,
    ground,
    latex,
    moving_frame,
    newton_euler,
    number,
    prismatic,
    reaction,
    revolute,
    rotate,
    spherical,
    sqrt,
    symbols,
    translate,
    universal,
)
from symbody.geometry.frame.chain import Chain
from symbody.multibody.data_sheet import WithSheet
from symbody.simulation import Occurrence

m, a, b, l, g = symbols("m a b l g")
crank, slider = Link("crank", m, center=(a, 0, 0)), Link("slider", m)
rod = Link("rod", m, Ix=a, Cxy=b, center=rotate("X", b))
A, B = revolute("A", ground, crank, limits=(None, 2)), revolute("B", crank, rod, at=(a, 0, 0))
C = revolute("C", rod, slider, at=translate(l, 0, 0) * rotate("Z", b), loop=True)
D = prismatic("D", ground, slider)
mechanism = assemble([A, B, C, D])

SHEETS: dict[str, WithSheet] = {
    "link rod\n"
    '    centre of mass: rotate("X", b)\n'
    "    mass: m\n"
    "    inertia: Matrix([[a, -b, 0], [-b, 0, 0], [0, 0, 0]])": rod,
    "revolute C\n"
    "    parent: rod\n"
    '    at: translate(l, 0, 0) * rotate("Z", b)\n'
    "    child: slider\n"
    "    to: (0, 0, 0)\n"
    "    loop: closes a loop\n"
    "    coordinate phi: phi_C\n"
    '    motion: rotate("Z", phi_C)': C,
    "revolute A, which opens the tree\n"
    "    parent: ground\n"
    "    axes on the parent: ground\n"
    "    child: crank\n"
    '    axes on the child: rotate("Z", phi_A)\n'
    "    coordinate phi: phi_A\n"
    "    largest phi: 2\n"
    "    force x: (1, 0, 0) in the axes of ground\n"
    "    force y: (0, 1, 0) in the axes of ground\n"
    "    force z: (0, 0, 1) in the axes of ground\n"
    "    moment about x: (1, 0, 0) in the axes of ground\n"
    "    moment about y: (0, 1, 0) in the axes of ground": mechanism.joint(A),
    "revolute C, which closes a loop\n"
    "    parent: rod\n"
    '    axes on the parent: rod * translate(l, 0, 0) * rotate("Z", b)\n'
    "    child: slider\n"
    "    axes on the child: slider\n"
    "    constraint C.x: s_D - a*cos(phi_A) - l*cos(phi_A + phi_B) = 0\n"
    "    constraint C.y: -a*sin(phi_A) - l*sin(phi_A + phi_B) = 0\n"
    "    force x: (1, 0, 0) in the axes of ground\n"
    "    force y: (0, 1, 0) in the axes of ground": mechanism.joint(C),
    "gear G\n    parent: crank\n    child: rod\n    couples: revolute A and revolute E\n"
    "    radius1: a\n    radius2: b": gear("G", A, revolute("E", ground, rod, at=(a + b, 0, 0)), a, b),
    "freedom s of prismatic D\n    value: s_D\n    rate: s_D'": mechanism.joint(D).freedom(),
    "limits of phi\n    largest phi: 2": A.limits[0],
    "condition x\n    condition: s_D - a*cos(phi_A) - l*cos(phi_A + phi_B) = 0\n"
    "    force x: (1, 0, 0) in the axes of ground": mechanism.joint(C).active[0],
    "constraint rope\n    condition: a - s_D = 0\n    multiplier: P\n    connects: crank, slider": Constraint(
        a - D.coordinate,
        "rope",
        multiplier=functions_of_time("P"),
        on=[mechanism.body(crank), mechanism.body(slider)],
    ),
}


def test_text_and_latex_and_table_have_the_same_rows() -> None:
    for text, thing in SHEETS.items():
        assert describe(thing) == text
        rows = [line.strip().split(": ", 1)[0] for line in text.splitlines()[1:]]
        assert latex(thing).count("&:") == len(rows)
        table = thing._repr_html_()
        assert all(f">{row}</td>" in table for row in rows)


def test_a_reaction_is_shown_by_its_components() -> None:
    bob = Link("bob", m, center=(0, -l, 0))
    pin = revolute("P", ground, bob)
    pendulum = assemble([pin])
    equations = newton_euler(pendulum.system(gravity=Vector(ground, 0, -g, 0)))
    found = reaction(equations, pin, frame=pendulum.frame(bob))
    assert describe(found) == (
        "reaction on bob about P, in the axes of bob\n"
        "    Fx: m*(l*phi_P'' + g*sin(phi_P))\n"
        "    Fy: m*(l*phi_P'**2 + g*cos(phi_P))\n"
        "    Fz: 0\n    Mx: 0\n    My: 0\n    Mz: 0"
    )
    assert latex(found).startswith(
        r"\begin{aligned} \text{Fx} &: m \left(l \ddot{\phi}_{P} + g \sin(\phi_{P})\right) \\ \text{Fy} &: "
    )
    assert ">reaction on bob about P, in the axes of bob<" in found._repr_html_()


def test_latex_of_an_element_and_of_a_mechanism() -> None:
    body = mechanism.body(slider)
    assert latex(friction(D.coordinate, viscous=b, on=body)) == (
        r"\begin{aligned} \text{viscous} &: b \\ \text{effort} &: -b \dot{s}_{D} \\ \text{rate} &: \dot{s}_{D} "
        r"\end{aligned}"
    )
    assert latex(assemble([D])) == r"\begin{aligned} \text{coordinates} &: \left(s_{D}\right) \end{aligned}"
    assert latex(mechanism).count("&:") == 3


def test_latex_of_words_and_formulas() -> None:
    assert latex(C) == (
        r"\begin{aligned} \text{parent} &: \text{rod} \\ \text{at} &: \mathrm{Trans}\left(l, 0, 0\right)\,"
        r"\mathrm{Rot}_{z}\left(b\right) \\ \text{child} &: \text{slider} "
        r"\\ \text{to} &: \left(0, 0, 0\right) \\ \text{loop} &: \text{closes a loop} \\ \text{coordinate phi} &: "
        r"\phi_{C} \\ \text{motion} &: \mathrm{Rot}_{z}\left(\phi_{C}\right) \end{aligned}"
    )
    assert latex(mechanism.joint(C)).endswith(
        r"\text{force y} &: \left(0, 1, 0\right)\ \text{in the axes of}\ \text{ground} \end{aligned}"
    )


def test_a_gear_shows_its_radii_and_where_it_meshes() -> None:
    axle, shaft = revolute("P", ground, crank), revolute("Q", ground, rod, at=(a - b, 0, 0))
    placed = assemble([axle, shaft, gear("G", axle, shaft, a, b, internal=True)]).joint("G")
    assert describe(placed).splitlines()[5:] == [
        "    radius1: a",
        "    radius2: b",
        "    constraint G.mesh: a*phi_P - b*phi_Q = 0",
        "    force mesh: (0, -1, 0) in the axes of ground",
        "    force at: (a, 0, 0) in the axes of ground",
    ]


def test_parts_of_joints_and_events_have_short_names() -> None:
    happened = Occurrence(Event(a - b, name="landing"), 0.25, {a: 1.0, b: 1.0})
    condition = mechanism.joint(D).closures[0]
    assert repr([A.limits[0], condition, happened]) == (
        "[Limit(phi from None to 2), Closure(y, 0 = 0), Occurrence(landing at t = 0.25)]"
    )


def test_motions_are_written_as_in_textbooks() -> None:
    x, y, z = functions_of_time("x y z")
    tilted, turned = rotate((sqrt(3) / 2, 0, number(1) / 2), a), rotate("Y", b)
    for k in range(12):
        turned = turned * rotate("XY"[k % 2], a)
    for frame, expected in (
        (tilted, r"\mathrm{Rot}_{\left(\frac{\sqrt{3}}{2}, 0, \frac{1}{2}\right)}\left(a\right)"),
        (
            moving_frame(a, 0, 0, 0, 0, b, name="car") * translate(l, 0, 0),
            r"\text{car}\,\mathrm{Trans}\left(l, 0, 0\right)",
        ),
        (floating_frame(), r"\mathrm{Floating}\left(\right)"),
        (
            Frame([[x, -y, 0, z], [y, x, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
            r"\begin{bmatrix} x & -y & 0 & z \\",
        ),
        (turned, r"\text{Frame(13 motions from ground)}"),
    ):
        assert latex(Chain(frame)).startswith(expected)


def test_a_long_reaction_is_shown_at_once_and_without_symbols_that_cancel() -> None:
    """At the foot of a chain about one point, the terms of the first acceleration cancel along its axis."""
    links = [Link(f"L{k}", 1, 0.01, 0.02, 0.02, center=(0.1, 0, 0)) for k in range(12)]
    parts = zip([ground, *links], links, strict=False)
    joints = [
        revolute(f"J{k}", parent, child, at=(0.2 * bool(k), 0, 0), axis="ZY"[k % 2])
        for k, (parent, child) in enumerate(parts)
    ]
    system = assemble(joints).system(gravity=Vector(ground, 0, 0, -g))
    found = reaction(newton_euler(system), joints[0])
    shared, last = describe(found).split("\n    Fx: ")
    assert "phi_J0''" in str(found.force.components[2])
    assert "\n    z1 = " in shared
    assert len(last.splitlines()) == 6
    assert " operations)</td>" in found._repr_html_()


def test_long_values_are_indented_and_long_couples_counted() -> None:
    total = sum(symbols("a1:21"))
    lines = describe(Link("far", m, center=(total, 2 * total, 0))).splitlines()
    assert lines[1] == "    centre of mass: ("
    assert [line[:8] for line in lines[2:4]] == [" " * 8] * 2
    assert lines[5:7] == ["    )", "    mass: m"]
    arm, bar = Link("arm", m), Link("bar", m)
    joints = [
        spherical("S", ground, arm),
        spherical("T", ground, bar, at=(a, 0, 0)),
        universal("U", arm, bar, at=(b, 0, 0), to=(0, l, 0), loop=True),
    ]
    couple = describe(assemble(joints).joint("U")).splitlines()[-1]
    assert couple == "    moment about z: (59 operations) in the axes of arm * translate(b, 0, 0)"
